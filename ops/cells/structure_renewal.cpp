// A structure that begins with the present object of another one.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ops/cells/cell_order.hpp"
#include "ops/cells/cone_parts.hpp"
#include "ops/cells/structure.hpp"
#include "sparse/archive_memory.hpp"
#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

/// The cells of the object, each after its faces, and among those of a dimension by age.
std::vector<CellId> cells_of_object(const Structure& structure) {
  structure.lazy().make_all();
  std::vector<CellId> cells;
  structure.cells().for_each_node([&](CellId c) {
    if (structure.is_current(c) && !structure.lazy().is_consumed(c)) {
      cells.push_back(c);
    }
  });
  sort_by_dimension_and_age(structure, cells);
  return with_parts(structure, cells);
}

}  // namespace

/// What one structure takes over from another.
class Structure::Renewal {
 public:
  Renewal(Structure& to, const Structure& from) : to_{to}, from_{from} {}

  void take_knowledge();
  void take_bodies();
  void take_cells();
  void take_body_names();
  void take_names_since(LinkId links);
  void take_abstract();
  void take_darts();

 private:
  void take_name_of(CellId old);
  /// The name of a node, and of its body if that is called so. `old`: a current cell of that body.
  void add_name(const std::string& name, CellId node, CellId old);
  [[nodiscard]] BodyId body(CellId old) const { return bodies_.at(from_.body_of(old)); }
  /// Questions on the way may make orders that were not known when knowledge was taken.
  [[nodiscard]] OrderId renewed(OrderId order) const { return to_.maps().taken_from(from_.maps(), order); }
  [[nodiscard]] Value renewed(const Value& value) const {
    const CellId cell = cells_.at(value.cell);
    const OrderId order = renewed(value.order);
    const bool is_of_map = from_.types().info(value.type).shape != nullptr;
    return {cell, is_of_map ? to_.maps().seen_through(order, to_.cells().type_id(cell)) : value.type, value.collapsed,
            order};
  }
  /// A node with faces; `face(k)`: a value of the new structure.
  template <class Face>
  CellId add_node(TypeId type, BodyId body, Face&& face);

  Structure& to_;
  const Structure& from_;
  std::unordered_map<BodyId, BodyId> bodies_;
  std::unordered_map<CellId, CellId> cells_;
};

/// Types and orders keep their numbers.
void Structure::Renewal::take_knowledge() {
  std::vector<char> bytes;
  sparse::ArchiveWriter writer(sparse::sink_into(bytes));
  from_.types().save(writer);
  from_.maps().save(writer);
  const Status written = writer.finish();
  sparse::ArchiveReader reader(sparse::source_of(bytes), bytes.size());
  to_.types().load(reader);
  to_.maps().load(reader);
  sparse::expects(written && reader.is_good(), "types and orders are read as they are written");
}

void Structure::Renewal::take_bodies() {
  for (const BodyId old : from_.bodies_.current()) {
    bodies_.emplace(old, to_.bodies_.add(from_.bodies_.kind(old)));
  }
}

template <class Face>
CellId Structure::Renewal::add_node(TypeId type, BodyId body, Face&& face) {
  const auto arity = static_cast<std::uint32_t>(to_.types().info(type).faces.size());
  std::vector<Incidence> faces;
  for (std::uint32_t k = 0; k < arity; ++k) {
    faces.push_back(to_.values_.incidence_of(face(k)));
  }
  const CellId node = to_.cells_.add(type, to_.directory_.names().size(), body);
  to_.forest_.add(node);
  for (const auto& [cell, order] : faces) {
    to_.cells_.add_face(cell, order);
  }
  to_.bodies_.add_cells(body, {node, node + 1});
  return node;
}

void Structure::Renewal::take_cells() {
  for (const CellId old : cells_of_object(from_)) {
    const BodyId of = body(old);
    const CellId cell = add_node(from_.cells_.type_id(old), of,
                                 [&](std::uint32_t k) { return renewed(from_.values_.face_of_cell(old, k)); });
    cells_.emplace(old, cell);
    add_name(from_.name(old), cell, old);
    if (const OrderId order = from_.directory_.named_value(old).order; order != same_order) {
      to_.directory_.set_order(cell, renewed(order));
    }
    to_.count(cell, 1);
  }
}

void Structure::Renewal::add_name(const std::string& name, CellId node, CellId old) {
  const BodyId of = body(old);
  const bool is_of_body = !to_.bodies_.is_named(of) && name == from_.directory_.name_of_body(from_.body_of(old));
  if (is_of_body) {
    to_.bodies_.set_name(of, to_.directory_.names().size());
  }
  to_.directory_.add(name, node, is_of_body ? of : BodyId{none});
}

/// Those that are no names of cells.
void Structure::Renewal::take_body_names() {
  for (const BodyId old : from_.bodies_.current()) {
    const BodyId of = bodies_.at(old);
    if (!to_.bodies_.is_named(of)) {
      to_.bodies_.set_name(of, to_.directory_.names().size());
      to_.directory_.add(from_.directory_.name_of_body(old), none, of);
    }
  }
}

/// Those of cells that have become others since, or are called by another name since they are others as well.
void Structure::Renewal::take_names_since(LinkId links) {
  for (LinkId link = links; link < from_.forest_.links(); ++link) {
    const CellId removed = from_.forest_.removed(link);
    take_name_of(removed);
    if (const CellId survivor = from_.forest_.parent(removed); survivor != none) {
      take_name_of(survivor);
    }
  }
}

/// As that of a node that has become what the other one has: so a name keeps its order.
void Structure::Renewal::take_name_of(CellId old) {
  const Value value = from_.values_.of(old);
  if (is_asked_for(old) || !cells_.contains(value.cell)) {
    return;
  }
  const std::string name = from_.directory_.own_name(old);
  if (to_.directory_.find(name)) {
    return;
  }
  const Value is_now = renewed(value);
  const CellId node = add_node(from_.cells_.type_id(old), to_.cells_.body(is_now.cell),
                               [&](std::uint32_t k) { return to_.values_.face(is_now, k); });
  add_name(name, node, value.cell);
  if (const OrderId order = from_.directory_.order_of_own_name(old); order != same_order) {
    to_.directory_.set_order(node, renewed(order));
  }
  to_.forest_.begin_step();
  if (is_now.is_degenerate()) {
    to_.forest_.link_squashed(node, is_now);
  } else {
    to_.forest_.link(node, is_now.cell, is_now.order, to_.maps().sign(is_now.order), is_now.cell);
  }
}

/// Maps of which something is left keep their names, as far as they are still names of bodies or cells.
void Structure::Renewal::take_darts() {
  const auto name = [&](std::uint32_t number) {
    const std::string& text = from_.directory_.names()[number].text;
    const std::uint32_t known = to_.directory_.names().number_of(text);
    if (known != none) {
      return known;
    }
    to_.directory_.add(text, none, none);
    return to_.directory_.names().size() - 1;
  };
  const auto is_cell = [&](const std::string& text) {
    const std::uint32_t number = to_.directory_.names().number_of(text);
    return number != none && to_.directory_.names()[number].cell != none;
  };
  const auto is_called_after = [&](const DartStore::Made& map, int i, Dart local) {
    const std::string& text = from_.directory_.names()[map.name].text;
    const bool is_face = i == 2 && local == 0 && is_cell(text);  // of a polygon
    return is_face || (!map.has_levels() && is_cell(fmt::format("{}.{}:{}", text, i, dart_text(map, local))));
  };
  const auto seen = [&](const DartStore::Made& map, int i, Dart dart) {
    const auto saw = seen_from_dart(from_, map, i, dart);
    const Value value = saw ? from_.values_.normal_form(*saw) : Value{};
    const bool is_there = saw && !value.is_degenerate() && cells_.contains(value.cell);
    if (!is_there) {
      return DartCells::Seen{UINT32_MAX, 0};
    }
    const bool is_cone = ops::is_cone(from_.cells().type(value.cell).type);
    return DartCells::Seen{cells_.at(value.cell),
                           is_cone ? from_.darts_.seen(map, i, dart).dart : from_.maps().dart_of(value.order)};
  };
  to_.darts_.begin_with(from_.darts_, {name, seen, is_called_after});
}

/// Vertices that are there, by the labels that they are called by.
void Structure::Renewal::take_abstract() {
  const auto is_abstract = [&](CellId old, CellId cell) {
    return from_.abstract_.contains(old) && to_.bodies_.kind(to_.cells_.body(cell)).is_abstract;
  };
  std::vector<std::pair<CellId, CellId>> simplices;
  for (const auto& [old, cell] : cells_) {
    if (is_abstract(old, cell)) {
      simplices.emplace_back(cell, old);
    }
  }
  std::sort(simplices.begin(), simplices.end());
  std::unordered_map<VertexId, VertexId> vertices;
  for (const auto& [cell, old] : simplices) {
    std::vector<VertexId> renewed;
    for (const VertexId vertex : from_.abstract_.vertices(old)) {
      const auto [at, is_new] = vertices.try_emplace(vertex);
      if (is_new) {  // its own simplex comes first
        const LabelId label = to_.abstract_.add_label(from_.abstract_.text(from_.abstract_.label_of(vertex)));
        at->second = VertexId{std::uint32_t{label}};
      }
      renewed.push_back(at->second);
    }
    to_.abstract_.include(cell, renewed);
  }
}

void Structure::begin_with(const Structure& other, LinkId names_since) {
  sparse::expects(cells_.size() == 0 && bodies_.size() == 0, "only what is empty begins with another object");
  Renewal renewal(*this, other);
  renewal.take_knowledge();
  renewal.take_bodies();
  renewal.take_cells();
  renewal.take_names_since(names_since);
  renewal.take_body_names();
  renewal.take_abstract();
  renewal.take_darts();
  journal_.clear();
}

}  // namespace sesame::ops

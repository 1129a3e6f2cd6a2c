// Insertions into abstract simplicial complexes.
#include <fmt/format.h>

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <compare>
#include <functional>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ops/plan/missing_simplices.hpp"
#include "ops/plan/new_cells.hpp"
#include "ops/plan/operation_plans.hpp"
#include "ops/plan/step_names.hpp"
#include "sparse/hash_index.hpp"
#include "sparse/quoted.hpp"

namespace sesame::ops {
namespace {

bool comes_before(std::string_view a, std::string_view b) { return std::is_lt(compare_labels(a, b)); }

/// What there is one of for each vertex of a simplex: of small simplices without an allocation.
template <class T>
using PerVertex = boost::container::small_vector<T, 6>;
/// A simplex: the positions of its vertices among the labels of an insertion, ascending.
using Positions = std::span<const std::uint32_t>;

std::span<const VertexId> as_span(const PerVertex<VertexId>& vertices) { return {vertices.data(), vertices.size()}; }

/// A label of the simplices to insert, with what it denotes.
struct Label {
  std::string_view text;
  VertexId vertex;  ///< or the number that it will have
  BodyId body;      ///< of a vertex that is there, or was and has been removed
};

/// Works out which of some simplices and of their faces are missing, and lays them out.
class InsertPlanner {
 public:
  /// `labels` are those of all simplices, sorted, none twice.
  InsertPlanner(const Structure& structure, std::span<const Label> labels) : structure_{structure}, labels_{labels} {}

  /// False when it is there already, or was added before. To be called for all before `add_faces`.
  bool add(Positions simplex) {
    while (layers_.size() < simplex.size()) {
      layers_.emplace_back(layers_.size() + 1);
    }
    MissingSimplices& missing = layers_[simplex.size() - 1].simplices;
    const std::uint64_t hash = MissingSimplices::hash_of(simplex);
    if (missing.find(simplex, hash) != MissingSimplices::nothing) {
      return false;
    }
    const PerVertex<VertexId> vertices = vertices_of(simplex);
    if (std::none_of(vertices.begin(), vertices.end(), [this](VertexId v) { return is_new(v); }) &&
        structure_.abstract().find(as_span(vertices)) != none) {
      return false;
    }
    missing.add(simplex, hash);
    ++count_;
    return true;
  }

  /// Adds the faces that are missing. False when there are more than `most` cells then; some are left out in that case.
  /// Goes down by dimension: the faces of a simplex that is there are there.
  bool add_faces(std::int64_t most) {
    for (std::size_t p = layers_.size(); p-- > 1;) {
      for (std::uint32_t number = 0; number < layers_[p].simplices.size(); ++number) {
        add_faces_of(p, number);
        if (count_ > most) {
          return false;
        }
      }
    }
    return count_ <= most;
  }

  [[nodiscard]] bool has_nothing_to_do() const { return count_ == 0; }
  [[nodiscard]] std::string name(Positions simplex) const {
    std::string text;
    write_name(simplex, text);
    return text;
  }

  /// Requires: some cells are missing. Errors: the name of a missing cell is in use. Then the plan is not to be used.
  Status write(Plan& plan) {
    AbstractChange& change = plan.abstract.emplace();
    plan.first = structure_.cells().size();
    CellId next = plan.first;
    const bool are_free = is_free_beginning("{", structure_, static_cast<std::size_t>(count_));
    for (std::size_t p = 0; p < layers_.size(); ++p) {
      Layer& layer = layers_[p];
      const TypeId type = structure_.types().simplex(static_cast<int>(p));
      layer.cells.resize(layer.simplices.size());
      const bool has_order = layer.simplices.size() > 1;  // else no list is made
      const std::vector<std::uint32_t> order = has_order ? layer.simplices.sorted() : std::vector<std::uint32_t>{};
      for (std::uint32_t k = 0; k < layer.simplices.size(); ++k) {
        const std::uint32_t number = has_order ? order[k] : k;
        const Positions simplex = layer.simplices[number];
        const std::size_t first_face = plan.faces.size();
        const std::size_t first_of_name = plan.names.size();
        layer.cells[number] = next++;
        if (p > 0) {
          write_faces(p, number, plan);
        }
        for (const std::uint32_t position : simplex) {
          change.vertices.push_back(labels_[position].vertex);
        }
        write_name(simplex, plan.names);
        if (const auto own = std::string_view{plan.names}.substr(first_of_name); !are_free && is_taken(own)) {
          return Error{
              Errc::bad_input,
              fmt::format("the name \"{}\", which a new cell would have, is in use: choose other labels", own)};
        }
        add_cell(type, first_face, plan);
        if (p == 0 && is_new(labels_[simplex[0]].vertex)) {
          change.labels.emplace_back(labels_[simplex[0]].text);
        }
      }
    }
    write_bodies(plan);
    return Done{};
  }

 private:
  /// A face of a missing simplex: a cell in an order; or no cell, and a number in the layer below.
  struct Face {
    CellId cell;
    OrderId order;
    std::uint32_t number;
  };
  /// The missing simplices of a dimension.
  struct Layer {
    explicit Layer(std::size_t vertices) : simplices{vertices} {}
    MissingSimplices simplices;
    boost::container::small_vector<Face, 4> faces;    ///< of one simplex after the other; of vertices there are none
    boost::container::small_vector<CellId, 2> cells;  ///< that they will be
  };

  [[nodiscard]] PerVertex<VertexId> vertices_of(Positions simplex) const {
    PerVertex<VertexId> vertices;
    for (const std::uint32_t position : simplex) {
      vertices.push_back(labels_[position].vertex);
    }
    return vertices;
  }
  /// {a,b,...}
  void write_name(Positions simplex, std::string& out) const {
    char before = '{';
    for (const std::uint32_t position : simplex) {
      out.append(1, std::exchange(before, ',')).append(labels_[position].text);
    }
    out += '}';
  }
  /// Whether a missing simplex cannot have its name. Without a star and a point that is read as one that was given, or
  /// as this simplex. A simplex that was removed may come again.
  [[nodiscard]] bool is_taken(std::string_view name) const {
    const NameTable::Name* given = structure_.directory().names().find(name);
    if (given != nullptr && given->cell != none && structure_.abstract().contains(given->cell) &&
        is_deleted(structure_.forest(), structure_.values().of(given->cell).cell)) {
      return false;
    }
    return given != nullptr || (name.find_first_of("*.") != std::string_view::npos && structure_.is_name_taken(name));
  }
  [[nodiscard]] bool is_new(VertexId vertex) const { return vertex >= structure_.abstract().labels(); }

  void add_faces_of(std::size_t p, std::uint32_t number) {
    MissingSimplices& below = layers_[p - 1].simplices;
    const Positions simplex = layers_[p].simplices[number];
    const std::uint64_t hash = MissingSimplices::hash_of(simplex);
    const PerVertex<VertexId> vertices = vertices_of(simplex);
    const auto news = std::count_if(vertices.begin(), vertices.end(), [this](VertexId v) { return is_new(v); });
    for (std::size_t k = 0; k <= p; ++k) {
      const std::uint64_t hash_of_face = hash - MissingSimplices::word(simplex[k]);
      Face face{none, same_order, below.find_face(simplex, k, hash_of_face)};
      if (face.number == MissingSimplices::nothing) {
        if (news == 0 || (news == 1 && is_new(vertices[k]))) {
          find_face(vertices, k, face);
        }
        if (face.cell == none) {
          face.number = below.add_face(simplex, k, hash_of_face);
          ++count_;
        }
      }
      layers_[p].faces.push_back(face);
    }
  }

  /// The face of vertices that are there, if it is.
  void find_face(const PerVertex<VertexId>& vertices, std::size_t without, Face& face) const {
    PerVertex<VertexId> order = vertices;
    order.erase(order.begin() + static_cast<std::ptrdiff_t>(without));
    face.cell = structure_.abstract().find(as_span(order));
    if (face.cell != none) {
      const std::span<const VertexId> own = structure_.abstract().vertices(face.cell);
      face.order =
          std::ranges::equal(own, order) ? same_order : structure_.maps().order(places_in(own, as_span(order)));
    }
  }

  /// The new cells join the bodies of the vertices that they have and make these one, or make a body.
  void write_bodies(Plan& plan) const {
    PerVertex<bool> is_used(labels_.size(), false);
    for (const Layer& layer : layers_) {
      for (std::uint32_t number = 0; number < layer.simplices.size(); ++number) {
        for (const std::uint32_t position : layer.simplices[number]) {
          is_used[position] = true;
        }
      }
    }
    std::set<BodyId> bodies;
    for (std::size_t position = 0; position < labels_.size(); ++position) {
      if (is_used[position] && !is_new(labels_[position].vertex)) {
        bodies.insert(labels_[position].body);
      }
    }
    if (bodies.empty()) {
      plan.new_body = fmt::format("{{{}}}", plan.abstract->labels.front());
    } else {
      join_bodies(bodies, plan);
    }
  }

  void write_faces(std::size_t p, std::uint32_t number, Plan& plan) const {
    const Layer& layer = layers_[p];
    for (std::size_t k = 0; k <= p; ++k) {
      const Face& face = layer.faces[(p + 1) * number + k];
      add_face({face.cell != none ? face.cell : layers_[p - 1].cells[face.number], face.order}, plan);
    }
  }

  const Structure& structure_;
  std::span<const Label> labels_;
  boost::container::small_vector<Layer, 3> layers_;  ///< by dimension
  std::int64_t count_ = 0;                           ///< of all missing simplices
};

/// That it is checked as: a vertex is as small as an edge.
CellType type_of(NameLists::List simplex) { return {std::max(1, static_cast<int>(simplex.size()) - 1)}; }

Status check_simplex(NameLists::List simplex, const Limits& limits) {
  if (simplex.empty()) {
    return Error{Errc::bad_input,
                 "a simplex has at least one vertex: it should be a list of labels, such as [\"a\",\"b\"]"};
  }
  for (const std::string_view label : simplex) {
    if (!is_label(label)) {
      return Error{Errc::bad_input,
                   fmt::format("{} is not a label: a label is not empty, and has no white space, no control "
                               "characters, and none of {{ }} and comma",
                               sparse::quoted(label))};
    }
  }
  if (Status s = check_size(type_of(simplex), limits); !s) {
    return s;
  }
  PerVertex<std::string_view> labels(simplex.begin(), simplex.end());
  std::sort(labels.begin(), labels.end());
  if (const auto twice = std::adjacent_find(labels.begin(), labels.end()); twice != labels.end()) {
    return Error{Errc::bad_input,
                 fmt::format("the label {} stands twice in the simplex: labels must differ", sparse::quoted(*twice))};
  }
  return Done{};
}

/// The labels of all simplices.
struct Labels {
  PerVertex<Label> sorted;               ///< none twice, as views of the operation
  std::vector<std::uint32_t> positions;  ///< of those of one simplex after the other, ascending in each
};

/// Numbers the labels of simplices as they come. Of many simplices those of a few are all, so they are checked once.
class LabelCollector {
 public:
  LabelCollector(const Limits& limits, bool is_one) : limits_{limits}, is_one_{is_one} {}

  /// Errors: for a list that is no simplex.
  Status add(NameLists::List simplex) {
    const std::size_t begin = numbers.size();
    if (is_one_) {
      for (const std::string_view label : simplex) {
        add_number(label);
      }
      return check_simplex(simplex, limits_);
    }
    for (const std::string_view label : simplex) {
      const std::uint64_t hash = std::hash<std::string_view>{}(label);
      const std::uint32_t known = met_.find(hash, [&](std::uint32_t k) { return texts[k] == label; });
      if (known != none) {
        numbers.push_back(known);
      } else if (is_label(label)) {
        met_.insert(hash, static_cast<std::uint32_t>(texts.size()));
        add_number(label);
      } else {
        return check_simplex(simplex, limits_);
      }
    }
    bool is_right = !simplex.empty() && check_size(type_of(simplex), limits_);
    for (auto at = numbers.begin() + static_cast<std::ptrdiff_t>(begin); is_right && at != numbers.end(); ++at) {
      is_right = std::find(at + 1, numbers.end(), *at) == numbers.end();
    }
    return is_right ? Status{Done{}} : check_simplex(simplex, limits_);
  }

  PerVertex<std::string_view> texts;
  std::vector<std::uint32_t> numbers;  ///< of the labels of one simplex after the other

 private:
  void add_number(std::string_view label) {
    numbers.push_back(static_cast<std::uint32_t>(texts.size()));
    texts.push_back(label);
  }

  const Limits& limits_;
  bool is_one_;  ///< a simplex, whose labels differ
  sparse::HashIndex met_;
};

/// Errors: for a list that is no simplex, and for a label of a vertex that no insertion may touch.
Result<Labels> labels_of(const Insert& operation, const Structure& structure, const Limits& limits) {
  LabelCollector collector(limits, operation.simplices.size() == 1);
  for (const NameLists::List simplex : operation.simplices) {
    if (Status s = collector.add(simplex); !s) {
      return s.error();
    }
  }
  PerVertex<std::uint32_t> order(collector.texts.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&collector](std::uint32_t a, std::uint32_t b) {
    return comes_before(collector.texts[a], collector.texts[b]);
  });
  Labels labels{{}, std::move(collector.numbers)};
  PerVertex<std::uint32_t> position_of(order.size());
  VertexId next{structure.abstract().labels()};
  for (const std::uint32_t number : order) {
    position_of[number] = static_cast<std::uint32_t>(labels.sorted.size());
    Label& label = labels.sorted.emplace_back(Label{collector.texts[number], none, none});
    const LabelId known = structure.abstract().label(label.text);
    const auto body = known == none ? Result<BodyId>{none} : abstract_body(known, structure);
    if (!body) {
      return body.error();
    }
    label.body = *body;
    label.vertex = known == none ? next++ : structure.abstract().vertex(known);
  }
  auto begin = labels.positions.begin();
  for (const NameLists::List simplex : operation.simplices) {
    const auto end = begin + static_cast<std::ptrdiff_t>(simplex.size());
    std::transform(begin, end, begin, [&](std::uint32_t number) { return position_of[number]; });
    std::sort(begin, end);
    begin = end;
  }
  return labels;
}

}  // namespace

Status plan_insertion(const Insert& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  const Result<Labels> labels = labels_of(operation, structure, limits);
  if (!labels) {
    return labels.error();
  }
  InsertPlanner planner(structure, {labels->sorted.data(), labels->sorted.size()});
  Positions rest{labels->positions};
  for (const NameLists::List simplex : operation.simplices) {
    const Positions positions = rest.first(simplex.size());
    rest = rest.subspan(simplex.size());
    if (planner.add(positions)) {
      continue;
    }
    if (!operation.exist_ok) {
      return Error{Errc::refused, fmt::format("the simplex {} is there already, which \"exist_ok\":true would allow",
                                              planner.name(positions))};
    }
    ++plan.already;
  }
  if (planner.has_nothing_to_do()) {
    return Done{};
  }
  const std::int64_t room = std::min(limits.cells_per_step, limits.cells - std::int64_t{structure.cells().size()});
  if (!planner.add_faces(room)) {
    return Error{Errc::refused,
                 fmt::format("this step would make more than {} cells, as many as there is room for", room)};
  }
  return planner.write(plan);
}

}  // namespace sesame::ops

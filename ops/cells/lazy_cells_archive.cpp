// Cells of lazy families, to and from archives.
#include <algorithm>

#include "ops/cells/lazy_cells.hpp"

namespace sesame::ops {

void LazyCells::save(sparse::ArchiveWriter& to) const {
  to.put(static_cast<std::uint64_t>(families_.size()));
  for (const LazyFamily& family : families_) {
    to.put(family.kind);
    to.put(std::string_view{family.name});
    to.put_list(family.bodies);
    to.put(family.by_edges);
    to.put(family.apex);
    to.put(family.first);
    to.put(family.links);
    to.put(family.body);
    to.put_list(family.counts);
  }
  for (const LazyCell& cell : lazy_cells_) {  // their faces follow
    to.put(cell.key.family);
    to.put(cell.key.part);
    for (const Value& v : {cell.key.left, cell.key.right}) {
      to.put(v.cell);
      to.put(v.type);
      to.put(v.collapsed);
      to.put(v.order);
    }
  }
}

void LazyCells::load(sparse::ArchiveReader& from, std::uint32_t most_nested) {
  constexpr std::size_t least_bytes_of_family = 42;
  for (std::size_t left = from.get_count(least_bytes_of_family); left > 0 && from.is_good(); --left) {
    load_family(from, most_nested);
  }
  for (CellId node = asked_node(0); node < cells_.asked() && from.is_good(); ++node) {
    if (cells_.lazy(node) != none) {
      load_cell(from, node);
    }
  }
}

void LazyCells::load_family(sparse::ArchiveReader& from, std::uint32_t most_nested) {
  LazyFamily family;
  family.kind = from.get<FamilyKind>();
  family.name = from.get_text();
  family.bodies = from.get_list<std::vector<BodyId>>();
  family.by_edges = from.get_bool();
  family.apex = from.get<CellId>();
  family.first = from.get<CellId>();
  family.links = from.get<LinkId>();
  family.body = from.get<BodyId>();
  family.counts = from.get_list<std::vector<std::uint64_t>>();
  const auto is_inside = [&](BodyId body) {
    return body < bodies_.size() && bodies_.nesting(body) < bodies_.nesting(family.body);
  };
  const bool is_cone = family.kind == FamilyKind::cone;
  from.check(family.kind <= FamilyKind::map_product && family.body < bodies_.size() &&
                 bodies_.nesting(family.body) <= most_nested && bodies_.made(family.body).family == families() &&
                 std::all_of(family.bodies.begin(), family.bodies.end(), is_inside) &&
                 (is_cone ? family.apex < cells_.size() && cells_.dimension(family.apex) == 0
                          : family.bodies.size() == 2 && family.apex == none) &&
                 family.first <= cells_.size() && family.links <= forest_.links() &&
                 family.counts.size() <= largest_dimension + 1,
             "a family is one of bodies that were there before it");
  if (from.is_good()) {
    add_family(family);
  }
}

/// Whether a value is one of a current cell of a body that a family is made of.
bool LazyCells::is_part(const Value& v, FamilyId of) const {
  const LazyFamily& family = families_[of];
  if (!cells_.contains(v.cell) || !forest_.is_current(v.cell) || !maps_.is_value_of(v, cells_.type_id(v.cell))) {
    return false;
  }
  if (is_asked_for(v.cell)) {
    const std::uint32_t number = cells_.lazy(v.cell);
    if (number == none || number >= lazy_cells_.size() || lazy_cells_[number].key.family >= of) {
      return false;
    }
  } else if (v.cell >= family.first) {
    return false;
  }
  const BodyId body = bodies_.find(cells_.body(v.cell));
  return std::any_of(family.bodies.begin(), family.bodies.end(),
                     [&](BodyId each) { return bodies_.find(each) == body; });
}

/// Whether a cell of a type can be the one that a key describes.
bool LazyCells::is_sound(const LazyKey& key, TypeId type) const {
  if (key.family >= families_.size() || !is_part(key.left, key.family)) {
    return false;
  }
  const LazyFamily& family = families_[key.family];
  CellType expected = types_.info(key.left.type).type;
  switch (key.part) {
    case LazyPart::coned:
      if (family.by_edges) {
        expected.push_back(1);
      } else if (!is_simplex(expected)) {
        return false;
      } else {
        expected = {types_.info(key.left.type).dimension + 1};
      }
      [[fallthrough]];
    case LazyPart::base:
      return family.kind == FamilyKind::cone && key.left.is_plain() && key.right == Value{} &&
             types_.info(type).type == expected;
    case LazyPart::pair:
      break;
  }
  if (key.part != LazyPart::pair || family.kind == FamilyKind::cone || !is_part(key.right, key.family)) {
    return false;
  }
  if (family.kind == FamilyKind::simplicial_product) {
    return type == key.left.type && type == key.right.type && is_simplex(expected) && key.left.order == same_order &&
           key.right.order == same_order && (key.left.collapsed & key.right.collapsed) == 0;
  }
  if (family.kind == FamilyKind::map_product) {
    return key.left.is_plain() && key.right.is_plain() && ProductTypes::is_factor(types_.info(key.left.type)) &&
           ProductTypes::is_factor(types_.info(key.right.type)) &&
           ProductTypes::is_possible(types_, key.left.type, key.right.type) &&
           products_.of(key.left.type, key.right.type).type == type;
  }
  const CellType& right = types_.info(key.right.type).type;
  expected.insert(expected.end(), right.begin(), right.end());
  return key.left.is_plain() && key.right.is_plain() && types_.info(type).type == expected;
}

void LazyCells::load_cell(sparse::ArchiveReader& from, CellId node) {
  LazyKey key{};
  key.family = from.get<FamilyId>();
  key.part = from.get<LazyPart>();
  for (Value* v : {&key.left, &key.right}) {
    v->cell = from.get<CellId>();
    v->type = from.get<TypeId>();
    v->collapsed = from.get<Degeneracy>();
    v->order = from.get<OrderId>();
  }
  if (from.check(cells_.lazy(node) == lazy_cells_.size() && is_sound(key, cells_.type_id(node)) &&
                     cells_.body(node) == families_[key.family].body && index_.emplace(key, node).second,
                 "a cell of a family is made of cells that were there before it")) {
    lazy_cells_.push_back({key});
    made_[key.family].push_back(node);
  }
}

}  // namespace sesame::ops

#include "ops/cells/name_reader.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <string>
#include <utility>

#include "ops/cells/dart_simplices.hpp"

namespace sesame::ops {

std::optional<Value> NameReader::read() { return read({0, text_.size()}); }

std::optional<Directory::Named> NameReader::find(Part part) const {
  return hashes_ ? structure_.directory().find(text(part), *hashes_, part.begin)
                 : structure_.directory().find(text(part));
}

/// Whether a name with odd brackets is part of this one, or that would take long to find out.
bool NameReader::contains_odd_name() const {
  constexpr std::size_t most = 64;
  const auto odd = structure_.directory().odd_names();
  return structure_.directory().count_of_odd_names() > most ||
         std::any_of(odd.begin(), odd.end(), [this](std::uint32_t number) {
           return text_.find(structure_.directory().names()[number].text) != std::string_view::npos;
         });
}

std::optional<Value> NameReader::read(Part part) {
  if (!tries_all_bars_) {
    return read_once(part);
  }
  const std::uint64_t looked_up = structure_.directory().looked_up() - looked_up_before_;
  if (++readings_ + looked_up > 16 * text_.size() + 500) {
    failure_ = Failure::ambiguous;
    return std::nullopt;
  }
  const auto [known, is_new] = known_.try_emplace(std::uint64_t{part.begin} << 32U | part.end);
  if (is_new) {
    std::optional<Value>& value = known->second;  // stays where it is
    value = read_once(part);
  }
  return known->second;
}

std::optional<Value> NameReader::read_once(Part part) {
  if (structure_.darts().maps() > 0) {  // whose darts may see other cells than those that were called after them
    if (auto cell = read_seen(part)) {
      return cell;
    }
  }
  if (const auto named = find(part); named && named->cell != none) {
    return given(named->cell);
  }
  if (const auto simplex = structure_.abstract().find_named(text(part))) {
    const TypeId type = structure_.types().simplex(static_cast<int>(simplex->places.size()) - 1);
    return structure_.maps().value_of(simplex->cell, type, simplex->places);
  }
  if (auto cell = structure_.darts().maps() > 0 ? read_seen(part) : std::nullopt) {
    return cell;
  }
  if (auto cell = read_standard(part)) {
    return cell;
  }
  return structure_.cones().size() > 0 || structure_.lazy().families() > 0 ? read_derived(part) : std::nullopt;
}

Value NameReader::given(CellId cell) const { return value_of({cell, structure_.directory().order_of_own_name(cell)}); }

/// t.2-0 or t.0-1-2 for the simplex t on 0, 1, 2; sorted lists of some of the vertices are names that were given.
std::optional<Value> NameReader::read_standard(Part part) {
  const auto split = split_vertices(text(part));
  const auto whole = split ? find({part.begin, part.begin + split->length}) : std::nullopt;
  if (!whole || whole->cell == none || whole->body == none ||  // a complex, for one, has no cell of its name
      !is_simploid(structure_.cells().type(whole->cell).type)) {
    return std::nullopt;
  }
  const auto list = read_vertices(split->vertices, structure_.cells().type(whole->cell).type);
  if (!list) {
    return std::nullopt;
  }
  const std::string base{text_.substr(part.begin, split->length)};
  const auto cell = list->is_whole ? whole : structure_.directory().find(base + "." + list->sorted);
  if (!cell || cell->cell == none) {
    return std::nullopt;
  }
  return structure_.maps().reordered(structure_.maps().order(list->order), given(cell->cell));
}

/// m.1:3, a cell of a map as a dart sees it; that from which it has its own name is one that was given.
std::optional<Value> NameReader::read_seen(Part part) {
  const auto split = split_dart(text(part));
  if (const auto simplex =
          structure_.darts().has_seen_others() ? simplex_named(structure_, text(part)) : std::nullopt) {
    const int index = seen_index(simplex->map->dimension, simplex->numbers);
    return find(part) ? seen_from_dart(structure_, *simplex->map, index, simplex->dart) : std::nullopt;
  }
  if (!split) {  // the face of a polygon is called as that is
    const DartStore::Made* polygon = map_named(structure_, text(part));
    const CellId face = polygon != nullptr ? structure_.directory().names()[polygon->name].cell : CellId{none};
    return face == none ? std::nullopt
                        : seen_from_dart(structure_, *polygon, structure_.dimension(face), polygon->first);
  }
  const DartStore::Made* map = split ? map_named(structure_, text({part.begin, part.begin + split->length})) : nullptr;
  const Dart dart = map != nullptr ? dart_of_text(*map, split->dimension, split->dart) : no_dart;
  if (dart == no_dart || map->is_by_simplices) {
    return std::nullopt;
  }
  return seen_from_dart(structure_, *map, split->dimension, map->first + dart);
}

std::optional<Value> NameReader::read_derived(Part part) {
  TextHash hash;
  for (std::size_t k = part.begin; k < part.end; ++k) {
    if (ends_prefix(text(part), k - part.begin)) {
      const NameTable::Name* name = structure_.directory().names().find(text({part.begin, k}), hash.value());
      const Cone* cone = name != nullptr && name->cell != none ? structure_.cones().from(name->cell) : nullptr;
      const FamilyId product = name != nullptr ? structure_.directory().product_named(*name) : none;
      if (cone != nullptr) {
        return text_[k] == '*' ? read_coned(*cone, {k + 1, part.end}) : std::nullopt;
      }
      if (product != none) {
        return text_[k] == '.' && text_[part.end - 1] == ')' ? read_pair(product, {k + 2, part.end - 1}) : std::nullopt;
      }
    }
    hash.add(text_[k]);
  }
  return std::nullopt;
}

/// One level deeper; false when that is too deep.
bool NameReader::enter() {
  if (depth_ == most_nested) {
    failure_ = Failure::nested;
    return false;
  }
  if (!hashes_) {
    hashes_.emplace(text_);
  }
  ++depth_;
  return true;
}

std::optional<Value> NameReader::read_coned(const Cone& cone, Part base) {
  if (!enter()) {
    return std::nullopt;
  }
  const auto value = read(base);
  --depth_;
  return value ? coned(cone, *value) : std::nullopt;
}

std::optional<Value> NameReader::read_pair(FamilyId product, Part inside) {
  if (!enter()) {
    return std::nullopt;
  }
  if (!brackets_) {
    brackets_.emplace(text_);
    tries_all_bars_ = contains_odd_name();
  }
  std::optional<Value> pair;
  if (tries_all_bars_) {
    for (std::size_t bar = inside.begin; bar < inside.end && !pair && failure_ != Failure::ambiguous; ++bar) {
      pair = text_[bar] == '|' ? read_pair(product, {inside.begin, bar}, {bar + 1, inside.end}) : std::nullopt;
    }
  } else if (const Brackets::Pair* found = brackets_->at(inside.begin - 1);
             found != nullptr && found->close == inside.end && found->bar != Brackets::nowhere) {
    pair = read_pair(product, {inside.begin, found->bar}, {found->bar + 1, inside.end});
  }
  --depth_;
  return pair;
}

std::optional<Value> NameReader::read_pair(FamilyId product, Part left_part, Part right_part) {
  const LazyFamily& family = structure_.lazy().family(product);
  const bool is_simplicial = family.kind == FamilyKind::simplicial_product;
  const auto left = read_factor(left_part, family.bodies[0], is_simplicial);
  const auto right = left ? read_factor(right_part, family.bodies[1], is_simplicial) : std::nullopt;
  if (!right) {
    return std::nullopt;
  }
  if (is_simplicial) {
    return left->type == right->type ? simplicial_pair(product, *left, *right) : std::nullopt;
  }
  return value_of(structure_.lazy().face(product, LazyPart::pair, *left, *right));
}

Value NameReader::value_of(const Incidence& incidence) const {
  const TypeId type = structure_.cells().type_id(incidence.node);
  return {incidence.node, structure_.maps().seen_through(incidence.order, type), 0, incidence.order};
}

/// A simplex of a simplicial product has vertices that increase on both sides. A name may have them in another order.
std::optional<Value> NameReader::simplicial_pair(FamilyId product, const Value& left, const Value& right) const {
  VertexMaps& maps = structure_.maps();
  const VertexMap of_left = maps.map_of(left);
  const VertexMap of_right = maps.map_of(right);
  std::vector<std::uint8_t> increasing(of_left.size());
  std::iota(increasing.begin(), increasing.end(), std::uint8_t{0});
  std::stable_sort(increasing.begin(), increasing.end(), [&](std::uint8_t a, std::uint8_t b) {
    return std::pair{of_left[a], of_right[a]} < std::pair{of_left[b], of_right[b]};
  });
  const OrderId order = maps.order(increasing);
  const Value sorted_left = maps.reordered(order, left);
  const Value sorted_right = maps.reordered(order, right);
  if (sorted_left.order != same_order || sorted_right.order != same_order) {
    return std::nullopt;
  }
  return maps.reordered(maps.inverse(order),
                        value_of(structure_.lazy().face(product, LazyPart::pair, sorted_left, sorted_right)));
}

/// The name of a cell of a factor, in a simplicial product also with collapsed directions after it.
std::optional<Value> NameReader::read_factor(Part part, BodyId body, bool is_simplicial) {
  const BodyId bodies[] = {body};
  if (const auto value = read(part)) {
    if (auto found = in_bodies(*value, bodies)) {
      return found;
    }
  }
  const auto split = is_simplicial ? split_directions(text(part)) : std::nullopt;
  const auto value = split ? read({part.begin, part.begin + split->length}) : std::nullopt;
  const auto found = value ? in_bodies(*value, bodies) : std::nullopt;
  if (!found) {
    return std::nullopt;
  }
  const int n = structure_.types().info(found->type).dimension + std::popcount(split->collapsed);
  return n > largest_dimension || split->collapsed >> n != 0
             ? std::nullopt
             : std::optional{
                   structure_.maps().compose({none, structure_.types().simplex(n), split->collapsed}, *found)};
}

std::optional<Value> NameReader::in_bodies(Value value, std::span<const BodyId> bodies) const {
  while (true) {
    const CellId node = value.cell;
    if (structure_.is_current(node) &&
        std::find(bodies.begin(), bodies.end(), structure_.body_of(node)) != bodies.end()) {
      return value;
    }
    if (lineage_.end_of(node) == Lineage::never) {
      return std::nullopt;
    }
    lineage_.advance(value);
  }
}

// -------------------------------------------------------------------------------------------------------------- cones

std::optional<Value> NameReader::coned(const Cone& cone, Value base) const {
  lineage_.advance_until(base, cone.made);
  if (auto value = cone_over(cone, base)) {
    return value;
  }
  // In its own order: two cells may meet when they have become degenerate, and then the order of the name would be
  // lost.
  Value plain = base;
  plain.order = same_order;
  std::optional<Value> first;
  Instant when = 0;
  CellId oldest = none;
  for (const CellId node : lineage_.nodes_that_are(base)) {
    Value itself = structure_.values().plain(node);
    const bool was_current = lineage_.end_of(node) > cone.made;
    if (!was_current || !cone_over(cone, itself)) {
      continue;
    }
    const Lineage::Meeting met = lineage_.meeting(plain, itself);
    const Instant instant = std::max(met.instant, cone.made);
    const CellId called = structure_.forest().oldest_at(node, cone.links);
    if (!first || instant < when || (instant == when && structure_.lazy().is_older(called, oldest))) {
      itself.order = structure_.maps().compose(base.order, met.order);
      first = cone_over(cone, itself);
      when = instant;
      oldest = called;
    }
  }
  return first;
}

/// The cone over a value of the time when the cone was taken, if its cell was coned.
std::optional<Value> NameReader::cone_over(const Cone& cone, const Value& value) const {
  if (cone.family == none) {
    const CellId node = written_cone_over(cone, value.cell);
    if (node == none) {
      return std::nullopt;
    }
    if (!is_simploid(structure_.cells().type(value.cell).type)) {  // known by its boundary: it has one orientation
      return structure_.values().plain(node);
    }
    // The base has its vertices in the order of the name that it had.
    VertexMaps& maps = structure_.maps();
    const auto last = static_cast<std::uint32_t>(structure_.cells().faces(node).size() - 1);
    const OrderId order = maps.inverse(structure_.cells().order(node, last));
    return maps.coned(node, maps.compose(value, {node, structure_.cells().type_id(value.cell), 0, order}),
                      cone.by_edges);
  }
  const std::vector<BodyId>& bodies = structure_.lazy().family(cone.family).bodies;
  if (!structure_.is_current(value.cell) ||
      std::find(bodies.begin(), bodies.end(), structure_.body_of(value.cell)) == bodies.end()) {
    return std::nullopt;
  }
  return value_of(structure_.lazy().face(cone.family, LazyPart::coned, value));
}

/// A cell of a cone that is written out has the canonical name that its base had then: so nothing is stored to find it.
CellId NameReader::written_cone_over(const Cone& cone, CellId base) const {
  std::string name{structure_.directory().own_name(cone.apex)};
  name.append(1, '*').append(structure_.directory().own_name(structure_.forest().oldest_at(base, cone.links)));
  const auto found = structure_.directory().find(name);
  return found && found->cell != none && found->cell > cone.apex && found->cell < cone.end &&
                 structure_.cells().faces(found->cell).back() == base
             ? found->cell
             : none;
}

}  // namespace sesame::ops

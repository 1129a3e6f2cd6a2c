#include "ops/cells/structure.hpp"

#include "ops/cells/name_reader.hpp"

namespace sesame::ops {

std::optional<Incidence> Structure::denoted(std::string_view name) const {
  const auto named = NameReader(*this, name).read();
  if (!named) {
    return std::nullopt;
  }
  Incidence found =
      named->is_degenerate() ? values_.incidence_of(values_.normal_form(*named)) : Incidence{named->cell, named->order};
  while (lazy_.is_consumed(found.node) && !is_deleted(forest_, values_.of(found.node).cell)) {
    const FamilyId family = lazy_.consumed_by(found.node);
    if (lazy_.family(family).kind != FamilyKind::cone) {
      break;
    }
    found = lazy_.face(family, LazyPart::base, maps().reordered(found.order, values_.of(found.node)));
  }
  return found;
}

std::optional<CellId> Structure::lookup(std::string_view name) const {
  const auto found = denoted(name);
  return found ? std::optional{found->node} : std::nullopt;
}

bool Structure::is_name_taken(std::string_view name) const {
  return directory_.find(name).has_value() || NameReader(*this, name).read().has_value();
}

std::optional<BodyId> Structure::lookup_body(std::string_view name) const {
  const NameTable::Name* found = directory_.names().find(name);
  if (found == nullptr || found->body == none) {
    return std::nullopt;
  }
  BodyId body = bodies_.find(found->body);
  for (FamilyId family = bodies_.consumed_by(body); family != none && lazy_.family(family).kind == FamilyKind::cone;
       family = bodies_.consumed_by(body)) {
    body = bodies_.find(lazy_.family(family).body);
  }
  return body;
}

std::span<const std::uint64_t> Structure::counts() const {
  std::size_t used = counts_.size();
  while (used > 0 && counts_[used - 1] == 0) {
    --used;
  }
  return {counts_.data(), used};
}

bool was_current(const Structure& structure, CellId c, const Moment& moment) {
  const LazyCell* lazy = structure.lazy().of(c);
  if (lazy != nullptr ? lazy->key.family >= moment.families : !moment.knew(c)) {
    return false;
  }
  if (structure.lazy().consumed_by(c) < moment.families) {  // none is more than any
    return false;
  }
  return structure.forest().find_at(c, moment.links) == c;
}

const DartStore::Made* map_named(const Structure& structure, std::string_view name) {
  const DartStore& darts = structure.darts();
  const std::uint32_t number = darts.maps() == 0 ? std::uint32_t{none} : structure.directory().names().number_of(name);
  return number == none ? nullptr : darts.named(number);
}

std::int64_t euler_characteristic(const Structure& structure) {
  std::int64_t sum = 0;
  for (const std::span<const std::uint64_t> counts : {structure.counts(), structure.bodies().parts()}) {
    for (std::size_t p = 0; p < counts.size(); ++p) {
      sum += (p % 2 == 0 ? 1 : -1) * static_cast<std::int64_t>(counts[p]);
    }
  }
  return sum;
}

std::optional<Value> seen_from_dart(const Structure& structure, const DartStore::Made& map, int i, Dart dart) {
  const DartCells::Seen seen = structure.darts().seen(map, i, dart);
  if (seen.offset == none) {
    return std::nullopt;
  }
  const CellId node{seen.offset};
  const TypeId type = structure.cells().type_id(node);
  if (is_cone(structure.cells().type(node).type)) {  // which has one orientation for all its darts
    return structure.values().plain(node);
  }
  const OrderId order = structure.maps().order_at(type, seen.dart);
  return Value{node, structure.maps().seen_through(order, type), 0, order};
}

}  // namespace sesame::ops

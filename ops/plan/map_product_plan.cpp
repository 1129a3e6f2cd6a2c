// Products of bodies with cells of maps.
#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <set>
#include <string_view>
#include <utility>

#include "ops/cells/name_text.hpp"
#include "ops/cells/product_types.hpp"
#include "ops/plan/map_factors.hpp"
#include "ops/plan/operation_plans.hpp"

namespace sesame::ops {
namespace {

std::set<TypeId> types_of(BodyId body, const Structure& structure) {
  std::set<TypeId> types;
  for (const CellId cell : structure.lazy().cells_of(body)) {
    types.insert(structure.cells().type_id(cell));
  }
  return types;
}

Status check_types(BodyId left, BodyId right, const std::string& name, const Structure& structure) {
  const TypeTable& types = structure.types();
  const std::set<TypeId> rights = types_of(right, structure);
  for (const TypeId one : types_of(left, structure)) {
    for (const TypeId other : rights) {
      if (!ProductTypes::is_possible(types, one, other)) {
        return Error{Errc::refused,
                     fmt::format("\"{}\" would have the product of a {} and a {}: in products of maps a cell may have "
                                 "dimension {} at most, and {} darts in its canonical boundary",
                                 name, describe(types.info(one).type), describe(types.info(other).type),
                                 largest_map_dimension, ProductTypes::most_darts)};
      }
    }
  }
  return Done{};
}

/// Are the names of all cells free, from whichever dart? Those that were given may be alike.
Status check_names(const std::string& name, const std::vector<Dart>& darts, const Structure& structure) {
  const NameTable& names = structure.directory().names();
  for (std::uint32_t number = 0; number < names.size(); ++number) {
    const std::string_view text = names[number].text;
    const auto split = text.starts_with(name) ? split_dart(text) : std::nullopt;
    Dart dart = no_dart;
    if (split && split->length == name.size() && static_cast<std::size_t>(split->dimension) < darts.size()) {
      std::from_chars(split->dart.data(), split->dart.data() + split->dart.size(), dart);
    }
    if (dart != no_dart && dart < darts[static_cast<std::size_t>(split->dimension)]) {
      return Error{Errc::bad_input,
                   fmt::format("the name \"{}\" is in use, so \"{}\" cannot name a product of maps: choose another",
                               text, name)};
    }
  }
  return Done{};
}

/// How many darts the product has, of chains of maps on each level.
std::vector<std::uint64_t> dart_counts(const MapFactor& left, const MapFactor& right) {
  const auto& lefts = left.darts.seen;
  const auto& rights = right.darts.seen;
  std::vector<std::uint64_t> counts(lefts.size() + rights.size() - 1, 0);
  if (left.kind == MapFactor::Kind::map) {
    const int k = left.map.dimension(), l = right.map.dimension();
    counts.assign(counts.size(), count_of_darts(left.map.size(), k, right.map.size(), l));
    return counts;
  }
  for (std::size_t a = 0; a < lefts.size(); ++a) {
    for (std::size_t b = 0; b < rights.size(); ++b) {
      const std::uint64_t more = count_of_darts(static_cast<Dart>(lefts[a].size()), static_cast<int>(a),
                                                static_cast<Dart>(rights[b].size()), static_cast<int>(b));
      counts[a + b] += std::min(more, UINT64_MAX - counts[a + b]);
    }
  }
  return counts;
}

Status add_darts(const std::string& name, MapFactor left, MapFactor right, const Structure& structure,
                 const Limits& limits, Plan& plan) {
  if (left.darts.seen.size() + right.darts.seen.size() > std::size_t{largest_map_dimension} + 2) {
    return Error{Errc::refused,
                 fmt::format("\"{}\" would be a map of dimension {}: at most {} is possible", name,
                             left.darts.seen.size() + right.darts.seen.size() - 2, largest_map_dimension)};
  }
  std::vector<Dart> darts;
  for (const std::uint64_t count : dart_counts(left, right)) {
    if (count > static_cast<std::uint64_t>(limits.cells_per_step)) {
      return Error{Errc::refused,
                   fmt::format("\"{}\" would have {} darts, the limit is {}", name, count, limits.cells_per_step)};
    }
    darts.push_back(static_cast<Dart>(count));
  }
  if (Status s = check_names(name, darts, structure); !s) {
    return s;
  }
  plan.map.emplace();
  if (left.kind == MapFactor::Kind::map) {
    plan.map->map = product(left.map, right.map);
  }
  plan.map->factors =
      std::make_shared<const std::pair<FactorDarts, FactorDarts>>(std::move(left.darts), std::move(right.darts));
  return Done{};
}

}  // namespace

Status plan_map_product(const NewFamily& family, const Structure& structure, const Limits& limits, Plan& plan) {
  const BodyId left = family.bodies[0], right = family.bodies[1];
  for (const BodyId body : family.bodies) {
    if (Status s = check_map_factor(body, structure); !s) {
      return s;
    }
  }
  if (Status s = check_types(left, right, family.name, structure); !s) {
    return s;
  }
  MapFactor of_left = map_factor(left, structure), of_right = map_factor(right, structure);
  if (of_left.kind != of_right.kind || of_left.kind == MapFactor::Kind::no_darts) {
    return Done{};
  }
  return add_darts(family.name, std::move(of_left), std::move(of_right), structure, limits, plan);
}

}  // namespace sesame::ops

#include "ops/plan/map_factors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "ops/cells/product_types.hpp"
#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

/// The body of the cells of a map, or none when all of them are gone.
BodyId body_of_map(const DartStore::Made& map, const Structure& structure) {
  for (int i = 0; i <= map.dimension; ++i) {
    const auto darts = static_cast<Dart>(map.cells->of[static_cast<std::size_t>(i)].size());
    for (Dart d = 0; d < darts; ++d) {
      if (const auto seen = structure.darts().seen(map, i, map.first + d); seen.offset != none) {
        return structure.body_of(CellId{seen.offset});
      }
    }
  }
  return none;
}

/// What a dart sees by now; of no cell when that is gone.
Value seen_by_now(const Structure& structure, const DartStore::Made& map, int i, Dart dart) {
  const auto seen = seen_from_dart(structure, map, i, dart);
  const Value value = seen ? structure.values().normal_form(*seen) : Value{};
  return value.cell == none || value.is_degenerate() || !structure.is_current(value.cell) ? Value{} : value;
}

void add_levels(const DartStore::Made& chain, const Structure& structure, FactorDarts& darts) {
  darts.seen.resize(std::max(darts.seen.size(), static_cast<std::size_t>(chain.dimension) + 1));
  for (int i = 0; i <= chain.dimension; ++i) {
    const auto count = static_cast<Dart>(chain.cells->of[static_cast<std::size_t>(i)].size());
    for (Dart d = 0; d < count; ++d) {
      darts.seen[static_cast<std::size_t>(i)].push_back(seen_by_now(structure, chain, i, d));
    }
  }
}

MapFactor factor_of_maps(const std::vector<const DartStore::Made*>& maps, const Structure& structure) {
  const DartStore& store = structure.darts();
  const int n = maps[0]->dimension;
  MapFactor factor{MapFactor::Kind::map, {}, {}};
  factor.darts.seen.resize(static_cast<std::size_t>(n) + 1);
  std::vector<Dart> darts;
  std::unordered_map<Dart, Dart> number;
  for (const DartStore::Made* map : maps) {
    for (Dart d = map->first; d < map->first + map->count; ++d) {
      if (store.taken_out_with(n, d)) {
        continue;
      }
      number.emplace(d, static_cast<Dart>(darts.size()));
      darts.push_back(d);
      for (int i = 0; i <= n; ++i) {
        factor.darts.seen[static_cast<std::size_t>(i)].push_back(seen_by_now(structure, *map, i, d));
      }
    }
  }
  std::vector<std::vector<Dart>> alpha(static_cast<std::size_t>(n) + 1);
  for (int i = 0; i <= n; ++i) {
    for (const Dart d : darts) {
      const auto image = number.find(store.alpha(n, i, d));  // vertices may be sewn to those of another body
      alpha[static_cast<std::size_t>(i)].push_back(image != number.end() ? image->second : number.at(d));
    }
  }
  Result<GMap> map = GMap::make(std::move(alpha));
  sparse::expects(map.has_value(), "maps that are sewn are a map");
  factor.map = std::move(*map);
  return darts.empty() ? MapFactor{} : factor;
}

}  // namespace

MapFactor map_factor(BodyId body, const Structure& structure) {
  const DartStore& store = structure.darts();
  std::vector<const DartStore::Made*> maps, chains;
  for (std::uint32_t number = 0; number < store.maps(); ++number) {
    const DartStore::Made& map = store.map(number);
    const bool is_extended = store.named(map.name) != &map;
    if (!map.is_by_simplices && !is_extended && body_of_map(map, structure) == body) {
      (map.has_levels() ? chains : maps).push_back(&map);
    }
  }
  const auto has_other_dimension = [&](const auto* map) { return map->dimension != maps[0]->dimension; };
  if (maps.empty() == chains.empty() || std::ranges::any_of(maps, has_other_dimension)) {
    return {};
  }
  if (!maps.empty()) {
    return factor_of_maps(maps, structure);
  }
  MapFactor factor{MapFactor::Kind::chain, {}, {}};
  for (const DartStore::Made* chain : chains) {
    add_levels(*chain, structure, factor.darts);
  }
  return factor;
}

Status check_map_factor(BodyId body, const Structure& structure) {
  const auto wrong = [](const std::string& what) { return Error{Errc::refused, what}; };
  for (const CellId cell : structure.lazy().cells_of(body)) {
    const TypeInfo& info = structure.cells().type(cell);
    const std::string name = structure.name(cell);
    if (is_cone(info.type) || is_cone_part(info.type)) {
      return wrong(
          fmt::format("the cell \"{}\" is no ball, and no product of it would be one: a product of maps needs "
                      "balls; make them \"as\":\"simplices\"",
                      name));
    }
    if (!ProductTypes::is_factor(info)) {
      return wrong(fmt::format(
          "the cell \"{}\" is {}: a product is one of simploids, or one of cells of maps, vertices "
          "and edges",
          name,
          is_by_boundary(info.type) ? "known by its boundary"
                                    : fmt::format("a {}, and other cells are cells of maps", describe(info.type))));
    }
    for (std::uint32_t k = 0; info.dimension > 1 && k < info.faces.size(); ++k) {
      if (structure.values().face_of_cell(cell, k).is_degenerate()) {
        return wrong(
            fmt::format("the cell \"{}\" of a map has a degenerate face: products with it are not possible", name));
      }
    }
  }
  return Done{};
}

}  // namespace sesame::ops

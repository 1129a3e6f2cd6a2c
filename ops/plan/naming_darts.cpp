#include "ops/plan/naming_darts.hpp"

#include <string>
#include <string_view>

#include "ops/cells/name_text.hpp"

namespace sesame::ops {

Dart NamingDarts::of(CellId node, int i, int dimension) const {
  const std::string called = structure_.directory().own_name(node);
  const auto split = split_dart(called);
  const std::string_view text = called;
  const DartStore::Made* map = map_named(structure_, split ? text.substr(0, split->length) : text);
  if (map == nullptr) {
    return in_product(node, i, called, dimension);
  }
  if (map->dimension != dimension || map->has_levels() || (split && split->dimension != i)) {
    return no_dart;
  }
  const Dart dart = split ? dart_of_text(*map, split->dart) : 0;  // the face of a polygon is called as that is
  return dart == no_dart ? no_dart : map->first + dart;
}

/// Only one beginning of a name can be that of a product: see check_new_apex.
Dart NamingDarts::in_product(CellId node, int i, std::string_view called, int dimension) const {
  for (std::size_t at = called.find(".("); at != std::string_view::npos; at = called.find(".(", at + 1)) {
    const DartStore::Made* map = map_named(structure_, called.substr(0, at));
    if (map == nullptr || map->dimension != dimension || map->has_levels()) {
      continue;
    }
    const auto [known, is_new] = of_products_.try_emplace({map->first, i});
    const auto& cells = map->cells->of[static_cast<std::size_t>(i)];
    for (Dart d = 0; is_new && d < map->count; ++d) {
      if (cells[d].offset != UINT32_MAX) {
        known->second.try_emplace(std::uint32_t{map->node} + cells[d].offset, map->first + d);
      }
    }
    const auto found = known->second.find(node);
    return found == known->second.end() ? no_dart : found->second;
  }
  return no_dart;
}

}  // namespace sesame::ops

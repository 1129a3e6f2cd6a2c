#include "ops/maps/orientation.hpp"

#include <fmt/format.h>

#include <utility>

#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

/// Appends what turning reaches from the last dart of a list, and marks it.
void turn(const GMap& map, std::vector<Dart>& found, std::vector<bool>& met) {
  const auto meet = [&](Dart d) {
    if (!met[d]) {
      met[d] = true;
      found.push_back(d);
    }
  };
  meet(found.back());
  for (std::size_t at = found.size() - 1; at < found.size(); ++at) {
    const Dart d = found[at];
    const Dart opposite = map.alpha(0, d);
    for (int i = 1; i <= map.dimension(); ++i) {
      if (!map.is_free(i, opposite)) {
        meet(map.alpha(i, opposite));
      }
      if (!map.is_free(i, d)) {
        meet(map.alpha(0, map.alpha(i, d)));
      }
    }
  }
}

/// What is wrong with a dart.
std::optional<IndexedDart> obstacle_at(const GMap& map, Dart d) {
  if (map.is_free(0, d)) {
    return IndexedDart{0, d};
  }
  for (int i = 2; i <= map.dimension(); ++i) {
    if (map.alpha(i, d) == map.alpha(0, d)) {
      return IndexedDart{i, d};
    }
  }
  return std::nullopt;
}

Error undefined(IndexedDart at) {
  return {Errc::refused, at.index == 0 ? fmt::format("dart {} is 0-free: an edge has two ends where a map has an "
                                                     "orientation or none",
                                                     at.dart)
                                       : fmt::format("alpha_{} and alpha_0 agree on dart {}: where a map has an "
                                                     "orientation or none no edge is folded onto itself",
                                                     at.index, at.dart)};
}

}  // namespace

std::vector<ComponentOrientability> orientability(const GMap& map) {
  sparse::expects(map.dimension() >= 0, "points have no orientation");
  const Orbits parts = components(map);
  std::vector<ComponentOrientability> all(parts.count());
  for (Dart d = 0; d < map.size(); ++d) {
    std::optional<IndexedDart>& obstacle = all[parts.of[d]].obstacle;
    if (!obstacle) {
      obstacle = obstacle_at(map, d);
    }
  }
  std::vector<bool> met(map.size(), false);
  std::vector<Dart> found;
  for (std::uint32_t part = 0; part < parts.count(); ++part) {
    ComponentOrientability& each = all[part];
    each.first = parts.first[part];
    if (!each.obstacle) {
      // The other class, if there is one, is that of alpha_0 of this dart.
      found.assign(1, each.first);
      turn(map, found, met);
      each.is = met[map.alpha(0, each.first)] ? Orientability::not_orientable : Orientability::orientable;
    }
  }
  return all;
}

Result<bool> is_orientable(const GMap& map) {
  bool all = true;
  for (const ComponentOrientability& each : orientability(map)) {
    if (each.obstacle) {
      return undefined(*each.obstacle);
    }
    all = all && each.is == Orientability::orientable;
  }
  return all;
}

Status check_turning(const GMap& map) {
  sparse::expects(map.dimension() >= 0, "points have no orientation");
  for (Dart d = 0; d < map.size(); ++d) {
    if (const auto obstacle = obstacle_at(map, d)) {
      return undefined(*obstacle);
    }
  }
  return Done{};
}

Signs signs(const GMap& map, IndexSet involutions) {
  Signs signs;
  signs.of.assign(map.size(), 0);
  std::vector<Dart> found;
  for (Dart first = 0; first < map.size(); ++first) {
    if (signs.of[first] != 0) {
      continue;
    }
    signs.of[first] = 1;
    found.assign(1, first);
    for (std::size_t at = 0; at < found.size(); ++at) {
      const Dart d = found[at];
      for (int i = 0; i <= map.dimension(); ++i) {
        if ((involutions >> i & 1U) == 0 || map.is_free(i, d)) {
          continue;
        }
        const Dart next = map.alpha(i, d);
        if (signs.of[next] == signs.of[d]) {
          return {.of = {}, .conflict = IndexedDart{i, d}};
        }
        if (signs.of[next] == 0) {
          signs.of[next] = static_cast<std::int8_t>(-signs.of[d]);
          found.push_back(next);
        }
      }
    }
  }
  return signs;
}

}  // namespace sesame::ops

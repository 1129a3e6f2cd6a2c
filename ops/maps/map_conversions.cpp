#include "ops/maps/map_conversions.hpp"

#include <fmt/format.h>

#include <utility>

#include "ops/maps/nmap_cells.hpp"
#include "ops/maps/orientation.hpp"
#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

/// The part of a map in which a dart is, and which darts these are.
HalfOfMap component_of(const NMap& whole, const Orbits& parts, Dart start) {
  HalfOfMap half;
  std::vector<Dart> number(whole.size(), no_dart);
  for (Dart d = 0; d < whole.size(); ++d) {
    if (parts.join(d, start)) {
      number[d] = static_cast<Dart>(half.dart.size());
      half.dart.push_back(d);
    }
  }
  if (whole.dimension() == 0) {
    half.map = NMap::points(static_cast<Dart>(half.dart.size()));
    return half;
  }
  std::vector<std::vector<Dart>> beta(static_cast<std::size_t>(whole.dimension()));
  for (int i = 1; i <= whole.dimension(); ++i) {
    for (const Dart d : half.dart) {
      const Dart image = whole.beta(i, d);
      beta[static_cast<std::size_t>(i) - 1].push_back(image == no_dart ? no_dart : number[image]);
    }
  }
  half.map = std::move(*NMap::make(std::move(beta)));
  return half;
}

}  // namespace

GMap to_gmap(const NMap& map) {
  const Dart size = map.size();
  sparse::expects(size < (Dart{1} << 31), "a G-map has twice the darts of its n-map");
  std::vector<std::vector<Dart>> alpha(static_cast<std::size_t>(map.dimension()) + 1,
                                       std::vector<Dart>(std::size_t{size} * 2));
  for (Dart b = 0; b < size; ++b) {
    const Dart c = b + size;
    alpha[0][b] = c;
    alpha[0][c] = b;
    for (int i = 1; i <= map.dimension(); ++i) {
      // b begins its edge, so what lies behind beta_0 is at its vertex; c ends it, and beta_1 begins there.
      const Dart before = map.beta(i == 1 ? 0 : i, b);
      const Dart after = map.beta(i, b);
      alpha[static_cast<std::size_t>(i)][b] = before == no_dart ? b : before + size;
      alpha[static_cast<std::size_t>(i)][c] = after == no_dart ? c : after;
    }
  }
  return std::move(*GMap::make(std::move(alpha)));
}

Result<NMap> turning_map(const GMap& map) {
  if (Status s = check_turning(map); !s) {
    return s.error();
  }
  if (map.dimension() == 0) {
    return NMap::points(map.size());
  }
  std::vector<std::vector<Dart>> beta(static_cast<std::size_t>(map.dimension()));
  for (int i = 1; i <= map.dimension(); ++i) {
    for (Dart d = 0; d < map.size(); ++d) {
      const Dart opposite = map.alpha(0, d);
      beta[static_cast<std::size_t>(i) - 1].push_back(map.is_free(i, opposite) ? no_dart : map.alpha(i, opposite));
    }
  }
  return NMap::make(std::move(beta));
}

Result<HalfOfMap> to_nmap(const GMap& map, Dart start) {
  if (start >= map.size()) {
    return Error{Errc::bad_input, fmt::format("there is no dart {}: the map has {}", start, map.size())};
  }
  const Result<NMap> whole = turning_map(map);
  if (!whole) {
    return whole.error();
  }
  const Orbits parts = components(map);
  for (Dart d = 0; d < map.size(); ++d) {
    if (!parts.join(d, start)) {
      return Error{Errc::refused, fmt::format("dart {} cannot be reached from dart {}: only a connected map has an "
                                              "orientation that one dart determines",
                                              d, start)};
    }
  }
  const Orbits halves = components(*whole);
  if (halves.join(start, map.alpha(0, start))) {
    return Error{Errc::refused, fmt::format("the map is not orientable: dart {} can be turned into dart {}, the other "
                                            "end of its edge",
                                            start, map.alpha(0, start))};
  }
  return component_of(*whole, halves, start);
}

}  // namespace sesame::ops

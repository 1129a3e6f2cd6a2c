/// \file
/// Orbits of darts: the cells of a map, its components, and how they lie to each other.
#pragma once

#include <cstdint>
#include <vector>

#include "ops/maps/gmap.hpp"

namespace sesame::ops {

/// A partition of darts into orbits, numbered in the order of their smallest darts.
struct Orbits {
  std::vector<std::uint32_t> of;  ///< per dart: the number of its orbit
  std::vector<Dart> first;        ///< per orbit: its smallest dart
  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(first.size()); }
  /// Whether two darts are in one.
  [[nodiscard]] bool join(Dart a, Dart b) const { return of[a] == of[b]; }
};

/// The orbits of some involutions. Cost: the darts, times the involutions.
[[nodiscard]] Orbits orbits(const GMap& map, IndexSet generators);
/// The orbits of the involutions without one: the i-cells.
[[nodiscard]] Orbits cells(const GMap& map, int i);
[[nodiscard]] Orbits components(const GMap& map);
[[nodiscard]] bool is_connected(const GMap& map);

/// The darts of one orbit, in the order in which a breadth first search meets them, the least index first. Cost: their
/// number, times the involutions, but for the first call of a map, which takes memory for each dart of it.
class OrbitWalk {
 public:
  explicit OrbitWalk(const GMap& map) : map_{map}, met_(map.size(), false) {}
  [[nodiscard]] std::vector<Dart> from(Dart start, IndexSet generators);

 private:
  const GMap& map_;
  std::vector<bool> met_;
};

}  // namespace sesame::ops

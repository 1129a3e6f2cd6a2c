/// \file
/// What a cell of a map is a cone over.
#pragma once

#include <vector>

#include "ops/maps/gmap.hpp"
#include "ops/maps/orbits.hpp"

namespace sesame::ops {

/// The canonical boundary of an i-cell: an (i-1)-G-map. Each of its darts stands for those of the cell that the
/// involutions above alpha_i reach from each other. The cell is the cone over it.
struct CellBoundary {
  GMap map;
  std::vector<Dart> darts;            ///< of the cell, ascending
  std::vector<Dart> boundary_darts;   ///< which dart of the boundary each stands for
  std::vector<Dart> representatives;  ///< of each dart of the boundary: the least of those that it stands for
};

/// Canonical boundaries of the cells of a map. Cost of each: the darts of the cell, times the involutions.
class CellBoundaries {
 public:
  explicit CellBoundaries(const GMap& map) : map_{map}, walk_{map}, boundary_dart_(map.size(), no_dart) {}
  /// Of the i-cell of a dart.
  [[nodiscard]] CellBoundary of(int i, Dart d);

 private:
  const GMap& map_;
  OrbitWalk walk_;
  std::vector<Dart> boundary_dart_;  // memory
};

}  // namespace sesame::ops

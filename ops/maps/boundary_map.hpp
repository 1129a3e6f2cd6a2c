/// \file
/// The boundary of a map, which is a map again, of one dimension less.
#pragma once

#include <vector>

#include "ops/maps/gmap.hpp"

namespace sesame::ops {

/// The boundary of an n-G-map along which no n-cell lies on the other side.
struct BoundaryMap {
  GMap map;                ///< of dimension n - 1
  std::vector<Dart> dart;  ///< per dart of it: the n-free dart that it is, in increasing order
};

/// The darts of the boundary are the n-free ones. alpha_i is as it was for i < n - 1; alpha_{n-1} turns around the
/// (n-2)-cell through the object, by alpha_{n-1} and then alpha_n and alpha_{n-1} again and again, until an n-free
/// dart. Its components are counted by `components` (orbits.hpp). Where a dart is free of another index the object ends
/// as well, but inside its n-cells: that part is no boundary here. Source: P. Lienhardt (1994). Cost: the darts times
/// n. Requires: n >= 0.
[[nodiscard]] BoundaryMap boundary_of(const GMap& map);

}  // namespace sesame::ops

/// \file
/// Welding: points at the same place become one point.
#pragma once

#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

/// Every point becomes the first earlier kept point within `tolerance` of it (maximum norm); the others are removed and
/// the rest keep their order. With tolerance 0 equal points are welded, and 0.0 equals -0.0.
///
/// Requires tolerance >= 0 and finite. A remark says how many points were welded.
/// Closeness is not transitive: with a tolerance the result depends on the order of the points, which is fixed.
/// Cost O(points) for tolerance 0, else O(points) times the number of points in a cube of side 3 tolerance.
void weld(Mesh& mesh, double tolerance);

}  // namespace sesame::tools

/// \file
/// From polygons to triangles, without a change of topology.
#pragma once

#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

enum class Polygons {
  fan,   ///< diagonals from one corner; no new points
  cone,  ///< a new point in the middle, joined to every side
};

/// Replaces each face with more than three corners, in place of it in the order of faces. Returns the face that each
/// triangle was cut from.
///
/// A fan whose diagonal joined two points that an edge joins already would glue the two edges, and so change the
/// topology: another corner is tried then, and if several fail the polygon gets a cone after all. In a polygon that
/// meets a point twice, triangles at the two corners would be glued along what joins them to the rest: it gets a ring
/// of new points first, one for each corner, and what is inside the ring is cut. Remarks say what was done and how
/// often. Concave polygons are no problem: only the topology counts here.
///
/// Requires a mesh as `normalise` leaves it. Ensures the same of the result, with triangles only; those of one face are
/// oriented as the face is.
std::vector<std::uint32_t> triangulate(Mesh& mesh, Polygons how);

}  // namespace sesame::tools

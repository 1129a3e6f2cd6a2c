/// \file
/// From what a file says to a clean cell complex: the policy for broken input, in one place.
#pragma once

#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

/// What `normalise` found.
struct Cleaning {
  std::size_t shortened_faces = 0;   ///< a corner repeated in a row was kept once; three or more are left
  std::size_t degenerate_faces = 0;  ///< left out: fewer than three points, or one point at two places
  std::size_t duplicate_faces = 0;   ///< left out: the corners of an earlier face, in either direction
  std::size_t segments = 0;          ///< faces with two corners, which became lines
  std::size_t redundant_lines = 0;   ///< left out: no length, an earlier line again, or a side of a face
  std::size_t unused_points = 0;     ///< left out: on no face and no line
};

/// Leaves out, and keeps the order of what stays. Each kind of change adds a remark that counts it and names the first.
/// A mesh without faces and lines is a point cloud: it keeps all its points.
///
/// Ensures  faces have at least three corners, all distinct; no two faces have the same cycle of corners; lines are
///          distinct, join two points and are not sides of faces; every point is used, or there are only points.
/// Cost     O(n log n) for n corners.
Cleaning normalise(Mesh& mesh);

}  // namespace sesame::tools

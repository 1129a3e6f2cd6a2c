/// \file
/// From what a file says to a clean cell complex: the policy for broken input, in one place.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

/// What `normalise` found. Every face of the file is kept, or counted as degenerate, duplicate or segment.
struct Cleaning {
  std::size_t shortened_faces = 0;   ///< a corner repeated in a row was kept once; three or more are left
  std::size_t degenerate_faces = 0;  ///< left out: fewer than three corners, but for repeats in a row
  std::size_t duplicate_faces = 0;   ///< left out: the corners of an earlier face in order, in either direction
  std::size_t segments = 0;          ///< faces with two corners, which became lines
  std::size_t folded_faces = 0;      ///< kept: the boundary runs back over itself until nothing of it is left
  std::size_t redundant_lines = 0;   ///< left out: no length, an earlier line again, or a side of a face
  std::size_t unused_points = 0;     ///< left out: on no face and no line

  /// Which faces of the file, counted from 0 and in order.
  std::vector<std::uint32_t> degenerate, duplicates, folded;
};

/// Leaves out, and keeps the order of what stays. Each kind of change adds a remark that counts it and names the first.
/// A mesh without faces and lines is a point cloud: it keeps all its points.
///
/// A face is a disc glued along its corners in order. It may meet a point or run along an edge several times: a square
/// with a hole is a polygon that runs along a bridge there and back, one that runs twice around a triangle is a
/// projective plane, and one that takes back all its steps a sphere. A corner that repeats the one before it is a side
/// without length. What has fewer than three corners then, as triangles without area do, bounds no disc.
///
/// Ensures  faces have at least three corners, none the same as the next; no two faces have the same cycle of corners;
///          lines are distinct, join two points and are not sides of faces; every point is used, or there are only
///          points.
/// Cost     O(n log n) for n corners.
Cleaning normalise(Mesh& mesh);
/// The same; `origin`: of each face that is left, which one of the file it is.
Cleaning normalise(Mesh& mesh, std::vector<std::uint32_t>& origin);

}  // namespace sesame::tools

/// \file
/// Where a mesh meets itself, exactly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

/// Two faces that have more in common than the vertices and edges that they share.
struct FaceMeeting {
  std::array<std::uint32_t, 2> faces;  ///< of the mesh, the lower one first
  Point place{};                       ///< a point of both, but for rounding
  /// An edge of one of them goes through the inside of the other, by more than four millionths of its size, which
  /// rounding does not. Else they touch, lie on each other, or cross by less.
  bool crosses = false;
};

struct SelfIntersections {
  std::vector<FaceMeeting> meetings;  ///< in the order of their faces
  bool is_complete = true;            ///< false: more pairs of faces were near each other than could be looked at

  /// How many of them cross.
  [[nodiscard]] std::size_t crossing() const;
};

/// All pairs of faces that meet beyond what they share, whatever the coordinates: signs are exact (exact_signs.hpp).
///
/// Two triangles without a common vertex meet when an edge of one meets the other. Those with one vertex meet beyond it
/// when the edge across from it meets the other triangle, for either of them; those with an edge when they are in one
/// plane and on one side of that edge. Polygons count as the triangles of cut_in_space; what these have to do with each
/// other within a polygon does not count. Faces without area are segments or points.
///
/// `mesh`: as normalise leaves it. Cost: n log n for n triangles of about one size, plus the pairs whose boxes meet, of
/// which 300 n + 10^7 are looked at; with doubles as a rule, with integers of any size where these do not decide.
[[nodiscard]] SelfIntersections self_intersections(const Mesh& mesh);

}  // namespace sesame::tools

/// \file
/// Linking numbers of loops on a closed surface in space with loops just outside of it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tools/mesh/cut_system.hpp"
#include "tools/mesh/exact_signs.hpp"

namespace sesame::tools {

/// The matrix of V(x_i, y_j) = lk(x_i, y_j+) for the loops x_i along and y_j across a surface, y+ being y pushed off
/// the surface outwards.
struct LinkingForm {
  sparse::Index rank = 0;
  std::vector<std::int64_t> entries;  ///< row i, column j at i * rank + j
  std::string obstacle;               ///< why there is none: the surface touches itself; else empty
  std::uint64_t pairs = 0;            ///< of segments that were compared

  [[nodiscard]] std::int64_t operator()(sparse::Index i, sparse::Index j) const { return entries[i * rank + j]; }
};

/// Computes it exactly, whatever the coordinates.
///
/// Seen against a direction d, lk(x, y) is the sum over the crossings where y is in front of x of the sign of
/// det(v, u, d), with u and v the directions of x and y there. The loops y run from the middles of triangles to the
/// middles of their sides and on; x runs along edges, so the two meet in middles of edges only. There y+ goes round the
/// edge on the outside, and is in front of it exactly when d, from the edge, points outwards between its two triangles:
/// it counts 1 then if x.y counts 1. (With y- it would be -1 when d points inwards. So V(x, y) - lk(x, y-) = x.y.)
///
/// All other segments are apart, unless the surface meets itself, and what lies on one line or in front of a vertex is
/// told apart by an infinitesimal shift of all y together. A few directions are tried until none of the signs is 0.
///
/// The converse holds as well: by Alexander duality, for a surface that does not meet itself, V(x, .) = 0 exactly when
/// x bounds inside, and V(x, .) = x . exactly when it bounds outside (see loop_sorting.hpp).
///
/// Cost: n log n for n segments, plus the pairs of them that come near each other as seen against d (found by a grid),
/// times the rank.
[[nodiscard]] LinkingForm linking_form(const CutSystem& system, std::span<const Edge> edges, const ExactSigns& signs);

}  // namespace sesame::tools

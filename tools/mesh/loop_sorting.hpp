/// \file
/// Which loops on closed surfaces in space bound inside, and which outside.
#pragma once

#include <string>
#include <vector>

#include "tools/mesh/cut_system.hpp"
#include "tools/mesh/linking_form.hpp"
#include "tools/mesh/mesh.hpp"
#include "tools/mesh/self_intersections.hpp"
#include "tools/mesh/short_loops.hpp"
#include "tools/mesh/validity.hpp"

namespace sesame::tools {

/// Of one connected part of a mesh.
struct PartSorting {
  bool is_sorted = false;
  std::string why_not;  ///< why its loops are not sorted; empty when they are, or when it has none
};

/// A cycle, by how often it runs up each of its edges.
using WeightedEdges = sparse::Terms<sparse::Integers>;

/// Half of the loops of closed surfaces: those that bound on one side.
///
/// `coordinates`, summed along a cycle of edges, are coordinates of what is left of its class when the half that bounds
/// on the other side is taken away; a cycle bounds on this side when the coordinates of the other half are zero on it.
struct HalfOfLoops {
  Annotation coordinates;
  /// Per coordinate, a cycle of edges that has this one 1, all others 0, and bounds on this side.
  std::vector<WeightedEdges> cycles;
};

struct LoopSorting {
  std::vector<PartSorting> parts;  ///< as connected_parts counts them, and Validity
  HalfOfLoops handles;             ///< bound inside
  HalfOfLoops tunnels;             ///< bound outside
  std::vector<std::string> remarks;
};

/// What was found out about a mesh before its loops are looked for.
struct KnownOfMesh {
  const Validity& validity;
  const SelfIntersections& meetings;
};

/// What linking numbers say about the classes of a surface, one of which is sorted as above.
///
/// Let S be a closed surface in R^3 of genus g, inside the bounded side of it, x_i and y_j dual bases of H_1(S) (see
/// cut_system.hpp), and P(i, j) = lk(x_i, y_j+), where y+ is y pushed outwards (see linking_form.hpp). Then:
///
/// * H_1(S) = H_1(inside) + H_1(outside), by Mayer and Vietoris in the 3-sphere, whose H_1 and H_2 are zero. So the
///   kernels K (bounds inside) and L (bounds outside) have H_1(S) as their direct sum. By Alexander duality
///   H_1(outside) is dual to H_1(inside) by linking numbers, so that all three have rank g.
/// * If x bounds inside, its filling does not meet any y+, so x P = 0. If it bounds outside, then lk(x, y-) = 0 for all
///   y, and lk(x, y+) - lk(x, y-) = x . y, so x P = x in coordinates by the bases.
/// * So P is the projection onto L along K: P P = P, of trace g. What comes out of a surface that meets itself need not
///   be one; this is checked.
///
/// So a cycle is a *handle* loop, which bounds inside, when x P = 0, and a *tunnel* loop, which bounds outside, when
/// x (1 - P) = 0. Source of the words: T. Dey, K. Li, J. Sun, "On computing handle and tunnel loops" (2007); of linking
/// numbers for them: T. Dey, F. Fan, Y. Wang, "An efficient computation of handle and tunnel loops via Reeb graphs"
/// (2013).
///
/// Inside and outside are meant with respect to each connected part alone, whatever others are in or around it.
/// Parts that are no closed orientable surfaces have no inside. Where triangles have no area, or sheets touch, so that
/// there are no linking numbers, they are taken of the surface with its points moved by a millionth of the edges there;
/// a remark says so. A surface that crosses itself, or another closed one, is not sorted. One that only touches itself
/// is sorted by its linking numbers if these pass the checks above.
///
/// `mesh`: as normalise leaves it; what is known of it is of this mesh, so parts and faces are the same. Cost: see
/// SurfaceCutter and linking_form, plus a Smith form of a matrix as large as the rank of H_1 of each part.
[[nodiscard]] LoopSorting sort_loops(const Mesh& mesh, const KnownOfMesh& known);

}  // namespace sesame::tools

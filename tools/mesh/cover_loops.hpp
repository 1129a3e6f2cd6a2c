/// \file
/// Short loops among those of which a homology class is zero, where shortest paths on the surface itself find none.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "tools/mesh/short_loops.hpp"

namespace sesame::tools {

struct CoverSearch {
  const Annotation* wanted = nullptr;  ///< what the loops are to be a basis of
  const Annotation* zero = nullptr;    ///< what is to be zero along each of them
  sparse::Index rank = 0;              ///< how many loops there can be around a root
  std::size_t most_states = 0;         ///< places to reach from a root, copies of a point counted each
  double longest = std::numeric_limits<double>::infinity();  ///< loops of this length or more are not looked for
};

struct CoverLoops {
  std::vector<Loop> loops;  ///< shortest first
  std::size_t states = 0;   ///< that were reached
};

/// Closed walks near a root along which `zero` adds up to 0, and whose classes in `wanted` can be part of a basis of
/// it. A walk may meet a point more than once.
///
/// On a tube with a knot in it the loops that bound outside wind around the tube, so no two shortest paths make one.
/// In the covering of the mesh where paths from the root end at one place only when `zero` is the same along them, they
/// do: there the loops are found as in short_loops, from one tree of shortest paths, which grows until it has a basis
/// and no shorter ones can follow, or too many states. Copies of a point are told apart by fingerprints of `zero`.
/// Cost: n log n for n states, of some 60 bytes each.
[[nodiscard]] CoverLoops loops_in_cover(const EdgeGraph& graph, const CoverSearch& search, std::uint32_t root);

}  // namespace sesame::tools

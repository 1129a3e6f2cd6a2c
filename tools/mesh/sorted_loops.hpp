/// \file
/// Short handle loops and short tunnel loops.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/mesh/loop_sorting.hpp"
#include "tools/mesh/short_loops.hpp"

namespace sesame::tools {

struct HalfBasis {
  std::vector<Loop> loops;                ///< closed walks, which may meet themselves
  std::vector<WeightedEdges> completion;  ///< cycles that complete them to a basis; as a rule none
  std::uint64_t tried = 0;                ///< loops that were compared
};

/// Short closed walks along edges that are a basis of one half of the loops of all surfaces that are sorted.
///
/// The loops of short_loops, and where these are no basis as on knotted tubes, those of loops_in_cover too. What even
/// then is missing are sums of short loops that bound on neither side. `rest`: the other half. Cost: that of
/// short_loops, plus up to 9,000,000 states of covers, plus a Smith form if something is missing.
[[nodiscard]] HalfBasis short_half(const EdgeGraph& graph, const HalfOfLoops& half, const HalfOfLoops& rest);

}  // namespace sesame::tools

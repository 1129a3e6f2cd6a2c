/// \file
/// What the cells of a history were called.
#pragma once

#include "engine/history_maps.hpp"
#include "engine/zigzag/chain_pasts.hpp"

namespace sesame::engine {

/// A chain of cells, as they are oriented themselves, by the canonical names that they had after so many removals.
template <sparse::Ring R>
[[nodiscard]] NameChain named_at(const R& ring, const ops::Structure& structure, ops::LinkId links, int degree,
                                 const sparse::Terms<R, ops::CellId>& chain);

/// The cycles of a bar that begins and ends with these steps, by names. At one step the last map counts, so what lies
/// between the halves of a replacement is left out. Requires: the bar does not end with the step that it begins with.
template <sparse::Ring R>
[[nodiscard]] std::vector<NamedCycle> named_cycles(const R& ring, const ops::Structure& structure,
                                                   const std::vector<HistoryMap>& maps, const Bar& bar,
                                                   const std::vector<ChainPiece<R>>& pieces);

}  // namespace sesame::engine

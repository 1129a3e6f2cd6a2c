/// \file
/// Whether bars and their cycles are what they are said to be.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/history_maps.hpp"
#include "engine/zigzag/chain_pasts.hpp"

namespace sesame::engine {

/// A bar by the numbers of the maps that begin and end it, UINT64_MAX when none does, and its chains.
template <sparse::Ring R>
struct ChainBar {
  int dimension;
  std::uint64_t birth, death;
  std::vector<ChainPiece<R>> pieces;
};

/// Checks by boundary matrices alone, which are reduced from scratch at every moment, that the chains of bars are an
/// interval decomposition of the homology of a history; then the bars are its barcode. At every moment the chains of
/// the bars that are alive are cycles of the object, independent modulo boundaries, and as many as the Betti number
/// says; and each map sends the chain of a bar to one that differs from the next by a boundary, or, of a bar that it
/// ends or begins, to a boundary. Nothing is asked of an engine.
///
/// Returns the first thing that is wrong, as a sentence; once `stop` is set, no further one is looked for. Cost: of
/// each map, that of a reduction of the boundary matrices of the object. Requires: the structure has done the maps.
template <sparse::Ring R>
[[nodiscard]] std::optional<std::string> first_wrong_bar(const R& ring, const ops::Structure& structure,
                                                         const std::vector<HistoryMap>& maps,
                                                         const std::vector<ChainBar<R>>& bars,
                                                         const std::atomic<bool>* stop = nullptr);

}  // namespace sesame::engine

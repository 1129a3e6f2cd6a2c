/// \file
/// A representative cycle for every bar of a tower, and the chain that it comes to bound.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/towers/barcode.hpp"
#include "ops/ids.hpp"
#include "sparse/rational_chain.hpp"

namespace sesame::engine {

/// An inclusion of a tower, counted from 0. It stands for the cell that it added: what that has become since, the one
/// who counts the inclusions can tell.
using InclusionId = ops::Id<struct InclusionOfTower>;
/// A chain of cells, by the inclusions that added them, increasing.
using InclusionChain = sparse::RationalChain<InclusionId>;

/// What a BarcodeTracker knows of its bars when it keeps cycles.
class BarCycles {
 public:
  /// A bar, and the operations that began and ended it, numbers from 0.
  struct TracedBar {
    Bar bar;
    std::uint64_t born_by;
    std::uint64_t killed_by;     ///< when the bar has ended
    std::uint32_t birth, death;  ///< the generators; death is that of the birth when the bar is open
  };

  virtual ~BarCycles() = default;

  /// All bars so far, by dimension, birth and death; those of length 0 too, but not what one operation bears and kills.
  [[nodiscard]] virtual std::vector<TracedBar> bars() const = 0;
  /// The last operation at the time of one: all operations at one time are one map, and the complex at that time is the
  /// one after the last of them. Cost: the logarithm of the number of operations.
  [[nodiscard]] virtual std::uint64_t last_operation_with(std::uint64_t operation) const = 0;
  /// A cycle that is born with a bar, and dies with it.
  [[nodiscard]] virtual InclusionChain cycle(const TracedBar& bar) = 0;
  /// The chain that the cycle bounds from the death on. Requires: the bar has ended.
  [[nodiscard]] virtual InclusionChain bounded_chain(const TracedBar& bar) = 0;
};

}  // namespace sesame::engine

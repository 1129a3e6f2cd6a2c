/// \file
/// The barcode of a tower with a representative cycle for every bar, and the chain that it comes to bound.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "engine/towers/barcode_tracker.hpp"
#include "sparse/rational.hpp"

namespace sesame::engine {

/// A BarcodeTracker that keeps the whole history, so that cycles can be asked for at any time. Its memory grows with
/// the number of operations and the lengths of the reduced boundaries.
///
/// A generator b of the big complex is reduced by older ones until the youngest generator of its boundary is alive, a,
/// or nothing is left: V(b) = b + sum of multiples of V(b'), R(b) = dV(b). Then a is the birth and b the death of a
/// bar: R(b) is a cycle that is there at the birth, and V(b) what it bounds at the death. When nothing is left V(b) is
/// a cycle that is born with b. Source: the standard algorithm of H. Edelsbrunner, D. Letscher and A. Zomorodian
/// (2002), here on the big complex of a tower; pairs come out as from the other tracker, by another method.
class CycleTracker : public BarcodeTracker {
 public:
  /// A chain of cells, each by the number of the inclusion that added it, from 0; with coefficients as they are
  /// printed. What a cell has become since, the one who counts the inclusions can tell.
  using InclusionChain = std::vector<std::pair<std::uint32_t, sparse::Rational>>;

  /// A bar, and the operations that began and ended it, numbers from 0.
  struct TracedBar {
    Bar bar;
    std::uint64_t born_by;
    std::uint64_t killed_by;     ///< when the bar has ended
    std::uint32_t birth, death;  ///< the generators; death is that of the birth when the bar is open
  };

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

/// `dimensions`: see make_barcode_tracker. Requires: the ring is a field.
[[nodiscard]] std::unique_ptr<CycleTracker> make_cycle_tracker(const sparse::AnyRing& ring,
                                                               BarcodeTracker::OnBar on_bar,
                                                               Dimensions dimensions = all_dimensions);

}  // namespace sesame::engine

/// \file
/// The barcode of a tower, kept current at every operation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "engine/towers/bar_cycles.hpp"
#include "engine/towers/barcode.hpp"
#include "engine/towers/tower_tracker.hpp"
#include "sparse/ring.hpp"

namespace sesame::engine {

/// Takes the operations of a tower one by one and reports every bar when it ends. Over a field.
///
/// The big complexes of a tower form a filtration, so the elder rule on their generators gives the barcode of the
/// tower: an inclusion appends a generator, a contraction one for every simplex that is merged or squashed; see
/// engine/LIVE_FORM.md. Nothing is kept of the past but the classes that are alive, and for each current cell what its
/// class is in them. So memory is that of the current complex and its classes; for a filtration that is everything.
///
/// One that keeps cycles has for each current cell a chain of generators, too, and the whole history: see ChainImages.
/// Its memory grows with the number of operations and the lengths of the reduced boundaries.
class BarcodeTracker : public TowerTracker {
 public:
  /// Called when a class dies: its dimension, birth and death. Those with birth = death are counted, not reported;
  /// those that one contraction ends come sorted.
  using OnBar = std::function<void(const Bar&)>;

  /// The number of classes alive, per dimension, up to the largest that ever had one.
  [[nodiscard]] virtual std::vector<std::uint64_t> betti() const = 0;
  /// Visits the bars of the classes that are alive, by dimension and birth; death = never.
  virtual void for_each_open_bar(const OnBar& visit) const = 0;
  /// The number of bars so far whose birth and death were different operations at the same time.
  [[nodiscard]] virtual std::uint64_t hidden() const = 0;
  [[nodiscard]] virtual const sparse::AnyRing& ring() const = 0;
  /// The cycles of the bars so far, or null when they are not kept.
  [[nodiscard]] virtual BarCycles* cycles() = 0;
  /// Terms read or written, and terms and classes held: what it has cost, and what it keeps. With cycles, of their
  /// chains.
  struct Work {
    std::uint64_t terms_touched = 0, terms_held = 0, classes_held = 0;
  };
  [[nodiscard]] virtual Work work() const = 0;
};

/// How cells are numbered: from 0 in each dimension, as a TowerComplex does, or all together, as a ColumnComplex does;
/// then there are no contractions.
enum class Slots { by_dimension, shared };

/// The dimensions whose classes a tracker keeps.
struct Dimensions {
  std::size_t last;

  [[nodiscard]] bool have(std::size_t dimension) const { return dimension <= last; }
  /// Cells of one dimension more kill classes; those above are nothing to a tracker.
  [[nodiscard]] bool are_above(std::size_t dimension) const { return dimension > last && dimension - last > 1; }
};
inline constexpr Dimensions all_dimensions{SIZE_MAX};

struct TrackerOptions {
  Slots slots = Slots::by_dimension;
  /// Bars above the last of these are not worked out: cells of higher dimensions cost next to nothing, and those one
  /// above it that kill no class leave nothing behind.
  Dimensions dimensions = all_dimensions;
  bool keeps_cycles = false;
};

/// Requires: the ring is a field.
[[nodiscard]] std::unique_ptr<BarcodeTracker> make_barcode_tracker(const sparse::AnyRing& ring,
                                                                   BarcodeTracker::OnBar on_bar,
                                                                   const TrackerOptions& options = {});

}  // namespace sesame::engine

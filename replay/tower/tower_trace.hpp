/// \file
/// A second look at a tower, with the cycles of its bars, for as long as it is small.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "engine/towers/barcode_tracker.hpp"
#include "replay/tower/operation_list.hpp"
#include "replay/tower/tower_history.hpp"

namespace sesame::replay {

/// What cycles may cost that nobody has asked for.
struct TraceLimits {
  std::uint64_t operations = 20'000;  ///< faces that are added are some, too
  std::uint64_t terms = 5'000'000;    ///< read or written
};

/// Keeps cycles beside a tracker that keeps none, and forgets everything once a tower is larger than its limits. So an
/// endless tower costs what it did.
class TowerTrace final : public engine::TowerTracker {
 public:
  /// `options.keeps_cycles` is not asked.
  TowerTrace(const sparse::AnyRing& ring, engine::TrackerOptions options, TraceLimits limits = {});

  void include(int dimension, Slot slot, std::span<const Slot> facets, engine::Time time) override;
  void contract(const ops::TowerComplex& complex, const ops::TowerComplex::Changes& changes,
                engine::Time time) override;

  /// What it kept, or null once the tower was too large.
  [[nodiscard]] engine::BarcodeTracker* tracker() { return tracker_.get(); }
  [[nodiscard]] bool is_kept() const { return tracker_ != nullptr; }

 private:
  void count();

  std::unique_ptr<engine::BarcodeTracker> tracker_;
  TraceLimits limits_;
  std::uint64_t operations_ = 0;
};

}  // namespace sesame::replay

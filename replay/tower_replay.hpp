/// \file
/// Replaying a tower: the complex, and whatever tracks its homology, one operation after the other.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/barcode_tracker.hpp"
#include "ops/column_complex.hpp"
#include "ops/tower_complex.hpp"
#include "replay/tower_history.hpp"
#include "replay/tower_reader.hpp"

namespace sesame::replay {

/// A tower under way.
class TowerReplay {
 public:
  /// Trackers, and a history, are told of every operation; they have to outlive this object. The history may be null.
  explicit TowerReplay(std::vector<engine::BarcodeTracker*> trackers, TowerHistory* history = nullptr)
      : trackers_{std::move(trackers)}, history_{history} {}

  /// Applies the next operation, or leaves everything as it was. Errors: bad_input, without the place.
  Status apply(const TowerOperation& operation);

  [[nodiscard]] std::uint64_t operations() const { return operations_; }
  /// The number of cells of each dimension, up to the largest that has one.
  [[nodiscard]] std::span<const std::uint64_t> cells() const {
    return columns_.counts().empty() ? complex_.counts() : columns_.counts();
  }

 private:
  void include(int dimension, ops::TowerComplex::Slot slot, std::span<const ops::TowerComplex::Slot> facets,
               double time);
  void prefetch(const TowerOperation& operation) const;

  std::vector<engine::BarcodeTracker*> trackers_;
  TowerHistory* history_;
  ops::TowerComplex complex_;
  ops::ColumnComplex columns_;
  std::uint64_t operations_ = 0;
};

}  // namespace sesame::replay

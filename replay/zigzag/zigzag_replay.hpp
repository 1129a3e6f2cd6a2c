/// \file
/// Replaying a zigzag: the complex, and whatever tracks its homology, one operation after the other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/towers/barcode_tracker.hpp"
#include "engine/zigzag/zigzag_tracker.hpp"
#include "ops/simplicial/zigzag_complex.hpp"
#include "replay/tower/tower_reader.hpp"
#include "replay/zigzag/zigzag_history.hpp"

namespace sesame::replay {

/// A zigzag under way. Threads: one at a time, for queries too.
class ZigzagReplay {
 public:
  /// Trackers have to outlive this object. They are told nothing of cells more than one dimension above `dimensions`.
  /// `history`, or null, is told of all that they are, too.
  explicit ZigzagReplay(std::vector<engine::ZigzagTracker*> trackers,
                        engine::Dimensions dimensions = engine::all_dimensions, ZigzagHistory* history = nullptr);

  /// Applies the next operation, or leaves everything as it was. Errors, without the place: unknown_name when a face of
  /// a simplex is missing; bad_input.
  Status apply(const TowerOperation& operation);

  /// What is there, by labels, and what is wrong with an operation.
  [[nodiscard]] ops::TowerRules rules() const { return complex_.rules(); }
  [[nodiscard]] std::uint64_t operations() const { return operations_; }
  /// The number of cells of each dimension, up to the largest that has one.
  [[nodiscard]] std::span<const std::uint64_t> cells() const { return complex_.counts(); }

 private:
  using Cell = ops::ZigzagComplex::Cell;
  using Slot = ops::ZigzagComplex::Slot;

  [[nodiscard]] bool is_told(Cell cell) const {
    return !dimensions_.are_above(static_cast<std::size_t>(cell.dimension));
  }
  void include(Cell cell, std::span<const Slot> facets, engine::Moment moment);
  void exclude(Cell cell, engine::Moment moment);

  std::vector<engine::ZigzagTracker*> trackers_;
  engine::Dimensions dimensions_;
  ZigzagHistory* history_;
  ops::ZigzagComplex complex_;
  std::uint64_t operations_ = 0;
};

}  // namespace sesame::replay

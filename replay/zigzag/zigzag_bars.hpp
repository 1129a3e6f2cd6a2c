/// \file
/// From the moments at which classes of a zigzag were born and died to bars.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/towers/barcode_tracker.hpp"
#include "engine/zigzag/zigzag_tracker.hpp"

namespace sesame::replay {

/// Hands bars on: those that one operation ends sorted, whatever the order in which they were found. At one time all
/// operations count as one, so bars whose birth and death have one time are counted only.
class ZigzagBars {
 public:
  using OnBar = std::function<void(const engine::Bar&)>;

  /// Bars above `dimensions` are left out, and not counted.
  explicit ZigzagBars(OnBar on_bar, engine::Dimensions dimensions = engine::all_dimensions)
      : on_bar_{std::move(on_bar)}, dimensions_{dimensions} {}

  /// Takes a bar. Requires: its death is not before those of the bars so far.
  void add(const engine::MomentBar& bar);
  /// Hands on what there is: no more bars end by the operation of the last one.
  void flush();
  [[nodiscard]] std::uint64_t hidden() const { return hidden_; }

 private:
  OnBar on_bar_;
  engine::Dimensions dimensions_;
  std::uint64_t operation_ = 0;  ///< of the deaths of those at hand
  std::vector<engine::Bar> at_hand_;
  std::uint64_t hidden_ = 0;
};

}  // namespace sesame::replay

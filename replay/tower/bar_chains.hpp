/// \file
/// The chains of bars with the labels of their moments.
#pragma once

#include <cstdint>

#include "engine/towers/barcode_tracker.hpp"
#include "replay/tower/tower_history.hpp"

namespace sesame::replay {

/// What is said of the class of a bar.
struct BarChains {
  TowerHistory::NamedChain cycle;   ///< one that is born with the bar, in the complex at its birth
  TowerHistory::NamedChain second;  ///< what it bounds at the death; of an open bar, what the cycle is now
};

/// Works them out. Refers to what it is made of; the tracker keeps cycles. Threads: one at a time.
class BarChainNamer {
 public:
  /// `operations`: how many there were.
  BarChainNamer(engine::BarcodeTracker& tracker, const TowerHistory& history, std::uint64_t operations);

  [[nodiscard]] engine::BarCycles& cycles() const { return cycles_; }
  /// The last operation at the time of the birth, and at that of the death or, of an open bar, of all: the complex
  /// after it is the one that the chains are of.
  [[nodiscard]] std::uint64_t moment_of_birth(const engine::BarCycles::TracedBar& traced) const;
  [[nodiscard]] std::uint64_t moment_of_death(const engine::BarCycles::TracedBar& traced) const;
  /// Cost: what it takes to work out the cycle, and the chains times the logarithm of the number of contractions.
  [[nodiscard]] BarChains chains(const engine::BarCycles::TracedBar& traced) const;

 private:
  engine::BarCycles& cycles_;
  const TowerHistory& history_;
  std::uint64_t operations_;
  std::uint32_t characteristic_;
};

}  // namespace sesame::replay

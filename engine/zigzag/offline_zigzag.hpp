/// \file
/// The barcode of a zigzag that is over.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/towers/time_list.hpp"
#include "engine/zigzag/zigzag_tracker.hpp"
#include "sparse/growing_array.hpp"

namespace sesame::engine {

/// Many moments, in 16 bytes each as long as their times are doubles.
class MomentList {
 public:
  void push_back(Moment moment) {
    operations_.push_back(moment.operation);
    times_.push_back(moment.time);
  }
  [[nodiscard]] Moment operator[](std::size_t at) const { return {operations_[at], times_[at]}; }

 private:
  sparse::GrowingArray<std::uint64_t> operations_;
  TimeList times_;
};

/// Remembers a zigzag, and finds its barcode when all of it is known.
///
/// Each inclusion is a cell b of its own. An exclusion of b adds a cell e of one dimension less, before all that there
/// is, with boundary - (sum of the e of its facets) where these go later, and e is added to the boundary of b: so the
/// complex from then on is what is left. The last e, ..., the first e, the first b, ..., the last b is a filtration,
/// and its pairs are the bars of the zigzag: of b and b from inclusion to inclusion; of e and e from exclusion to
/// exclusion; of e and b between the exclusion and the inclusion, whichever comes first; what has no partner does not
/// end. The pairs are those of FiltrationPairs.
/// Source: T. K. Dey, T. Hou, "Fast computation of zigzag persistence" (2022), for the reduction to a filtration.
class OfflineZigzag final : public ZigzagTracker {
 public:
  using OnBar = ZigzagBarcode::OnBar;

  void include(int dimension, Slot slot, std::span<const Slot> facets, Moment moment) override;
  void exclude(int dimension, Slot slot, Moment moment) override;

  [[nodiscard]] std::size_t inclusions() const { return dimensions_.size(); }
  [[nodiscard]] std::size_t exclusions() const { return excluded_.size(); }
  /// The most cells that there ever were at once.
  [[nodiscard]] std::size_t most_present() const { return most_present_; }

  /// Tells somebody of everything, in order.
  void tell(ZigzagTracker& tracker) const;

  /// All bars but those of one operation, those that end by the order of their deaths, then the others; death = never
  /// for these. Requires: the ring is a field. Cost: the reduction of a matrix with a column for each change.
  ZigzagBarcode::Work for_each_bar(const sparse::AnyRing& ring, const OnBar& visit) const;

 private:
  friend class ZigzagFiltration;
  static constexpr std::uint32_t never_excluded = UINT32_MAX;

  sparse::GrowingArray<std::uint8_t> dimensions_;  ///< per inclusion
  sparse::GrowingArray<Slot> slots_;               ///< per inclusion
  sparse::GrowingArray<std::uint32_t> facets_;     ///< of all inclusions, by inclusion
  sparse::GrowingArray<std::uint64_t> first_;      ///< per inclusion: where its facets begin
  sparse::GrowingArray<std::uint32_t> exclusion_;  ///< per inclusion
  sparse::GrowingArray<std::uint32_t> excluded_;   ///< per exclusion: the inclusion
  sparse::GrowingArray<std::uint32_t> after_;      ///< per inclusion: how many exclusions were before it
  MomentList inclusions_, exclusions_;
  std::size_t most_present_ = 0;
  std::vector<std::vector<std::uint32_t>> present_;  ///< per dimension and slot: the last inclusion
};

}  // namespace sesame::engine

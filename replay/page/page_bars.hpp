/// \file
/// Bars as the page of a tower has them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/towers/barcode.hpp"
#include "ops/vocabulary/json_text.hpp"

namespace sesame::replay {

/// How times are written: numbers for JavaScript, which has doubles.
class PageTimes {
 public:
  /// Of a page with these bars.
  explicit PageTimes(std::span<const engine::Bar> bars);

  /// Whole numbers beyond 2^53 are counted from this one; else it is 0.
  [[nodiscard]] engine::Time origin() const { return origin_; }
  /// Whether all times are whole numbers, so that their differences are exact, and shorter.
  [[nodiscard]] bool are_whole() const { return are_whole_; }
  /// Whether some whole numbers are too large for doubles and too far apart for an origin.
  [[nodiscard]] bool are_rounded() const { return are_rounded_; }
  /// Counted from the origin.
  [[nodiscard]] double number(engine::Time time) const { return (time - origin_).nearest(); }
  void write(engine::Time time, ops::JsonText& out) const { write_number(number(time), out); }
  void write_number(double number, ops::JsonText& out) const;

 private:
  engine::Time origin_ = 0;
  bool are_whole_ = true, are_rounded_ = false;
};

/// The bars of each dimension that has some as {"dim","births","deaths","open"}: births and deaths of those that end,
/// and the births of the others. When times are whole, births are written as what they are more than the one before,
/// and instead of deaths there are "lengths". Requires: bars sorted.
void write_page_bars(std::span<const engine::Bar> bars, const PageTimes& times, ops::JsonText& out);

/// The numbers of bars on the page.
class PageBarNumbers {
 public:
  /// Requires: bars sorted; they outlive this.
  explicit PageBarNumbers(std::span<const engine::Bar> bars);
  /// Of the next bar that is the same as this one; nothing when all of these have been asked for.
  std::optional<std::uint64_t> next(const engine::Bar& bar);

 private:
  std::span<const engine::Bar> bars_;
  std::vector<std::uint64_t> numbers_;  ///< by the order of the barcode
  std::vector<std::size_t> asked_;      ///< how often for bars that are the same as this one, of which it is the first
};

}  // namespace sesame::replay

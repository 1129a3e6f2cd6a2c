/// \file
/// Axes of pictures: ranges, scales, ticks at round numbers.
#pragma once

#include <string>
#include <vector>

#include "engine/towers/barcode.hpp"

namespace sesame::replay {

/// Of every panel, in pixels.
constexpr double title_height = 28, axis_height = 44, right_margin = 16;

/// An interval of numbers, never of length 0.
struct Range {
  double low = 0, high = 1;
  bool is_integral = true;  ///< only whole numbers matter
  engine::Time origin = 0;  ///< from which low and high, and the values of ticks, are counted
};

/// From the first birth to the last birth or death that is finite. Whole numbers that are near to each other, but no
/// doubles, are counted from a round one near the first.
[[nodiscard]] Range time_range(const engine::Barcode& barcode);

/// The name of an axis for times, which says from where they are counted.
[[nodiscard]] std::string axis_name(const std::string& time_name, const Range& range);

/// The range with a part of its length more on both sides.
[[nodiscard]] Range widened(const Range& range, double part);

/// The linear map from a range to pixels. Differences of doubles may be too large for a double, and halves of them too
/// small, hence the wider type.
class Scale {
 public:
  Scale(const Range& range, double from, double to)
      : origin_{range.origin}, low_{range.low}, length_{range.high - low_}, from_{from}, to_{to} {}
  /// Of a number that is counted from the origin of the range.
  double operator()(double x) const { return from_ + (to_ - from_) * static_cast<double>((x - low_) / length_); }
  [[nodiscard]] double at(engine::Time time) const { return operator()((time - origin_).nearest()); }

 private:
  engine::Time origin_;
  long double low_, length_;
  double from_, to_;
};

struct Tick {
  double value;
  std::string label;
};

/// Ticks in the range at multiples of 1, 2 or 5 times a power of ten, about `most` at most. There may be but one, or
/// none, in a range that is hardly wider than the precision of doubles.
/// Requires: most >= 2.
[[nodiscard]] std::vector<Tick> round_ticks(const Range& range, std::size_t most);

/// As many as there is room for on a horizontal axis of that many pixels without labels that touch.
[[nodiscard]] std::vector<Tick> ticks_across(const Range& range, double pixels);

/// The width of the widest label.
[[nodiscard]] double label_width(const std::vector<Tick>& ticks);

}  // namespace sesame::replay

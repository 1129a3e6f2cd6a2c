/// \file
/// Axes of pictures: ranges, scales, ticks at round numbers.
#pragma once

#include <string>
#include <vector>

#include "engine/barcode.hpp"

namespace sesame::replay {

/// An interval of numbers, never of length 0.
struct Range {
  double low = 0, high = 1;
  bool is_integral = true;  ///< only whole numbers matter
};

/// From the first birth to the last birth or death that is finite.
[[nodiscard]] Range time_range(const engine::Barcode& barcode);

/// The range with a part of its length more on both sides.
[[nodiscard]] Range widened(const Range& range, double part);

/// The linear map from a range to pixels. Differences of doubles may be too large for a double, and halves of them too
/// small, hence the wider type.
class Scale {
 public:
  Scale(const Range& range, double from, double to)
      : low_{range.low}, length_{range.high - low_}, from_{from}, to_{to} {}
  double operator()(double x) const { return from_ + (to_ - from_) * static_cast<double>((x - low_) / length_); }

 private:
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

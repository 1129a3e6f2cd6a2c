/// \file
/// Lengths, areas and volumes of whatever size: coordinates as large as a double can be have areas far beyond it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

/// The number value * 2^exponent.
struct Measure {
  double value = 0;
  int exponent = 0;

  /// The nearest double: infinite when it would be too large, 0 when it would be too small.
  [[nodiscard]] double to_double() const;
};

/// Whether one is less than another, both as they are beyond the doubles.
[[nodiscard]] bool is_less(const Measure& a, const Measure& b);

/// Six digits, as `%g` has them.
[[nodiscard]] std::string to_text(const Measure& measure);

/// The least e with all coordinates within 2^e of 0; 0 when all of them are 0.
[[nodiscard]] int binary_exponent(std::span<const Point> points);

/// The point times 2^exponent. Nothing is rounded unless it falls below the normal doubles.
[[nodiscard]] Point scaled(const Point& point, int exponent);

/// The points, scaled by a power of two to within 1 of the origin: so no distance between them is too large for a
/// double.
[[nodiscard]] std::vector<Point> within_one(std::vector<Point> points);

}  // namespace sesame::tools

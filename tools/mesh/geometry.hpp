/// \file
/// Arithmetic of points as vectors, and boxes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

[[nodiscard]] inline Point minus(const Point& p, const Point& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
[[nodiscard]] inline double dot(const Point& p, const Point& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }
[[nodiscard]] inline Point cross(const Point& p, const Point& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

/// The lowest and the highest coordinates of some points.
using Box = std::array<Point, 2>;

/// That of no points.
[[nodiscard]] inline Box empty_box() {
  constexpr double most = std::numeric_limits<double>::max();
  return {Point{most, most, most}, Point{-most, -most, -most}};
}
inline void extend(Box& box, const Point& point) {
  for (std::size_t i = 0; i < 3; ++i) {
    box[0][i] = std::min(box[0][i], point[i]);
    box[1][i] = std::max(box[1][i], point[i]);
  }
}

}  // namespace sesame::tools

/// \file
/// Linking numbers by the integral of Gauss, in doubles: the plain twin of exact ones.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "tools/mesh/geometry.hpp"

namespace sesame::tools {

/// The part of a cycle along a segment.
struct WeightedSegment {
  std::array<Point, 2> ends;
  double times = 1;
};

/// The signed solid angle of a triangle, seen from 0. Source: A. van Oosterom and J. Strackee, "The solid angle of a
/// plane triangle" (1983).
inline double solid_angle(const Point& a, const Point& b, const Point& c) {
  const double la = std::sqrt(dot(a, a));
  const double lb = std::sqrt(dot(b, b));
  const double lc = std::sqrt(dot(c, c));
  return 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

/// Of two cycles that do not meet. The differences of points on two segments are a parallelogram, and its solid angle,
/// over that of a sphere, is the integral of Gauss for the two but for its sign, which is that of the sum over
/// crossings where the second is in front, of det(second, first, towards the eye).
inline double linking_number(const std::vector<WeightedSegment>& one, const std::vector<WeightedSegment>& other) {
  double sum = 0;
  for (const auto& [p, p_times] : one) {
    for (const auto& [q, q_times] : other) {
      const Point a = minus(p[0], q[0]);
      const Point b = minus(p[1], q[0]);
      const Point c = minus(p[1], q[1]);
      const Point d = minus(p[0], q[1]);
      sum += p_times * q_times * (solid_angle(a, b, c) + solid_angle(a, c, d));
    }
  }
  return -sum / (4 * std::numbers::pi);
}

inline std::vector<WeightedSegment> segments_of(const std::vector<Point>& polygon) {
  std::vector<WeightedSegment> segments;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    segments.push_back({{polygon[i], polygon[(i + 1) % polygon.size()]}, 1});
  }
  return segments;
}

inline double linking_number(const std::vector<Point>& one, const std::vector<Point>& other) {
  return linking_number(segments_of(one), segments_of(other));
}

}  // namespace sesame::tools

/// \file
/// Signs of determinants of points of a mesh, never wrong by rounding.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sparse/integer.hpp"
#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

/// A vertex of a mesh, the middle of an edge, or the middle of a triangle, by the vertices that it is the mean of.
struct MeanPoint {
  std::array<std::uint32_t, 3> vertices{};
  std::uint32_t count = 1;  ///< how many of them: 1, 2 or 3

  [[nodiscard]] static MeanPoint vertex(std::uint32_t v) { return {{v, v, v}, 1}; }
  [[nodiscard]] static MeanPoint middle(std::uint32_t a, std::uint32_t b) { return {{a, b, b}, 2}; }
  [[nodiscard]] static MeanPoint middle(const std::array<std::uint32_t, 3>& triangle) { return {triangle, 3}; }
};

/// A direction in space; its entries are below 2^20 in size.
using Direction = std::array<std::int32_t, 3>;

/// Takes the coordinates as the numbers that they are, and answers -1, 0 or 1. Doubles decide where the error that they
/// may have is smaller than what they say, integers of any size where it is not: some tens of nanoseconds, or some
/// microseconds.
class ExactSigns {
 public:
  /// Requires: coordinates within 1 of 0. `points` must outlive it. Cost: the points.
  explicit ExactSigns(std::span<const Point> points);

  /// Six times a point, but for rounding.
  [[nodiscard]] Point sixfold(const MeanPoint& point) const;
  /// Of det(b - a, c - a, d): which way a, b, c turn as seen against the direction d.
  [[nodiscard]] int turn(const MeanPoint& a, const MeanPoint& b, const MeanPoint& c, const Direction& d) const;
  /// Of det(b - a, w, d).
  [[nodiscard]] int turn(const MeanPoint& a, const MeanPoint& b, const Direction& w, const Direction& d) const;
  /// Of det(b - a, c - a, e - a): positive when e is on the side from which a, b, c turn counterclockwise.
  [[nodiscard]] int side(const MeanPoint& a, const MeanPoint& b, const MeanPoint& c, const MeanPoint& e) const;
  /// Of the volume that closed and oriented triangles enclose: positive when they face outwards.
  [[nodiscard]] int volume(std::span<const std::array<std::uint32_t, 3>> triangles) const;

 private:
  using Vector = std::array<sparse::Integer, 3>;

  [[nodiscard]] sparse::Integer exact(double x) const;
  [[nodiscard]] Vector difference(const MeanPoint& a, const MeanPoint& b) const;

  std::span<const Point> points_;
  int lowest_ = 0;  ///< every coordinate is a whole multiple of 2^lowest_
};

}  // namespace sesame::tools

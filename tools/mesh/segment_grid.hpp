/// \file
/// Which segments come near each other when they are seen against a direction.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "tools/mesh/exact_signs.hpp"
#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

/// A box in the plane that has the shadow of a segment in it, whatever rounding does.
struct Shadow {
  std::array<double, 2> low;
  std::array<double, 2> high;
};

/// A plane across a direction.
class ShadowPlane {
 public:
  /// Requires: the direction is not 0.
  explicit ShadowPlane(const Direction& direction);
  /// Requires: coordinates within 6 of 0.
  [[nodiscard]] Shadow shadow(const Point& p, const Point& q) const;

 private:
  std::array<Point, 2> axes_;
};

/// Boxes in the squares of a grid, of which there are about as many as boxes.
class SegmentGrid {
 public:
  explicit SegmentGrid(std::vector<Shadow> shadows);

  /// Calls visit(k) once for each box k that meets one. Cost: the boxes in the squares that it meets.
  template <class Visit>
  void for_each_near(const Shadow& box, Visit&& visit) const {
    if (shadows_.empty()) {
      return;
    }
    const auto first = square(box.low);
    const auto last = square(box.high);
    for (std::uint32_t y = first[1]; y <= last[1]; ++y) {
      for (std::uint32_t x = first[0]; x <= last[0]; ++x) {
        const std::size_t here = std::size_t{y} * size_[0] + x;
        for (std::uint32_t k = begin_[here]; k < begin_[here + 1]; ++k) {
          const Shadow& other = shadows_[inside_[k]];
          // Of all squares that both meet, in the lowest one.
          const bool meets = other.low[0] <= box.high[0] && box.low[0] <= other.high[0] &&
                             other.low[1] <= box.high[1] && box.low[1] <= other.high[1];
          if (meets &&
              std::array{x, y} == square({std::max(box.low[0], other.low[0]), std::max(box.low[1], other.low[1])})) {
            visit(inside_[k]);
          }
        }
      }
    }
  }

 private:
  /// The square that has a point, or the one nearest to it.
  [[nodiscard]] std::array<std::uint32_t, 2> square(const std::array<double, 2>& point) const;

  std::vector<Shadow> shadows_;
  std::array<double, 2> low_{};
  double width_ = 1;  ///< of a square
  std::array<std::uint32_t, 2> size_{1, 1};
  std::vector<std::uint32_t> begin_;  ///< per square, where its boxes begin in inside_; one more
  std::vector<std::uint32_t> inside_;
};

}  // namespace sesame::tools

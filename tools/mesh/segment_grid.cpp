#include "tools/mesh/segment_grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/mesh/geometry.hpp"

namespace sesame::tools {

namespace {

Point unit(const Point& v) {
  const double length = std::hypot(v[0], v[1], v[2]);
  return {v[0] / length, v[1] / length, v[2] / length};
}

}  // namespace

ShadowPlane::ShadowPlane(const Direction& direction) {
  const Point along =
      unit({static_cast<double>(direction[0]), static_cast<double>(direction[1]), static_cast<double>(direction[2])});
  Point other{};  // the axis that is farthest from the direction
  std::size_t least = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (std::abs(along[i]) < std::abs(along[least])) {
      least = i;
    }
  }
  other[least] = 1;
  axes_[0] = unit(cross(along, other));
  axes_[1] = cross(along, axes_[0]);
}

Shadow ShadowPlane::shadow(const Point& p, const Point& q) const {
  constexpr double rounding = 1e-13;
  Shadow box{};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto [low, high] = std::minmax({dot(p, axes_[i]), dot(q, axes_[i])});
    box.low[i] = low - rounding;
    box.high[i] = high + rounding;
  }
  return box;
}

SegmentGrid::SegmentGrid(std::vector<Shadow> shadows) : shadows_{std::move(shadows)} {
  if (shadows_.empty()) {
    return;
  }
  low_ = shadows_.front().low;
  std::array<double, 2> high = shadows_.front().high;
  double sum = 0;
  for (const Shadow& box : shadows_) {
    for (std::size_t i = 0; i < 2; ++i) {
      low_[i] = std::min(low_[i], box.low[i]);
      high[i] = std::max(high[i], box.high[i]);
    }
    sum += std::max(box.high[0] - box.low[0], box.high[1] - box.low[1]);
  }
  // As wide as boxes are, but not so narrow that there are more squares than boxes.
  const auto count = static_cast<double>(shadows_.size());
  const std::array<double, 2> extent{high[0] - low_[0], high[1] - low_[1]};
  width_ = std::max({sum / count, std::sqrt(extent[0] * extent[1] / count), extent[0] / count, extent[1] / count});
  for (std::size_t i = 0; i < 2; ++i) {
    size_[i] = static_cast<std::uint32_t>(extent[i] / width_) + 1;
  }
  std::vector<std::uint32_t> fill(std::size_t{size_[0]} * size_[1] + 1, 0);
  const auto for_each_square = [this](const Shadow& box, const auto& visit) {
    const auto first = square(box.low);
    const auto last = square(box.high);
    for (std::uint32_t y = first[1]; y <= last[1]; ++y) {
      for (std::uint32_t x = first[0]; x <= last[0]; ++x) {
        visit(std::size_t{y} * size_[0] + x);
      }
    }
  };
  for (const Shadow& box : shadows_) {
    for_each_square(box, [&fill](std::size_t here) { ++fill[here + 1]; });
  }
  for (std::size_t here = 1; here < fill.size(); ++here) {
    fill[here] += fill[here - 1];
  }
  begin_ = fill;
  inside_.resize(fill.back());
  for (std::uint32_t k = 0; k < shadows_.size(); ++k) {
    for_each_square(shadows_[k], [&](std::size_t here) { inside_[fill[here]++] = k; });
  }
}

std::array<std::uint32_t, 2> SegmentGrid::square(const std::array<double, 2>& point) const {
  std::array<std::uint32_t, 2> place{};
  for (std::size_t i = 0; i < 2; ++i) {
    const double steps = std::floor((point[i] - low_[i]) / width_);
    place[i] = static_cast<std::uint32_t>(std::clamp(steps, 0.0, static_cast<double>(size_[i] - 1)));
  }
  return place;
}

}  // namespace sesame::tools

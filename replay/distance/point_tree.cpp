#include "replay/distance/point_tree.hpp"

#include <algorithm>

namespace sesame::replay {
namespace {

using engine::Time;

/// Of x from the interval [low, high]. Rounding is monotonic: no point in the interval is computed to be nearer.
Time gap(Time x, Time low, Time high) { return x < low ? low - x : x > high ? x - high : Time{}; }

}  // namespace

PointTree::PointTree(std::span<const DiagramPoint> points, std::vector<PointId> members)
    : points_{points}, members_{std::move(members)} {
  if (!members_.empty()) {
    build(0, 0, members_.size());
  }
}

void PointTree::build(std::size_t node, std::size_t begin, std::size_t end) {
  if (nodes_.size() <= node) {
    nodes_.resize(node + 1);
  }
  DiagramPoint low = points_[members_[begin]], high = low;
  for (std::size_t i = begin; i < end; ++i) {
    const DiagramPoint& point = points_[members_[i]];
    low = {std::min(low.birth, point.birth), std::min(low.death, point.death)};
    high = {std::max(high.birth, point.birth), std::max(high.death, point.death)};
  }
  nodes_[node] = {low, high, static_cast<PointId>(end - begin)};
  if (end - begin <= leaf_size) {
    return;
  }
  const auto at = [&](std::size_t i) { return members_.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t middle = begin + (end - begin) / 2;
  Time DiagramPoint::*const side =
      high.birth - low.birth > high.death - low.death ? &DiagramPoint::birth : &DiagramPoint::death;
  std::nth_element(at(begin), at(middle), at(end),
                   [&](PointId x, PointId y) { return points_[x].*side < points_[y].*side; });
  build(2 * node + 1, begin, middle);
  build(2 * node + 2, middle, end);
}

PointId PointTree::take_within(const DiagramPoint& centre, Time radius) {
  return members_.empty() ? no_point : take(0, 0, members_.size(), centre, radius);
}

PointId PointTree::take(std::size_t node, std::size_t begin, std::size_t end, const DiagramPoint& centre, Time radius) {
  Node& here = nodes_[node];
  if (here.present == 0 || gap(centre.birth, here.low.birth, here.high.birth) > radius ||
      gap(centre.death, here.low.death, here.high.death) > radius) {
    return no_point;
  }
  PointId taken = no_point;
  if (end - begin <= leaf_size) {
    for (std::size_t i = begin; i < begin + here.present; ++i) {
      if (ground_distance(points_[members_[i]], centre, GroundMetric::maximum) <= radius) {
        taken = members_[i];
        std::swap(members_[i], members_[begin + here.present - 1]);
        break;
      }
    }
  } else {
    const std::size_t middle = begin + (end - begin) / 2;
    taken = take(2 * node + 1, begin, middle, centre, radius);
    if (taken == no_point) {
      taken = take(2 * node + 2, middle, end, centre, radius);
    }
  }
  here.present -= taken == no_point ? 0 : 1;
  return taken;
}

void PointTree::restore() {
  if (!members_.empty()) {
    restore(0, 0, members_.size());
  }
}

void PointTree::restore(std::size_t node, std::size_t begin, std::size_t end) {
  nodes_[node].present = static_cast<PointId>(end - begin);
  if (end - begin > leaf_size) {
    const std::size_t middle = begin + (end - begin) / 2;
    restore(2 * node + 1, begin, middle);
    restore(2 * node + 2, middle, end);
  }
}

}  // namespace sesame::replay

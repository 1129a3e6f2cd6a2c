/// \file
/// Points of the plane, found and taken away by nearness in the maximum metric.
#pragma once

#include <span>
#include <vector>

#include "replay/distance/diagram_parts.hpp"

namespace sesame::replay {

/// A k-d tree over some of the points of an array, which must outlive it. Points can only be taken out, or all put
/// back.
class PointTree {
 public:
  /// Cost: O(n * log n).
  PointTree(std::span<const DiagramPoint> points, std::vector<PointId> members);

  /// Takes a point whose distance from `centre` is at most `radius` out of the tree; no_point when there is none.
  /// Distances are compared as ground_distance computes them, to the last bit.
  /// Cost: O(sqrt n) at worst, mostly O(log n).
  PointId take_within(const DiagramPoint& centre, engine::Time radius);

  /// Puts all points back. Cost: O(n / leaf size).
  void restore();

 private:
  static constexpr std::size_t leaf_size = 8;

  /// Node k has the children 2k + 1 and 2k + 2; which members are below it follows from the halving of ranges.
  struct Node {
    DiagramPoint low, high;  ///< the box of all its points, taken or not
    PointId present;         ///< points not taken; those of a leaf stand first in its range
  };

  void build(std::size_t node, std::size_t begin, std::size_t end);
  PointId take(std::size_t node, std::size_t begin, std::size_t end, const DiagramPoint& centre, engine::Time radius);
  void restore(std::size_t node, std::size_t begin, std::size_t end);

  std::span<const DiagramPoint> points_;
  std::vector<PointId> members_;
  std::vector<Node> nodes_;
};

}  // namespace sesame::replay

/// \file
/// Shortest paths from a point along the edges of a mesh, and the loops that they make.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "tools/mesh/short_loops.hpp"

namespace sesame::tools {

/// Shortest paths from a root, as far as a radius. Reused from root to root: cleared at the cost of what was reached.
class PathTree {
 public:
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  struct Step {
    double distance = infinite;
    std::uint32_t before = 0;  ///< the point before this one on the path from the root
    std::uint32_t edge = none;
    std::uint32_t depth = 0;
    bool is_settled = false;
  };
  static constexpr std::uint32_t none = 0xffffffff;

  explicit PathTree(const EdgeGraph& graph) : graph_{graph}, steps_(graph.points()) {}

  /// Dijkstra's algorithm; ties go to the lower point. Returns the number of ways walked.
  std::uint64_t grow(std::uint32_t root, double radius) {
    clear();
    std::uint64_t walked = 0;
    Queue queue;
    reach(root, {0, root, none, 0, false}, queue);
    while (!queue.empty()) {
      const auto [distance, point] = queue.top();
      queue.pop();
      if (steps_[point].is_settled) {
        continue;
      }
      if (distance > radius) {
        break;
      }
      steps_[point].is_settled = true;
      settled_.push_back(point);
      for (const auto& way : graph_.ways(point)) {
        ++walked;
        const double length = distance + way.length;
        if (length < steps_[way.to].distance) {
          reach(way.to, {length, point, way.edge, steps_[point].depth + 1, false}, queue);
        }
      }
    }
    return walked;
  }

  /// The points within the radius, nearest first.
  [[nodiscard]] const std::vector<std::uint32_t>& settled() const { return settled_; }
  [[nodiscard]] const Step& step(std::uint32_t point) const { return steps_[point]; }

  /// The loop of an edge outside the tree, without what its two paths have in common.
  [[nodiscard]] Loop loop(std::uint32_t from, const EdgeGraph::Way& way) const {
    Loop loop;
    loop.length = steps_[from].distance + way.length + steps_[way.to].distance;
    std::vector<std::uint32_t> back;
    std::uint32_t a = from;
    std::uint32_t b = way.to;
    while (a != b) {
      if (steps_[a].depth >= steps_[b].depth) {
        loop.points.push_back(a);
        a = steps_[a].before;
      } else {
        back.push_back(b);
        b = steps_[b].before;
      }
    }
    loop.length -= 2 * steps_[a].distance;
    loop.points.push_back(a);
    loop.points.insert(loop.points.end(), back.rbegin(), back.rend());
    return loop;
  }

 private:
  using Reached = std::pair<double, std::uint32_t>;
  using Queue = std::priority_queue<Reached, std::vector<Reached>, std::greater<>>;

  void reach(std::uint32_t point, const Step& step, Queue& queue) {
    if (steps_[point].distance == infinite) {
      touched_.push_back(point);
    }
    steps_[point] = step;
    queue.emplace(step.distance, point);
  }

  void clear() {
    for (const auto point : touched_) {
      steps_[point] = Step{};
    }
    touched_.clear();
    settled_.clear();
  }

  const EdgeGraph& graph_;
  std::vector<Step> steps_;
  std::vector<std::uint32_t> touched_;
  std::vector<std::uint32_t> settled_;
};

}  // namespace sesame::tools

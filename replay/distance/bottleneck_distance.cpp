// Whether a cost of r is enough: points nearer than r to the diagonal can go there, only the others, the far ones, need
// partners. The far points of the left must be matched to any points of the right within r, and the far points of the
// right to any of the left; when each can be done by itself, both can be done at once (Mendelsohn and Dulmage 1958).
// So there are two bipartite problems without diagonal points, each solved as by Hopcroft and Karp, where the edges are
// not listed but found by a search tree from which visited points are taken (Efrat, Itai and Katz).
// Which r: doubles from 0 on are ordered as their bit patterns are, so halving an interval of patterns ends after at
// most 64 questions, at the least double that is enough. It is one of the distances, exactly as computed; or beyond
// 2^53 the one that is looked for may be a whole number below it, which is no double: at most 11 questions more.
#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "replay/distance/point_tree.hpp"
#include "sparse/contract.hpp"

namespace sesame::replay {
namespace {

using engine::Time;
using Points = std::span<const DiagramPoint>;

Time to_diagonal(const DiagramPoint& x) { return distance_to_diagonal(x, GroundMetric::maximum); }

Time between(const DiagramPoint& x, const DiagramPoint& y) { return ground_distance(x, y, GroundMetric::maximum); }

std::vector<PointId> all_of(Points points) {
  std::vector<PointId> all(points.size());
  std::iota(all.begin(), all.end(), PointId{0});
  return all;
}

/// Matches the far points of one side, `from`, to points of the other, `to`. The matching of one question is where the
/// next one starts.
class FarMatching {
 public:
  FarMatching(Points from, Points to)
      : from_{from}, to_{to}, tree_(to, all_of(to)), partner_(from.size(), no_point), owner_(to.size(), no_point) {}

  /// Whether all points of `from` that are farther than r from the diagonal can be matched within r.
  bool is_enough(Time r) {
    drop_edges(r);
    while (!free_.empty()) {
      if (!find_layers(r)) {
        return false;
      }
      std::erase_if(free_, [&](PointId x) { return augment(x, r); });
    }
    return true;
  }

  /// Of each point of `from`; no_point for those that need none.
  [[nodiscard]] const std::vector<PointId>& partners() const { return partner_; }
  /// Of each point of `to`.
  [[nodiscard]] const std::vector<PointId>& owners() const { return owner_; }

 private:
  /// Keeps the edges that can still be used, and lists the far points without one.
  void drop_edges(Time r) {
    free_.clear();
    for (PointId x = 0; x < from_.size(); ++x) {
      const bool is_far = to_diagonal(from_[x]) > r;
      if (partner_[x] != no_point && (!is_far || between(from_[x], to_[partner_[x]]) > r)) {
        owner_[partner_[x]] = no_point;
        partner_[x] = no_point;
      }
      if (is_far && partner_[x] == no_point) {
        free_.push_back(x);
      }
    }
  }

  /// The points of `to` by the length of the shortest alternating path from a free point, up to the first layer with
  /// points that have no owner; of that layer only those. False when there is no such layer.
  bool find_layers(Time r) {
    tree_.restore();
    layers_.clear();
    std::vector<PointId> ends = free_, layer, unowned;
    while (unowned.empty() && !ends.empty()) {
      layer.clear();
      std::vector<PointId> next;
      for (const PointId x : ends) {
        for (PointId y = tree_.take_within(from_[x], r); y != no_point; y = tree_.take_within(from_[x], r)) {
          layer.push_back(y);
          if (owner_[y] == no_point) {
            unowned.push_back(y);
          } else {
            next.push_back(owner_[y]);
          }
        }
      }
      layers_.emplace_back(to_, unowned.empty() ? layer : unowned);
      ends = std::move(next);
    }
    return !unowned.empty();
  }

  /// Follows layer after layer from a free point, taking what it meets, and turns the path around when it reaches the
  /// last.
  bool augment(PointId x, Time r) {
    path_.assign(1, {x, no_point});
    while (!path_.empty()) {
      Edge& edge = path_.back();
      edge.to = layers_[path_.size() - 1].take_within(from_[edge.from], r);
      if (edge.to == no_point) {
        path_.pop_back();
      } else if (path_.size() < layers_.size()) {
        path_.push_back({owner_[edge.to], no_point});
      } else {
        for (const Edge& used : path_) {
          partner_[used.from] = used.to;
          owner_[used.to] = used.from;
        }
        return true;
      }
    }
    return false;
  }

  struct Edge {
    PointId from, to;
  };

  Points from_, to_;
  PointTree tree_;                        ///< of all points of `to`
  std::vector<PointId> partner_, owner_;  ///< the matching, from both sides
  std::vector<PointId> free_;             ///< far points that still need a partner
  std::vector<PointTree> layers_;
  std::vector<Edge> path_;
};

/// One matching that covers what each of the two covers on its own side: beginning with the first, each point of the
/// right that only the second covers draws a path of edges from both, along which the second one's are taken.
std::vector<PointId> merged(const FarMatching& of_left, const FarMatching& of_right) {
  std::vector<PointId> partner = of_left.partners(), owner = of_left.owners();
  const std::vector<PointId>& wanted = of_right.partners();
  for (PointId start = 0; start < wanted.size(); ++start) {
    PointId y = owner[start] == no_point ? start : no_point;
    while (y != no_point && wanted[y] != no_point) {
      const PointId x = wanted[y];
      const PointId freed = partner[x];
      partner[x] = y;
      owner[y] = x;
      if (freed != no_point) {
        owner[freed] = no_point;
      }
      y = freed;
    }
  }
  return partner;
}

/// The least number from first to last that is enough. Requires: the last is, and so are all above one that is.
template <class IsEnough>
std::uint64_t least(std::uint64_t first, std::uint64_t last, IsEnough&& is_enough) {
  while (first < last) {
    const std::uint64_t middle = first + (last - first) / 2;
    if (is_enough(middle)) {
      last = middle;
    } else {
      first = middle + 1;
    }
  }
  return first;
}

/// The least time that is enough, when x is the least double that is: the whole numbers before it are times too.
template <class IsEnough>
Time least_between_doubles(double x, IsEnough&& is_enough) {
  constexpr double two_to_64 = 18446744073709551616.0;
  const double before = std::nextafter(x, 0.0);
  if (x - before <= 1 || x > two_to_64) {
    return x;
  }
  const auto gap = static_cast<std::uint64_t>(x - before);
  const auto time = [&](std::uint64_t k) { return k == gap ? Time{x} : Time{static_cast<std::uint64_t>(before) + k}; };
  return time(least(1, gap, [&](std::uint64_t k) { return is_enough(time(k)); }));
}

}  // namespace

std::vector<PointId> bottleneck_partners(Points left, Points right) {
  FarMatching of_left(left, right), of_right(right, left);
  const auto is_enough = [&](Time r) { return of_left.is_enough(r) && of_right.is_enough(r); };
  Time most;
  for (const Points side : {left, right}) {
    for (const DiagramPoint& point : side) {
      most = std::max(most, to_diagonal(point));
    }
  }
  const std::uint64_t last = std::bit_cast<std::uint64_t>(most.nearest()) + (most > most.nearest() ? 1 : 0);
  const auto least_double = std::bit_cast<double>(
      least(0, last, [&](std::uint64_t pattern) { return is_enough(std::bit_cast<double>(pattern)); }));
  const Time found = least_between_doubles(least_double, is_enough);
  sparse::expects(is_enough(found), "the cost that was found is enough");
  return merged(of_left, of_right);
}

DiagramDistance bottleneck_distance(std::span<const engine::Bar> left, std::span<const engine::Bar> right) {
  const DiagramParts left_parts(left), right_parts(right);
  DiagramDistance found{
      0, whole_matching(left, right, left_parts, right_parts,
                        bottleneck_partners(left_parts.points, right_parts.points), GroundMetric::maximum)};
  for (const Match& match : found.matching) {
    found.value = std::max(found.value, match.cost);
  }
  return found;
}

}  // namespace sesame::replay

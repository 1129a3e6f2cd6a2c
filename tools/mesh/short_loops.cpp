#include "tools/mesh/short_loops.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "tools/mesh/basis_selection.hpp"
#include "tools/mesh/fingerprint.hpp"
#include "tools/mesh/path_tree.hpp"

namespace sesame::tools {

namespace {

using sparse::Index;
using sparse::Integers;
using sparse::Terms;

void to_canonical(Loop& loop) {
  auto& points = loop.points;
  std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
  if (points.size() > 2 && points.back() < points[1]) {
    std::reverse(points.begin() + 1, points.end());
  }
}

bool is_shorter(const Loop& a, const Loop& b) {
  return a.length != b.length ? a.length < b.length : a.points < b.points;
}

/// The sum of fingerprints along the paths from a root, for one annotation.
class Potential {
 public:
  Potential(const EdgeGraph& graph, const Annotation& annotation, const sparse::AnyRing& ring)
      : fingerprinter_{ring}, of_point_(graph.points()) {
    of_edge_.reserve(annotation.of_edge.size());
    for (const auto& vector : annotation.of_edge) {
      of_edge_.push_back(fingerprinter_.of(vector));
    }
  }

  void follow(const PathTree& tree) {
    for (const auto point : tree.settled()) {
      const auto& step = tree.step(point);
      of_point_[point] = step.edge == PathTree::none ? Fingerprint{} : beyond(step.before, step.edge, point);
    }
  }
  /// The fingerprint of the loop of an edge outside the tree.
  [[nodiscard]] Fingerprint around(std::uint32_t from, const EdgeGraph::Way& way) const {
    Fingerprint sum = beyond(from, way.edge, way.to);
    fingerprinter_.subtract(sum, of_point_[way.to]);
    return sum;
  }
  [[nodiscard]] Fingerprint up_to_sign(const Fingerprint& f) const {
    Fingerprint minus{};
    fingerprinter_.subtract(minus, f);
    return std::min(f, minus);
  }

 private:
  [[nodiscard]] Fingerprint beyond(std::uint32_t from, std::uint32_t edge, std::uint32_t to) const {
    Fingerprint sum = of_point_[from];
    if (from < to) {
      fingerprinter_.add(sum, of_edge_[edge]);
    } else {
      fingerprinter_.subtract(sum, of_edge_[edge]);
    }
    return sum;
  }

  Fingerprinter fingerprinter_;
  std::vector<Fingerprint> of_edge_;
  std::vector<Fingerprint> of_point_;
};

class Search {
 public:
  Search(const EdgeGraph& graph, const LoopSearch& search)
      : graph_{graph}, search_{search}, tree_{graph}, wanted_{graph, *search.wanted, search.ring} {
    if (search_.zero != nullptr) {
      zero_.emplace(graph, *search_.zero, sparse::Integers{});
    }
  }

  LoopBasis run() {
    if (search_.wanted->rank == 0) {
      return std::move(found_);
    }
    look_at_each_component();
    select();
    look_from_spread_points();
    select();
    for (int round = 0; round < most_rounds && walked_ < search_.effort; ++round) {
      const double before = total_length();
      look_along_loops();
      select();
      if (total_length() > (1 - 1e-9) * before) {
        break;
      }
    }
    return std::move(found_);
  }

 private:
  static constexpr int most_rounds = 6;
  static constexpr std::size_t spread_per_component = 16;
  static constexpr std::size_t roots_per_loop = 32;
  static constexpr std::size_t most_pooled_points = 4'000'000;

  void look_at_each_component() {
    std::vector<bool> is_seen(graph_.points(), false);
    for (std::uint32_t point = 0; point < graph_.points(); ++point) {
      if (is_seen[point] || graph_.ways(point).empty()) {
        continue;
      }
      const bool has_loops = look_from(point, PathTree::infinite);
      const auto& reached = tree_.settled();
      for (const auto other : reached) {
        is_seen[other] = true;
      }
      if (!has_loops) {
        continue;
      }
      const std::size_t spread = std::min(spread_per_component, reached.size() - 1);
      for (std::size_t i = 1; i <= spread; ++i) {
        spread_.push_back(reached[i * (reached.size() - 1) / spread]);
      }
    }
    walked_ = 0;
  }

  /// Half of the effort goes to points that are spread, half to those on the loops found.
  void look_from_spread_points() {
    for (const auto root : spread_) {
      if (walked_ > search_.effort / 2) {
        return;
      }
      look_from(root, longest_ / 2);
    }
  }

  /// A loop through a point that is shorter than a given one stays within half of its length of the point.
  void look_along_loops() {
    const std::vector<Loop> longest_first{found_.loops.rbegin(), found_.loops.rend()};
    for (const Loop& loop : longest_first) {
      const std::size_t count = std::min(roots_per_loop, loop.points.size());
      for (std::size_t i = 0; i < count; ++i) {
        if (walked_ > search_.effort) {
          return;
        }
        look_from(loop.points[i * loop.points.size() / count], loop.length / 2);
      }
    }
  }

  /// Pools the loops from a root, the shortest of each class. Returns whether there were any.
  bool look_from(std::uint32_t root, double radius) {
    walked_ += tree_.grow(root, radius);
    wanted_.follow(tree_);
    if (zero_) {
      zero_->follow(tree_);
    }
    bool has_loops = false;
    for (const auto from : tree_.settled()) {
      for (const auto& way : graph_.ways(from)) {
        if (from > way.to || !tree_.step(way.to).is_settled) {
          continue;
        }
        if (way.edge == tree_.step(from).edge || way.edge == tree_.step(way.to).edge) {
          continue;
        }
        const Fingerprint fingerprint = wanted_.around(from, way);
        if (fingerprint == Fingerprint{}) {
          continue;
        }
        if (zero_ && zero_->around(from, way) != Fingerprint{}) {
          continue;
        }
        has_loops = true;
        pool(wanted_.up_to_sign(fingerprint), tree_.loop(from, way));
      }
    }
    if (pooled_points_ > most_pooled_points) {
      select();
    }
    return has_loops;
  }

  void pool(const Fingerprint& fingerprint, Loop loop) {
    ++found_.tried;
    if (loop.length >= longest_) {
      return;
    }
    const auto [at, is_new] = place_in_pool_.emplace(fingerprint, pool_.size());
    if (is_new) {
      pool_.emplace_back();
    } else if (pool_[at->second].length <= loop.length) {
      return;
    }
    Loop& kept = pool_[at->second];
    pooled_points_ += loop.points.size();
    pooled_points_ -= kept.points.size();
    kept = std::move(loop);
  }

  /// The best basis of what is pooled and what was taken before.
  void select() {
    for (Loop& loop : pool_) {
      to_canonical(loop);
    }
    std::move(found_.loops.begin(), found_.loops.end(), std::back_inserter(pool_));
    std::sort(pool_.begin(), pool_.end(), is_shorter);
    found_.loops.clear();
    found_.completion.clear();
    std::visit([this](const auto& ring) { select_over(ring); }, search_.ring);
    pool_.clear();
    place_in_pool_.clear();
    pooled_points_ = 0;
    longest_ = PathTree::infinite;
    if (found_.completion.empty() && !found_.loops.empty()) {
      longest_ = found_.loops.back().length;
    }
  }

  template <sparse::Ring R>
  void select_over(const R& ring) {
    BasisSelection<R> selection{ring, search_.wanted->rank};
    for (Loop& loop : pool_) {
      if (selection.missing() == 0) break;
      if (search_.zero != nullptr && !class_of(graph_, *search_.zero, loop).empty()) continue;
      sparse::RawTerms<R> vector;
      for (const auto& [index, coefficient] : class_of(graph_, *search_.wanted, loop)) {
        vector.push_back({index, ring.from(coefficient)});
      }
      if (selection.take(std::move(vector).normal(ring))) {
        found_.loops.push_back(std::move(loop));
      }
    }
    for (const auto& vector : selection.completion()) {
      auto& integers = found_.completion.emplace_back();
      for (const auto& [index, coefficient] : vector) {
        integers.push_back({index, ring.to_integer(coefficient)});
      }
    }
  }

  [[nodiscard]] double total_length() const {
    double sum = 0;
    for (const Loop& loop : found_.loops) {
      sum += loop.length;
    }
    return sum;
  }

  const EdgeGraph& graph_;
  const LoopSearch& search_;
  PathTree tree_;
  Potential wanted_;
  std::optional<Potential> zero_;
  std::vector<std::uint32_t> spread_;
  std::uint64_t walked_ = 0;
  double longest_ = PathTree::infinite;  ///< of the loops taken, when they are a basis
  LoopBasis found_;
  std::vector<Loop> pool_;
  std::unordered_map<Fingerprint, std::size_t, FingerprintHash> place_in_pool_;  // never iterated
  std::size_t pooled_points_ = 0;
};

}  // namespace

EdgeGraph::EdgeGraph(std::span<const Point> points, std::span<const Edge> edges) : begin_(points.size() + 1, 0) {
  for (const auto& edge : edges) {
    for (const auto end : edge) {
      ++begin_[end + 1];
    }
  }
  for (std::size_t p = 0; p < points.size(); ++p) {
    begin_[p + 1] += begin_[p];
  }
  ways_.resize(2 * edges.size());
  std::vector<std::uint32_t> next = begin_;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges[e];
    const double length =
        std::hypot(points[a][0] - points[b][0], points[a][1] - points[b][1], points[a][2] - points[b][2]);
    ways_[next[a]++] = {b, e, length};
    ways_[next[b]++] = {a, e, length};
  }
}

const EdgeGraph::Way& EdgeGraph::way(std::uint32_t from, std::uint32_t to) const {
  const auto here = ways(from);
  const auto found = std::find_if(here.begin(), here.end(), [to](const Way& way) { return way.to == to; });
  sparse::expects(found != here.end(), "neighbours on a loop are joined by an edge");
  return *found;
}

Terms<Integers> class_of(const EdgeGraph& graph, const Annotation& annotation, const Loop& loop) {
  sparse::RawTerms<Integers> sum;
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    const auto from = loop.points[i];
    const auto to = loop.points[i + 1 < loop.points.size() ? i + 1 : 0];
    for (const auto& [index, coefficient] : annotation.of_edge[graph.way(from, to).edge]) {
      sum.push_back({index, from < to ? coefficient : -coefficient});
    }
  }
  return std::move(sum).normal(Integers{});
}

LoopBasis short_loops(const EdgeGraph& graph, const LoopSearch& search) { return Search{graph, search}.run(); }

}  // namespace sesame::tools

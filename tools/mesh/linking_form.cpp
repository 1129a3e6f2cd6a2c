#include "tools/mesh/linking_form.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "tools/mesh/geometry.hpp"
#include "tools/mesh/segment_grid.hpp"

namespace sesame::tools {

namespace {

using sparse::Index;
using sparse::Integers;
using sparse::RawTerms;
using sparse::Terms;

/// Part of the loops along the surface: an edge, how often each of them runs up it, and what lies beside it.
struct AlongEdge {
  std::uint32_t edge;
  Terms<Integers> times;
  std::uint32_t third_up = 0;    ///< the third point of the triangle that the edge runs upwards in
  std::uint32_t third_down = 0;  ///< of the other one
};

/// Part of the loops across it: from the middle of a triangle to that of a side, and how much of each leaves there.
struct HalfWay {
  MeanPoint from;
  MeanPoint to;
  std::uint32_t edge;  ///< that of the side; none inside of a face
  const Terms<Integers>* times;
};

class LinkingCount {
 public:
  LinkingCount(const CutSystem& system, std::span<const Edge> edges, const ExactSigns& signs)
      : edges_{edges}, signs_{signs}, rank_{system.rank} {
    collect_along(system);
    collect_across(system);
  }

  LinkingForm run() {
    constexpr std::uint64_t most_directions = 8;
    LinkingForm form;
    for (std::uint64_t attempt = 0; attempt < most_directions; ++attempt) {
      direction_ = some_direction(2 * attempt);
      shift_ = some_direction(2 * attempt + 1);
      form.rank = rank_;
      form.entries.assign(std::size_t{rank_} * rank_, 0);
      form.obstacle.clear();
      is_generic_ = true;
      meets_itself_ = false;
      count(form);
      if (meets_itself_) {
        form.obstacle = "the surface touches itself";
        return form;
      }
      if (is_generic_) {
        return form;
      }
    }
    form.obstacle = "it has triangles without area where its loops run";
    return form;
  }

 private:
  /// Source of the numbers: S. Vigna's splitmix64.
  static Direction some_direction(std::uint64_t seed) {
    Direction d{};
    for (std::uint64_t i = 0; i < 3; ++i) {
      std::uint64_t n = (3 * seed + i + 1) * 0x9e3779b97f4a7c15U;
      n = (n ^ (n >> 30U)) * 0xbf58476d1ce4e5b9U;
      n = (n ^ (n >> 27U)) * 0x94d049bb133111ebU;
      d[i] = static_cast<std::int32_t>(n >> 44U) - (1 << 19);
    }
    return d;
  }

  void collect_along(const CutSystem& system) {
    std::vector<std::pair<std::uint32_t, sparse::Term<Integers>>> steps;
    for (Index i = 0; i < system.rank; ++i) {
      for (const auto& [edge, direction] : system.loops[i]) {
        steps.push_back({edge, {i, direction}});
      }
    }
    std::stable_sort(steps.begin(), steps.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t begin = 0; begin < steps.size();) {
      RawTerms<Integers> sum;
      std::size_t end = begin;
      for (; end < steps.size() && steps[end].first == steps[begin].first; ++end) {
        sum.push_back(steps[end].second);
      }
      along_.push_back({steps[begin].first, std::move(sum).normal(Integers{}), 0, 0});
      begin = end;
    }
    std::unordered_map<std::uint32_t, AlongEdge*> of_edge;
    for (AlongEdge& along : along_) {
      of_edge.emplace(along.edge, &along);
    }
    for (const SpaceTriangle& triangle : system.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (const auto at = of_edge.find(triangle.edges[k]); at != of_edge.end()) {
          const bool is_up = triangle.points[k] < triangle.points[(k + 1) % 3];
          (is_up ? at->second->third_up : at->second->third_down) = triangle.points[(k + 2) % 3];
        }
      }
    }
  }

  void collect_across(const CutSystem& system) {
    for (const SpaceTriangle& triangle : system.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (!triangle.outflow[k].empty()) {
          across_.push_back({MeanPoint::middle(triangle.points),
                             MeanPoint::middle(triangle.points[k], triangle.points[(k + 1) % 3]), triangle.edges[k],
                             &triangle.outflow[k]});
        }
      }
    }
    for (const auto& [edge, times] : system.crossings) {
      crossings_.emplace(edge, &times);
    }
  }

  void count(LinkingForm& form) {
    const ShadowPlane plane(direction_);
    std::vector<Shadow> shadows;
    shadows.reserve(across_.size());
    for (const HalfWay& way : across_) {
      shadows.push_back(plane.shadow(signs_.sixfold(way.from), signs_.sixfold(way.to)));
    }
    const SegmentGrid grid(std::move(shadows));
    std::vector<std::int64_t> row(rank_);
    for (const AlongEdge& along : along_) {
      std::fill(row.begin(), row.end(), 0);
      const MeanPoint low = MeanPoint::vertex(edges_[along.edge][0]);
      const MeanPoint high = MeanPoint::vertex(edges_[along.edge][1]);
      grid.for_each_near(plane.shadow(signs_.sixfold(low), signs_.sixfold(high)), [&](std::uint32_t k) {
        ++form.pairs;
        if (across_[k].edge != along.edge) {
          add(row, crossing(low, high, across_[k]), *across_[k].times);
        }
      });
      if (const auto at = crossings_.find(along.edge); at != crossings_.end() && points_outwards(along)) {
        add(row, 1, *at->second);
      }
      if (!is_generic_ || meets_itself_) {
        return;
      }
      for (const auto& [i, times] : along.times) {
        for (Index j = 0; j < rank_; ++j) {
          form.entries[std::size_t{i} * rank_ + j] += times.to_int64().value() * row[j];
        }
      }
    }
  }

  static void add(std::vector<std::int64_t>& row, int sign, const Terms<Integers>& times) {
    if (sign != 0) {
      for (const auto& [j, factor] : times) {
        row[j] += sign * factor.to_int64().value();
      }
    }
  }

  /// -1, 0 or 1: how the half way crosses the edge in front of it.
  int crossing(const MeanPoint& low, const MeanPoint& high, const HalfWay& way) {
    const int from_side = shifted(signs_.turn(low, high, way.from, direction_), low, high, 1);
    const int to_side = shifted(signs_.turn(low, high, way.to, direction_), low, high, 1);
    if (from_side == to_side) {
      return 0;
    }
    const int low_side = shifted(signs_.turn(way.from, way.to, low, direction_), way.from, way.to, -1);
    const int high_side = shifted(signs_.turn(way.from, way.to, high, direction_), way.from, way.to, -1);
    if (low_side == high_side) {
      return 0;
    }
    // With u along the edge and v along the way, det(u, v, d) has the sign of to_side. Where they cross, the way is in
    // front by h in from - low = h d + (u and v), so h has the sign of det(u, v, from - low) times that one.
    const int height = signs_.side(low, high, way.to, way.from);
    meets_itself_ = meets_itself_ || height == 0;
    return height == to_side ? -to_side : 0;
  }

  /// The sign that a determinant has when all loops across are shifted a little, by which it changes as it says.
  int shifted(int sign, const MeanPoint& a, const MeanPoint& b, int change) {
    if (sign == 0) {
      sign = change * signs_.turn(a, b, shift_, direction_);
      is_generic_ = is_generic_ && sign != 0;
    }
    return sign;
  }

  /// Whether the direction, from the middle of an edge, points outwards between its two triangles.
  bool points_outwards(const AlongEdge& along) {
    const MeanPoint low = MeanPoint::vertex(edges_[along.edge][0]);
    const MeanPoint high = MeanPoint::vertex(edges_[along.edge][1]);
    const MeanPoint up = MeanPoint::vertex(along.third_up);
    const MeanPoint down = MeanPoint::vertex(along.third_down);
    const bool is_before_one = is_in_front(signs_.turn(low, high, up, direction_));
    const bool is_before_other = is_in_front(signs_.turn(high, low, down, direction_));
    const int bend = signs_.side(low, high, up, down);
    if (bend == 0) {  // flat, or folded back onto itself
      meets_itself_ = meets_itself_ || is_before_one != is_before_other;
      return is_before_one;
    }
    return bend < 0 ? is_before_one || is_before_other : is_before_one && is_before_other;
  }
  bool is_in_front(int sign) {
    is_generic_ = is_generic_ && sign != 0;
    return sign > 0;
  }

  std::span<const Edge> edges_;
  const ExactSigns& signs_;
  Index rank_;
  std::vector<AlongEdge> along_;
  std::vector<HalfWay> across_;
  std::unordered_map<std::uint32_t, const Terms<Integers>*> crossings_;
  Direction direction_{};
  Direction shift_{};
  bool is_generic_ = true;
  bool meets_itself_ = false;
};

}  // namespace

LinkingForm linking_form(const CutSystem& system, std::span<const Edge> edges, const ExactSigns& signs) {
  return LinkingCount{system, edges, signs}.run();
}

}  // namespace sesame::tools

#include "tools/mesh/sorted_loops.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "sparse/smith.hpp"
#include "tools/mesh/basis_selection.hpp"
#include "tools/mesh/cover_loops.hpp"
#include "tools/mesh/graph.hpp"

namespace sesame::tools {

namespace {

using sparse::Index;
using sparse::Integers;
using sparse::Terms;

bool is_simple(const Loop& loop) {
  return std::set<std::uint32_t>(loop.points.begin(), loop.points.end()).size() == loop.points.size();
}

/// What lengths are compared by: a walk that meets itself is taken only when simple loops are longer by a twentieth.
double cost_of(const Loop& loop) { return is_simple(loop) ? loop.length : 1.05 * loop.length; }

/// Both halves as one group.
Annotation both(const Annotation& one, const Annotation& other) {
  Annotation sum = one;
  sum.rank += other.rank;
  for (std::size_t edge = 0; edge < other.of_edge.size(); ++edge) {
    for (const auto& [index, coefficient] : other.of_edge[edge]) {
      sum.of_edge[edge].push_back({one.rank + index, coefficient});
    }
  }
  return sum;
}

class HalfSearch {
 public:
  HalfSearch(const EdgeGraph& graph, const HalfOfLoops& half, const HalfOfLoops& rest)
      : graph_{graph}, half_{half.coordinates}, rest_{rest.coordinates}, cycles_{half.cycles} {}

  HalfBasis run() {
    basis_ = short_loops(graph_, {Integers{}, &half_, &rest_});
    if (basis_.completion.empty()) {
      return {std::move(basis_.loops), {}, basis_.tried};
    }
    find_incomplete_parts();
    // Roots where loops of any kind are short: there those of this half may be, too.
    const Annotation all = both(half_, rest_);
    const LoopBasis of_all = short_loops(graph_, {Integers{}, &all});
    look_along(of_all.loops, true);
    select();
    for (int round = 0; round < most_rounds; ++round) {
      const double before = total_length();
      look_along(std::vector<Loop>(basis_.loops.rbegin(), basis_.loops.rend()), false);
      select();
      if (total_length() > (1 - 1e-9) * before || states_ > few_states) {
        break;
      }
    }
    return {std::move(basis_.loops), sums_of(of_all, all), basis_.tried};
  }

 private:
  static constexpr std::size_t most_states = 9'000'000;
  static constexpr std::size_t most_states_of_root = 3'000'000;
  static constexpr std::size_t few_states = 1'000'000;  ///< beyond, roots are few
  static constexpr std::size_t most_roots = 8;
  static constexpr Index enough_bases = 4;
  static constexpr int most_rounds = 6;

  struct PartOfMesh {
    Index rank = 0;   ///< of this half
    Index found = 0;  ///< loops of a basis
    Index bases = 0;  ///< found in covers
  };

  void find_incomplete_parts() {
    std::vector<Edge> links;
    for (std::uint32_t point = 0; point < graph_.points(); ++point) {
      for (const auto& way : graph_.ways(point)) {
        links.push_back({point, way.to});
      }
    }
    parts_ = connected_parts(graph_.points(), links);
    of_part_.resize(parts_.count);
    std::vector<bool> is_counted(half_.rank, false);
    for (std::uint32_t point = 0; point < graph_.points(); ++point) {
      for (const auto& way : graph_.ways(point)) {
        for (const auto& [index, coefficient] : half_.of_edge[way.edge]) {
          if (!is_counted[index]) {
            is_counted[index] = true;
            ++of_part_[parts_.of[point]].rank;
          }
        }
      }
    }
    for (const Loop& loop : basis_.loops) {
      ++of_part_[parts_.of[loop.points.front()]].found;
    }
  }

  /// Takes some points of each loop as roots, in parts that lacked loops at first: until there are bases enough,
  /// or (not `for_bases`) for loops that are shorter than this one.
  void look_along(const std::vector<Loop>& loops, bool for_bases) {
    for (const Loop& loop : loops) {
      PartOfMesh& part = of_part_[parts_.of[loop.points.front()]];
      const std::size_t roots = states_ < few_states ? most_roots : for_bases ? 2 : is_simple(loop) ? 1 : 4;
      for (std::size_t i = 0; i < roots && states_ < most_states; ++i) {
        const bool is_enough = states_ > few_states && i > 0 && is_simple(loop);
        if (part.found == part.rank || is_enough || (for_bases && part.bases >= std::min(part.rank, enough_bases))) {
          break;
        }
        CoverSearch search{&half_, &rest_, part.rank, std::min(most_states - states_, most_states_of_root)};
        search.longest = for_bases ? search.longest : cost_of(loop);
        CoverLoops found = loops_in_cover(graph_, search, loop.points[(2 * i + 1) * loop.points.size() / (2 * roots)]);
        states_ += found.states;
        basis_.tried += found.loops.size();
        part.bases += found.loops.size() == part.rank ? 1 : 0;
        std::move(found.loops.begin(), found.loops.end(), std::back_inserter(pool_));
      }
    }
  }

  [[nodiscard]] double total_length() const {
    double sum = 0;
    for (const Loop& loop : basis_.loops) {
      sum += loop.length;
    }
    return sum;
  }

  void select() {
    std::move(basis_.loops.begin(), basis_.loops.end(), std::back_inserter(pool_));
    std::vector<std::pair<double, Loop>> by_cost;
    for (Loop& loop : pool_) {
      by_cost.emplace_back(cost_of(loop), std::move(loop));
    }
    pool_.clear();
    std::sort(by_cost.begin(), by_cost.end(), [](const auto& a, const auto& b) {
      return a.first != b.first ? a.first < b.first : a.second.points < b.second.points;
    });
    BasisSelection<Integers> selection{Integers{}, half_.rank};
    basis_.loops.clear();
    for (auto& [cost, loop] : by_cost) {
      if (selection.missing() > 0 && selection.take(class_of(graph_, half_, loop))) {
        basis_.loops.push_back(std::move(loop));
      }
    }
    basis_.completion = selection.completion();
  }

  /// Cycles of what is missing: sums of the loops of a basis of all classes, if there is one.
  [[nodiscard]] std::vector<WeightedEdges> sums_of(const LoopBasis& of_all, const Annotation& all) const {
    std::vector<WeightedEdges> loops = cycles_;
    std::vector<Terms<Integers>> factors = basis_.completion;
    if (of_all.completion.empty() && !factors.empty()) {
      loops.clear();
      sparse::Matrix<Integers> classes{Integers{}, all.rank, 0};
      for (const Loop& loop : of_all.loops) {
        classes.append_column(class_of(graph_, all, loop));
        loops.push_back(edges_of(loop));
      }
      // With left M right = 1 the inverse of M is right left.
      const auto smith = sparse::smith_form(classes);
      for (Terms<Integers>& vector : factors) {
        vector = smith.right.apply(smith.left.apply(vector));
      }
    }
    std::vector<WeightedEdges> sums;
    for (const Terms<Integers>& vector : factors) {
      WeightedEdges& sum = sums.emplace_back();
      for (const auto& [k, factor] : vector) {
        sparse::add_multiple<Integers>(Integers{}, sum, factor, loops[k]);
      }
    }
    return sums;
  }
  [[nodiscard]] WeightedEdges edges_of(const Loop& loop) const {
    sparse::RawTerms<Integers> edges;
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      const auto from = loop.points[i];
      const auto to = loop.points[i + 1 < loop.points.size() ? i + 1 : 0];
      edges.push_back({graph_.way(from, to).edge, from < to ? 1 : -1});
    }
    return std::move(edges).normal(Integers{});
  }

  const EdgeGraph& graph_;
  const Annotation& half_;
  const Annotation& rest_;
  const std::vector<WeightedEdges>& cycles_;
  LoopBasis basis_;
  Parts parts_;
  std::vector<PartOfMesh> of_part_;
  std::vector<Loop> pool_;
  std::size_t states_ = 0;
};

}  // namespace

HalfBasis short_half(const EdgeGraph& graph, const HalfOfLoops& half, const HalfOfLoops& rest) {
  return HalfSearch{graph, half, rest}.run();
}

}  // namespace sesame::tools

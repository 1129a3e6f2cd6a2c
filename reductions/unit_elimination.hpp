/// \file
/// The work behind `reduce`: all unit pairs of a complex, as rewriting rules. Included by elimination.cpp only.
#pragma once

#include <limits>
#include <vector>

#include "reductions/graded_map.hpp"

namespace sesame::reductions {

/// Eliminates unit pairs degree by degree and remembers how.
///
/// A pair (a, b) with d b = e a + rest is a *rule*: a -> -rest / e. The rules of one degree are numbered in the order
/// in which they were found; the rest of a rule holds only generators that were not eliminated then, so rewriting the
/// earliest rule first meets each rule at most once. The *trace* of a rewriting says how much of each b it used: with
/// it, V(x) = x - sum of trace[k] V(b_k) is the chain of the old complex that the generator x stands for.
template <Ring R>
class UnitElimination {
 public:
  using Element = typename R::Element;
  enum class Keep { boundaries, traces };

  /// Requires: d d = 0. With Keep::boundaries only small() may be asked for.
  UnitElimination(const ChainComplex<R>& complex, Keep keep);

  [[nodiscard]] ChainComplex<R> small() const;
  [[nodiscard]] GradedMap<R> f() const;
  [[nodiscard]] GradedMap<R> g() const;
  [[nodiscard]] GradedMap<R> h() const;

 private:
  static constexpr Index none = std::numeric_limits<Index>::max();

  struct Rule {
    Index a;
    Index b;
    Element inverse;  // 1 / e
    Terms<R> rest;
    Terms<R> trace;  // of d b, by rule number
  };
  /// What is known of the generators of one degree.
  struct Level {
    Index size = 0;
    std::vector<Rule> rules;         // whose a has this degree
    std::vector<Index> rule_of;      // the rule that eliminates a generator as its a, or none
    std::vector<bool> is_b;          // eliminated as the b of a rule of the level below
    std::vector<Terms<R>> boundary;  // rewritten, in generators of the level below
    std::vector<Terms<R>> trace;     // of that rewriting, by rule number; empty for b (its rule has it)
    std::vector<Index> number;       // among the small generators, or none
    Index small_size = 0;
  };

  void eliminate_degree(std::size_t p, const Matrix<R>& boundary);
  /// Rewrites the boundary of x by the rules of the level below; true when that gave a rule with b = x.
  bool settle(std::size_t p, Index x);
  void rewrite(std::size_t p, Index x);
  void make_rule(std::size_t p, Index b, const Term<R>& pivot);
  void number_small_generators();
  /// V(x) for a generator of level p that no rule of its own level removed; `trace` is that of d x.
  [[nodiscard]] Terms<R> lift(std::size_t p, Index x, const Terms<R>& trace) const;
  [[nodiscard]] Terms<R> renumbered(const Level& level, const Terms<R>& terms) const;
  [[nodiscard]] Sizes sizes() const;
  [[nodiscard]] Sizes small_sizes() const;

  R ring_;
  Keep keep_;
  std::vector<Level> levels_;
  std::vector<Element> values_;  // scratch of rewrite: all zero between calls
};

}  // namespace sesame::reductions

/// \file
/// The homotopy h and the lift g of the right reduction, worked out on demand.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/right/correctable_deletions.hpp"
#include "engine/right/dependents.hpp"
#include "engine/right/effort.hpp"
#include "engine/right/perturbations.hpp"
#include "engine/right/rules.hpp"
#include "sparse/accumulator.hpp"
#include "sparse/column_store.hpp"
#include "sparse/descending_sum.hpp"

namespace sesame::engine {

/// Coefficients of a rewriting by rule: what the homotopy h is made of.
template <Ring R>
using Trace = std::vector<std::pair<RuleId, typename R::Element>>;

/// The traces that lifts have needed, for whoever lifts many chains: which share most of them. They are those of the
/// boundaries of small symbols now, and of the b's of rules at the times of these. Valid until anything happens to the
/// equivalence.
template <Ring R>
class KnownTraces {
 public:
  using TraceTerm = typename Trace<R>::value_type;

  /// What is known of a symbol; nothing: it is not known.
  [[nodiscard]] std::optional<std::span<const TraceTerm>> find(Symbol x) const {
    if (x >= places_.size() || places_[x].size == unknown) {
      return std::nullopt;
    }
    return std::span{terms_.data() + places_[x].begin, places_[x].size};
  }
  /// Keeps the trace of a symbol, as long as there is room. Requires: it is not known.
  void keep(Symbol x, const Trace<R>& trace) {
    if (terms_.size() + trace.size() > most_terms) {
      return;
    }
    if (x >= places_.size()) {
      places_.resize(x + std::size_t{1});
    }
    places_[x] = {static_cast<std::uint32_t>(terms_.size()), static_cast<std::uint32_t>(trace.size())};
    terms_.insert(terms_.end(), trace.begin(), trace.end());
  }

 private:
  static constexpr std::size_t most_terms = std::size_t{1} << 22U;
  static constexpr std::uint32_t unknown = UINT32_MAX;
  struct Place {
    std::uint32_t begin = 0, size = unknown;
  };

  std::vector<Place> places_;  ///< per symbol
  std::vector<TraceTerm> terms_;
};

/// Traces and lifts, by the rules as they were made. The *trace* of a chain v has for each elimination (a, b) with unit
/// e that rewriting v uses e^-1 times the coefficient under which a was rewritten; the *lift* of a symbol x at time t
/// is the cycle modulo b's that x stands for:
///
///   h(v) = sum trace(v)[a] V(b_a),    V_t(x) = x - sum trace_t(d x)[a] V(b_a)
///
/// with the rules made before t, each V(b_a) at the time of its own rule; for x' = x - q y made by rule m,
/// V_t(x') = V_m(x) - q V_m(y) - sum of the trace, between m and t, of the boundary that x' was made with.
///
/// A perturbation delta changes what rules say. Whoever needs a rule has it `take_in` what it lacks first, and with it
/// the rules that it depends on; that is delta(V(b)), by going down the same traces.
///
/// Invariant: it keeps nothing; what is below is scratch. Source: engine/LIVE_FORM.md.
template <Ring R>
class Lifts {
 public:
  using Element = typename R::Element;
  using TermType = sparse::Term<R, Symbol>;
  using TermOfB = sparse::Term<R, GeneratorId>;

  /// All of them must outlive it.
  Lifts(R ring, const sparse::ColumnStore<R, GeneratorId>& boundary, const Rules<R>& rules,
        Perturbations<R>& perturbations, Dependents<R>& dependents, Effort& effort)
      : ring_{ring},
        boundary_{boundary},
        rules_{rules},
        perturbations_{perturbations},
        dependents_{dependents},
        effort_{effort},
        pending_{ring} {}

  /// h, as a trace, of a chain of B. Cost: the rules that apply, each once, times the logarithm of their number.
  [[nodiscard]] Trace<R> trace(std::span<const TermOfB> chain_of_b);
  /// g of a chain of S (in symbols) plus sum trace[a] V(b_a): a chain of B in normal form.
  /// Cost: each rule involved is expanded once; one that is `known` by its trace only.
  [[nodiscard]] Terms<R, GeneratorId> lift(std::span<const TermType> chain_of_s, const Trace<R>& trace = {},
                                           KnownTraces<R>* known = nullptr);

  /// V_time(x) by rules that know nothing of some deletions, nor of the one at hand, whose generator is `last`: they
  /// are not brought up to date with these. It stops at lifts of b's of rules that somebody else knows: `take(b,
  /// coefficient)` says whether it does, and then it is left out. Cost: likewise.
  template <class Take>
  [[nodiscard]] Terms<R, GeneratorId> lift_without(const CorrectableDeletions& deletions, Symbol last, Symbol x,
                                                   RuleId time, Take take) {
    left_out_ = {&deletions, last};
    Terms<R, GeneratorId> lift = run_lift({{{time, x}, ring_.one()}}, {}, nullptr, take);
    left_out_ = {};
    return lift;
  }

  /// delta(V_time(x)) of the perturbations with new symbols from `first` on, in these; in normal form.
  /// Cost: the rules under x are brought up to date, else that of the lift.
  [[nodiscard]] Terms<R, Symbol> gain(Symbol x, RuleId time, Symbol first);
  /// Brings a rule up to date, and all rules that it depends on. Cost: O(1) when it is.
  void take_in(RuleId rule);

  /// Forgets what an OverBudget has cut off.
  void drop_work();

 private:
  /// Deletions that rules know nothing of, for the time being.
  struct LeftOut {
    const CorrectableDeletions* deletions = nullptr;
    Symbol last{};
  };
  /// What is to be expanded: V_t(x) by (t, x), with its coefficient.
  using Others = std::map<std::pair<RuleId, Symbol>, Element, std::greater<>>;
  /// V_t(x) = generators - sum trace[a] V(b_a).
  struct Expansion {
    RawTerms<R, GeneratorId> generators;
    Trace<R> trace;
  };

  template <class Begin>
  Trace<R> run_trace(RuleId before, Begin begin);
  Trace<R> trace_of_boundary(Symbol x, RuleId before);
  std::span<const typename Trace<R>::value_type> find_trace(Symbol x, RuleId time, KnownTraces<R>* known,
                                                            Trace<R>& made);
  template <class Add, class AddRule>
  void expand(RuleId time, Symbol x, const Element& coefficient, RawTerms<R, GeneratorId>& generators, Add add,
              AddRule add_rule, KnownTraces<R>* known = nullptr);
  template <class Take>
  [[nodiscard]] Terms<R, GeneratorId> run_lift(Others others, const Trace<R>& trace, KnownTraces<R>* known, Take take);
  [[nodiscard]] Expansion expansion(Symbol x, RuleId time);
  [[nodiscard]] Terms<R, Symbol> gain_of(const Expansion& v, Symbol first);

  R ring_;
  const sparse::ColumnStore<R, GeneratorId>& boundary_;
  const Rules<R>& rules_;
  Perturbations<R>& perturbations_;
  Dependents<R>& dependents_;
  Effort& effort_;
  /// One for each trace that is running: taking in may start another.
  std::deque<sparse::Accumulator<R, Symbol>> traced_;
  std::size_t traces_running_ = 0;
  LeftOut left_out_;
  sparse::DescendingSum<R> pending_;  ///< of a lift: the b's of rules that are still to be expanded
};

// ------------------------------------------------------------------------------------------------------------ bodies

/// One step of writing a * V_time(x) in generators of B and in lifts of earlier times: `add(time, y, coefficient)` is
/// told of those of a combination, `add_rule(rule, factor, coefficient)` of those of the symbols b of rules, a product.
template <Ring R>
template <class Add, class AddRule>
void Lifts<R>::expand(RuleId time, Symbol x, const Element& a, RawTerms<R, GeneratorId>& generators, Add add,
                      AddRule add_rule, KnownTraces<R>* known) {
  if (const auto* combination = rules_.combination(x)) {
    add(combination->rule, combination->x, a);
    add(combination->rule, combination->y, ring_.negate(ring_.multiply(a, combination->q)));
  } else {
    generators.push_back({rules_.generator_in(x), a});
  }
  const Element minus = ring_.negate(a);
  Trace<R> made;
  for (const auto& [rule, factor] : find_trace(x, time, known, made)) {
    add_rule(rule, minus, factor);
  }
}

template <Ring R>
template <class Take>
Terms<R, GeneratorId> Lifts<R>::run_lift(Others others, const Trace<R>& trace, KnownTraces<R>* known, Take take) {
  // What is still to be expanded, V_t(x) with its coefficient, the latest t first: the b's of rules in `pending_`, the
  // others, which are few, here. Expanding one leads to earlier ones only, so equal ones have been added up by the time
  // their turn comes. No b of a rule has the time of another one.
  const auto add = [&](RuleId time, Symbol x, const Element& coefficient) {
    ring_.add_product(others.try_emplace({time, x}, ring_.zero()).first->second, coefficient, ring_.one());
  };
  const auto add_rule = [&](RuleId rule, const Element& factor, const Element& coefficient) {
    pending_.add_product(rule, factor, coefficient);
  };
  for (const auto& [rule, coefficient] : trace) {
    add_rule(rule, ring_.one(), coefficient);
  }
  RawTerms<R, GeneratorId> chain;
  while (true) {
    const std::optional<sparse::Term<R>> next = pending_.take();
    const RuleId rule{next ? next->index : 0};
    if (!others.empty() && others.begin()->first.first >= rule) {
      if (next) {
        add_rule(rule, ring_.one(), next->coefficient);
      }
      const auto node = others.extract(others.begin());
      if (!ring_.is_zero(node.mapped())) {
        expand(node.key().first, node.key().second, node.mapped(), chain, add, add_rule, known);
      }
      continue;
    }
    if (!next) {
      return std::move(chain).normal(ring_);
    }
    if (!take(rules_[rule].b, next->coefficient)) {
      expand(rule, rules_[rule].b, next->coefficient, chain, add, add_rule, known);
    }
  }
}

}  // namespace sesame::engine

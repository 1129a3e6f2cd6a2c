#include "engine/right/lifts.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

namespace sesame::engine {

// ----------------------------------------------------------------------------------------------------------- traces

/// Rewrites with the rules made before a time, each as it was made, the earliest first; `begin(add)` adds what is to be
/// rewritten. Rules refer to later rules only, so each is applied at most once.
template <Ring R>
template <class Begin>
Trace<R> Lifts<R>::run_trace(RuleId before, Begin begin) {
  if (traces_running_ == traced_.size()) {
    traced_.emplace_back(ring_);
  }
  sparse::Accumulator<R, Symbol>& traced = traced_[traces_running_++];
  std::priority_queue<RuleId, std::vector<RuleId>, std::greater<>> queue;
  const Rules<R>& rules = rules_;
  const auto add = [&](Symbol x, const Element& factor, const Element& coefficient) {
    const RuleId rule = rules.removed_by(x);
    const bool is_left_out = left_out_.deletions != nullptr && left_out_.deletions->contains(rules.degree(x), x);
    if (rule < before && rules[rule].a == x && !is_left_out && traced.add_product(x, factor, coefficient)) {
      queue.push(rule);
    }
  };
  begin(add);
  Trace<R> trace;
  std::optional<std::size_t> perturbations;  // until that time; all rules that follow are of one degree
  while (!queue.empty()) {
    const RuleId rule = queue.top();
    queue.pop();
    const Element coefficient = traced.take(rules[rule].a);
    if (ring_.is_zero(coefficient)) {
      continue;
    }
    if (rules[rule].b != no_symbol) {
      trace.emplace_back(rule, ring_.multiply(rules[rule].inverse, coefficient));
    }
    if (!perturbations) {
      perturbations = perturbations_.until(rule, before);
      if (left_out_.deletions != nullptr) {
        const auto left_out = left_out_.deletions->of_degree(rules.degree(rules[rule].a));
        const Symbol first = left_out.empty() ? left_out_.last : left_out.front().e;
        perturbations = std::min(*perturbations, perturbations_.before(rule, first));
      }
    }
    if (perturbations_.lacks_any_of(*perturbations, rule)) {
      take_in(rule);  // else what it is behind with is in symbols that no rule of that time can use
    }
    const std::uint64_t weight = words(coefficient);
    std::uint64_t effort = 0;
    perturbations_.for_each_in_value(rule, [&](Symbol y, const Element& factor) {
      effort += weight * words(factor);
      add(y, coefficient, factor);
    });
    effort_.spend(effort);
    effort_.check();
  }
  traced.clear();
  --traces_running_;
  return trace;
}

template <Ring R>
Trace<R> Lifts<R>::trace(std::span<const TermOfB> chain_of_b) {
  return run_trace(rules_.size(), [&](auto add) {
    for (const TermOfB& term : chain_of_b) {
      add(rules_.symbol_of(term.index), term.coefficient, ring_.one());
    }
  });
}

/// The trace of the boundary of x by the rules made before a time (after its making, for a combination).
template <Ring R>
Trace<R> Lifts<R>::trace_of_boundary(Symbol x, RuleId before) {
  return run_trace(before, [&](auto add) {
    if (const auto* combination = rules_.combination(x)) {
      for (const TermType& term : combination->column) {
        add(term.index, term.coefficient, ring_.one());
      }
    } else {
      boundary_.for_each_in_column(rules_.generator_in(x), [&](const TermOfB& term) {
        add(rules_.symbol_of(term.index), term.coefficient, ring_.one());
      });
    }
  });
}

/// The trace of the boundary of x by the rules made before a time: the known one, or else `made`.
template <Ring R>
std::span<const typename Trace<R>::value_type> Lifts<R>::find_trace(Symbol x, RuleId time, KnownTraces<R>* known,
                                                                    Trace<R>& made) {
  // At the end of time, or at that of the rule whose b it is; a small one has no such rule.
  const bool may_be_known = known != nullptr && (time == rules_.size() || rules_.removed_by(x) == time);
  if (may_be_known) {
    if (const auto found = known->find(x)) {
      return *found;
    }
  }
  made = trace_of_boundary(x, time);
  if (may_be_known) {
    known->keep(x, made);
  }
  return made;
}

template <Ring R>
void Lifts<R>::drop_work() {
  for (sparse::Accumulator<R, Symbol>& traced : traced_) {
    traced.clear();
  }
  traces_running_ = 0;
  while (pending_.take()) {
  }
  left_out_ = {};
}

// ------------------------------------------------------------------------------------------------------------ lifts

template <Ring R>
Terms<R, GeneratorId> Lifts<R>::lift(std::span<const TermType> chain_of_s, const Trace<R>& trace,
                                     KnownTraces<R>* known) {
  Others others;
  for (const TermType& term : chain_of_s) {
    ring_.add_product(others.try_emplace({rules_.size(), term.index}, ring_.zero()).first->second, term.coefficient,
                      ring_.one());
  }
  return run_lift(std::move(others), trace, known, [](Symbol, const Element&) { return false; });
}

template <Ring R>
typename Lifts<R>::Expansion Lifts<R>::expansion(Symbol x, RuleId time) {
  Expansion v;
  std::vector<std::tuple<RuleId, Symbol, Element>> pending{{time, x, ring_.one()}};
  while (!pending.empty()) {
    const auto [t, y, coefficient] = pending.back();
    pending.pop_back();
    expand(
        t, y, coefficient, v.generators, [&](RuleId at, Symbol z, const Element& a) { pending.emplace_back(at, z, a); },
        [&](RuleId rule, const Element& a, const Element& b) {
          v.trace.emplace_back(rule, ring_.negate(ring_.multiply(a, b)));
        });
  }
  return v;
}

// ------------------------------------------------------------------------------------------------------------ gains

/// delta(V), in symbols from `first` on. Requires: the rules of the trace are up to date.
template <Ring R>
Terms<R, Symbol> Lifts<R>::gain_of(const Expansion& v, Symbol first) {
  RawTerms<R, Symbol> gain;
  const Symbol end = perturbations_.expected();
  for (const TermOfB& part : v.generators) {
    boundary_.for_each_in_column(part.index, [&](const TermOfB& term) {
      const Symbol e = rules_.symbol_of(term.index);
      if (term.index > part.index && e >= first && e < end) {
        gain.push_back({e, ring_.multiply(part.coefficient, term.coefficient)});
      }
    });
  }
  for (const auto& [rule, coefficient] : v.trace) {
    for (const TermType& term : perturbations_.gain(rule)) {
      if (term.index >= first) {
        gain.push_back({term.index, ring_.negate(ring_.multiply(coefficient, term.coefficient))});
      }
    }
  }
  effort_.spend(words_of(gain));
  return std::move(gain).normal(ring_);
}

/// With a stack of its own, for chains of rules can be as long as the history.
template <Ring R>
void Lifts<R>::take_in(RuleId rule) {
  if (!perturbations_.is_behind(rule)) {
    return;
  }
  struct Frame {
    RuleId rule;
    Expansion lift;  // of its b
    std::size_t next = 0;
  };
  std::vector<Frame> stack;
  const LeftOut left_out = std::exchange(left_out_, {});  // a rule takes all in
  const auto push = [&](RuleId r) {
    Expansion lift = expansion(rules_[r].b, r);
    stack.push_back({r, std::move(lift)});
  };
  push(rule);
  while (!stack.empty()) {
    Frame& top = stack.back();
    while (top.next < top.lift.trace.size() && !perturbations_.is_behind(top.lift.trace[top.next].first)) {
      ++top.next;
    }
    if (top.next < top.lift.trace.size()) {
      push(top.lift.trace[top.next].first);
      continue;
    }
    const Terms<R, Symbol> gain = gain_of(top.lift, perturbations_.first_missing(top.rule));
    perturbations_.take_in(top.rule, gain);
    for (const TermType& term : gain) {
      dependents_.gain_value(term.index, top.rule);
    }
    effort_.read(gain.size() + top.lift.trace.size());
    effort_.spend(words_of(gain));
    stack.pop_back();
  }
  left_out_ = left_out;
}

template <Ring R>
Terms<R, Symbol> Lifts<R>::gain(Symbol x, RuleId time, Symbol first) {
  const Expansion v = expansion(x, time);
  for (const auto& [rule, coefficient] : v.trace) {
    take_in(rule);
  }
  return gain_of(v, first);
}

#define SESAME_INSTANTIATE(R) template class Lifts<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine

#include "engine/right/corrected_lifts.hpp"

#include <algorithm>
#include <utility>

namespace sesame::engine {

/// V(x) at a time at which there had been so many correctable deletions; nothing: that goes too deep.
template <Ring R>
std::optional<typename CorrectedLifts<R>::Sum> CorrectedLifts<R>::work_out(Symbol x, RuleId time, std::size_t deletions,
                                                                           int depth) {
  Sum sum;
  std::vector<Base> known;
  sum.terms = lifts_.lift_without(deletions_, last_, x, time, [&](Symbol b, const Element& factor) {
    const bool is_known = known_.is_known(b);
    if (is_known) {
      known.push_back({b, factor, 0});
    }
    return is_known;
  });
  for (const Base& each : known) {
    if (!add_known(sum, each)) {
      add(sum, each.factor, known_.written_out(each.x));
    }
  }
  if (!correct(sum, deletions, depth)) {
    return std::nullopt;
  }
  return sum;
}

/// Subtracts lifts of the cycles that were eliminated with the first `deletions` of them until none is in the boundary.
template <Ring R>
bool CorrectedLifts<R>::correct(Sum& sum, std::size_t deletions, int depth) {
  if (deletions == 0) {
    return true;
  }
  Queue queue;
  for (const TermOfB& term : sum.terms) {
    enqueue(term.index, 0, queue);
  }
  for (const auto& [generator, coefficient] : sum.more) {
    enqueue(generator, 0, queue);
  }
  std::size_t scanned = 0;  // until there all are looked at that a base may have
  while (true) {
    scanned = std::max(scanned, sum.base ? sum.base->from : deletions);
    const std::size_t k = std::min(scanned, queue.empty() ? deletions : queue.top());
    if (k >= deletions) {
      return true;
    }
    while (!queue.empty() && queue.top() == k) {
      queue.pop();
    }
    scanned += k == scanned ? 1 : 0;
    const CorrectableDeletions::Deletion& deletion = deletions_.of_degree(degree())[k];
    effort_.spend(1 + deletion.changed.size());
    effort_.check();
    const RuleId rule = rules_.removed_by(deletion.e);
    if (rule == no_rule) {
      continue;
    }
    const Symbol z = rules_[rule].b;
    if (sum.base && known_.is_known(z)) {
      move_base(sum, z, k, queue);
    }
    const Element excess = excess_of(sum, deletion, rule);
    if (ring_.is_zero(excess)) {
      continue;
    }
    const Element factor = ring_.negate(ring_.multiply(excess, rules_[rule].inverse));
    Terms<R, GeneratorId> more;
    if (known_.is_known(z)) {
      if (add_known(sum, {z, factor, k + 1})) {
        scanned = k + 1;
        continue;
      }
      more = known_.written_out(z);
    } else {
      std::optional<Sum> lift = depth < deepest ? work_out(z, rule, k, depth + 1) : std::nullopt;
      if (!lift) {
        return false;
      }
      const std::optional<Base> base = lift->base;
      more = explicit_part(std::move(*lift));
      if (base) {
        sparse::add_multiple<R>(ring_, more, base->factor, known_.written_out(base->x));
      }
    }
    add(sum, factor, more);
    effort_.spend(more.size());
    for (const TermOfB& term : more) {
      enqueue(term.index, k + 1, queue);
    }
  }
}

/// Writes the base as a multiple of the lift of z, which was eliminated with deletion k, if it is a few steps from it.
template <Ring R>
void CorrectedLifts<R>::move_base(Sum& sum, Symbol z, std::size_t k, Queue& queue) {
  if (sum.base->x == z) {
    return;
  }
  if (const auto relation = known_.relation(sum.base->x, z)) {
    add(sum, sum.base->factor, relation->difference);
    for (const TermOfB& term : relation->difference) {
      enqueue(term.index, k, queue);
    }
    sum.base = Base{z, ring_.multiply(sum.base->factor, relation->factor), sum.base->from};
  }
}

/// The coefficient of the e of a deletion in the boundary of a sum; it was eliminated by a rule.
template <Ring R>
typename R::Element CorrectedLifts<R>::excess_of(const Sum& sum, const CorrectableDeletions::Deletion& deletion,
                                                 RuleId rule) {
  const bool is_own = sum.base && sum.base->x == rules_[rule].b;  // whose boundary is a unit times e
  Element excess = is_own ? ring_.multiply(sum.base->factor, ring_.inverse(rules_[rule].inverse)) : ring_.zero();
  for (const GeneratorId generator : deletion.changed) {
    Element in_sum = coefficient(sum, generator);
    if (sum.base && !is_own) {
      ring_.add_product(in_sum, sum.base->factor, known_.coefficient(sum.base->x, generator));
    }
    ring_.add_product(excess, in_sum, boundary_.entry(rules_.generator_in(deletion.e), generator));
  }
  return excess;
}

/// The deletions, from a place on, whose e are in the boundary of a generator.
template <Ring R>
void CorrectedLifts<R>::enqueue(GeneratorId generator, std::size_t from, Queue& queue) const {
  const std::size_t none = deletions_.of_degree(degree()).size();
  boundary_.for_each_in_column(generator, [&](const TermOfB& term) {
    const std::size_t k = deletions_.place(degree(), rules_.symbol_of(term.index));
    if (k >= from && k != none) {
      queue.push(k);
    }
  });
}

template <Ring R>
void CorrectedLifts<R>::add(Sum& sum, const Element& factor, const Terms<R, GeneratorId>& terms) const {
  for (const TermOfB& term : terms) {
    ring_.add_product(sum.more.try_emplace(term.index, ring_.zero()).first->second, factor, term.coefficient);
  }
}

/// Adds a multiple of a lift that is known, as the base, if there is none or it is that one. Returns whether it did.
template <Ring R>
bool CorrectedLifts<R>::add_known(Sum& sum, const Base& more) {
  if (!sum.base) {
    sum.base = more;
  } else if (sum.base->x == more.x) {
    ring_.add_product(sum.base->factor, more.factor, ring_.one());
    sum.base->from = std::min(sum.base->from, more.from);
    if (ring_.is_zero(sum.base->factor)) {
      sum.base.reset();
    }
  } else {
    return false;
  }
  return true;
}

/// In all but the base.
template <Ring R>
typename R::Element CorrectedLifts<R>::coefficient(const Sum& sum, GeneratorId generator) const {
  const TermOfB* term = sparse::find_term<R>(sum.terms, generator);
  Element total = term != nullptr ? term->coefficient : ring_.zero();
  if (const auto more = sum.more.find(generator); more != sum.more.end()) {
    ring_.add_product(total, more->second, ring_.one());
  }
  return total;
}

/// All but the base.
template <Ring R>
Terms<R, GeneratorId> CorrectedLifts<R>::explicit_part(Sum sum) const {
  if (!sum.more.empty()) {
    RawTerms<R, GeneratorId> more;
    for (const auto& [generator, coefficient] : sum.more) {
      more.push_back({generator, coefficient});
    }
    sparse::add_multiple<R>(ring_, sum.terms, ring_.one(), std::move(more).normal(ring_));
  }
  return std::move(sum.terms);
}

#define SESAME_INSTANTIATE(R) template class CorrectedLifts<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine

#include "engine/right/deletion_gains.hpp"

#include <algorithm>
#include <utility>

namespace sesame::engine {

template <Ring R>
void DeletionGains<R>::clear() {
  known_.clear();
  correctable_.clear();
  indices_.clear();
  seen_ = rules_.size();
}

template <Ring R>
void DeletionGains<R>::append(GeneratorId generator) {
  const int below = rules_.degree(rules_.symbol_of(generator)) - 1;
  if (!correctable_.of_degree(below).empty()) {
    boundary_.for_each_in_column(generator, [&](const TermOfB& term) {
      correctable_.add_changed(below, rules_.symbol_of(term.index), generator);
    });
  }
}

// ------------------------------------------------------------------------------------------------------ small symbols

template <Ring R>
void DeletionGains<R>::begin(GeneratorId deletion, std::span<const GeneratorId> changed) {
  deletion_ = deletion;
  changed_ = changed;
  gained_.clear();
  for (; seen_ < rules_.size(); ++seen_) {
    const Symbol a = rules_[seen_].a;
    if (correctable_.contains(rules_.degree(a), a)) {
      correctable_.forget_until(rules_.degree(a), a);
    }
  }
}

template <Ring R>
typename DeletionGains<R>::Index* DeletionGains<R>::index() {
  const auto at = indices_.find(degree());
  return at != indices_.end() ? &at->second : nullptr;
}

template <Ring R>
typename Perturbations<R>::Reached DeletionGains<R>::small_with() {
  if (index() == nullptr) {
    return std::nullopt;
  }
  std::vector<Symbol> fresh;
  rules_.for_each_small_since(degree() + 1, index()->until, [&](Symbol x) { fresh.push_back(x); });
  for (const Symbol x : fresh) {
    add_to_index(x, known_.is_known(x) ? Terms<R, GeneratorId>{} : learn(x));
  }
  index()->until = rules_.next_symbol();
  std::vector<Symbol> found = changed_loose();
  for (const GeneratorId generator : changed_) {
    index()->lifts.for_each_with(generator, [&](Symbol x) { found.push_back(x); });
  }
  std::erase_if(found, [this](Symbol x) { return !rules_.is_small(x); });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

/// Those with a boundary whose lifts may have changed since they were put into the index.
template <Ring R>
std::vector<Symbol> DeletionGains<R>::changed_loose() {
  std::vector<Symbol> changed;
  auto& loose = index()->loose;
  std::erase_if(loose, [this](const auto& each) { return !rules_.is_small(each.first); });
  for (const auto& [x, column] : loose) {
    if (const Terms<R, Symbol>* now = core_.find(x); now == nullptr || !(*now == column)) {
      changed.push_back(x);
    }
  }
  return changed;
}

template <Ring R>
void DeletionGains<R>::begin_index() {
  Index& index = indices_.insert_or_assign(degree(), Index{{}, rules_.next_symbol(), {}}).first->second;
  rules_.for_each_small_since(degree() + 1, Symbol{0}, [&](Symbol x) {
    if (core_.find(x) != nullptr) {
      index.loose.try_emplace(x);
    }
  });
}

/// `lift`: that of x, unless it is known.
template <Ring R>
void DeletionGains<R>::add_to_index(Symbol x, const Terms<R, GeneratorId>& lift) {
  Index* const index = this->index();
  if (index == nullptr) {
    return;
  }
  const Terms<R, Symbol>* const column = core_.find(x);
  const auto loose = index->loose.find(x);
  const bool is_loose = loose != index->loose.end();
  if (column != nullptr ? is_loose && loose->second == *column : !is_loose && index->lifts.has(x)) {
    return;  // it is there
  }
  index->lifts.add(x, known_.is_known(x) ? known_.written_out(x) : lift);
  if (column != nullptr) {
    index->loose.insert_or_assign(x, *column);
  } else if (is_loose) {
    index->loose.erase(loose);
  }
}

template <Ring R>
void DeletionGains<R>::add(Symbol x) {
  Terms<R, GeneratorId> lift = known_.is_known(x) ? Terms<R, GeneratorId>{} : learn(x);
  Element sum = ring_.zero();
  for (const GeneratorId generator : changed_) {
    const TermOfB* term = sparse::find_term<R>(lift, generator);
    const Element in_lift = term != nullptr      ? term->coefficient
                            : known_.is_known(x) ? known_.coefficient(x, generator)
                                                 : ring_.zero();
    ring_.add_product(sum, in_lift, boundary_.entry(deletion_, generator));
  }
  effort_.spend(changed_.size());
  effort_.check();
  add_to_index(x, lift);
  if (!ring_.is_zero(sum)) {
    gained_.push_back({x, sum, std::move(lift)});
  }
}

template <Ring R>
std::vector<sparse::Term<R, Symbol>> DeletionGains<R>::gained() {
  std::vector<std::pair<std::size_t, std::size_t>> order;  // by the length of the lift
  for (std::size_t k = 0; k < gained_.size(); ++k) {
    const auto& [x, coefficient, lift] = gained_[k];
    order.emplace_back(lift.empty() && known_.is_known(x) ? known_.size(x) : lift.size(), k);
  }
  std::sort(order.begin(), order.end());
  std::vector<sparse::Term<R, Symbol>> gained;
  gained.reserve(order.size());
  for (const auto& [size, k] : order) {
    gained.push_back({gained_[k].x, gained_[k].coefficient});
  }
  return gained;
}

template <Ring R>
void DeletionGains<R>::finish(RuleId since, bool concerns_rules) {
  const Symbol e = rules_.symbol_of(deletion_);
  const bool is_eliminated = rules_.size() == since + 1 && rules_[since].a == e;
  const bool is_plain = is_eliminated || rules_.size() == since;  // else e may be part of another basis
  if (!gained_.empty()) {
    if (is_eliminated) {
      follow(since);
    } else {
      clear();
    }
  }
  seen_ = rules_.size();
  if (!is_plain || (is_eliminated && !rules_.value(since).empty())) {
    correctable_.forget(degree());
  } else if (concerns_rules) {
    correctable_.record(degree(), e, {changed_.begin(), changed_.end()});
  }
  gained_.clear();
}

/// What the elimination of e has done to the lifts of those that have gained a multiple of it: the one that was
/// eliminated with it is subtracted from the others.
template <Ring R>
void DeletionGains<R>::follow(RuleId since) {
  const Symbol z = rules_[since].b;
  const auto is_lost = [this](const Gained& g) { return g.lift.empty() && !known_.is_known(g.x); };
  const auto own = std::find_if(gained_.begin(), gained_.end(), [=](const Gained& g) { return g.x == z; });
  if (own == gained_.end() || std::any_of(gained_.begin(), gained_.end(), is_lost)) {  // there was no room
    clear();
    return;
  }
  for (Gained& each : gained_) {
    if (each.x != z) {
      subtract(each, *own);
    }
  }
  if (is_lost(*own)) {
    clear();
  }
}

/// The lift of x has become another one by that of the z that was eliminated.
template <Ring R>
void DeletionGains<R>::subtract(Gained& x, const Gained& z) {
  Index* index = this->index();
  if (core_.find(x.x) != nullptr) {
    known_.forget(x.x);
    if (index != nullptr) {
      index->loose[x.x].clear();
    }
    return;
  }
  const Element factor = ring_.negate(ring_.multiply(x.coefficient, ring_.inverse(z.coefficient)));
  const bool is_short = !known_.is_known(x.x);
  const bool is_known = known_.is_known(z.x);
  if (index != nullptr && !index->lifts.inherit(x.x, z.x)) {
    index->lifts.add(x.x, is_known ? known_.written_out(z.x) : z.lift);
  }
  if (!is_short && is_known) {
    known_.add(x.x, factor, z.x);
  } else if (is_known) {
    known_.keep(x.x, z.x, factor, std::move(x.lift));
  } else if (!is_short) {
    Terms<R, GeneratorId> difference = z.lift;
    for (TermOfB& term : difference) {
      term.coefficient = ring_.multiply(factor, term.coefficient);
    }
    known_.keep(x.x, x.x, ring_.one(), std::move(difference));
  }  // else both are short
}

/// Works the lift of a small symbol out, and keeps it if it is long and does not change by rules to come. Returns it
/// when it is not kept.
template <Ring R>
Terms<R, GeneratorId> DeletionGains<R>::learn(Symbol x) {
  const bool is_cycle = core_.find(x) == nullptr;
  auto sum = corrected_.lift(x, rules_.symbol_of(deletion_));
  if (sum && sum->base) {
    const auto base = *sum->base;
    Terms<R, GeneratorId> rest = corrected_.explicit_part(std::move(*sum));
    if (is_cycle && ring_.is_unit(base.factor)) {
      if (Index* index = this->index(); index != nullptr && !index->lifts.has(x) && index->lifts.inherit(x, base.x)) {
        index->lifts.add(x, rest);
      }
      // It is kept, or, for want of room, nothing is known any more.
      known_.keep(x, base.x, base.factor, std::move(rest));
      return known_.is_known(x) ? Terms<R, GeneratorId>{} : learn(x);
    }
    sparse::add_multiple<R>(ring_, rest, base.factor, known_.written_out(base.x));
    sum = typename CorrectedLifts<R>::Sum{std::move(rest), {}, {}};
  }
  Terms<R, GeneratorId> lift =
      sum ? corrected_.explicit_part(std::move(*sum)) : lifts_.lift(Terms<R, Symbol>{{x, ring_.one()}});
  if (is_cycle) {
    known_.keep(x, lift);
  }
  return lift;
}

#define SESAME_INSTANTIATE(R) template class DeletionGains<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine

#include "engine/right/dependents.hpp"

#include <algorithm>

namespace sesame::engine {

template <Ring R>
std::uint64_t Dependents<R>::size_of_backlog() const {
  return std::uint64_t{rules_.next_symbol() - seen_.symbols} + (rules_.size() - seen_.rules);
}

template <Ring R>
void Dependents<R>::catch_up() {
  // In the order in which they were made, so that undo finds the last ones at the end.
  while (seen_.symbols < rules_.next_symbol() || seen_.rules < rules_.size()) {
    if (seen_.symbols < rules_.next_symbol() && rules_.born(seen_.symbols) <= seen_.rules) {
      add_symbol(seen_.symbols++);
    } else {
      add_rule(seen_.rules++);
    }
  }
  if (!is_kept_) {
    perturbations_.for_each_gain([this](RuleId rule, std::span<const sparse::Term<R, Symbol>> gain) {
      for (const sparse::Term<R, Symbol>& term : gain) {
        add(term.index, rule, Kind::value);
      }
    });
    is_kept_ = true;
  }
}

template <Ring R>
void Dependents<R>::add(Symbol from, std::uint32_t to, Kind kind) {
  if (from >= last_.size()) {
    last_.resize(std::size_t{from} + 1, no_edge);
  }
  edges_.push_back({from, to, last_[from], kind});
  last_[from] = static_cast<std::uint32_t>(edges_.size() - 1);
}

template <Ring R>
void Dependents<R>::add_symbol(Symbol x) {
  if (const auto* combination = rules_.combination(x)) {
    add(combination->x, x, Kind::combination);
    add(combination->y, x, Kind::combination);
    for (const sparse::Term<R, Symbol>& term : combination->column) {
      add(term.index, x, Kind::boundary);
    }
    return;
  }
  boundary_.for_each_in_column(rules_.generator_in(x), [&](const sparse::Term<R, GeneratorId>& term) {
    add(rules_.symbol_of(term.index), x, Kind::boundary);
  });
}

template <Ring R>
void Dependents<R>::add_rule(RuleId rule) {
  for (const sparse::Term<R, Symbol>& term : rules_.value(rule)) {
    add(term.index, rule, Kind::value);
  }
}

/// Rewriting z may use a rule that matters.
template <Ring R>
void Dependents<R>::reach_rewriting(Symbol z) {
  if (reached_[z].rewriting != search_) {
    reached_[z].rewriting = search_;
    pending_rewritings_.push_back(z);
  }
}

/// The lift of x may have one of the generators.
template <Ring R>
void Dependents<R>::reach_lift(Symbol x) {
  if (reached_[x].lift != search_) {
    reached_[x].lift = search_;
    pending_lifts_.push_back(x);
  }
}

template <Ring R>
std::optional<std::vector<Symbol>> Dependents<R>::lifts_with(std::span<const GeneratorId> generators,
                                                             std::uint64_t most) {
  ++search_;
  reached_.resize(rules_.next_symbol());
  last_.resize(std::max<std::size_t>(last_.size(), rules_.next_symbol()), no_edge);
  found_.clear();
  pending_rewritings_.clear();
  pending_lifts_.clear();
  for (const GeneratorId generator : generators) {
    reach_lift(rules_.symbol_of(generator));
  }
  const std::uint64_t before = looked_at_;
  while (!pending_lifts_.empty() || !pending_rewritings_.empty()) {
    if (++looked_at_ - before > most) {
      return std::nullopt;
    }
    const bool is_lift = !pending_lifts_.empty();
    std::vector<Symbol>& pending = is_lift ? pending_lifts_ : pending_rewritings_;
    const Symbol z = pending.back();
    pending.pop_back();
    if (is_lift) {
      const RuleId rule = rules_.removed_by(z);
      if (rule != no_rule && rules_[rule].b == z) {
        reach_rewriting(rules_[rule].a);
      }
      if (rules_.is_small(z) || rules_.combination(z) != nullptr) {
        found_.push_back(z);
      }
    }
    for (std::uint32_t at = last_[z]; at != no_edge; at = edges_[at].previous) {
      ++looked_at_;
      const auto [from, to, previous, kind] = edges_[at];
      if (is_lift) {
        if (kind == Kind::combination && to < rules_.next_symbol()) {
          reach_lift(Symbol{to});
        }
      } else if (kind == Kind::boundary && to < rules_.next_symbol()) {
        reach_lift(Symbol{to});
      } else if (kind == Kind::value && to < rules_.size()) {
        reach_rewriting(rules_[RuleId{to}].a);
      }
    }
  }
  std::sort(found_.begin(), found_.end());
  return found_;
}

template <Ring R>
bool Dependents<R>::is_gone(const Edge& edge, const typename Rules<R>::Mark& mark) const {
  const std::uint32_t end = edge.kind == Kind::value ? std::uint32_t{mark.rules} : std::uint32_t{mark.symbols};
  return edge.from >= mark.symbols || edge.to >= end;
}

template <Ring R>
void Dependents<R>::undo(const typename Rules<R>::Mark& mark) {
  while (!edges_.empty() && is_gone(edges_.back(), mark)) {
    last_[edges_.back().from] = edges_.back().previous;
    edges_.pop_back();
  }
  seen_.symbols = std::min(seen_.symbols, mark.symbols);
  seen_.rules = std::min(seen_.rules, mark.rules);
}

#define SESAME_INSTANTIATE(R) template class Dependents<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine

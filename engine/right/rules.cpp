#include "engine/right/rules.hpp"

#include <algorithm>

namespace sesame::engine {

// ---------------------------------------------------------------------------------------------------------- symbols

template <Ring R>
void Rules<R>::reserve(std::size_t generators) {
  removed_by_.reserve(generators);
  degree_.reserve(generators);
  generator_.reserve(generators);
  born_.reserve(generators);
  neighbours_.reserve(generators);
  symbol_of_.reserve(generators);
  rules_.reserve(generators / 2);
  values_.reserve(generators);
  constexpr std::size_t usual_degrees = 5;
  first_.reserve(usual_degrees);
  last_.reserve(usual_degrees);
  small_counts_.reserve(usual_degrees);
}

template <Ring R>
Symbol Rules<R>::append_generator(int degree) {
  const auto generator = static_cast<std::uint32_t>(symbol_of_.size());
  const Symbol x = add_symbol(degree, generator);
  symbol_of_.push_back(x);
  return x;
}

template <Ring R>
Symbol Rules<R>::add_symbol(int degree, std::uint32_t generator) {
  const Symbol x = next_symbol();
  const std::size_t list = list_of_degree(degree);
  if (list >= first_.size()) {
    first_.resize(list + 1, no_symbol);
    last_.resize(list + 1, no_symbol);
    small_counts_.resize(list, 0);
  }
  removed_by_.push_back(no_rule);
  degree_.push_back(static_cast<std::int8_t>(degree));
  generator_.push_back(generator);
  born_.push_back(size());
  neighbours_.push_back({last_[list], no_symbol});
  relink(x);
  return x;
}

template <Ring R>
void Rules<R>::drop_last_symbol() {
  const Symbol x = next_symbol() - 1;
  unlink(x);
  if (is_combination(x)) {
    combinations_.pop_back();
  } else {
    symbol_of_.pop_back();
  }
  removed_by_.pop_back();
  degree_.pop_back();
  generator_.pop_back();
  born_.pop_back();
  neighbours_.pop_back();
}

template <Ring R>
void Rules<R>::count_small(Symbol x, int change) {
  if (degree_[x] >= 0) {
    small_counts_[static_cast<std::size_t>(degree_[x])] += static_cast<std::uint32_t>(change);
  }
}

template <Ring R>
void Rules<R>::unlink(Symbol x) {
  const std::size_t p = list_of(x);
  const auto [before, after] = neighbours_[x];
  (before == no_symbol ? first_[p] : neighbours_[before].after) = after;
  (after == no_symbol ? last_[p] : neighbours_[after].before) = before;
  count_small(x, -1);
}

/// Undoes the unlink of x, when everything that was linked or unlinked since has been undone.
template <Ring R>
void Rules<R>::relink(Symbol x) {
  const std::size_t p = list_of(x);
  const auto [before, after] = neighbours_[x];
  (before == no_symbol ? first_[p] : neighbours_[before].after) = x;
  (after == no_symbol ? last_[p] : neighbours_[after].before) = x;
  count_small(x, 1);
}

template <Ring R>
GeneratorId Rules<R>::generator_in(Symbol x) const {
  while (const Combination* combined = combination(x)) {
    x = combined->x;
  }
  return GeneratorId{generator_[x]};
}

template <Ring R>
Symbol Rules<R>::small_of(GeneratorId generator) const {
  Symbol x = symbol_of(generator);
  for (RuleId rule = removed_by(x); rule != no_rule; rule = removed_by(x)) {
    if (rules_[rule].b != no_symbol) {
      return no_symbol;
    }
    x = value(rule).back().index;  // the symbol that was made is the youngest
  }
  return is_small(x) ? x : no_symbol;
}

template <Ring R>
std::vector<Symbol> Rules<R>::small(int degree) const {
  std::vector<Symbol> symbols;
  if (degree >= 0 && list_of_degree(degree) < first_.size()) {
    for (Symbol x = first_[list_of_degree(degree)]; x != no_symbol; x = neighbours_[x].after) {
      symbols.push_back(x);
    }
  }
  return symbols;
}

// ------------------------------------------------------------------------------------------------------------ rules

/// A new rule whose value is what has been appended to the pool.
template <Ring R>
RuleId Rules<R>::push(Symbol a, Symbol b, Element inverse, std::size_t value_begin) {
  const RuleId id = size();
  const std::size_t terms = values_.size() - value_begin;
  rules_.push_back({a, b, std::move(inverse), value_begin, static_cast<std::uint32_t>(terms)});
  terms_made_ += terms;
  removed_by_[a] = id;
  unlink(a);
  if (b != no_symbol) {
    removed_by_[b] = id;
    unlink(b);
  }
  ++version_;
  return id;
}

template <Ring R>
void Rules<R>::pop() {
  const Rule& rule = rules_.back();
  if (rule.b != no_symbol) {
    relink(rule.b);
    removed_by_[rule.b] = no_rule;
  }
  relink(rule.a);
  removed_by_[rule.a] = no_rule;
  values_.truncate(rule.value_begin);
  rules_.pop_back();
}

template <Ring R>
RuleId Rules<R>::eliminate(Symbol a, Symbol b, const Terms<R, Symbol>& column) {
  const auto at = std::find_if(column.begin(), column.end(), [a](const TermType& term) { return term.index == a; });
  Element inverse = ring_.inverse(at->coefficient);
  const Element minus_inverse = ring_.negate(inverse);
  const std::size_t begin = values_.size();
  for (const TermType& term : column) {
    if (term.index != a) {
      values_.push_back({term.index, ring_.multiply(minus_inverse, term.coefficient)});
    }
  }
  return push(a, b, std::move(inverse), begin);
}

template <Ring R>
RuleId Rules<R>::change_basis(Symbol x, const Element& q, Symbol y, Terms<R, Symbol> column) {
  const auto index = static_cast<std::uint32_t>(combinations_.size());
  const Symbol made = add_symbol(degree_[x], combination_bit | index);
  const std::size_t begin = values_.size();
  values_.push_back({y, q});  // y is older than the symbol made: this is normal form
  values_.push_back({made, ring_.one()});
  const RuleId rule = push(x, no_symbol, ring_.zero(), begin);
  combinations_.push_back({x, y, q, rule, made, std::move(column)});
  return rule;
}

template <Ring R>
void Rules<R>::consume(Symbol x) {
  push(x, no_symbol, ring_.zero(), values_.size());
  removed_by_[x] = no_rule;  // rewriting ends at it
}

template <Ring R>
void Rules<R>::extend_column(std::size_t combination, const Terms<R, Symbol>& terms) {
  Terms<R, Symbol>& column = combinations_[combination].column;
  column.insert(column.end(), terms.begin(), terms.end());
}

template <Ring R>
void Rules<R>::cut_column(std::size_t combination, Symbol first) {
  std::erase_if(combinations_[combination].column, [first](const TermType& term) { return term.index >= first; });
}

template <Ring R>
void Rules<R>::undo(const Mark& mark) {
  while (size() > mark.rules || next_symbol() > mark.symbols) {
    // A symbol was made after the last rule exactly when it was born at the present time.
    if (next_symbol() > mark.symbols && born_.back() >= size()) {
      drop_last_symbol();
    } else {
      pop();
    }
  }
  ++version_;
}

#define SESAME_INSTANTIATE(R) template class Rules<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine

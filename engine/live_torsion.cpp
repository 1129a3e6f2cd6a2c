#include "engine/live_torsion.hpp"

#include <concepts>
#include <iterator>

namespace sesame::engine {

namespace {

/// With more new columns than this their order matters, and an elimination chooses it.
constexpr std::ptrdiff_t most_new_columns = 64;

}  // namespace

template <Ring R>
void LiveTorsion<R>::begin_afresh() {
  degrees_.clear();
  next_rule_ = rewriter_.rules();
  next_symbol_ = 0;
  breaks_ = rewriter_.breaks();
  is_lost_ = false;
}

template <Ring R>
bool LiveTorsion<R>::follow() {
  if constexpr (std::same_as<R, sparse::Integers>) {
    const auto& columns = rewriter_.core().columns();
    const bool is_small = std::ssize(columns) <= most_new_columns;
    if (columns.empty() || breaks_ != rewriter_.breaks() || (is_lost_ && is_small)) {
      begin_afresh();
    }
    const auto first = columns.lower_bound(next_symbol_);
    is_lost_ = is_lost_ || (!is_small && std::distance(first, columns.end()) > most_new_columns);
    if (is_lost_) {
      return false;
    }
    for (; next_rule_ < rewriter_.rules(); ++next_rule_) {
      take_in_rule(next_rule_);
    }
    for (auto column = first; column != columns.end(); ++column) {
      sparse::RawTerms<R> relation;
      for (const auto& term : column->second) {
        relation.push_back({term.index, term.coefficient});
      }
      degrees_[rewriter_.degree(column->first) - 1].group.add_relation(std::move(relation).normal(sparse::Integers{}));
    }
    next_symbol_ = rewriter_.all_rules().next_symbol();
    return true;
  }
  return false;
}

/// The one that knows a symbol, or null.
template <Ring R>
auto LiveTorsion<R>::degree_with(Symbol x) -> Degree* {
  const auto degree = degrees_.find(rewriter_.degree(x));
  return degree != degrees_.end() && degree->second.group.contains(x) ? &degree->second : nullptr;
}

template <Ring R>
void LiveTorsion<R>::take_in_rule(RuleId rule) {
  if constexpr (std::same_as<R, sparse::Integers>) {
    const Rules<R>& rules = rewriter_.all_rules();
    const Symbol a = rules[rule].a, b = rules[rule].b;
    if (Degree* const of_b = b != no_symbol ? degree_with(b) : nullptr) {  // it goes, and others take their share of it
      of_b->group.add_relation({{b, 1}});
      ++of_b->eliminated;
    }
    Degree* const of_a = degree_with(a);
    if (of_a == nullptr) {
      return;
    }
    const auto value = rules.value(rule);
    if (b == no_symbol) {  // a = made + q y
      const auto& [y, made] = std::pair{value[0], value[1]};
      of_a->group.add_combination(made.index,
                                  RawTerms<R>{{a, 1}, {y.index, -y.coefficient}}.normal(sparse::Integers{}));
      return;
    }
    sparse::RawTerms<R> relation{{a, -1}};
    for (const auto& term : value) {
      relation.push_back({term.index, term.coefficient});
    }
    of_a->group.add_relation(std::move(relation).normal(sparse::Integers{}));
    ++of_a->eliminated;
  }
}

#define SESAME_INSTANTIATE(R) template class LiveTorsion<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine

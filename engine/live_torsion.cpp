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

template <Ring R>
void LiveTorsion<R>::take_in_rule(RuleId rule) {
  if constexpr (std::same_as<R, sparse::Integers>) {
    const Rules<R>& rules = rewriter_.all_rules();
    const Symbol a = rules[rule].a;
    const auto degree = degrees_.find(rules.degree(a));
    if (degree == degrees_.end() || !degree->second.group.contains(a)) {
      return;
    }
    const auto value = rules.value(rule);
    if (rules[rule].b == no_symbol) {  // a = made + q y
      const auto& [y, made] = std::pair{value[0], value[1]};
      degree->second.group.add_combination(made.index,
                                           RawTerms<R>{{a, 1}, {y.index, -y.coefficient}}.normal(sparse::Integers{}));
      return;
    }
    sparse::RawTerms<R> relation{{a, -1}};
    for (const auto& term : value) {
      relation.push_back({term.index, term.coefficient});
    }
    degree->second.group.add_relation(std::move(relation).normal(sparse::Integers{}));
    ++degree->second.eliminated;
  }
}

#define SESAME_INSTANTIATE(R) template class LiveTorsion<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine

#include "engine/right/perturbations.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace sesame::engine {
namespace {

template <Ring R>
void cut(Terms<R, Symbol>& terms, Symbol first) {
  std::erase_if(terms, [first](const sparse::Term<R, Symbol>& term) { return term.index >= first; });
}

}  // namespace

template <Ring R>
typename Perturbations<R>::Concerned Perturbations<R>::record(RuleId time, Symbol first,
                                                              std::span<const GeneratorId> changed,
                                                              const Reached& reached, bool is_deletion) {
  Concerned concerned;
  std::set<int> combined;  // degrees with changes of basis
  for (const auto& combination : rules_.combinations()) {
    combined.insert(rules_.degree(combination.x));
  }
  std::map<int, RuleId> since;  // by degree: rules made before do not have a changed generator in their lifts
  for (const GeneratorId generator : changed) {
    const Symbol x = rules_.symbol_of(generator);
    const RuleId rule = rules_.removed_by(x);
    if (rule == no_rule) {
      concerned.small.insert(x);
    }
    // In the lifts of others are only the b of rules, and whatever is part of a combination.
    const bool is_combined = combined.contains(rules_.degree(x));
    if (is_combined || (rule != no_rule && rules_[rule].b == x)) {
      const RuleId from = is_combined ? rules_.born(x) : rule;
      const auto [at, is_new] = since.try_emplace(rules_.degree(x), from);
      at->second = std::min(at->second, from);
    }
  }
  Step step{first, {}, {}, {}, {}};
  for (const auto& [degree, rule] : since) {
    step.degrees.push_back(degree);
    const auto q = static_cast<std::size_t>(degree);
    of_degree_.resize(std::max(of_degree_.size(), q + 1));
    of_degree_[q].push_back(
        {time, rule, first, static_cast<std::uint32_t>(of_degree_[q].size()), ++last_serial_, is_deletion});
    for (const Symbol x : reached ? *reached : rules_.small(degree)) {
      if (x < first && rules_.degree(x) == degree && rules_.is_small(x)) {
        concerned.small.insert(x);
      }
    }
  }
  steps_.push_back(std::move(step));
  expected_ = no_symbol;
  ++recorded_;
  for (std::size_t k = 0; k < rules_.combinations().size() && !since.empty(); ++k) {
    const auto& combination = rules_.combinations()[k];
    const auto of_degree = since.find(rules_.degree(combination.x));
    const bool is_reached = !reached || std::binary_search(reached->begin(), reached->end(), combination.made);
    if (is_reached && combination.rule < time && of_degree != since.end() && combination.rule >= of_degree->second) {
      concerned.combinations.push_back(k);
    }
  }
  return concerned;
}

template <Ring R>
void Perturbations<R>::forget_those_not_felt() {
  Step& step = steps_.back();
  for (std::size_t degree = 0; degree < of_degree_.size(); ++degree) {
    auto& all = of_degree_[degree];
    if (all.empty()) {
      continue;
    }
    const std::uint32_t before = all.back().last_felt;
    std::uint32_t last = before;
    while (last != nobody && all[last].is_deletion && is_rewritten_to_zero(all[last].first)) {
      last = last > 0 ? all[last - 1].last_felt : nobody;
    }
    if (last != before) {
      all.back().last_felt = last;
      if (all.back().first != step.first) {
        step.felt_before.emplace_back(degree, before);
      }
    }
  }
}

/// How many perturbations of generators of a degree there had been at a time.
template <Ring R>
std::size_t Perturbations<R>::until(std::size_t degree, RuleId time) const {
  if (degree >= of_degree_.size()) {
    return 0;
  }
  const auto& all = of_degree_[degree];
  const auto after = std::upper_bound(all.begin(), all.end(), time,
                                      [](RuleId t, const Perturbation& perturbation) { return t < perturbation.time; });
  return static_cast<std::size_t>(after - all.begin());
}

template <Ring R>
std::size_t Perturbations<R>::before(RuleId rule, Symbol first) const {
  const std::size_t q = degree_of_b(rule);
  if (q >= of_degree_.size()) {
    return 0;
  }
  const auto& all = of_degree_[q];
  const auto at = std::lower_bound(all.begin(), all.end(), first,
                                   [](const Perturbation& perturbation, Symbol x) { return perturbation.first < x; });
  return static_cast<std::size_t>(at - all.begin());
}

/// How many perturbations of its degree a rule has taken in: those made before it have been part of it from the start.
template <Ring R>
std::size_t Perturbations<R>::taken_in(RuleId rule) const {
  const Gain* gained = find_gain(rule);
  return gained != nullptr ? gained->taken_in : until(degree_of_b(rule), rule);
}

template <Ring R>
bool Perturbations<R>::is_behind(RuleId rule) const {
  const std::size_t q = degree_of_b(rule);
  if (q >= of_degree_.size() || of_degree_[q].empty() || rules_[rule].b == no_symbol) {
    return false;
  }
  const auto& all = of_degree_[q];
  return std::any_of(all.begin() + static_cast<std::ptrdiff_t>(taken_in(rule)), all.end(),
                     [rule](const Perturbation& perturbation) { return perturbation.since <= rule; });
}

template <Ring R>
void Perturbations<R>::take_in(RuleId rule, const Terms<R, Symbol>& more) {
  if (rule >= place_.size()) {
    place_.resize(rules_.size(), no_place);
  }
  if (place_[rule] == no_place) {
    place_[rule] = static_cast<std::uint32_t>(gains_.size());
    gains_.push_back({rule, {}, 0});
  }
  Gain& sum = gains_[place_[rule]];
  sum.terms.insert(sum.terms.end(), more.begin(), more.end());
  sum.taken_in = of_degree_[degree_of_b(rule)].size();
  steps_.back().rules.push_back(rule);
}

template <Ring R>
void Perturbations<R>::extend_column(std::size_t combination, const Terms<R, Symbol>& more) {
  if (!more.empty()) {
    rules_.extend_column(combination, more);
    steps_.back().combinations.push_back(combination);
  }
}

template <Ring R>
void Perturbations<R>::undo(std::size_t size, RuleId rules) {
  expected_ = no_symbol;
  while (steps_.size() > size) {
    undo_last();
  }
  for (RuleId rule = rules; rule < place_.size(); ++rule) {
    forget_gain(rule);
  }
  place_.resize(std::min<std::size_t>(place_.size(), rules));
}

/// The last one takes its place.
template <Ring R>
void Perturbations<R>::forget_gain(RuleId rule) {
  const std::uint32_t place = std::exchange(place_[rule], no_place);
  if (place == no_place) {
    return;
  }
  if (place + 1 < gains_.size()) {
    gains_[place] = std::move(gains_.back());
    place_[gains_[place].rule] = place;
  }
  gains_.pop_back();
}

template <Ring R>
void Perturbations<R>::undo_last() {
  const Step step = std::move(steps_.back());
  steps_.pop_back();
  for (const int degree : step.degrees) {
    of_degree_[static_cast<std::size_t>(degree)].pop_back();
  }
  for (const auto& [degree, felt] : step.felt_before) {
    of_degree_[degree].back().last_felt = felt;
  }
  for (const std::size_t combination : step.combinations) {
    rules_.cut_column(combination, step.first);
  }
  for (const RuleId rule : step.rules) {
    Gain* gained = find_gain(rule);
    if (gained == nullptr) {
      continue;
    }
    cut<R>(gained->terms, step.first);
    gained->taken_in = std::min(gained->taken_in, of_degree_[degree_of_b(rule)].size());
    if (steps_.empty()) {
      forget_gain(rule);
    } else {
      steps_.back().rules.push_back(rule);
    }
  }
}

#define SESAME_INSTANTIATE(R) template class Perturbations<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine

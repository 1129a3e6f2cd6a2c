#include "reductions/unit_elimination.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <queue>

namespace sesame::reductions {

template <Ring R>
UnitElimination<R>::UnitElimination(const ChainComplex<R>& complex, Keep keep) : ring_{complex.ring()}, keep_{keep} {
  for (int p = 0; p <= complex.top(); ++p) {
    Level& level = levels_.emplace_back();
    level.size = complex.size(p);
    level.rule_of.assign(level.size, none);
    level.is_b.assign(level.size, false);
    level.boundary.resize(level.size);
    level.trace.resize(level.size);
    if (p > 0) {
      eliminate_degree(static_cast<std::size_t>(p), complex.boundary(p));
    }
  }
  number_small_generators();
}

template <Ring R>
void UnitElimination<R>::eliminate_degree(std::size_t p, const Matrix<R>& boundary) {
  values_.assign(levels_[p - 1].size, ring_.zero());
  std::vector<Index> left;  // boundaries that are neither zero nor of a rule: none of them over a field
  for (Index x = 0; x < levels_[p].size; ++x) {
    levels_[p].boundary[x] = boundary.column(x);
    if (!settle(p, x) && !levels_[p].boundary[x].empty()) {
      left.push_back(x);
    }
  }
  // A rule found later may give a boundary without units one: until nothing happens any more.
  for (std::size_t rules = 0; rules != levels_[p - 1].rules.size();) {
    rules = levels_[p - 1].rules.size();
    std::erase_if(left, [&](Index x) { return settle(p, x); });
  }
}

template <Ring R>
bool UnitElimination<R>::settle(std::size_t p, Index x) {
  rewrite(p, x);
  const Terms<R>& boundary = levels_[p].boundary[x];
  const auto pivot =
      std::find_if(boundary.rbegin(), boundary.rend(), [&](const Term<R>& t) { return ring_.is_unit(t.coefficient); });
  if (pivot == boundary.rend()) {
    return false;
  }
  make_rule(p, x, *pivot);
  return true;
}

template <Ring R>
void UnitElimination<R>::rewrite(std::size_t p, Index x) {
  const Level& below = levels_[p - 1];
  Terms<R>& boundary = levels_[p].boundary[x];
  std::vector<Index> touched;
  std::priority_queue<Index, std::vector<Index>, std::greater<>> rules;
  const auto add = [&](const Element& factor, const Term<R>& t) {
    if (below.is_b[t.index]) {
      return;
    }
    if (ring_.is_zero(values_[t.index])) {
      touched.push_back(t.index);
      if (below.rule_of[t.index] != none) {
        rules.push(below.rule_of[t.index]);
      }
    }
    ring_.add_product(values_[t.index], factor, t.coefficient);
  };
  for (const Term<R>& t : boundary) {
    add(ring_.one(), t);
  }
  Terms<R> used;
  for (; !rules.empty(); rules.pop()) {
    const Rule& rule = below.rules[rules.top()];
    if (ring_.is_zero(values_[rule.a])) {
      continue;  // cancelled, or queued twice
    }
    const Element share = ring_.multiply(values_[rule.a], rule.inverse);
    values_[rule.a] = ring_.zero();
    const Element factor = ring_.negate(share);
    for (const Term<R>& t : rule.rest) {
      add(factor, t);
    }
    used.push_back({rules.top(), share});
  }
  std::sort(touched.begin(), touched.end());
  boundary.clear();
  for (const Index i : touched) {
    if (!ring_.is_zero(values_[i])) {
      boundary.push_back({i, std::exchange(values_[i], ring_.zero())});
    }
  }
  if (keep_ == Keep::traces) {
    sparse::add_multiple<R>(ring_, levels_[p].trace[x], ring_.one(), used);
  }
}

template <Ring R>
void UnitElimination<R>::make_rule(std::size_t p, Index b, const Term<R>& pivot) {
  Level& below = levels_[p - 1];
  Rule rule{pivot.index, b, ring_.inverse(pivot.coefficient), std::exchange(levels_[p].boundary[b], {}),
            std::exchange(levels_[p].trace[b], {})};
  std::erase_if(rule.rest, [&](const Term<R>& t) { return t.index == rule.a; });
  below.rule_of[rule.a] = static_cast<Index>(below.rules.size());
  levels_[p].is_b[b] = true;
  below.rules.push_back(std::move(rule));
}

template <Ring R>
void UnitElimination<R>::number_small_generators() {
  for (Level& level : levels_) {
    level.number.assign(level.size, none);
    for (Index x = 0; x < level.size; ++x) {
      if (!level.is_b[x] && level.rule_of[x] == none) {
        level.number[x] = level.small_size++;
      }
    }
  }
}

template <Ring R>
Terms<R> UnitElimination<R>::lift(std::size_t p, Index x, const Terms<R>& trace) const {
  sparse::expects(keep_ == Keep::traces, "lifts need the traces of the rewritings");
  RawTerms<R> result{{x, ring_.one()}};
  // From the latest rule to the earliest, equal terms added first: each rule is expanded at most once.
  std::map<Index, Element, std::greater<>> pending;
  const auto subtract = [&](const Element& factor, const Terms<R>& terms) {
    for (const Term<R>& t : terms) {
      const auto [at, is_new] = pending.try_emplace(t.index, ring_.zero());
      ring_.add_product(at->second, ring_.negate(factor), t.coefficient);
    }
  };
  for (subtract(ring_.one(), trace); !pending.empty();) {
    const auto [number, coefficient] = *pending.begin();
    pending.erase(pending.begin());
    if (!ring_.is_zero(coefficient)) {
      const Rule& rule = levels_[p - 1].rules[number];
      result.push_back({rule.b, coefficient});
      subtract(coefficient, rule.trace);
    }
  }
  return std::move(result).normal(ring_);
}

template <Ring R>
Terms<R> UnitElimination<R>::renumbered(const Level& level, const Terms<R>& terms) const {
  Terms<R> result;
  for (const Term<R>& t : terms) {
    result.push_back({level.number[t.index], t.coefficient});
  }
  return result;
}

template <Ring R>
Sizes UnitElimination<R>::sizes() const {
  Sizes result;
  for (const Level& level : levels_) {
    result.push_back(level.size);
  }
  return result;
}

template <Ring R>
Sizes UnitElimination<R>::small_sizes() const {
  Sizes result;
  for (const Level& level : levels_) {
    result.push_back(level.small_size);
  }
  return result;
}

template <Ring R>
ChainComplex<R> UnitElimination<R>::small() const {
  std::vector<Matrix<R>> boundaries;
  for (std::size_t p = 0; p < levels_.size(); ++p) {
    const Level& level = levels_[p];
    Matrix<R>& matrix = boundaries.emplace_back(ring_, p == 0 ? 0 : levels_[p - 1].small_size, level.small_size);
    for (Index x = 0; x < level.size; ++x) {
      if (level.number[x] != none && !level.boundary[x].empty()) {
        matrix.set_column(level.number[x], renumbered(levels_[p - 1], level.boundary[x]));
      }
    }
  }
  return ChainComplex<R>(ring_, small_sizes(), std::move(boundaries));
}

template <Ring R>
GradedMap<R> UnitElimination<R>::f() const {
  std::vector<Matrix<R>> parts;
  for (const Level& level : levels_) {
    Matrix<R>& part = parts.emplace_back(ring_, level.small_size, level.size);
    for (Index x = 0; x < level.size; ++x) {
      if (level.number[x] != none) {
        part.set_column(x, Terms<R>{{level.number[x], ring_.one()}});
      }
    }
    // The rest of a rule is small, or the business of later rules.
    for (auto rule = level.rules.rbegin(); rule != level.rules.rend(); ++rule) {
      Terms<R> image;
      sparse::add_multiple<R>(ring_, image, ring_.negate(rule->inverse), part.apply(rule->rest));
      part.set_column(rule->a, image);
    }
  }
  return GradedMap<R>(ring_, 0, sizes(), small_sizes(), std::move(parts));
}

template <Ring R>
GradedMap<R> UnitElimination<R>::g() const {
  std::vector<Matrix<R>> parts;
  for (std::size_t p = 0; p < levels_.size(); ++p) {
    const Level& level = levels_[p];
    Matrix<R>& part = parts.emplace_back(ring_, level.size, level.small_size);
    for (Index x = 0; x < level.size; ++x) {
      if (level.number[x] != none) {
        part.set_column(level.number[x], lift(p, x, level.trace[x]));
      }
    }
  }
  return GradedMap<R>(ring_, 0, small_sizes(), sizes(), std::move(parts));
}

template <Ring R>
GradedMap<R> UnitElimination<R>::h() const {
  const Sizes all = sizes();
  std::vector<Matrix<R>> parts;
  for (std::size_t p = 0; p < levels_.size(); ++p) {
    const Level& level = levels_[p];
    Matrix<R>& part = parts.emplace_back(ring_, size_at(all, static_cast<int>(p) + 1), level.size);
    for (auto rule = level.rules.rbegin(); rule != level.rules.rend(); ++rule) {
      Terms<R> image;
      sparse::add_multiple<R>(ring_, image, rule->inverse, lift(p + 1, rule->b, rule->trace));
      sparse::add_multiple<R>(ring_, image, ring_.negate(rule->inverse), part.apply(rule->rest));
      part.set_column(rule->a, image);
    }
  }
  return GradedMap<R>(ring_, 1, all, all, std::move(parts));
}

#define SESAME_INSTANTIATE(R) template class UnitElimination<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::reductions

/// \file
/// Right reductions made at random, rule by rule.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/right/lifts.hpp"
#include "tests/support/rewriting.hpp"

namespace sesame::tests {

/// A reduction whose rules are made at random: any unit is eliminated, bases are changed now and then.
template <Ring R>
struct RandomReduction {
  RandomReduction(const R& k, unsigned seed) : ring{k}, random{seed} {}

  R ring;
  Random random;
  GrowingComplex<R> b{ring};
  engine::Rules<R> rules{ring};
  engine::Perturbations<R> perturbations{ring, rules};
  engine::Dependents<R> dependents{b.boundary, rules, perturbations};
  engine::Effort effort;
  engine::Lifts<R> lifts{ring, b.boundary, rules, perturbations, dependents, effort};

  [[nodiscard]] ChainOfS<R> f(const ChainOfB<R>& chain) const {
    return rewritten(ring, rules, in_symbols(ring, rules, chain));
  }
  ChainOfB<R> g(const ChainOfS<R>& symbols) { return lifts.lift(symbols); }
  ChainOfB<R> h(const ChainOfB<R>& chain) { return lifts.lift({}, lifts.trace(chain)); }
  ChainOfS<R> small_boundary(engine::Symbol x) { return f(b.d(g({{x, ring.one()}}))); }

  void grow_to(const ChainComplex<R>& complex) {
    const GrowingComplex<R> all = in_random_order(random, complex);
    for (engine::GeneratorId x = 0; x < all.size(); ++x) {
      append(all.degrees[x], all.boundary.column(x));
      if (random.one_in(4)) {
        change_any_basis(all.degrees[x]);
      }
    }
  }
  void append(int degree, const ChainOfB<R>& boundary) {
    b.append(degree, boundary);
    const engine::Symbol x = rules.append_generator(degree);
    const ChainOfS<R> image = f(boundary);
    std::vector<engine::Symbol> units;
    for (const auto& term : image) {
      if (ring.is_unit(term.coefficient)) {
        units.push_back(term.index);
      }
    }
    if (!units.empty()) {
      rules.eliminate(units[static_cast<std::size_t>(random.in(0, static_cast<int>(units.size()) - 1))], x, image);
    }
  }
  void change_any_basis(int degree) {
    const std::vector<engine::Symbol> small = rules.small(degree);
    if (small.size() > 1) {
      const auto q = ring.from(std::int64_t{random.in(1, 3)});
      const engine::Symbol x = small.front(), y = small.back();
      rules.change_basis(x, q, y, sum_of(ring, small_boundary(x), ring.negate(q), small_boundary(y)));
    }
  }
  [[nodiscard]] std::vector<engine::Symbol> small() const {
    std::vector<engine::Symbol> all;
    for (int p = 0; p < 5; ++p) {
      const std::vector<engine::Symbol> of_degree = rules.small(p);
      all.insert(all.end(), of_degree.begin(), of_degree.end());
    }
    return all;
  }
  std::string broken_law() {
    return tests::broken_law(
        b, small(), [this](const ChainOfB<R>& v) { return f(v); }, [this](const ChainOfS<R>& v) { return g(v); },
        [this](const ChainOfB<R>& v) { return h(v); }, [this](engine::Symbol x) { return small_boundary(x); });
  }
};

}  // namespace sesame::tests

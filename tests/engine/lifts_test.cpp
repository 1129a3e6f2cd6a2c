#include "engine/right/lifts.hpp"

#include "tests/support/catch.hpp"
#include "tests/support/rewriting.hpp"

using namespace sesame;
using namespace sesame::tests;
using engine::Effort;
using engine::GeneratorId;
using engine::Lifts;
using engine::Perturbations;
using engine::RuleId;
using engine::Rules;
using engine::Symbol;

namespace {

/// A reduction whose rules are made at random: any unit is eliminated, bases are changed now and then.
template <Ring R>
struct RandomReduction {
  RandomReduction(const R& k, unsigned seed) : ring{k}, random{seed} {}

  R ring;
  Random random;
  GrowingComplex<R> b{ring};
  Rules<R> rules{ring};
  Perturbations<R> perturbations{ring, rules};
  Effort effort;
  Lifts<R> lifts{ring, b.boundary, rules, perturbations, effort};

  [[nodiscard]] ChainOfS<R> f(const ChainOfB<R>& chain) const {
    return rewritten(ring, rules, in_symbols(ring, rules, chain));
  }
  ChainOfB<R> g(const ChainOfS<R>& symbols) { return lifts.lift(symbols); }
  ChainOfB<R> h(const ChainOfB<R>& chain) { return lifts.lift({}, lifts.trace(chain)); }
  ChainOfS<R> small_boundary(Symbol x) { return f(b.d(g({{x, ring.one()}}))); }

  void grow_to(const ChainComplex<R>& complex) {
    const GrowingComplex<R> all = in_random_order(random, complex);
    for (GeneratorId x = 0; x < all.size(); ++x) {
      append(all.degrees[x], all.boundary.column(x));
      if (random.one_in(4)) {
        change_any_basis(all.degrees[x]);
      }
    }
  }
  void append(int degree, const ChainOfB<R>& boundary) {
    b.append(degree, boundary);
    const Symbol x = rules.append_generator(degree);
    const ChainOfS<R> image = f(boundary);
    std::vector<Symbol> units;
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
    const std::vector<Symbol> small = rules.small(degree);
    if (small.size() > 1) {
      const auto q = ring.from(std::int64_t{random.in(1, 3)});
      const Symbol x = small.front(), y = small.back();
      rules.change_basis(x, q, y, sum_of(ring, small_boundary(x), ring.negate(q), small_boundary(y)));
    }
  }
  [[nodiscard]] std::vector<Symbol> small() const {
    std::vector<Symbol> all;
    for (int p = 0; p < 5; ++p) {
      const std::vector<Symbol> of_degree = rules.small(p);
      all.insert(all.end(), of_degree.begin(), of_degree.end());
    }
    return all;
  }
  std::string broken_law() {
    return tests::broken_law(
        b, small(), [this](const ChainOfB<R>& v) { return f(v); }, [this](const ChainOfS<R>& v) { return g(v); },
        [this](const ChainOfB<R>& v) { return h(v); }, [this](Symbol x) { return small_boundary(x); });
  }
};

}  // namespace

TEMPLATE_TEST_CASE("Lifts: with rewriting rule by rule they are a reduction", "[engine][law]", Integers, Z2, Zp) {
  using R = TestType;
  RandomReduction<R> live{test_ring<R>(), GENERATE(range(0U, 15U))};
  live.grow_to(random_complex(live.ring, live.random).complex);
  CHECK(live.broken_law().empty());
}

TEMPLATE_TEST_CASE("Lifts: the lift of a chain with a trace is g of the one plus the lifts of the other's symbols b",
                   "[engine][law]", Integers, Zp) {
  using R = TestType;
  RandomReduction<R> live{test_ring<R>(), GENERATE(range(0U, 8U))};
  live.grow_to(random_complex(live.ring, live.random).complex);
  for (GeneratorId x = 0; x < live.b.size(); ++x) {
    const ChainOfB<R> unit{{x, live.ring.one()}};
    const ChainOfB<R> both = live.lifts.lift(live.f(unit), live.lifts.trace(unit));
    CHECK(both == sum_of(live.ring, live.g(live.f(unit)), live.ring.one(), live.h(unit)));
  }
}

TEST_CASE("Lifts: a triangle's edges are traced by the rules that eliminated its vertices", "[engine]") {
  // Vertices 0, 1, 2; edges 3 = 01, 4 = 12, 5 = 02 with d 01 = 1 - 0: 1 -> 0 by the first, 2 -> 1 by the second.
  const Integers ring;
  GrowingComplex<Integers> b{ring};
  Rules<Integers> rules{ring};
  Perturbations<Integers> perturbations{ring, rules};
  Effort effort;
  Lifts<Integers> lifts{ring, b.boundary, rules, perturbations, effort};
  for (int k = 0; k < 3; ++k) {
    b.append(0, {});
    rules.append_generator(0);
  }
  for (const ChainOfB<Integers>& boundary :
       {ChainOfB<Integers>{{0, -1}, {1, 1}}, {{1, -1}, {2, 1}}, {{0, -1}, {2, 1}}}) {
    b.append(1, boundary);
    rules.append_generator(1);
  }
  rules.eliminate(1, 3, {{0, -1}, {1, 1}});
  rules.eliminate(2, 4, {{0, -1}, {2, 1}});
  // Vertex 2 was rewritten by the second rule only: its value is 0, as the boundary of 4 had been rewritten then.
  CHECK(lifts.trace(ChainOfB<Integers>{{2, 1}}) == engine::Trace<Integers>{{RuleId{1U}, 1}});
  CHECK(lifts.lift({}, {{RuleId{1U}, 1}}) ==
        ChainOfB<Integers>{{3, 1}, {4, 1}});  // V(12) = 12 + 01: its boundary is 2 - 0
  CHECK(lifts.lift(ChainOfS<Integers>{{5, 1}}) == ChainOfB<Integers>{{3, -1}, {4, -1}, {5, 1}});  // the loop
}

TEMPLATE_TEST_CASE("Lifts: the gain of a symbol is delta of its lift, as it was when nothing was perturbed",
                   "[engine][law]", Integers, Z2, Zp) {
  using R = TestType;
  RandomReduction<R> live{test_ring<R>(), GENERATE(range(20U, 35U))};
  const R ring = live.ring;
  live.grow_to(random_complex(ring, live.random).complex);
  const GeneratorId old = live.b.size();
  const std::vector<Symbol> small = live.small();
  std::map<Symbol, ChainOfB<R>> lifts_before;
  for (const Symbol x : small) {
    lifts_before[x] = live.g({{x, ring.one()}});
  }
  // delta = phi d for a random phi on old generators, so d + delta is a boundary again.
  const RuleId time = live.rules.size();
  std::vector<ChainOfB<R>> phi(old);
  for (int k = 0; k < 4; ++k) {
    const int degree = live.random.in(0, 2);
    const GeneratorId e = live.b.append(degree, {});
    live.rules.append_generator(degree);
    for (GeneratorId x = 0; x < old; ++x) {
      if (live.b.degrees[x] == degree && live.random.one_in(2)) {
        phi[x].push_back({e, ring.from(std::int64_t{live.random.in(1, 2)})});
      }
    }
  }
  std::vector<ChainOfB<R>> delta(old);
  std::vector<GeneratorId> changed;
  for (GeneratorId x = 0; x < old; ++x) {
    live.b.boundary.for_each_in_column(x, [&](const sparse::Term<R, GeneratorId>& term) {
      sparse::add_multiple<R>(ring, delta[x], term.coefficient, phi[term.index]);
    });
    if (!delta[x].empty()) {
      changed.push_back(x);
    }
  }
  for (const GeneratorId x : changed) {
    live.b.boundary.add_to_column(x, ring.one(), delta[x]);
  }
  const Symbol first = live.rules.symbol_of(old);
  const auto concerned = live.perturbations.record(time, first, changed);
  for (const std::size_t k : concerned.combinations) {
    const auto& combination = live.rules.combinations()[k];
    live.perturbations.extend_column(k, live.lifts.gain(combination.made, combination.rule + 1, first));
  }
  for (const Symbol x : small) {
    ChainOfB<R> expected;
    for (const auto& [generator, coefficient] : lifts_before[x]) {
      sparse::add_multiple<R>(ring, expected, coefficient, delta[generator]);
    }
    CHECK(live.lifts.gain(x, live.rules.size(), first) == in_symbols(ring, live.rules, expected));
    CHECK((expected.empty() || concerned.small.contains(x)));
    CHECK(live.g({{x, ring.one()}}) == lifts_before[x]);  // no rule of the copies: lifts stay
  }
  // What a rule that is up to date says more, is what its own b gained.
  for (RuleId rule = 0; rule < time; ++rule) {
    live.lifts.take_in(rule);
    CHECK_FALSE(live.perturbations.is_behind(rule));
  }
}

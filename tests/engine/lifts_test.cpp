#include "engine/right/lifts.hpp"

#include "tests/support/catch.hpp"
#include "tests/support/random_reduction.hpp"

using namespace sesame;
using namespace sesame::tests;
using engine::Effort;
using engine::GeneratorId;
using engine::Lifts;
using engine::Perturbations;
using engine::RuleId;
using engine::Rules;
using engine::Symbol;

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
  engine::Dependents<Integers> dependents{b.boundary, rules, perturbations};
  Effort effort;
  Lifts<Integers> lifts{ring, b.boundary, rules, perturbations, dependents, effort};
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

TEMPLATE_TEST_CASE("Lifts: known traces change nothing", "[engine][twin]", Integers, Z2, Zp) {
  using R = TestType;
  RandomReduction<R> live{test_ring<R>(), GENERATE(range(0U, 10U))};
  live.grow_to(random_complex(live.ring, live.random).complex);
  engine::KnownTraces<R> known;
  for (const Symbol x : live.small()) {
    const ChainOfS<R> unit{{x, live.ring.one()}};
    CHECK(live.lifts.lift(unit, {}, &known) == live.lifts.lift(unit));
  }
  for (GeneratorId x = 0; x < live.b.size(); ++x) {
    const auto trace = live.lifts.trace(ChainOfB<R>{{x, live.ring.one()}});
    CHECK(live.lifts.lift({}, trace, &known) == live.lifts.lift({}, trace));
  }
}

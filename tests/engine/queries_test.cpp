// Classes, bounding chains, generators and the maps F, G, K: what "effective" means.
#include <numeric>

#include "tests/support/engines.hpp"
#include "tests/support/random_steps.hpp"

using namespace sesame;
using namespace sesame::tests;
using sparse::Rational;

namespace {

/// A state that a random stream leads to.
struct State {
  AnyRing ring;
  Engine engine;
  RandomSteps random;

  State(unsigned seed, const std::string& name)
      : ring{ring_named(name)}, engine{ring}, random{seed, {.most_cells = 60, .simploids = true, .cones = true}} {}

  void advance(int steps) {
    for (; steps > 0; --steps) {
      carry_out(engine, random.next(engine.structure()));
    }
  }
  std::vector<ops::CellId> cells(int degree) const {
    std::vector<ops::CellId> found;
    for (const ops::CellId c : current_cells(engine.structure())) {
      if (engine.structure().dimension(c) == degree) {
        found.push_back(c);
      }
    }
    return found;
  }
  CellChain random_chain(int degree) {
    CellChain chain{degree, {}};
    for (const ops::CellId c : cells(degree)) {
      if (random.random().one_in(2)) {
        chain = sum(chain, random.random().in(-4, 4), {degree, {{1, c}}}, ring);
      }
    }
    chain.degree = degree;
    return chain;
  }
  int top() const { return static_cast<int>(engine.cells().size()) - 1; }
};

/// The coefficients of a + factor b, modulo the orders of the generators.
std::vector<Rational> combine(const std::vector<Rational>& a, const Integer& factor, const std::vector<Rational>& b,
                              const std::vector<engine::Generator>& generators, std::uint32_t characteristic) {
  std::vector<Rational> total;
  for (std::size_t k = 0; k < generators.size(); ++k) {
    const Rational value = a[k] + factor * b[k];
    const Integer modulus = characteristic != 0 ? Integer{std::int64_t{characteristic}} : generators[k].order;
    total.push_back(modulus.is_zero() ? value : sparse::divide(value.numerator(), modulus).remainder);
  }
  return total;
}

std::uint32_t characteristic_of(const AnyRing& ring) {
  return std::visit([](const auto& r) { return r.characteristic(); }, ring);
}

const std::vector<std::string> rings{"Z", "Z/2", "Z/3", "Q"};

}  // namespace

TEST_CASE("the class of a boundary is zero, and the chain that it bounds has exactly this boundary",
          "[engine][stream]") {
  const unsigned seed = GENERATE(range(0U, 8U));
  const std::string ring = GENERATE(from_range(rings));
  CAPTURE(seed, ring);
  State state(seed, ring);
  for (int round = 0; round < 6; ++round) {
    state.advance(6);
    for (int p = 1; p <= state.top(); ++p) {
      const CellChain boundary = state.engine.maps().boundary(state.random_chain(p));
      const ClassAnswer answer = state.engine.classify(boundary);
      REQUIRE(answer.is_cycle);
      REQUIRE(answer.is_zero);
      REQUIRE(answer.bounds);
      REQUIRE(answer.bounds->degree == p);
      REQUIRE(state.engine.maps().boundary(*answer.bounds) == boundary);
      for (const Rational& a : answer.coefficients) {
        REQUIRE(a.is_zero());
      }
    }
  }
}

TEST_CASE("a chain with a boundary is no cycle, and has no class", "[engine][stream]") {
  const unsigned seed = GENERATE(range(20U, 26U));
  const std::string ring = GENERATE(from_range(rings));
  CAPTURE(seed, ring);
  State state(seed, ring);
  int met = 0;
  for (int round = 0; round < 6; ++round) {
    state.advance(6);
    for (int p = 0; p <= state.top(); ++p) {
      const CellChain chain = state.random_chain(p);
      const bool has_boundary = !state.engine.maps().boundary(chain).terms.empty();
      met += has_boundary ? 1 : 0;
      const ClassAnswer answer = state.engine.classify(chain);
      REQUIRE(answer.is_cycle == !has_boundary);
      if (has_boundary) {
        REQUIRE_FALSE(answer.is_zero);
        REQUIRE(answer.coefficients.empty());
        REQUIRE_FALSE(answer.bounds);
      }
    }
  }
  CHECK(met > 3);
}

TEST_CASE("coefficients are linear, modulo the orders", "[engine][stream]") {
  const unsigned seed = GENERATE(range(40U, 50U));
  const std::string ring = GENERATE(from_range(rings));
  CAPTURE(seed, ring);
  State state(seed, ring);
  Random& random = state.random.random();
  for (int round = 0; round < 5; ++round) {
    state.advance(6);
    for (int p = 0; p <= state.top(); ++p) {
      const auto generators = state.engine.generators(p);
      // Cycles of all kinds: combinations of generators, plus a boundary.
      const auto random_cycle = [&] {
        CellChain cycle{p, {}};
        for (const auto& generator : generators) {
          cycle = sum(cycle, random.in(-5, 5), generator.cycle, state.ring);
        }
        return p == state.top() ? cycle
                                : sum(cycle, 1, state.engine.maps().boundary(state.random_chain(p + 1)), state.ring);
      };
      CellChain a = random_cycle();
      CellChain b = random_cycle();
      a.degree = b.degree = p;
      const Integer factor{random.in(-7, 7)};
      CellChain c = sum(a, factor, b, state.ring);
      c.degree = p;
      const ClassAnswer of_a = state.engine.classify(a);
      const ClassAnswer of_b = state.engine.classify(b);
      const ClassAnswer of_c = state.engine.classify(c);
      REQUIRE(of_a.is_cycle);
      REQUIRE(of_a.coefficients.size() == generators.size());
      REQUIRE(of_c.coefficients ==
              combine(of_a.coefficients, factor, of_b.coefficients, generators, characteristic_of(state.ring)));
      // In normal form, and the class that they say it is: the rest bounds.
      CellChain rest = a;
      for (std::size_t k = 0; k < generators.size(); ++k) {
        REQUIRE((generators[k].order.is_zero() ||
                 (of_a.coefficients[k].sign() >= 0 && of_a.coefficients[k] < generators[k].order)));
        rest = sum(rest, -of_a.coefficients[k], generators[k].cycle, state.ring);
      }
      rest.degree = p;
      const ClassAnswer left = state.engine.classify(rest);
      REQUIRE(left.is_zero);
      REQUIRE(equal_to(state.engine.maps().boundary(*left.bounds), 1, rest, state.ring));
    }
  }
}

TEST_CASE("generators are cycles, independent, of the order stated, and as many as the group needs",
          "[engine][stream]") {
  const unsigned seed = GENERATE(range(60U, 72U));
  const std::string ring = GENERATE(from_range(rings));
  CAPTURE(seed, ring);
  State state(seed, ring);
  for (int round = 0; round < 5; ++round) {
    state.advance(6);
    const engine::Homology homology = state.engine.homology();
    for (int p = 0; p <= state.top(); ++p) {
      const auto at = static_cast<std::size_t>(p);
      const auto generators = state.engine.generators(p);
      std::vector<Integer> orders;
      for (std::size_t k = 0; k < generators.size(); ++k) {
        const engine::Generator& generator = generators[k];
        REQUIRE(generator.degree == p);
        REQUIRE_FALSE(generator.cycle.terms.empty());
        REQUIRE(state.engine.maps().boundary(generator.cycle).terms.empty());
        const ClassAnswer own = state.engine.classify(generator.cycle);
        for (std::size_t m = 0; m < generators.size(); ++m) {
          REQUIRE(own.coefficients[m] == Integer{m == k ? 1 : 0});
        }
        if (generator.order.is_zero()) {
          REQUIRE(generator.bounding.terms.empty());
          continue;
        }
        orders.push_back(generator.order);
        REQUIRE(
            equal_to(state.engine.maps().boundary(generator.bounding), generator.order, generator.cycle, state.ring));
        // No smaller multiple bounds: the order divided by any of its divisors leaves a class.
        for (const int divisor : {2, 3, 5, 7}) {
          const auto [quotient, remainder] = sparse::divide(generator.order, divisor);
          if (remainder.is_zero()) {
            CHECK_FALSE(state.engine.classify(sum({}, quotient, generator.cycle, state.ring)).is_zero);
          }
        }
      }
      REQUIRE(orders == homology.torsion[at]);
      REQUIRE(static_cast<std::int64_t>(generators.size() - orders.size()) == homology.betti[at]);
    }
  }
}

TEST_CASE("on every cell 1 - G F = d K + K d, and F and G are chain maps", "[engine][stream]") {
  const unsigned seed = GENERATE(range(80U, 86U));
  const std::string ring = GENERATE(from_range(rings));
  CAPTURE(seed, ring);
  State state(seed, ring);
  for (int round = 0; round < 4; ++round) {
    state.advance(7);
    engine::HomologyTracker& maps = state.engine.maps();
    for (const ops::CellId c : current_cells(state.engine.structure())) {
      const int p = state.engine.structure().dimension(c);
      const CellChain cell{p, {{1, c}}};
      const CellChain d = maps.boundary(cell);
      REQUIRE(maps.boundary(maps.apply_F(cell)) == maps.apply_F(d));
      CellChain right = sum(maps.boundary(maps.apply_K(cell)), 1, maps.apply_K(d), state.ring);
      right = sum(right, 1, maps.apply_G(maps.apply_F(cell)), state.ring);
      REQUIRE(equal_to(right, 1, cell, state.ring));
      REQUIRE(maps.boundary(d).terms.empty());
    }
    const engine::Homology homology = state.engine.homology();
    for (std::size_t p = 0; p < homology.small.size(); ++p) {
      for (engine::SmallId k = 0; k < homology.small[p]; ++k) {
        const engine::SmallChain generator{static_cast<int>(p), {{1, k}}};
        REQUIRE(maps.boundary(maps.apply_G(generator)) == maps.apply_G(maps.boundary(generator)));
        // F G differs from 1 by a homotopy only: it acts on homology as the identity.
        if (maps.boundary(generator).terms.empty()) {
          const CellChain cycle = maps.apply_G(generator);
          const CellChain again = maps.apply_G(maps.apply_F(cycle));
          CellChain difference = sum(cycle, -1, again, state.ring);
          difference.degree = static_cast<int>(p);
          REQUIRE(state.engine.classify(difference).is_zero);
        }
      }
    }
  }
}

TEST_CASE("a chain may name a cell twice, by any of its names, with coefficients that vanish", "[engine]") {
  Engine engine;
  build(engine, {R"({"op":"simplex","name":"t","dim":1})", R"({"op":"identify","pairs":[["t.0","t.1"]]})"});
  const auto ask = [&](const std::string& chain) {
    return carry_out(engine, R"({"op":"class","chain":)" + chain + "}").answer.value();
  };
  CHECK(ask(R"([[1,"t"]])").coefficients == std::vector<Rational>{1});
  CHECK(ask(R"([[1,"t"],[2,"t"]])").coefficients == std::vector<Rational>{3});
  CHECK(ask(R"([[5,"t"],[-5,"t"]])").is_zero);
  CHECK(ask(R"([[0,"t"]])").is_zero);
  CHECK(ask(R"([[1,"t.0"],[-1,"t.1"]])").is_zero);
  CHECK(ask("[]").is_zero);
  CHECK(ask(R"([["1000000000000000000000000000000","t"]])").coefficients[0].to_string() ==
        "1000000000000000000000000000000");
}

TEST_CASE("the class of a chain in Z/p is that of its residues", "[engine]") {
  Engine engine(ring_named("Z/3"));
  build(engine, {R"({"op":"simplex","name":"t","dim":1})"});
  const auto ask = [&](const std::string& chain) {
    return carry_out(engine, R"({"op":"class","chain":)" + chain + "}").answer.value();
  };
  CHECK_FALSE(ask(R"([[1,"t"]])").is_cycle);
  CHECK(ask(R"([[3,"t"]])").is_cycle);
  CHECK(ask(R"([[-4,"t.0"]])").coefficients == std::vector<Rational>{2});
  CHECK(ask(R"([["-1000000000000000000000000000000","t.0"]])").coefficients == std::vector<Rational>{2});
}

TEST_CASE("a question about an empty workspace has an answer", "[engine]") {
  Engine engine;
  CHECK(live_groups(engine).empty());
  CHECK(engine.homology().betti.empty());
  CHECK(engine.euler_characteristic() == 0);
  CHECK(engine.generators(0).empty());
  CHECK(engine.generators(-1).empty());
  CHECK(engine.generators(17).empty());
  CHECK(engine.classify({}).is_zero);
  CHECK(engine.classify({3, {}}).is_zero);
  CHECK(engine.first_defect().value_or("") == "");
  CHECK(engine.live<Integers>() != nullptr);
  CHECK(engine.live<Z2>() == nullptr);
}

TEST_CASE("generators come one by one as in the list, and leave no cells of products behind", "[engine]") {
  const std::string kind = GENERATE("simploidal", "simplicial");
  const std::string ring = GENERATE("Z", "Z/3");
  CAPTURE(kind, ring);
  Engine engine(ring_named(ring));
  build(engine, {R"({"op":"complex","name":"B","cells":[{"id":"v"},{"id":"w"},{"id":"a","faces":["w","v"]},)"
                 R"({"id":"b","faces":["w","v"]},{"id":"c","faces":["v","v"]},{"id":"t","faces":["c","c","c"]}]})",
                 R"({"op":"product","name":"P","left":"B","right":"B","kind":")" + kind + R"("})",
                 R"({"op":"product","name":"Q","left":"P","right":"P","kind":")" + kind + R"("})"});
  for (int p = 0; p < static_cast<int>(engine.cells().size()); ++p) {
    const ops::CellId before = engine.structure().cells().asked();
    std::vector<engine::Generator> visited;
    std::vector<std::size_t> lengths;
    engine.visit_generators(p, engine::uncountable, [&](engine::Generator generator) {
      CHECK(engine.maps().boundary(generator.cycle).terms.empty());
      lengths.push_back(generator.cycle.terms.size());
      visited.push_back(std::move(generator));
      return true;
    });
    CHECK(engine.structure().cells().asked() == before);
    std::vector<std::uint64_t> bounds;
    engine.visit_generators(p, 0, [&](engine::Generator generator) {
      CHECK(generator.cycle.terms.empty());
      bounds.push_back(generator.terms_of_cycle);
      return true;
    });
    CHECK(engine.structure().cells().asked() == before);
    const auto listed = engine.generators(p);
    REQUIRE(listed.size() == visited.size());
    REQUIRE(bounds.size() == visited.size());
    for (std::size_t k = 0; k < listed.size(); ++k) {
      CHECK(listed[k].order == visited[k].order);
      CHECK(listed[k].cycle.terms.size() == lengths[k]);
      CHECK(lengths[k] <= bounds[k]);
      CHECK(bounds[k] <= 64 * lengths[k]);
    }
    std::size_t first = 0;
    engine.visit_generators(p, engine::uncountable, [&](const engine::Generator&) { return ++first < 2; });
    CHECK(first == std::min<std::size_t>(2, listed.size()));
  }
}

TEST_CASE("no generator of glued products and lazy cones has more terms than are foretold", "[engine]") {
  Engine engine(ring_named("Z"), {.cells_of_explicit_cone = 0});
  build(engine, {R"({"op":"complex","name":"B","cells":[{"id":"v"},{"id":"w"},{"id":"a","faces":["w","v"]},)"
                 R"({"id":"b","faces":["w","v"]}]})",
                 R"({"op":"product","name":"P","left":"B","right":"B"})",
                 R"x({"op":"identify","pairs":[["P.(B.a|B.v)","P.(B.b|B.v)"]]})x",
                 R"({"op":"complex","name":"D","cells":[{"id":"v"},{"id":"a","faces":["v","v"]}]})",
                 R"({"op":"cone","apex":"o","over":"D"})", R"x({"op":"identify","pairs":[["D.a","P.(B.a|B.w)"]]})x"});
  std::size_t generators = 0;
  for (int p = 0; p < static_cast<int>(engine.cells().size()); ++p) {
    std::vector<std::uint64_t> bounds;
    engine.visit_generators(p, 0, [&](engine::Generator generator) {
      bounds.push_back(generator.terms_of_cycle);
      return true;
    });
    const auto listed = engine.generators(p);
    REQUIRE(listed.size() == bounds.size());
    for (std::size_t k = 0; k < listed.size(); ++k) {
      CHECK(listed[k].cycle.terms.size() <= bounds[k]);
      ++generators;
    }
  }
  CHECK(generators == 3);  // one of each dimension: a sphere and a circle
}

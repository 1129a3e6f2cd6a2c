// Random streams of steps: after each, the live equivalence against everything that can be computed from scratch.
#include "sparse/smith.hpp"
#include "tests/support/engines.hpp"
#include "tests/support/loops.hpp"
#include "tests/support/random_steps.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

/// How often torsion was met, so that a stream without any would be noticed.
struct Tally {
  int steps = 0;
  int with_torsion = 0;
  std::size_t cells = 0;
};

void run_stream(unsigned seed, const std::string& ring, int steps, const StreamShape& shape, Tally& tally) {
  Engine engine(ring_named(ring), {}, taking_splits_in);
  RandomSteps random(seed, shape);
  for (int k = 0; k < steps; ++k) {
    const ops::Operation op = random.next(engine.structure());
    CAPTURE(seed, ring, k, ops::to_text(op));
    carry_out(engine, op);
    const auto defect = engine.first_defect();
    REQUIRE(defect.value_or("") == "");
    const auto groups = live_groups(engine);
    REQUIRE(groups ==
            std::visit([&](const auto& r) { return groups_from_scratch(engine.structure(), r); }, ring_named(ring)));
    ++tally.steps;
    tally.cells += current_cells(engine.structure()).size();
    tally.with_torsion += std::any_of(groups.begin(), groups.end(), [](const auto& g) { return !g.torsion.empty(); });
  }
}

}  // namespace

TEST_CASE("over Z every law holds after every step of random streams", "[engine][stream]") {
  Tally tally;
  for (unsigned seed = 0; seed < 60; ++seed) {
    run_stream(seed, "Z", 30, {.most_cells = 80, .simploids = true, .cones = true}, tally);
  }
  CHECK(tally.steps == 1800);
  CHECK(tally.with_torsion > 600);
  CHECK(tally.cells > 1800 * 40);
}

TEST_CASE("over Z/2 and Z/3 every law holds after every step of random streams", "[engine][stream]") {
  const std::string ring = GENERATE("Z/2", "Z/3");
  Tally tally;
  for (unsigned seed = 100; seed < 120; ++seed) {
    run_stream(seed, ring, 30, {.most_cells = 80, .simploids = true, .cones = true}, tally);
  }
  CHECK(tally.steps == 600);
}

TEST_CASE("universal coefficients hold between Z and Z/p, all along random streams", "[engine][stream]") {
  const unsigned seed = GENERATE(range(200U, 240U));
  CAPTURE(seed);
  Engine integral(ring_named("Z"));
  std::vector<std::pair<std::uint32_t, std::unique_ptr<Engine>>> modular;
  for (const std::uint32_t p : {2U, 3U, 5U, 2147483647U}) {
    modular.emplace_back(p, std::make_unique<Engine>(ring_named("Z/" + std::to_string(p))));
  }
  RandomSteps random(seed, {.most_cells = 90, .simploids = true, .cones = true});
  for (int k = 0; k < 60; ++k) {
    const ops::Operation op = random.next(integral.structure());
    CAPTURE(k, ops::to_text(op));
    carry_out(integral, op);
    const auto groups = live_groups(integral);
    REQUIRE(groups == groups_from_scratch(integral.structure(), Integers{}));
    for (auto& [p, engine] : modular) {
      CAPTURE(p);
      carry_out(*engine, op);
      std::vector<Index> betti;
      for (const AbelianGroup& group : live_groups(*engine)) {
        betti.push_back(group.rank);
        REQUIRE(group.torsion.empty());
      }
      std::vector<Index> expected = reductions::betti_numbers_modulo(groups, p);
      while (!expected.empty() && expected.back() == 0) {
        expected.pop_back();
      }
      REQUIRE(betti == expected);
    }
    std::int64_t euler = 0;
    for (std::size_t q = 0; q < groups.size(); ++q) {
      euler += (q % 2 == 0 ? 1 : -1) * std::int64_t{groups[q].rank};
    }
    REQUIRE(integral.euler_characteristic() == euler);
  }
}

TEST_CASE("the small complex of a field is its homology, and the big one grows by what is added and removed",
          "[engine][stream]") {
  const unsigned seed = GENERATE(range(60U, 64U));
  CAPTURE(seed);
  Engine engine(ring_named("Z/2"), {}, taking_splits_in);
  RandomSteps random(seed);
  for (int k = 0; k < 50; ++k) {
    carry_out(engine, random.next(engine.structure()));
    const engine::Homology homology = engine.homology();
    std::uint64_t big = 0;
    for (const std::uint32_t n : homology.big) {
      big += n;
    }
    REQUIRE(big == engine.structure().cells().size() + engine.structure().forest().links());
    for (std::size_t p = 0; p < homology.betti.size(); ++p) {
      REQUIRE(homology.betti[p] == homology.small[p]);
    }
  }
}

TEST_CASE("the small complex has no generator above the dimension of the object", "[engine][stream]") {
  const unsigned seed = GENERATE(range(300U, 340U));
  CAPTURE(seed);
  Engine engine({}, {}, taking_splits_in);
  RandomSteps random(seed, {.most_cells = 80, .simploids = true, .cones = true});
  for (int k = 0; k < 40; ++k) {
    carry_out(engine, random.next(engine.structure()));
    REQUIRE(engine.homology().small.size() == engine.cells().size());
  }
}

TEST_CASE("random relations give the group that their Smith form says, whatever their entries", "[engine][stream]") {
  const unsigned seed = GENERATE(range(0U, 20U));
  CAPTURE(seed);
  Random random(seed);
  const int loops = random.in(1, 6);
  const int most = random.one_in(2) ? 30 : 6;
  Loops complex("K");
  std::vector<std::vector<Entry>> columns;
  for (int k = 1; k <= loops; ++k) {
    complex.add_loop("a" + std::to_string(k));
  }
  for (int relations = random.in(0, 7); relations > 0; --relations) {
    std::vector<int> factors;
    columns.emplace_back();
    for (int k = 0; k < loops; ++k) {
      factors.push_back(random.one_in(3) ? 0 : random.in(-most, most));
      columns.back().emplace_back(static_cast<Index>(k), factors.back());
    }
    complex.relate(factors);
  }
  std::vector<Integer> orders = sparse::invariant_factors(matrix_of(Integers{}, static_cast<Index>(loops), columns));
  const std::size_t rank = orders.size();
  orders.resize(static_cast<std::size_t>(loops));  // the rest is free: order 0
  Engine engine({}, {}, taking_splits_in);
  carry_out(engine, complex.take());
  CHECK(live_groups(engine)[0] == group(1));
  const engine::Homology homology = engine.homology();
  const AbelianGroup expected = reductions::group_of(orders);
  CHECK(homology.betti[1] == std::int64_t{expected.rank});
  CHECK(homology.torsion[1] == expected.torsion);
  CHECK(homology.betti[2] == static_cast<std::int64_t>(columns.size() - rank));
  CHECK(engine.first_defect().value_or("") == "");
}

#include "ops/step_sequence.hpp"

#include "tests/support/figures.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/random_steps.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;
using sparse::Rest;

namespace {

/// The columns that a graded map stores, over all degrees.
template <Ring R>
std::size_t stored_columns(const GradedMap<R>& map) {
  std::size_t count = 0;
  for (int p = 0; p < static_cast<int>(map.source().size()); ++p) {
    count += map.at(p).stored_columns();
  }
  return count;
}

/// The generators of each degree, in some order.
using Orders = std::vector<std::vector<CellId>>;

Orders cells_named(const Workshop& shop, const std::vector<std::vector<std::string>>& names) {
  Orders orders;
  for (const auto& degree : names) {
    orders.emplace_back();
    for (const std::string& name : degree) {
      orders.back().push_back(*shop.structure().lookup("C." + name));
    }
  }
  return orders;
}

/// The map as entries between cells: what does not depend on the order of the bases.
template <Ring R>
std::map<std::pair<CellId, CellId>, Integer> entries(const GradedMap<R>& map, const Orders& source,
                                                     const Orders& target) {
  std::map<std::pair<CellId, CellId>, Integer> all;
  for (std::size_t p = 0; p < map.source().size(); ++p) {
    for (Index column = 0; column < map.source()[p]; ++column) {
      for (const auto& term : map.at(static_cast<int>(p)).column(column)) {
        all[{source[p][column], target[p][term.index]}] = map.ring().to_integer(term.coefficient);
      }
    }
  }
  return all;
}

}  // namespace

TEMPLATE_TEST_CASE("every step of a random stream is an exact sequence", "[ops][stream]", Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  const unsigned seed = GENERATE(range(0U, 6U));
  CAPTURE(seed);
  Workshop shop;
  RandomSteps steps(seed);
  std::vector<Moment> moments{now(shop.structure())};
  for (int k = 0; k < 30; ++k) {
    REQUIRE(shop.apply(steps.next(shop.structure())));
    moments.push_back(now(shop.structure()));
  }
  // All of them at the end: a sequence can be had long after its step.
  for (std::size_t k = 1; k < moments.size(); ++k) {
    CAPTURE(k);
    if (moments[k] == moments[k - 1]) {
      continue;
    }
    const auto found = step_sequence(shop.structure(), moments[k - 1], moments[k], ring);
    REQUIRE(found);
    const auto& step = *found;
    REQUIRE(defect_of(step.sequence) == "");
    const bool adds = moments[k].created > moments[k - 1].created;
    CHECK((step.direction == Direction::backward) == adds);
    const auto before =
        chain_complex(shop.structure(), cells_at(shop.structure(), moments[k - 1]), moments[k - 1], ring);
    const auto after = chain_complex(shop.structure(), cells_at(shop.structure(), moments[k]), moments[k], ring);
    if (adds) {
      REQUIRE(step.sequence.c0 == before);
      REQUIRE(step.sequence.c1 == after);
    } else {
      REQUIRE(step.sequence.c1.sizes() == before.sizes());
      REQUIRE(step.sequence.c2 == after);
    }
  }
}

TEST_CASE("the maps of a step store only what the step touched", "[ops][stream]") {
  const unsigned seed = GENERATE(range(10U, 16U));
  CAPTURE(seed);
  Workshop shop;
  RandomSteps steps(seed);
  for (int k = 0; k < 40; ++k) {
    const Moment before = now(shop.structure());
    REQUIRE(shop.apply(steps.next(shop.structure())));
    const Moment after = now(shop.structure());
    if (before == after) {
      continue;
    }
    const auto step = step_sequence(shop.structure(), before, after, Integers{});
    const auto& [direction, sequence, basis0, basis1, basis2] = *step;
    const std::size_t touched =
        direction == Direction::forward ? after.links - before.links : after.created - before.created;
    CHECK(stored_columns(sequence.j) == touched);
    if (direction == Direction::forward) {
      CHECK(stored_columns(sequence.i) == touched);
      CHECK(stored_columns(sequence.r) == touched);
      CHECK(stored_columns(sequence.s) == 0);
      for (std::size_t p = 0; p < basis0.cells().size(); ++p) {
        for (const CellId removed : basis0.cells()[p]) {
          CHECK(sequence.j.at(static_cast<int>(p)).is_stored(basis1.index(removed)));
          CHECK(sequence.r.at(static_cast<int>(p)).is_stored(basis1.index(removed)));
        }
      }
    } else {
      CHECK(stored_columns(sequence.i) == 0);
      CHECK(stored_columns(sequence.r) == 0);
      CHECK(stored_columns(sequence.s) == touched);
    }
  }
}

TEMPLATE_TEST_CASE("S. Peltier, habilitation (2023), figure 3.10: the identification has the printed maps", "[ops]",
                   Integers, Z2, Zp) {
  Workshop shop;
  shop.build(
      {R"({"op":"complex","name":"C","cells":[{"id":"v0"},{"id":"v1"},{"id":"v2"},{"id":"v3"},{"id":"v4"},{"id":"v5"},)"
       R"({"id":"e0","faces":["v1","v0"]},{"id":"e1","faces":["v2","v1"]},{"id":"e2","faces":["v2","v0"]},)"
       R"({"id":"e3","faces":["v5","v3"]},{"id":"e4","faces":["v4","v3"]},{"id":"e5","faces":["v5","v4"]},)"
       R"({"id":"f0","faces":["e1","e2","e0"]},{"id":"f1","faces":["e5","e3","e4"]}]})"});
  const Moment before = now(shop.structure());
  shop.build({R"({"op":"identify","pairs":[["C.e1","C.e4"]]})"});
  const auto ring = test_ring<TestType>();
  const auto step = *step_sequence(shop.structure(), before, now(shop.structure()), ring);
  const auto printed = figure_3_10(ring);
  const Orders c0 = cells_named(shop, {{"v3", "v4"}, {"e4"}});
  const Orders c1 =
      cells_named(shop, {{"v0", "v1", "v2", "v3", "v4", "v5"}, {"e0", "e1", "e2", "e3", "e4", "e5"}, {"f0", "f1"}});
  const Orders c2 = cells_named(shop, {{"v0", "v1", "v2", "v5"}, {"e0", "e1", "e2", "e3", "e5"}, {"f0", "f1"}});
  const Orders& s0 = step.basis0.cells();
  const Orders& s1 = step.basis1.cells();
  const Orders& s2 = step.basis2.cells();
  CHECK(entries(step.sequence.i, s0, s1) == entries(printed.i, c0, c1));
  CHECK(entries(step.sequence.j, s1, s2) == entries(printed.j, c1, c2));
  CHECK(entries(step.sequence.r, s1, s0) == entries(printed.r, c1, c0));
  CHECK(entries(step.sequence.s, s2, s1) == entries(printed.s, c2, c1));
}

TEST_CASE("C0 of an identification carries the boundary of differences, C2 of new cells that of the quotient",
          "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"a","dim":1})"});
  const Moment start = now(shop.structure());
  shop.build({R"({"op":"simplex","name":"b","dim":1})"});
  const Moment two = now(shop.structure());
  shop.build({R"({"op":"cone","apex":"v","over":["a.0"]})"});
  const Moment coned = now(shop.structure());
  shop.build({R"({"op":"identify","pairs":[["a","b"]]})"});
  const Integers ring;
  const auto added = *step_sequence(shop.structure(), start, two, ring);
  CHECK(added.sequence.c2.sizes() == Sizes{2, 1});
  CHECK(added.sequence.c2.boundary(1).column(0).size() == 2);
  CHECK(added.sequence.chi().is_zero());
  // Of the edge from a.0 to v only v is new: modulo the old cells its boundary is v.
  const auto cone = *step_sequence(shop.structure(), two, coned, ring);
  CHECK(cone.sequence.c2.sizes() == Sizes{1, 1});
  CHECK(cone.sequence.c2.boundary(1).column(0) == Terms<Integers>{{0, 1}});
  CHECK_FALSE(cone.sequence.chi().is_zero());
  const auto glued = *step_sequence(shop.structure(), coned, now(shop.structure()), ring);
  CHECK(glued.sequence.c0.sizes() == Sizes{2, 1});
  // d0 = r d1 i: for b - a it is the difference of the ends, with the signs of the edge.
  CHECK(glued.sequence.c0.boundary(1).column(0).size() == 2);
}

TEST_CASE("a step that both adds and removes is a contract breach", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"a","dim":0})", R"({"op":"simplex","name":"b","dim":0})",
              R"({"op":"identify","pairs":[["a","b"]]})"});
  CHECK_THROWS_AS(step_sequence(shop.structure(), Moment{}, now(shop.structure()), Integers{}),
                  sparse::ContractViolation);
}

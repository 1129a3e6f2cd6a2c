#include "ops/plan/step_sequence.hpp"

#include <map>

#include "tests/support/figures.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/random_steps.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;
using sparse::Rest;

namespace {

/// The ring of a test over Z, Z/2 and Z/3.
template <Ring R>
R ring_of_three() {
  if constexpr (std::same_as<R, Zp>) {
    return Zp::make(3).value();
  } else {
    return R{};
  }
}

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
    const auto found = tests::sequence_between(shop.structure(), moments[k - 1], moments[k], ring);
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

TEMPLATE_TEST_CASE("every step of a random stream of all operations is an exact sequence", "[ops][stream]", Integers,
                   Z2, Zp) {
  const auto ring = ring_of_three<TestType>();
  const unsigned seed = GENERATE(range(0U, 16U));
  CAPTURE(seed);
  Workshop shop(seed % 2 == 0 ? Limits{.cells_of_explicit_cone = 0} : Limits{});
  RandomSteps steps(seed, everything_and_maps(30));
  struct Step {
    Operation operation;
    StepKind kind;
    Moment before, after;  // what is asked for between two steps belongs to neither
  };
  std::vector<Step> done;
  for (int k = 0; k < 25; ++k) {
    const Operation op = steps.next(shop.structure());
    const Moment before = now(shop.structure());
    REQUIRE(shop.apply(op));
    REQUIRE(shop.last_plan().kind() == tests::kind_between(shop.structure(), before, now(shop.structure())));
    done.push_back({op, shop.last_plan().kind(), before, now(shop.structure())});
  }
  for (std::size_t k = 0; k < done.size(); ++k) {
    const Operation& op = done[k].operation;
    CAPTURE(k, to_text(op));
    const Structure& s = shop.structure();
    const auto before = chain_complex(s, cells_at(s, done[k].before), done[k].before, ring);
    const auto after = chain_complex(s, cells_at(s, done[k].after), done[k].after, ring);
    REQUIRE(defect_of(after) == "");
    const bool is_product = std::holds_alternative<MakeProduct>(op);
    if (done[k].kind == StepKind::replacement) {
      const auto steps_of_two = step_sequences(s, done[k].kind, done[k].before, done[k].after, ring);
      REQUIRE(steps_of_two.size() == 2);
      for (const auto& each : steps_of_two) {
        REQUIRE(defect_of(each.sequence) == "");
      }
      CHECK(steps_of_two[0].direction == Direction::backward);
      CHECK(steps_of_two[1].direction == Direction::kernel);
      REQUIRE(steps_of_two[0].sequence.c0 == before);
      REQUIRE(steps_of_two[0].sequence.c1.sizes() == steps_of_two[1].sequence.c1.sizes());
      REQUIRE(steps_of_two[1].sequence.c0 == after);
      continue;
    }
    const auto found = tests::only(step_sequences(s, done[k].kind, done[k].before, done[k].after, ring));
    if (!found) {
      REQUIRE((is_product || before == after));
      continue;
    }
    REQUIRE_FALSE(is_product);
    const auto& step = *found;
    REQUIRE(defect_of(step.sequence) == "");
    const bool equates = std::holds_alternative<Identify>(op) || std::holds_alternative<Degenerate>(op) ||
                         std::holds_alternative<Sew>(op);
    CHECK((step.direction == Direction::forward) == equates);
    if (equates) {
      REQUIRE(step.sequence.c1.sizes() == before.sizes());
      REQUIRE(step.sequence.c2 == after);
    } else if (std::holds_alternative<Remove>(op)) {
      REQUIRE(step.direction == Direction::kernel);
      REQUIRE(step.sequence.c0 == after);
      REQUIRE(step.sequence.c1.sizes() == before.sizes());
    } else if (std::holds_alternative<Deidentify>(op) || std::holds_alternative<Unsew>(op)) {
      REQUIRE(step.sequence.c2 == before);
      REQUIRE(step.sequence.c1.sizes() == after.sizes());
    } else {
      REQUIRE(step.sequence.c0 == before);
      REQUIRE(step.sequence.c1.sizes() == after.sizes());
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
    const auto step = tests::sequence_between(shop.structure(), before, after, Integers{});
    const auto& [direction, sequence, basis0, basis1, basis2] = *step;
    const std::size_t touched =
        direction == Direction::forward ? after.links - before.links : after.created - before.created;
    CHECK(stored_columns(sequence.j) == touched);
    if (direction == Direction::forward) {
      CHECK(stored_columns(sequence.i) == touched);
      CHECK(stored_columns(sequence.r) == touched);
      CHECK(stored_columns(sequence.s) == 0);
      for (std::size_t p = 0; p < basis0.generators().size(); ++p) {
        for (const CellId removed : basis0.generators()[p]) {
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
  const auto step = *tests::sequence_between(shop.structure(), before, now(shop.structure()), ring);
  const auto printed = figure_3_10(ring);
  const Orders c0 = cells_named(shop, {{"v3", "v4"}, {"e4"}});
  const Orders c1 =
      cells_named(shop, {{"v0", "v1", "v2", "v3", "v4", "v5"}, {"e0", "e1", "e2", "e3", "e4", "e5"}, {"f0", "f1"}});
  const Orders c2 = cells_named(shop, {{"v0", "v1", "v2", "v5"}, {"e0", "e1", "e2", "e3", "e5"}, {"f0", "f1"}});
  const Orders& s0 = step.basis0.generators();
  const Orders& s1 = step.basis1.generators();
  const Orders& s2 = step.basis2.generators();
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
  const auto added = *tests::sequence_between(shop.structure(), start, two, ring);
  CHECK(added.sequence.c2.sizes() == Sizes{2, 1});
  CHECK(added.sequence.c2.boundary(1).column(0).size() == 2);
  CHECK(added.sequence.chi().is_zero());
  // Of the edge from a.0 to v only v is new: modulo the old cells its boundary is v.
  const auto cone = *tests::sequence_between(shop.structure(), two, coned, ring);
  CHECK(cone.sequence.c2.sizes() == Sizes{1, 1});
  CHECK(cone.sequence.c2.boundary(1).column(0) == Terms<Integers>{{0, 1}});
  CHECK_FALSE(cone.sequence.chi().is_zero());
  const auto glued = *tests::sequence_between(shop.structure(), coned, now(shop.structure()), ring);
  CHECK(glued.sequence.c0.sizes() == Sizes{2, 1});
  // d0 = r d1 i: for b - a it is the difference of the ends, with the signs of the edge.
  CHECK(glued.sequence.c0.boundary(1).column(0).size() == 2);
}

TEST_CASE("the maps of a split, and of squashing, store only what the step touched", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"s","dim":2})", R"({"op":"simplex","name":"t","dim":2})",
              R"({"op":"identify","pairs":[["s.1-2","t.0-1"]]})"});
  const Integers ring;
  const Moment start = now(shop.structure());
  shop.build({R"({"op":"deidentify","split":[{"cell":"s.1-2","as":"x","moves":[["t",2]]}]})"});
  const Moment split = now(shop.structure());
  shop.build({R"({"op":"degenerate","cell":"t.0-2","along":0})"});
  const Moment squashed = now(shop.structure());
  const auto copied = *tests::sequence_between(shop.structure(), start, split, ring);
  CHECK(copied.direction == Direction::backward);
  CHECK(copied.sequence.c0.sizes() == Sizes{0, 1});
  CHECK(stored_columns(copied.sequence.i) == 1);
  CHECK(stored_columns(copied.sequence.j) == 1);
  CHECK(stored_columns(copied.sequence.r) == 1);
  CHECK(stored_columns(copied.sequence.s) == 0);
  const auto forward = *tests::sequence_between(shop.structure(), split, squashed, ring);
  CHECK(forward.direction == Direction::forward);
  CHECK(forward.sequence.c0.sizes() == Sizes{1, 1});
  CHECK(stored_columns(forward.sequence.i) == 2);
  CHECK(stored_columns(forward.sequence.j) == 2);
  CHECK(stored_columns(forward.sequence.r) == 2);
  CHECK(stored_columns(forward.sequence.s) == 0);
}

// The text has no more than the caption: an object, a simplex that is squashed with what this entails, and the result.
TEMPLATE_TEST_CASE(
    "S. Peltier, habilitation (2023), figure 3.18: squashing is the sequence of the cells that it removes", "[ops]",
    Integers, Z2, Zp) {
  // Two triangles side by side, as in figure 3.17: v1 becomes v0, the edge between them degenerate, and so both.
  Workshop shop;
  shop.build({R"({"op":"complex","name":"C","cells":[{"id":"v0"},{"id":"v1"},{"id":"v2"},{"id":"v3"},)"
              R"({"id":"e01","faces":["v1","v0"]},{"id":"e02","faces":["v2","v0"]},{"id":"e12","faces":["v2","v1"]},)"
              R"({"id":"e03","faces":["v3","v0"]},{"id":"e13","faces":["v3","v1"]},)"
              R"({"id":"t","faces":["e12","e02","e01"]},{"id":"u","faces":["e13","e03","e01"]}]})"});
  const auto ring = ring_of_three<TestType>();
  const Moment start = now(shop.structure());
  shop.build({R"({"op":"degenerate","cell":"C.e01","along":0})"});
  const Moment edge = now(shop.structure());
  shop.build({R"({"op":"degenerate","cell":"C.t","along":0})"});
  const Moment triangle = now(shop.structure());

  const auto first = *tests::sequence_between(shop.structure(), start, edge, ring);
  CHECK(first.direction == Direction::forward);
  const Orders c0 = cells_named(shop, {{"v1"}, {"e01"}});
  const Orders c1 = cells_named(shop, {{"v0", "v1", "v2", "v3"}, {"e01", "e02", "e12", "e03", "e13"}, {"t", "u"}});
  REQUIRE(first.basis0.generators() == c0);
  const auto id = [&](const std::string& name) { return *shop.structure().lookup("C." + name); };
  const Integer minus_one = ring.to_integer(ring.negate(ring.one()));
  using Entries = std::map<std::pair<CellId, CellId>, Integer>;
  // i is v0 - v1 and, as e01 becomes 0, - e01; r takes both back.
  CHECK(entries(first.sequence.i, c0, first.basis1.generators()) ==
        Entries{{{id("v1"), id("v0")}, 1}, {{id("v1"), id("v1")}, minus_one}, {{id("e01"), id("e01")}, minus_one}});
  CHECK(entries(first.sequence.r, first.basis1.generators(), c0) ==
        Entries{{{id("v1"), id("v1")}, minus_one}, {{id("e01"), id("e01")}, minus_one}});
  // d0 e01 = r d1 (-e01) = r (v0 - v1) = v1.
  CHECK(first.sequence.c0.boundary(1).column(0) == Terms<TestType>{{0, ring.one()}});
  // j: v1 goes to v0, e01 to 0, all else to itself.
  Entries kept{{{id("v1"), id("v0")}, 1}};
  Entries same;
  for (const auto& degree : c1) {
    for (const CellId c : degree) {
      if (c != id("v1") && c != id("e01")) {
        kept[{c, c}] = 1;
        same[{c, c}] = 1;
      }
    }
  }
  CHECK(entries(first.sequence.j, first.basis1.generators(), first.basis2.generators()) == kept);
  CHECK(entries(first.sequence.s, first.basis2.generators(), first.basis1.generators()) == same);
  CHECK(defect_of(first.sequence) == "");
  // The boundary of a triangle has lost the degenerate side.
  const auto& d2 = first.sequence.c2.boundary(2);
  for (Index column = 0; column < 2; ++column) {
    CHECK(d2.column(column).size() == 2);
  }

  // To squash a triangle onto its side is to glue its other two: one of them goes, and the triangle.
  const auto second = *tests::sequence_between(shop.structure(), edge, triangle, ring);
  CHECK(second.sequence.c0.sizes() == Sizes{0, 1, 1});
  CHECK(second.sequence.c1.sizes() == first.sequence.c2.sizes());
  CHECK(second.sequence.c2.sizes() == Sizes{3, 3, 1});
  CHECK(defect_of(second.sequence) == "");
  CHECK(stored_columns(second.sequence.i) == 2);
  // i(t) = -t and d0 t = r d1 (-t) is the difference of the glued sides: an isomorphism.
  const auto column = second.sequence.c0.boundary(2).column(0);
  REQUIRE(column.size() == 1);
  CHECK(ring.is_unit(column[0].coefficient));
}

TEST_CASE("a product is no sequence, and neither is a step that changes nothing", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"e","dim":1})", R"({"op":"simplex","name":"f","dim":1})"});
  const Moment before = now(shop.structure());
  shop.build({R"({"op":"identify","pairs":[["e","e"]]})"});
  CHECK_FALSE(tests::sequence_between(shop.structure(), before, now(shop.structure()), Integers{}));
  shop.build({R"({"op":"product","name":"P","left":"e","right":"f"})"});
  const Moment product = now(shop.structure());
  CHECK_FALSE(tests::sequence_between(shop.structure(), before, product, Integers{}));
  const auto basis = cells_at(shop.structure(), product);
  CHECK(basis.sizes() == Sizes{4, 4, 1});
  CHECK(defect_of(chain_complex(shop.structure(), basis, product, Integers{})) == "");
  CHECK(cells_at(shop.structure(), before).sizes() == Sizes{4, 2});
  shop.build({R"({"op":"product","name":"Q","left":"P","right":"P","kind":"simploidal"})"});
  CHECK(cells_at(shop.structure(), now(shop.structure())).sizes() == Sizes{16, 32, 24, 8, 1});
  CHECK(cells_at(shop.structure(), product).sizes() == Sizes{4, 4, 1});
}

TEST_CASE("questions asked after a step do not change its sequence", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"e","dim":1})", R"({"op":"simplex","name":"f","dim":1})",
              R"({"op":"product","name":"P","left":"e","right":"e"})"});
  const Moment before = now(shop.structure());
  SECTION("a split") {
    shop.build({R"({"op":"deidentify","split":[{"cell":"f.0","as":"x","moves":[]}]})"});
    shop.structure().lazy().make_all();
    const auto step = tests::sequence_between(shop.structure(), before, now(shop.structure()), Integers{});
    REQUIRE(step);
    CHECK(step->sequence.c0.sizes() == Sizes{1});
    CHECK(defect_of(step->sequence) == "");
  }
  SECTION("a step that changes nothing") {
    shop.structure().lazy().make_all();
    CHECK_FALSE(tests::sequence_between(shop.structure(), before, now(shop.structure()), Integers{}));
  }
}

TEST_CASE("a step that both adds and removes is a contract breach", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"a","dim":0})", R"({"op":"simplex","name":"b","dim":0})",
              R"({"op":"identify","pairs":[["a","b"]]})"});
  CHECK_THROWS_AS(tests::sequence_between(shop.structure(), Moment{}, now(shop.structure()), Integers{}),
                  sparse::ContractViolation);
}

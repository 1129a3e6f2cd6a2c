#include "ops/simplicial/tower_complex.hpp"

#include <numeric>

#include "ops/simplicial/column_complex.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_towers.hpp"

namespace sesame {
namespace {

using ops::Label;
using ops::TowerComplex;
using tests::PlainComplex;
using tests::TowerStep;

std::set<PlainComplex::Simplex> simplices_of(const TowerComplex& complex) {
  std::set<PlainComplex::Simplex> found;
  for (int d = 0; d < static_cast<int>(complex.counts().size()); ++d) {
    std::uint64_t count = 0;
    complex.for_each(d, [&](TowerComplex::Slot slot) {
      const std::vector<Label> labels = complex.labels(d, slot);
      found.emplace(labels.begin(), labels.end());
      ++count;
    });
    CHECK(count == complex.counts()[static_cast<std::size_t>(d)]);
  }
  return found;
}

/// An edge from a vertex to each of `count` others, labelled from `first` on.
void add_star(TowerComplex& complex, Label centre, Label first, Label count) {
  REQUIRE(complex.include({&centre, 1}).has_value());
  for (Label v = first; v < first + count; ++v) {
    REQUIRE(complex.include({&v, 1}).has_value());
    const Label edge[] = {centre, v};
    REQUIRE(complex.include(edge).has_value());
  }
}

TEST_CASE("a tower leaves the simplices that a plain model has", "[ops][tower]") {
  const std::uint32_t seed = GENERATE(range(0u, 30u));
  CAPTURE(seed);
  TowerComplex complex;
  PlainComplex plain;
  for (const TowerStep& step : tests::random_tower(seed, 150, 9, seed % 5)) {
    tests::apply(step, complex);
    plain.apply(step);
    REQUIRE(simplices_of(complex) == plain.simplices());
  }
}

TEST_CASE("the faces that a simplex lacks are found, and make it one that can be included", "[ops][tower]") {
  const std::uint32_t seed = GENERATE(range(0u, 20u));
  CAPTURE(seed);
  TowerComplex complex;
  PlainComplex plain;
  std::mt19937 random(seed);
  for (const TowerStep& step : tests::random_tower(seed, 60, 7, seed % 5)) {
    tests::apply(step, complex);
    plain.apply(step);
  }
  for (int round = 0; round < 20; ++round) {
    std::vector<Label> labels;
    for (Label v = 0; v < 12; ++v) {
      if (random() % 3 == 0) {
        labels.push_back(v);
      }
    }
    std::shuffle(labels.begin(), labels.end(), random);
    const PlainComplex::Simplex simplex(labels.begin(), labels.end());
    REQUIRE(complex.rules().contains(labels) == plain.has(simplex));
    if (labels.empty() || plain.has(simplex)) {
      continue;
    }
    const auto faces = complex.rules().missing_faces(labels);
    REQUIRE(faces);
    for (const std::vector<Label>& face : *faces) {
      REQUIRE(plain.can_include({face.begin(), face.end()}));
      REQUIRE(complex.include(face));
      plain.apply({false, face});
    }
    REQUIRE(plain.can_include(simplex));
    CHECK(complex.rules().missing_faces(labels).value().empty());
    REQUIRE(complex.include(labels));
    plain.apply({false, labels});
  }
  CHECK(simplices_of(complex) == plain.simplices());
}

TEST_CASE("a simplex that lacks too many faces, or has a vertex twice, is refused", "[ops][tower]") {
  TowerComplex complex;
  std::vector<Label> labels(60);
  std::iota(labels.begin(), labels.end(), Label{0});
  CHECK_FALSE(complex.rules().contains(labels));
  CHECK_THAT(complex.rules().missing_faces(labels).error().what, Catch::Contains("lacks more than 1048576 faces"));
  labels = {3, 1, 3};
  CHECK(complex.rules().missing_faces(labels).error().what == "vertex 3 is repeated in {3 1 3}");
  labels = {0, 1};
  CHECK(complex.include(labels).error().code == Errc::unknown_name);
}

TEST_CASE("facet k of a simplex lacks vertex k of the order that orients it", "[ops][tower]") {
  TowerComplex complex;
  for (const TowerStep& step : tests::random_tower(3, 200, 9, 2)) {
    tests::apply(step, complex);
  }
  for (int d = 1; d < static_cast<int>(complex.counts().size()); ++d) {
    complex.for_each(d, [&](TowerComplex::Slot slot) {
      const std::vector<Label> labels = complex.labels(d, slot);
      const std::size_t except = slot % (labels.size() + 1);
      std::size_t visited = 0;
      complex.for_each_facet(d, slot, except, [&](std::size_t k, TowerComplex::Slot facet) {
        std::vector<Label> without = labels;
        without.erase(without.begin() + static_cast<std::ptrdiff_t>(k));
        CHECK(complex.labels(d - 1, facet) == without);
        CHECK(k != except);
        ++visited;
      });
      CHECK(visited == labels.size() - (except < labels.size() ? 1 : 0));
    });
  }
}

TEST_CASE("a contraction works on the smaller of the two stars, whichever vertex goes", "[ops][tower]") {
  const bool small_goes = GENERATE(true, false);
  TowerComplex complex;
  add_star(complex, 0, 10, 10'000);
  add_star(complex, 1, 100'000, 3);
  const std::uint64_t before = complex.touched();
  REQUIRE(complex.plan_contraction(small_goes ? 1 : 0, small_goes ? 0 : 1).has_value());
  complex.contract();
  CHECK(complex.touched() - before <= 6);
  const Label merged = small_goes ? 0 : 1;
  CHECK(simplices_of(complex).contains({merged, 100'001}));
  CHECK(simplices_of(complex).contains({merged, 10}));
}

TEST_CASE("slots of simplices that are gone are used again", "[ops][tower]") {
  TowerComplex complex;
  add_star(complex, 0, 1, 5);
  for (Label v = 100; v < 10'000; ++v) {
    const Label edge[] = {0, v};
    REQUIRE(complex.include({&v, 1}).has_value());
    REQUIRE(complex.include(edge).has_value());
    REQUIRE(complex.plan_contraction(v, 0).has_value());
    complex.contract();
  }
  CHECK(complex.slots(0) == 7);
  CHECK(complex.slots(1) == 6);
}

TEST_CASE("what is wrong with an operation of a tower is said, and changes nothing", "[ops][tower]") {
  TowerComplex complex;
  add_star(complex, 0, 1, 2);
  const auto before = simplices_of(complex);
  const auto refusal = [&](std::vector<Label> labels) { return complex.include(labels).error().what; };
  CHECK(refusal({1}) == "vertex 1 is there already; a simplex is included once");
  CHECK(refusal({1, 0}) == "simplex {1 0} is there already; a simplex is included once");
  CHECK(refusal({1, 7}) == "vertex 7 is not there; include the faces of a simplex first");
  CHECK(refusal({1, 1}) == "vertex 1 is repeated in {1 1}");
  CHECK(refusal({2, 0, 1}) == "the face {2 1} of {2 0 1} is not there; include the faces of a simplex first");
  CHECK(refusal({}) == "a simplex has from 1 to 64 vertices, not 0");
  CHECK(complex.plan_contraction(0, 9).error().what ==
        "vertex 9 is not there; only two vertices of the complex can be contracted");
  CHECK(complex.plan_contraction(1, 1).error().what == "vertex 1 cannot be contracted into itself");
  CHECK(simplices_of(complex) == before);
}

TEST_CASE("a label that was contracted away may name a new vertex", "[ops][tower]") {
  TowerComplex complex;
  add_star(complex, 0, 1, 2);
  REQUIRE(complex.plan_contraction(1, 0).has_value());
  complex.contract();
  const Label one = 1;
  REQUIRE(complex.include({&one, 1}).has_value());
  CHECK(simplices_of(complex) == std::set<PlainComplex::Simplex>{{0}, {1}, {2}, {0, 2}});
}

TEST_CASE("a boundary matrix is taken column by column, and refused where it is none", "[ops][tower]") {
  ops::ColumnComplex columns;
  const auto include = [&](int dimension, std::vector<std::uint64_t> rows) { return columns.include(dimension, rows); };
  for (int v = 0; v < 3; ++v) {
    REQUIRE(include(0, {}).has_value());
  }
  REQUIRE(include(1, {0, 1}).has_value());
  REQUIRE(include(1, {1, 2}).has_value());
  REQUIRE(include(1, {0, 2}).has_value());
  CHECK(include(2, {3, 4}).error().what == "the boundary of its boundary is not 0");
  CHECK(include(2, {3, 1}).error().what ==
        "row 1 is of dimension 0; the boundary of a cell of dimension 2 has cells of dimension 1");
  CHECK(include(1, {0, 9}).error().what == "row 9 is no earlier cell");
  CHECK(include(0, {1}).error().what == "a cell of dimension 0 has no boundary");
  CHECK(include(99, {}).error().what == "dimension 99 should be from 0 to 63");
  CHECK(include(2, {3, 4, 5}).value() == 6);
  CHECK(std::vector<std::uint64_t>(columns.counts().begin(), columns.counts().end()) ==
        std::vector<std::uint64_t>{3, 3, 1});
}

}  // namespace
}  // namespace sesame

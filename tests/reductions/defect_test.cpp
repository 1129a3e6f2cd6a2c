#include "reductions/defect.hpp"

#include "tests/support/catch.hpp"
#include "tests/support/figures.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/random_complexes.hpp"

using namespace sesame;
using namespace sesame::tests;
using reductions::Defect;
using reductions::first_defect;

namespace {

/// The map with one more unit in one entry of one degree.
template <Ring R>
GradedMap<R> bumped(GradedMap<R> map, int p, Index row, Index column) {
  Matrix<R> part = map.at(p);
  part.add_to_column(column, map.ring().one(), terms_of(map.ring(), {{row, 1}}));
  map.set(p, std::move(part));
  return map;
}

/// The map with the sign of one column of one degree changed.
template <Ring R>
GradedMap<R> flipped(GradedMap<R> map, int p, Index column) {
  Matrix<R> part = map.at(p);
  Terms<R> terms = part.column(column);
  for (auto& term : terms) {
    term.coefficient = map.ring().negate(term.coefficient);
  }
  part.set_column(column, terms);
  map.set(p, std::move(part));
  return map;
}

void check_law(const std::optional<Defect>& defect, const std::string& law, int degree, Index column) {
  REQUIRE(defect.has_value());
  CHECK(defect->law == law);
  CHECK(defect->degree == degree);
  CHECK(defect->column == column);
}

}  // namespace

TEST_CASE("a boundary whose boundary is not zero is named", "[reductions]") {
  const auto broken = complex_of(Integers{}, {2, 2, 1}, {{{}, {{0, 1}, {1, -1}}}, {{{1, 1}}}});
  check_law(first_defect(broken), "d d = 0", 2, 0);
  CHECK(first_defect(broken)->to_string() == "d d = 0 fails on generator 0 of degree 2 (entry 0)");
}

TEST_CASE("one flipped sign in a reduction is caught, with law and place", "[reductions]") {
  const auto good = figure_3_8(Integers{});
  REQUIRE(defect_of(good) == "");
  SECTION("in h on a vertex: the homotopy law, on that vertex") {
    auto broken = good;
    broken.h = flipped(good.h, 0, 4);
    check_law(first_defect(broken), "g f + d h + h d = 1", 0, 4);
  }
  SECTION("in f on an edge: f is no chain map") {
    auto broken = good;
    broken.f = flipped(good.f, 1, 5);
    check_law(first_defect(broken), "d f = f d", 1, 5);
  }
  SECTION("in g on an edge: g is no chain map") {
    auto broken = good;
    broken.g = flipped(good.g, 1, 1);
    check_law(first_defect(broken), "d g = g d", 1, 1);
  }
  SECTION("in the big boundary of the face") {
    auto broken = good;
    auto d = differential(good.big);
    Matrix<Integers> part = d.at(2);
    part.add_to_column(0, Integer(2), terms_of(Integers{}, {{0, 1}}));
    d.set(2, part);
    broken.big = complex_with(d);
    check_law(first_defect(broken), "big: d d = 0", 2, 0);
  }
}

TEST_CASE("each law of a reduction has its own name", "[reductions]") {
  const Integers z;
  // Zero boundaries: every map is a chain map, so that the later laws can break alone.
  const auto flat = [&](Sizes sizes) { return ChainComplex<Integers>::with_zero_boundary(z, std::move(sizes)); };
  const auto line = reductions::identity_reduction(flat({1, 1}));
  auto broken = line;
  broken.f = flipped(line.f, 1, 0);
  check_law(first_defect(broken), "f g = 1", 1, 0);

  const Reduction<Integers> gone{flat({1}), flat({}), GradedMap<Integers>::zero(z, 0, {1}, {}),
                                 GradedMap<Integers>::zero(z, 0, {}, {1}), GradedMap<Integers>::zero(z, 1, {1}, {1})};
  check_law(first_defect(gone), "g f + d h + h d = 1", 0, 0);

  broken = line;
  broken.h = bumped(line.h, 0, 0, 0);
  check_law(first_defect(broken), "f h = 0", 0, 0);
}

TEST_CASE("h g and h h have their own names where the homotopy law cannot see h", "[reductions]") {
  const Integers z;
  SECTION("h g: the point that stays is sent to a cycle") {
    // One point, and a pair d b = a in degrees 1 and 2.
    const auto big = complex_of(z, {1, 1, 1}, {{{}}, {{{0, 1}}}});
    auto broken = reductions::reduce(big);
    REQUIRE(defect_of(broken) == "");
    broken.h = bumped(broken.h, 0, 0, 0);
    check_law(first_defect(broken), "h g = 0", 0, 0);
  }
  // One point, and pairs d b1 = a1 in degrees 0 and 1, d b2 = a2 in degrees 2 and 3.
  const auto big = complex_of(z, {2, 1, 1, 1}, {{{{1, 1}}}, {{}}, {{{0, 1}}}});
  const auto good = reductions::reduce(big);
  REQUIRE(defect_of(good) == "");
  SECTION("h h: h runs on from b1 to a2") {
    auto broken = good;
    broken.h = bumped(good.h, 1, 0, 0);
    check_law(first_defect(broken), "h h = 0", 0, 1);
  }
  SECTION("h h: h + d k d satisfies the homotopy law as h does") {
    auto k = GradedMap<Integers>::zero(z, 3, big.sizes(), big.sizes());
    k.set(0, matrix_of(z, 1, {{}, {{0, 1}}}));
    const auto d = differential(big);
    auto broken = good;
    broken.h = good.h + d * k * d;
    check_law(first_defect(broken), "h h = 0", 0, 1);
  }
}

TEST_CASE("maps between the wrong modules are reported, not thrown", "[reductions]") {
  const auto good = figure_3_8(Integers{});
  auto broken = good;
  broken.f = good.g;
  CHECK(first_defect(broken)->law == "f goes from its source to its target");
  broken = good;
  broken.h = GradedMap<Integers>::zero(Integers{}, 2, good.big.sizes(), good.big.sizes());
  CHECK(first_defect(broken)->law == "h: big -> big, degree 1");
}

TEST_CASE("an equivalence names the side, and notices two different big complexes", "[reductions]") {
  const auto reduction = figure_3_8(Integers{});
  auto broken = reductions::equivalence_of(reduction);
  REQUIRE(defect_of(broken) == "");
  broken.right.h = flipped(broken.right.h, 0, 1);
  check_law(first_defect(broken), "right: g f + d h + h d = 1", 0, 1);
  broken = reductions::equivalence_of(reduction);
  broken.left = reductions::identity_reduction(sphere(Integers{}, 2));
  CHECK(first_defect(broken)->law == "left and right share the big complex");
}

TEST_CASE("each law of an exact sequence has its own name", "[reductions]") {
  const auto good = figure_3_10(Integers{});
  REQUIRE(defect_of(good) == "");
  auto broken = good;
  broken.r = flipped(good.r, 0, 3);
  check_law(first_defect(broken), "r i = 1", 0, 0);
  broken = good;
  broken.s = bumped(good.s, 1, 4, 0);  // e0 -> e0 + e4
  check_law(first_defect(broken), "j s = 1", 1, 0);
  broken = good;
  broken.r = bumped(good.r, 1, 0, 2);  // e2 -> e4
  check_law(first_defect(broken), "i r + s j = 1", 1, 2);
  broken = good;
  broken.i = flipped(good.i, 1, 0);
  check_law(first_defect(broken), "d i = i d", 1, 0);
  broken = good;
  broken.j = flipped(good.j, 2, 1);
  check_law(first_defect(broken), "d j = j d", 2, 1);
}

TEST_CASE("any single changed entry of a random reduction is caught", "[reductions][law]") {
  for (unsigned seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto good = random_reduction(random, random_complex(Integers{}, random).complex);
    const int p = random.in(0, std::max(0, good.big.top() - 1));
    if (good.big.size(p) == 0 || good.big.size(p + 1) == 0) {
      continue;
    }
    auto broken = good;
    broken.h = bumped(good.h, p, static_cast<Index>(random.in(0, static_cast<int>(good.big.size(p + 1)) - 1)),
                      static_cast<Index>(random.in(0, static_cast<int>(good.big.size(p)) - 1)));
    REQUIRE(defect_of(broken) != "");
  }
}

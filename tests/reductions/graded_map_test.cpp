#include "reductions/graded_map.hpp"

#include "tests/support/catch.hpp"
#include "tests/support/random_complexes.hpp"

using namespace sesame;
using namespace sesame::tests;

TEMPLATE_TEST_CASE("composition is that of functions, and degrees add", "[reductions]", Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  for (unsigned seed = 0; seed < 30; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Sizes a{2, 3, 1};
    const Sizes b{1, 2, 3, 2};
    const Sizes c{3, 1, 2};
    const auto first = random_map(ring, random, 1, a, b);
    const auto second = random_map(ring, random, -1, b, c);
    const auto both = second * first;
    REQUIRE(both.degree() == 0);
    for (int p = 0; p < 3; ++p) {
      for (Index i = 0; i < a[static_cast<std::size_t>(p)]; ++i) {
        const sparse::Chain<TestType> x(ring, {p}, {{i, ring.one()}});
        REQUIRE(both.apply(x) == second.apply(first.apply(x)));
      }
    }
  }
}

TEMPLATE_TEST_CASE("sums, differences and identities obey the rules of linear maps", "[reductions]", Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  for (unsigned seed = 0; seed < 30; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Sizes a{2, 3, 1};
    const Sizes b{1, 2, 3};
    const auto x = random_map(ring, random, 0, a, b);
    const auto y = random_map(ring, random, 0, a, b);
    const auto z = random_map(ring, random, 1, b, a);
    REQUIRE(x + y - y == x);
    REQUIRE((x - x).is_zero());
    REQUIRE(-x + x == GradedMap<TestType>::zero(ring, 0, a, b));
    REQUIRE(z * (x + y) == z * x + z * y);
    REQUIRE(x * GradedMap<TestType>::identity(ring, a) == x);
    REQUIRE(GradedMap<TestType>::identity(ring, b) * x == x);
  }
}

TEST_CASE("maps of other degrees or between other modules do not mix", "[reductions]") {
  const Integers z;
  const auto map = GradedMap<Integers>::zero(z, 0, {1, 1}, {1, 1});
  CHECK_THROWS_AS(map + GradedMap<Integers>::zero(z, 1, {1, 1}, {1, 1}), sparse::ContractViolation);
  CHECK_THROWS_AS(map + GradedMap<Integers>::zero(z, 0, {1, 2}, {1, 1}), sparse::ContractViolation);
  CHECK_THROWS_AS(map * GradedMap<Integers>::zero(z, 0, {1, 1}, {2, 1}), sparse::ContractViolation);
}

TEST_CASE("a map is there, and empty, in degrees where one side has no generators", "[reductions]") {
  const auto map = GradedMap<Integers>::zero(Integers{}, -1, {0, 2}, {1, 1, 4});
  CHECK(map.at(0).columns() == 0);
  CHECK(map.at(1).rows() == 1);
  CHECK(map.at(3).rows() == 4);
  CHECK(map.at(3).columns() == 0);
  CHECK(map.at(9).rows() == 0);
  CHECK(map.apply(sparse::Chain<Integers>(Integers{}, {5})).degree().value == 4);
}

TEST_CASE("raising degrees moves the matrices and changes the degree by the difference", "[reductions]") {
  Random random(1);
  const auto map = random_map(Integers{}, random, 0, {2, 1}, {1, 3});
  const auto raised = map.raised(1, 0);
  CHECK(raised.degree() == -1);
  CHECK(raised.source() == Sizes{0, 2, 1});
  CHECK(raised.at(2) == map.at(1));
  CHECK(map.raised(1, 1).degree() == 0);
  CHECK(map.raised(1, 1).at(1) == map.at(0));
}

TEST_CASE("a block map acts on each summand by its column of blocks", "[reductions]") {
  const Integers z;
  Random random(2);
  const Sizes x{2, 1};
  const Sizes y{1, 2};
  const auto a = random_map(z, random, 0, x, x);
  const auto b = random_map(z, random, 0, y, x);
  const auto c = random_map(z, random, 0, x, y);
  const auto d = random_map(z, random, 0, y, y);
  const auto blocks = block_map(a, b, c, d);
  CHECK(blocks == stacked(beside(a, b), beside(c, d)));
  CHECK(blocks == beside(stacked(a, c), stacked(b, d)));
  CHECK(blocks.at(1).entry(0, 1) == b.at(1).entry(0, 0));
  CHECK(blocks.at(1).entry(2, 0) == c.at(1).entry(1, 0));
  CHECK(blocks.at(1).entry(1, 2) == d.at(1).entry(0, 1));
}

TEST_CASE("the identity of a direct sum of modules stays implicit", "[reductions]") {
  const Integers z;
  const auto one = diagonal(GradedMap<Integers>::identity(z, {3}), GradedMap<Integers>::identity(z, {4, 2}));
  CHECK(one.at(0).stored_columns() == 0);
  CHECK(one == GradedMap<Integers>::identity(z, {7, 2}));
}

TEST_CASE("the first difference names degree, row and column", "[reductions]") {
  const auto zero = GradedMap<Integers>::zero(Integers{}, 0, {2, 2, 2}, {2, 2, 2});
  auto other = zero;
  other.set(2, matrix_of(Integers{}, 2, {{{0, 1}}, {}}));
  other.set(1, matrix_of(Integers{}, 2, {{}, {{1, 5}}}));
  const auto place = first_difference(zero, other);
  REQUIRE(place.has_value());
  CHECK(place->degree == 1);
  CHECK(place->row == 1);
  CHECK(place->column == 1);
  CHECK_FALSE(first_difference(other, other).has_value());
}

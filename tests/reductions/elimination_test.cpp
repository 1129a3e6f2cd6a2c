#include "reductions/elimination.hpp"

#include "reductions/homology.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/random_complexes.hpp"

using namespace sesame;
using namespace sesame::tests;
using reductions::eliminate_all_units;
using reductions::eliminate_pair;
using reductions::reduce;

namespace {

struct Pair {
  int p;
  Index a;
  Index b;
};

template <Ring R>
std::optional<Pair> some_unit_pair(const ChainComplex<R>& complex) {
  for (int p = 0; p < complex.top(); ++p) {
    for (Index b = 0; b < complex.size(p + 1); ++b) {
      for (const auto& term : complex.boundary(p + 1).column(b)) {
        if (complex.ring().is_unit(term.coefficient)) {
          return Pair{p, term.index, b};
        }
      }
    }
  }
  return std::nullopt;
}

}  // namespace

TEMPLATE_TEST_CASE("eliminating a unit pair gives a reduction without the two generators", "[reductions][law]",
                   Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  for (unsigned seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto complex = random_complex(ring, random).complex;
    const auto pair = some_unit_pair(complex);
    if (!pair) {
      continue;
    }
    const auto reduction = eliminate_pair(complex, pair->p, pair->a, pair->b);
    REQUIRE(reduction);
    REQUIRE(defect_of(*reduction) == "");
    REQUIRE(reduction->small.total_size() + 2 == complex.total_size());
  }
}

TEMPLATE_TEST_CASE("pair by pair or all at once, no unit is left and the laws hold", "[reductions][law]", Integers, Z2,
                   Zp) {
  const auto ring = test_ring<TestType>();
  for (unsigned seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto complex = random_complex(ring, random).complex;
    auto one_by_one = reductions::identity_reduction(complex);
    while (const auto pair = some_unit_pair(one_by_one.small)) {
      auto next = eliminate_pair(one_by_one, pair->p, pair->a, pair->b);
      REQUIRE(next);
      one_by_one = *std::move(next);
    }
    REQUIRE(defect_of(one_by_one) == "");
    const auto at_once = reduce(complex);
    REQUIRE(defect_of(at_once) == "");
    REQUIRE_FALSE(some_unit_pair(at_once.small));
    REQUIRE(homology_groups(one_by_one.small) == homology_groups(at_once.small));
    if (TestType::is_field) {
      REQUIRE(one_by_one.small.sizes() == at_once.small.sizes());
      REQUIRE(differential(at_once.small).is_zero());
    }
  }
}

TEMPLATE_TEST_CASE("the small complex and its lift are those of the full reduction", "[reductions]", Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  for (unsigned seed = 0; seed < 30; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto complex = random_complex(ring, random).complex;
    const auto full = reduce(complex);
    const auto model = reductions::small_model(complex);
    REQUIRE(model.small == full.small);
    REQUIRE(model.g == full.g);
    REQUIRE(reductions::small_complex(complex) == full.small);
    const auto expanded = random_expansion(random, complex);
    const auto again = eliminate_all_units(expanded);
    REQUIRE(defect_of(again) == "");
    REQUIRE(again.small == full.small);
  }
}

TEST_CASE("a boundary without units is looked at again when a later pair gives it one", "[reductions]") {
  // d b0 = 2 a0 + 3 a1 has no unit; d b1 = a0 + a1 makes -a0 of a1, and d b0 becomes -a0.
  const auto late = complex_of(Integers{}, {2, 2}, {{{{0, 2}, {1, 3}}, {{0, 1}, {1, 1}}}});
  const auto reduction = reduce(late);
  CHECK(defect_of(reduction) == "");
  CHECK(reduction.small.total_size() == 0);
}

TEST_CASE("boundaries without units stay, rewritten by the pairs found after them", "[reductions]") {
  // d b1 = a0 - a1 makes a0 of a1, and 5 a0 of the boundaries before and after it.
  const auto complex = complex_of(Integers{}, {2, 3}, {{{{0, 2}, {1, 3}}, {{0, 1}, {1, -1}}, {{0, 2}, {1, 3}}}});
  const auto reduction = reduce(complex);
  CHECK(defect_of(reduction) == "");
  CHECK(reduction.small == complex_of(Integers{}, {1, 2}, {{{{0, 5}}, {{0, 5}}}}));
}

TEST_CASE("a pair without a unit between them is refused", "[reductions]") {
  const auto plane = moore_space(Integers{}, 1, 2);
  const auto refused = eliminate_pair(plane, 1, 0, 0);
  REQUIRE_FALSE(refused);
  CHECK(refused.error().code == Errc::not_a_unit);
  CHECK(refused.error().what ==
        "elimination: the coefficient of generator 0 of degree 1 in the boundary of generator 0 is 2, not a unit of Z");
  CHECK(eliminate_pair(moore_space(test_ring<Zp>(), 1, 2), 1, 0, 0));
}

#include "reductions/reduction.hpp"

#include "reductions/equivalence.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/random_complexes.hpp"

using namespace sesame;
using namespace sesame::tests;

TEMPLATE_TEST_CASE("identities, isomorphisms and compositions are reductions", "[reductions][law]", Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  for (unsigned seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto complex = random_complex(ring, random).complex;
    REQUIRE(defect_of(complex) == "");
    REQUIRE(defect_of(reductions::identity_reduction(complex)) == "");
    REQUIRE(defect_of(random_isomorphism(random, complex)) == "");
    const auto first = random_expansion(random, complex);
    REQUIRE(defect_of(first) == "");
    const auto second = random_reduction(random, complex);
    REQUIRE(defect_of(second) == "");
    REQUIRE(defect_of(compose(first, second)) == "");
  }
}

TEMPLATE_TEST_CASE("F and G of an equivalence are chain maps, and K a homotopy from G F to 1", "[reductions][law]",
                   Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  for (unsigned seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto object = random_complex(ring, random).complex;
    const auto equivalence = random_equivalence(random, object);
    REQUIRE(defect_of(equivalence) == "");
    const auto f = equivalence.F();
    const auto g = equivalence.G();
    const auto k = equivalence.K();
    const auto d = differential(object);
    REQUIRE(defect_of(f, equivalence.object(), equivalence.small(), "F") == "");
    REQUIRE(defect_of(g, equivalence.small(), equivalence.object(), "G") == "");
    REQUIRE(d * k + k * d == identity_of(object) - g * f);
  }
}

TEST_CASE("the trivial equivalence and that of a reduction are lawful, and can be shrunk", "[reductions]") {
  const auto object = torus(Integers{});
  const auto trivial = reductions::trivial_equivalence(object);
  CHECK(defect_of(trivial) == "");
  const auto reduction = reductions::reduce(object);
  const auto reduced = reductions::equivalence_of(reduction);
  CHECK(defect_of(reduced) == "");
  CHECK(shrink(trivial, reduction) == reduced);
}

#include "reductions/exact_sequence.hpp"

#include "reductions/homology.hpp"
#include "reductions/perturbation.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/random_complexes.hpp"

using namespace sesame;
using namespace sesame::tests;
using reductions::homology_groups;

TEMPLATE_TEST_CASE("forward: equivalences of C0 and C1 give one of C2", "[reductions][law]", Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  for (unsigned seed = 0; seed < 150; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto sequence = random_exact_sequence(ring, random);
    REQUIRE(defect_of(sequence) == "");
    const auto eq0 = random_equivalence(random, sequence.c0);
    const auto eq1 = random_equivalence(random, sequence.c1);
    const auto eq2 = forward(sequence, eq0, eq1);
    REQUIRE(defect_of(eq2) == "");
    REQUIRE(eq2.object() == sequence.c2);
    // On the object itself (the formulas that a local engine uses).
    const auto dS2 = differential(eq2.small());
    const auto corner = eq1.F() * sequence.i * eq0.G();
    REQUIRE(dS2 == block_map((-differential(eq0.small())).raised(1, 1),
                             GradedMap<TestType>::zero(ring, -2, eq1.small().sizes(), eq0.small().sizes()).raised(0, 1),
                             corner.raised(1, 0), differential(eq1.small())));
    const auto rest = sequence.s - sequence.i * eq0.K() * sequence.chi();
    REQUIRE(eq2.F() == stacked((-(eq0.F() * sequence.chi())).raised(0, 1), eq1.F() * rest));
    REQUIRE(eq2.G() == beside((-(sequence.j * eq1.K() * sequence.i * eq0.G())).raised(1, 0), sequence.j * eq1.G()));
    REQUIRE(eq2.K() == sequence.j * eq1.K() * rest);
  }
}

TEMPLATE_TEST_CASE("backward: equivalences of C0 and C2 give one of C1", "[reductions][law]", Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  for (unsigned seed = 0; seed < 150; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto sequence = random_exact_sequence(ring, random);
    const auto eq0 = random_equivalence(random, sequence.c0);
    const auto eq2 = random_equivalence(random, sequence.c2);
    const auto eq1 = backward(sequence, eq0, eq2);
    REQUIRE(eq1);
    REQUIRE(defect_of(*eq1) == "");
    REQUIRE(eq1->object() == sequence.c1);
    // The right reduction is the one of the basic perturbation lemma.
    const auto sum = direct_sum(eq0.right, eq2.right);
    const auto perturbed = basic_perturbation(sum, differential(eq1->big()) - differential(sum.big));
    REQUIRE(perturbed);
    REQUIRE(*perturbed == eq1->right);
  }
}

TEMPLATE_TEST_CASE("kernel: equivalences of C1 and C2 give one of C0, raised", "[reductions][law]", Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  for (unsigned seed = 0; seed < 150; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto sequence = random_exact_sequence(ring, random);
    const auto eq1 = random_equivalence(random, sequence.c1);
    const auto eq2 = random_equivalence(random, sequence.c2);
    const auto eq0 = kernel(sequence, eq1, eq2);
    REQUIRE(defect_of(eq0) == "");
    REQUIRE(differential(eq0.object()) == (-differential(sequence.c0)).raised(1, 1));
    // On the object itself.
    REQUIRE(differential(eq0.small()) ==
            block_map((-differential(eq1.small())).raised(1, 1),
                      GradedMap<TestType>::zero(ring, -2, eq2.small().sizes(), eq1.small().sizes()).raised(0, 1),
                      (eq2.F() * sequence.j * eq1.G()).raised(1, 0), differential(eq2.small())));
  }
}

TEST_CASE("small complexes of the theorem have the homology of the object", "[reductions]") {
  for (unsigned seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto sequence = random_exact_sequence(Integers{}, random);
    const auto eq2 =
        forward(sequence, random_equivalence(random, sequence.c0), random_equivalence(random, sequence.c1));
    auto small = homology_groups(eq2.small());
    auto object = homology_groups(sequence.c2);
    const auto degrees = std::max(small.size(), object.size());
    small.resize(degrees);
    object.resize(degrees);
    REQUIRE(small == object);
  }
}

TEST_CASE("a sequence whose chi does not anticommute with d is refused", "[reductions]") {
  const Integers z;
  // C1 with a differential that is not one: d1 d1 != 0 shows up in chi.
  const auto c0 = complex_of(z, {1, 1}, {{{{0, 1}}}});
  const auto c2 = complex_of(z, {0, 0, 1}, {{}, {{}}});
  const auto c1 = complex_of(z, {1, 1, 1}, {{{{0, 1}}}, {{{0, 1}}}});
  const auto one = [&](int p, const ChainComplex<Integers>& from, const ChainComplex<Integers>& to) {
    auto map = GradedMap<Integers>::zero(z, 0, from.sizes(), to.sizes());
    for (int q = p; q <= (p == 0 ? 1 : 2); ++q) {
      map.set(q, matrix_of(z, 1, {{{0, 1}}}));
    }
    return map;
  };
  const ExactSequence<Integers> broken{c0, c1, c2, one(0, c0, c1), one(2, c1, c2), one(0, c1, c0), one(2, c2, c1)};
  const auto refused = backward(broken, reductions::trivial_equivalence(c0), reductions::trivial_equivalence(c2));
  REQUIRE_FALSE(refused);
  CHECK(refused.error().code == Errc::law_broken);
  CHECK(refused.error().what.find("generator 0 of degree 2") != std::string::npos);
}

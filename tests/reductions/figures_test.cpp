// The maps printed in S. Peltier, habilitation (2023), section 3.3.3, are what they are said to be.
#include "tests/support/figures.hpp"

#include "reductions/elimination.hpp"
#include "reductions/homology.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/laws.hpp"

using namespace sesame;
using namespace sesame::tests;
using reductions::equivalence_of;
using reductions::homology_groups;
using reductions::trivial_equivalence;

using Groups = std::vector<AbelianGroup>;

TEMPLATE_TEST_CASE("S. Peltier, habilitation (2023), figure 3.8: the printed f, g, h are a reduction", "[reductions]",
                   Integers, Z2, Zp) {
  const auto reduction = figure_3_8(test_ring<TestType>());
  CHECK(defect_of(reduction) == "");
  CHECK(homology_groups(reduction.big) == Groups{group(1), group(1), group(0)});
  CHECK(homology_groups(reduction.small) == Groups{group(1), group(1)});
}

TEMPLATE_TEST_CASE("S. Peltier, habilitation (2023), figure 3.10: the printed i, j, r, s are an exact sequence",
                   "[reductions]", Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  const auto sequence = figure_3_10(ring);
  CHECK(defect_of(sequence) == "");
  // r and s are not chain maps: chi sees the two surviving cells next to the removed ones.
  CHECK(sequence.chi() == sequence.r * differential(sequence.c1) * sequence.s);
  CHECK(differential(sequence.c1) * sequence.s == sequence.s * differential(sequence.c2) + sequence.i * sequence.chi());
  CHECK_FALSE(sequence.chi().is_zero());
}

TEST_CASE("S. Peltier, habilitation (2023), section 3.3.3.3: i, j, r, s and d0 follow the recipe of an identification",
          "[reductions]") {
  const auto sequence = figure_3_10(Integers{});
  CHECK(differential(sequence.c0) == sequence.r * differential(sequence.c1) * sequence.i);
  CHECK(differential(sequence.c2) == sequence.j * differential(sequence.c1) * sequence.s);
}

TEMPLATE_TEST_CASE("S. Peltier, habilitation (2023), figures 3.11 and 3.14: the theorem gives a lawful equivalence",
                   "[reductions]", Integers, Z2, Zp) {
  const auto sequence = figure_3_10(test_ring<TestType>());
  const auto eq0 = equivalence_of(reductions::reduce(sequence.c0));
  const auto eq1 = equivalence_of(reductions::reduce(sequence.c1));
  CHECK(eq0.small().total_size() == 1);
  CHECK(eq1.small().total_size() == 2);
  const auto eq2 = forward(sequence, eq0, eq1);
  CHECK(defect_of(eq2) == "");
  CHECK(eq2.object() == sequence.c2);
  // Big: the object before, and the identified part one degree higher (the cone of i).
  CHECK(eq2.big().sizes() == Sizes{6, 8, 3});
  CHECK(eq2.small().sizes() == Sizes{2, 1});
  CHECK(homology_groups(eq2.small())[0] == group(1));
  const auto smallest = shrink(eq2, reductions::reduce(eq2.small()));
  CHECK(defect_of(smallest) == "");
  CHECK(smallest.small().sizes() == Sizes{1});

  const auto back = backward(sequence, eq0, eq2);
  REQUIRE(back);
  CHECK(defect_of(*back) == "");
  CHECK(back->object() == sequence.c1);
}

#include "reductions/perturbation.hpp"

#include "reductions/strong_components.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/random_complexes.hpp"

using namespace sesame;
using namespace sesame::tests;
using reductions::basic_perturbation;
using reductions::easy_perturbation;

namespace {

/// Another differential on the same module minus the given one: (1 + k) d (1 + k)^-1 - d for a random automorphism.
template <Ring R>
GradedMap<R> random_perturbation(Random& random, const ChainComplex<R>& complex) {
  return differential(random_isomorphism(random, complex).small) - differential(complex);
}

/// A perturbation of a sum X + Y + Z that only goes from later summands to earlier ones.
template <Ring R>
GradedMap<R> triangular_perturbation(Random& random, const Sizes& x, const Sizes& y, const Sizes& z,
                                     const ChainComplex<R>& sum) {
  const R& ring = sum.ring();
  const auto zero = [&](const Sizes& from, const Sizes& to) { return GradedMap<R>::zero(ring, 0, from, to); };
  const auto k_yx = random_map(ring, random, 0, y, x);
  const auto k_zx = random_map(ring, random, 0, z, x);
  const auto k_zy = random_map(ring, random, 0, z, y);
  const auto inner = block_map(zero(x, x), k_yx, zero(x, y), zero(y, y));
  const auto k = block_map(inner, stacked(k_zx, k_zy), zero(reductions::sum(x, y), z), zero(z, z));
  const auto one = identity_of(sum);
  return (one + k) * differential(sum) * (one - k + k * k) - differential(sum);
}

}  // namespace

TEMPLATE_TEST_CASE("an easily perturbed reduction is a reduction of the perturbed complexes", "[reductions][law]",
                   Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  for (unsigned seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto reduction = random_expansion(random, random_complex(ring, random).complex);
    const auto delta = random_perturbation(random, reduction.small);
    const auto perturbed = easy_perturbation(reduction, delta);
    REQUIRE(perturbed);
    REQUIRE(defect_of(*perturbed) == "");
    REQUIRE(differential(perturbed->small) == differential(reduction.small) + delta);
  }
}

TEMPLATE_TEST_CASE("a perturbed reduction is a reduction of the perturbed complexes", "[reductions][law]", Integers, Z2,
                   Zp) {
  const auto ring = test_ring<TestType>();
  int used_series = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    std::vector<Reduction<TestType>> parts;
    for (int k = 0; k < 3; ++k) {
      parts.push_back(random_reduction(random, random_complex(ring, random, 2, {1, 2, {1, 1, 1, 2}}).complex));
    }
    const auto sum = direct_sum(direct_sum(parts[0], parts[1]), parts[2]);
    const auto delta =
        triangular_perturbation(random, parts[0].big.sizes(), parts[1].big.sizes(), parts[2].big.sizes(), sum.big);
    const auto perturbed = basic_perturbation(sum, delta);
    REQUIRE(perturbed);
    REQUIRE(defect_of(*perturbed) == "");
    REQUIRE(differential(perturbed->big) == differential(sum.big) + delta);
    const auto once = sum.h * delta;
    used_series += (once * once).is_zero() ? 0 : 1;
  }
  CHECK(used_series > 5);  // the inputs do exercise the third term
}

TEMPLATE_TEST_CASE("in a random basis, where supports have cycles, nilpotent series still stop", "[reductions][law]",
                   Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  for (unsigned seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto a = random_reduction(random, random_complex(ring, random, 2).complex);
    const auto b = random_reduction(random, random_complex(ring, random, 2).complex);
    const auto sum = direct_sum(a, b);
    const auto delta = triangular_perturbation(random, a.big.sizes(), {}, b.big.sizes(), sum.big);
    const auto basis = random_isomorphism(random, sum.big);
    const auto perturbed = basic_perturbation(compose(inverted(basis), sum), basis.f * delta * basis.g);
    REQUIRE(perturbed);
    REQUIRE(defect_of(*perturbed) == "");
  }
}

TEST_CASE("a series that does not stop is refused, with a generator on which it does not", "[reductions]") {
  // An edge with one end, reduced to nothing; taking the end away again makes h delta = -1 on it.
  const Integers z;
  const auto pair = complex_of(z, {1, 1}, {{{{0, 1}}}});
  const auto reduction = reductions::reduce(pair);
  REQUIRE(defect_of(reduction) == "");
  const auto refused = basic_perturbation(reduction, -differential(pair));
  REQUIRE_FALSE(refused);
  CHECK(refused.error().code == Errc::not_nilpotent);
  CHECK(refused.error().what ==
        "perturbation: the series of h delta does not stop on generator 0 of degree 1 of the big complex; h delta has "
        "to be nilpotent");
}

TEST_CASE("the generator named is one whose series grows, not one that dies out", "[reductions]") {
  // Three pairs a_i, b_i; h delta sends b_0 to 0 and runs round b_1 -> b_2 -> b_1.
  const Z2 ring;
  const auto pairs = complex_of(ring, {3, 3}, {{{{0, 1}}, {{1, 1}}, {{2, 1}}}});
  auto delta = GradedMap<Z2>::zero(ring, -1, pairs.sizes(), pairs.sizes());
  delta.set(1, matrix_of(ring, 3, {{}, {{2, 1}}, {{1, 1}}}));
  const auto refused = basic_perturbation(reductions::reduce(pairs), delta);
  REQUIRE_FALSE(refused);
  CHECK(refused.error().code == Errc::not_nilpotent);
  CHECK(refused.error().what.find("generator 1 of degree 1") != std::string::npos);
}

TEST_CASE("a perturbation after which d d is not zero is refused by both lemmas", "[reductions]") {
  const Integers z;
  const auto complex = complex_of(z, {1, 1, 1}, {{{}}, {{}}});
  auto delta = GradedMap<Integers>::zero(z, -1, complex.sizes(), complex.sizes());
  delta.set(1, matrix_of(z, 1, {{{0, 1}}}));
  delta.set(2, matrix_of(z, 1, {{{0, 1}}}));
  const auto reduction = reductions::identity_reduction(complex);
  for (const auto& refused : {easy_perturbation(reduction, delta), basic_perturbation(reduction, delta)}) {
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code == Errc::law_broken);
    CHECK(refused.error().what.find("generator 0 of degree 2") != std::string::npos);
  }
}

TEST_CASE("components come after everything that they lead to", "[reductions]") {
  // 0 -> 1 <-> 2 -> 3, 4 -> 4, 5
  const std::vector<std::vector<Index>> graph{{1}, {2}, {1, 3}, {}, {4}, {}};
  const auto components = reductions::strong_components(graph);
  REQUIRE(components.size() == 5);
  std::vector<std::size_t> at(graph.size());
  for (std::size_t c = 0; c < components.size(); ++c) {
    for (const Index v : components[c]) {
      at[v] = c;
    }
  }
  CHECK(at[1] == at[2]);
  CHECK(at[3] < at[2]);
  CHECK(at[1] < at[0]);
  CHECK(components[at[1]] == std::vector<Index>{1, 2});
}

#include "reductions/cone.hpp"

#include "reductions/homology.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/random_complexes.hpp"

using namespace sesame;
using namespace sesame::tests;
using reductions::homology_groups;

namespace {

/// A random chain map: null-homotopic, plus a multiple of the identity when the two ends are one complex.
template <Ring R>
GradedMap<R> random_chain_map(Random& random, const ChainComplex<R>& source, const ChainComplex<R>& target) {
  const auto k = random_map(source.ring(), random, 1, source.sizes(), target.sizes());
  auto phi = differential(target) * k + k * differential(source);
  if (source.sizes() == target.sizes() && source == target) {
    phi.add(source.ring().from(std::int64_t{random.in(-2, 2)}), identity_of(source));
  }
  return phi;
}

}  // namespace

TEMPLATE_TEST_CASE("the cone of a chain map is a complex, and reductions of its ends reduce it", "[reductions][law]",
                   Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  for (unsigned seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto c0 = random_complex(ring, random, 2).complex;
    const auto c1 = random.one_in(2) ? c0 : random_complex(ring, random, 2).complex;
    const auto phi = random_chain_map(random, c0, c1);
    REQUIRE(defect_of(phi, c0, c1) == "");
    REQUIRE(defect_of(reductions::cone(phi, c0, c1)) == "");
    const auto rho0 = random_reduction(random, c0);
    const auto rho1 = random_reduction(random, c1);
    const auto reduction = reductions::cone_reduction(phi, rho0, rho1);
    REQUIRE(defect_of(reduction) == "");
    REQUIRE(reduction.big == reductions::cone(phi, c0, c1));
  }
}

TEST_CASE("the cone of an identity has no homology", "[reductions]") {
  const auto plane = projective_plane(Integers{});
  for (const auto& group : homology_groups(reductions::cone(identity_of(plane), plane, plane))) {
    CHECK(group.is_trivial());
  }
}

TEST_CASE("the cone of a map that is no chain map is no complex", "[reductions]") {
  const auto edge = complex_of(Integers{}, {2, 1}, {{{{0, -1}, {1, 1}}}});
  auto phi = identity_of(edge);
  phi.set(1, matrix_of(Integers{}, 1, {{{0, -1}}}));
  CHECK(defect_of(reductions::cone(phi, edge, edge)) != "");
}

#include "reductions/homology.hpp"

#include "tests/support/catch.hpp"
#include "tests/support/random_complexes.hpp"

using namespace sesame;
using namespace sesame::tests;
using reductions::betti_numbers_modulo;
using reductions::homology;
using reductions::homology_groups;

namespace {

using Groups = std::vector<AbelianGroup>;

/// Every statement that a homology with generators makes, checked by its properties.
template <Ring R>
void check_generators(const ChainComplex<R>& complex) {
  const R& ring = complex.ring();
  const auto groups = homology_groups(complex);
  const auto found = homology(complex);
  REQUIRE(found.size() == groups.size());
  for (std::size_t p = 0; p < found.size(); ++p) {
    REQUIRE(found[p].group == groups[p]);
    std::vector<Integer> orders = groups[p].torsion;
    orders.resize(orders.size() + groups[p].rank, Integer{0});
    REQUIRE(found[p].generators.size() == orders.size());
    for (std::size_t k = 0; k < orders.size(); ++k) {
      const auto& [cycle, order, bounding] = found[p].generators[k];
      REQUIRE(order == orders[k]);
      REQUIRE(cycle.degree().value == static_cast<int>(p));
      REQUIRE_FALSE(cycle.is_zero());
      REQUIRE(complex.boundary_of(cycle).is_zero());
      reductions::Chain<R> multiple(ring, cycle.degree());
      multiple.add(ring.from(order), cycle);
      REQUIRE(complex.boundary_of(bounding) == multiple);
    }
  }
}

/// Attaching one cell along each generator kills the group: they do generate it.
template <Ring R>
void check_that_generators_generate(const ChainComplex<R>& complex) {
  const auto found = homology(complex);
  for (int p = 0; p <= complex.top(); ++p) {
    Matrix<R> above = complex.boundary(p + 1);
    for (const auto& generator : found[static_cast<std::size_t>(p)].generators) {
      above.append_column(generator.cycle.terms());
    }
    Sizes sizes;
    std::vector<Matrix<R>> boundaries;
    for (int q = 0; q <= p; ++q) {
      sizes.push_back(complex.size(q));
      boundaries.push_back(complex.boundary(q));
    }
    sizes.push_back(above.columns());
    boundaries.push_back(std::move(above));
    const ChainComplex<R> killed(complex.ring(), sizes, std::move(boundaries));
    REQUIRE((killed.top() < p || homology_groups(killed)[static_cast<std::size_t>(p)].is_trivial()));
  }
}

}  // namespace

TEST_CASE("known spaces have their known homology over Z", "[reductions]") {
  const Integers z;
  CHECK(homology_groups(sphere(z, 2)) == Groups{group(1), group(0), group(1)});
  CHECK(homology_groups(sphere(z, 0)) == Groups{group(2)});
  CHECK(homology_groups(torus(z)) == Groups{group(1), group(2), group(1)});
  CHECK(homology_groups(klein_bottle(z)) == Groups{group(1), group(1, {2}), group(0)});
  CHECK(homology_groups(projective_plane(z)) == Groups{group(1), group(0, {2}), group(0)});
  CHECK(homology_groups(dunce_hat(z)) == Groups{group(1), group(0), group(0)});
  CHECK(homology_groups(lens_space(z, 7)) == Groups{group(1), group(0, {7}), group(0), group(1)});
  CHECK(homology_groups(projective_space(z, 4)) == Groups{group(1), group(0, {2}), group(0), group(0, {2}), group(0)});
  for (int t = 2; t <= 12; ++t) {
    CHECK(homology_groups(moore_space(z, 2, t)) == Groups{group(1), group(0), group(0, {t}), group(0)});
  }
}

TEST_CASE("known spaces have their known homology over fields", "[reductions]") {
  CHECK(homology_groups(klein_bottle(Z2{})) == Groups{group(1), group(2), group(1)});
  CHECK(homology_groups(klein_bottle(test_ring<Zp>())) == Groups{group(1), group(1), group(0)});
  CHECK(homology_groups(projective_space(Z2{}, 4)) == Groups(5, group(1)));
  CHECK(homology_groups(moore_space(test_ring<Zp>(), 1, 10)) == Groups{group(1), group(1), group(1)});
}

TEST_CASE("the zero complex has no homology groups", "[reductions]") {
  const auto nothing = ChainComplex<Integers>::with_zero_boundary(Integers{}, {});
  CHECK(homology(nothing).empty());
  CHECK(homology_groups(nothing).empty());
}

TEST_CASE("generators of known spaces are cycles of the stated order, and generate", "[reductions]") {
  const Integers z;
  for (const auto& space : {sphere(z, 2), torus(z), klein_bottle(z), projective_plane(z), dunce_hat(z),
                            moore_space(z, 2, 12), lens_space(z, 5), projective_space(z, 5)}) {
    check_generators(space);
    check_that_generators_generate(space);
  }
}

TEMPLATE_TEST_CASE("random complexes: groups as built, generators of the stated orders that generate",
                   "[reductions][law]", Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  for (unsigned seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto sample = random_complex(ring, random);
    REQUIRE(homology_groups(sample.complex) == sample.groups);
    check_generators(sample.complex);
    check_that_generators_generate(sample.complex);
  }
}

TEST_CASE("universal coefficients: Betti numbers over Z/p follow from the integral groups", "[reductions][law]") {
  const Integers z;
  const auto z5 = test_ring<Zp>();
  const auto betti = [](const Groups& groups) {
    std::vector<Index> ranks;
    for (const AbelianGroup& g : groups) {
      ranks.push_back(g.rank);
    }
    return ranks;
  };
  for (unsigned seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    // The same random choices over each ring: one integral complex, read modulo p.
    Random random(seed);
    const auto integral = random_complex(z, random);
    const auto reduced = [&](const auto& ring) {
      using R = std::decay_t<decltype(ring)>;
      std::vector<Matrix<R>> boundaries;
      for (const auto& boundary : integral.complex.boundaries()) {
        auto& matrix = boundaries.emplace_back(ring, boundary.rows(), boundary.columns());
        for (Index j = 0; j < boundary.columns(); ++j) {
          sparse::RawTerms<R> column;
          for (const auto& term : boundary.column(j)) {
            column.push_back({term.index, ring.from(term.coefficient)});
          }
          matrix.set_column(j, std::move(column).normal(ring));
        }
      }
      return betti(homology_groups(ChainComplex<R>(ring, integral.complex.sizes(), std::move(boundaries))));
    };
    REQUIRE(reduced(Z2{}) == betti_numbers_modulo(integral.groups, 2));
    REQUIRE(reduced(z5) == betti_numbers_modulo(integral.groups, 5));
  }
}

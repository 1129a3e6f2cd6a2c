#include "reductions/chain_complex.hpp"

#include "tests/support/catch.hpp"
#include "tests/support/complexes.hpp"
#include "tests/support/laws.hpp"

using namespace sesame;
using namespace sesame::tests;

TEST_CASE("a complex answers for every degree, also those it does not have", "[reductions]") {
  const auto edge = complex_of(Integers{}, {2, 1}, {{{{0, -1}, {1, 1}}}});
  CHECK(edge.top() == 1);
  CHECK(edge.size(-1) == 0);
  CHECK(edge.size(2) == 0);
  CHECK(edge.total_size() == 3);
  CHECK(edge.boundary(0).rows() == 0);
  CHECK(edge.boundary(0).columns() == 2);
  CHECK(edge.boundary(2).rows() == 1);
  CHECK(edge.boundary(2).columns() == 0);
  CHECK(edge.boundary(7).rows() == 0);
  CHECK(edge.boundary(-3).columns() == 0);
}

TEST_CASE("empty degrees at the top are dropped, so that equal complexes compare equal", "[reductions]") {
  const auto point = complex_of(Integers{}, {1}, {});
  CHECK(complex_of(Integers{}, {1, 0, 0}, {{}, {}}) == point);
  CHECK_FALSE(complex_of(Integers{}, {1, 0, 1}, {{}, {{}}}) == point);
  CHECK(ChainComplex<Integers>::with_zero_boundary(Integers{}, {0, 0}).top() == -1);
}

TEST_CASE("the boundary of a chain lies one degree lower", "[reductions]") {
  const auto circle = sphere(Integers{}, 1);
  const sparse::Chain<Integers> edges(Integers{}, {1}, {{0, 1}, {2, 1}});
  const auto boundary = circle.boundary_of(edges);
  CHECK(boundary.degree().value == 0);
  CHECK(boundary.coefficient(0) == Integer(-1));
  CHECK(boundary.coefficient(2) == Integer(1));
  CHECK(circle.boundary_of(boundary).is_zero());
}

TEST_CASE("a complex whose matrices do not fit together is a broken contract", "[reductions]") {
  const Integers z;
  std::vector<Matrix<Integers>> boundaries;
  boundaries.emplace_back(z, 0, 2);
  CHECK_THROWS_AS(ChainComplex<Integers>(z, {2, 1}, boundaries), sparse::ContractViolation);
  boundaries.emplace_back(z, 3, 1);
  CHECK_THROWS_AS(ChainComplex<Integers>(z, {2, 1}, boundaries), sparse::ContractViolation);
}

TEMPLATE_TEST_CASE("the known spaces of the tests are complexes", "[reductions]", Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  for (const auto& space : {sphere(ring, 3), torus(ring), projective_plane(ring), klein_bottle(ring), dunce_hat(ring),
                            moore_space(ring, 2, 6), lens_space(ring, 5), projective_space(ring, 4)}) {
    CHECK(defect_of(space) == "");
  }
}

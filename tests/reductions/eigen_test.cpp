#include "sparse/eigen.hpp"

#include <Eigen/SparseQR>

#include "reductions/homology.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/complexes.hpp"

using namespace sesame;
using namespace sesame::tests;
using sparse::Integers;
using sparse::Rationals;

namespace {

/// Eigen's numeric rank of d_p; 0 where the complex has nothing.
template <sparse::Ring R>
Eigen::Index rank(const ChainComplex<R>& complex, int p) {
  const Eigen::SparseMatrix<double> d = sparse::to_eigen<double>(complex.boundary(p)).value();
  if (d.rows() == 0 || d.cols() == 0) {
    return 0;
  }
  const Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> qr(d);
  REQUIRE(qr.info() == Eigen::Success);
  return qr.rank();
}

}  // namespace

TEMPLATE_TEST_CASE("Eigen finds that boundaries have none, and the Betti numbers of spaces", "[reductions][twin]",
                   Integers, Rationals) {
  const TestType ring;
  using Numbers = std::vector<Eigen::Index>;
  const std::vector<std::pair<ChainComplex<TestType>, Numbers>> spaces{
      {sphere(ring, 3), {1, 0, 0, 1}},     {torus(ring), {1, 2, 1}},
      {projective_plane(ring), {1, 0, 0}}, {klein_bottle(ring), {1, 1, 0}},
      {dunce_hat(ring), {1, 0, 0}},        {moore_space(ring, 2, 5), {1, 0, 0, 0}},
      {lens_space(ring, 7), {1, 0, 0, 1}}, {projective_space(ring, 5), {1, 0, 0, 0, 0, 1}}};
  for (const auto& [complex, betti] : spaces) {
    Numbers found;
    for (int p = 0; p <= complex.top(); ++p) {
      const auto d = sparse::to_eigen<std::int64_t>(complex.boundary(p)).value();
      const auto next = sparse::to_eigen<std::int64_t>(complex.boundary(p + 1)).value();
      CHECK(Eigen::SparseMatrix<std::int64_t>{(d * next).pruned()}.nonZeros() == 0);
      found.push_back(complex.size(p) - rank(complex, p) - rank(complex, p + 1));
    }
    CHECK(found == betti);
  }
}

#include "sparse/determinant_bounds.hpp"

#include <cmath>
#include <limits>

#include "sparse/smith.hpp"
#include "tests/sparse/dense.hpp"
#include "tests/support/catch.hpp"

using namespace sesame::sparse;

namespace {

ApproximateMatrix approximate(const Dense& dense) {
  ApproximateMatrix result{dense.rows, {}, 0};
  for (const std::int64_t entry : dense.entries) {
    result.entries.push_back(static_cast<double>(entry));
  }
  return result;
}

}  // namespace

TEST_CASE("the determinant is within its bounds, and a singular matrix has none", "[sparse][twin]") {
  int regular = 0, singular = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    Random random{seed};
    const Index n = 1 + below(random, 8);
    const Dense dense = random_dense(random, n, n, 1 + below(random, 3));
    Integer determinant = 1;
    const auto factors = invariant_factors_by_elimination(to_sparse(Integers{}, dense));
    for (const Integer& factor : factors) {
      determinant *= factor;
    }
    CAPTURE(seed, determinant.to_string());
    const auto bounds = log_determinant(approximate(dense));
    if (factors.size() < n) {
      REQUIRE(!bounds);
      ++singular;
    } else {
      const double exact = std::log(static_cast<double>(*determinant.to_int64()));
      REQUIRE(bounds);
      REQUIRE(bounds->lower <= exact);
      REQUIRE(exact <= bounds->upper);
      REQUIRE(bounds->upper - bounds->lower < 1e-9);
      ++regular;
    }
  }
  CHECK(regular > 100);
  CHECK(singular > 50);
}

TEST_CASE("bounds of a determinant widen with what is not known of the entries", "[sparse]") {
  ApproximateMatrix matrix{2, {3, 1, 1, 2}, 0};
  const auto exact = log_determinant(matrix);
  matrix.relative_error = 0.01;
  const auto rough = log_determinant(matrix);
  REQUIRE(exact);
  REQUIRE(rough);
  // All entries within one per cent: between 2.97 * 1.98 - 1.01^2 and 3.03 * 2.02 - 0.99^2.
  CHECK(rough->lower <= std::log(2.97 * 1.98 - 1.01 * 1.01));
  CHECK(rough->upper >= std::log(3.03 * 2.02 - 0.99 * 0.99));
  CHECK(exact->upper - exact->lower < 1e-9);
  matrix.relative_error = 1;
  CHECK(!log_determinant(matrix));
}

TEST_CASE("where doubles cannot tell there are no bounds", "[sparse]") {
  const Index n = 14;  // Hilbert's matrix, whose condition is about 1e19
  ApproximateMatrix hilbert{n, {}, 0x1p-53};
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      hilbert.entries.push_back(1.0 / (i + j + 1));
    }
  }
  CHECK(!log_determinant(hilbert));
  CHECK(!log_determinant({1, {std::numeric_limits<double>::quiet_NaN()}, 0}));
  CHECK(!log_determinant({2, {std::numeric_limits<double>::infinity(), 0, 0, 1}, 0}));
  CHECK(!log_determinant({2, {1e308, 1e308, 1e308, -1e308}, 0}));
  REQUIRE(log_determinant({}));
  CHECK(log_determinant({})->upper == 0);
}

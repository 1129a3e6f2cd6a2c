#include "sparse/eigen.hpp"

#include "tests/sparse/dense.hpp"
#include "tests/support/catch.hpp"

using namespace sesame::sparse;

namespace {

/// A column matrix of one entry.
template <Ring R>
Matrix<R> entry(const R& ring, const typename R::Element& value) {
  Matrix<R> matrix(ring, 1, 0);
  matrix.append_column(Terms<R>{{0, value}});
  return matrix;
}

Integer power_of_two(int exponent) {
  Integer power = 1;
  for (int k = 0; k < exponent; ++k) {
    power *= 2;
  }
  return power;
}

template <Scalar S>
bool holds(const Integer& n) {
  const auto found = to_eigen<S>(entry(Integers{}, n));
  return found.has_value() && from_eigen(Integers{}, found->template cast<std::int64_t>().eval()).entry(0, 0) == n;
}

}  // namespace

TEMPLATE_TEST_CASE("a matrix is the same after a way to Eigen and back", "[sparse][law]", Integers, Z2, Zp, Rationals) {
  const auto ring = sample_ring<TestType>();
  Random random{GENERATE(range(0u, 50u))};
  const auto [sparse, dense] = random_pair(ring, random, below(random, 9), below(random, 9),
                                           below(random, 2) == 0 ? Rest::zero : Rest::identity, 3);
  const auto words = to_eigen<std::int64_t>(sparse);
  REQUIRE(words.has_value());
  CHECK(from_eigen(ring, *words) == sparse);
  const auto reals = to_eigen<double>(sparse);
  REQUIRE(reals.has_value());
  CHECK(reals->isCompressed());
  CHECK(static_cast<std::size_t>(reals->nonZeros()) == sparse.nonzeros());
  REQUIRE(reals->rows() == sparse.rows());
  REQUIRE(reals->cols() == sparse.columns());
  for (Index i = 0; i < sparse.rows(); ++i) {
    for (Index j = 0; j < sparse.columns(); ++j) {
      CHECK(Integer{static_cast<std::int64_t>(reals->coeff(i, j))} == ring.to_integer(sparse.entry(i, j)));
    }
  }
}

TEST_CASE("an integer becomes a number of Eigen's only when it stays exact", "[sparse]") {
  const Integer word = power_of_two(63);
  CHECK(holds<std::int64_t>(word - 1));
  CHECK(holds<std::int64_t>(-word));
  CHECK_FALSE(holds<std::int64_t>(word));
  CHECK_FALSE(holds<std::int64_t>(-word - 1));
  CHECK(holds<int>(power_of_two(31) - 1));
  CHECK_FALSE(holds<int>(power_of_two(31)));
  for (const int sign : {1, -1}) {
    CHECK(holds<double>(power_of_two(53) * sign));
    CHECK_FALSE(holds<double>((power_of_two(53) + 1) * sign));
    CHECK_FALSE(holds<double>(power_of_two(200) * sign));
  }
}

TEST_CASE("a fraction becomes the nearest double, and no integer", "[sparse]") {
  const auto third = entry(Rationals{}, Rational{1, 3});
  CHECK(to_eigen<double>(third)->coeff(0, 0) == 1.0 / 3.0);
  const auto refused = to_eigen<std::int64_t>(third);
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().code == sesame::Errc::refused);
  CHECK(refused.error().what.starts_with("the entry in row 0, column 0 is 1/3, which is no number"));
}

TEST_CASE("a matrix that Eigen's int cannot count is refused", "[sparse]") {
  const auto refused = to_eigen<double>(Matrix<Integers>(Integers{}, Index{1} << 31, 0));
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().what.ends_with("this one has 2147483648, 0 and 0"));
}

#include "sparse/rational_span.hpp"

#include "sparse/smith.hpp"
#include "tests/sparse/dense.hpp"
#include "tests/support/catch.hpp"

using namespace sesame::sparse;

namespace {

std::vector<Terms<Integers>> columns_of(const Matrix<Integers>& matrix) {
  std::vector<Terms<Integers>> columns;
  for (Index j = 0; j < matrix.columns(); ++j) {
    columns.push_back(matrix.column(j));
  }
  return columns;
}

}  // namespace

TEST_CASE("a rational span has the vectors that do not raise the rank", "[sparse][twin]") {
  int members = 0, others = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    Random random{seed};
    const Index rows = 1 + below(random, 9);
    const auto matrix = to_sparse(Integers{}, random_dense(random, rows, below(random, 9), 1 + below(random, 4)));
    const auto span = RationalSpan::of(rows, columns_of(matrix));
    REQUIRE(span);
    const std::size_t rank = invariant_factors_by_elimination(matrix).size();
    for (int k = 0; k < 8; ++k) {
      // A combination, perhaps with one more entry, perhaps divided by what all entries have in common.
      Terms<Integers> v;
      for (Index j = 0; j < matrix.columns(); ++j) {
        add_multiple<Integers>(Integers{}, v, static_cast<int>(below(random, 7)) - 3, matrix.column(j));
      }
      if (k % 2 == 1) {
        const Terms<Integers> more{{below(random, rows), 1}};
        add_multiple<Integers>(Integers{}, v, 1, more);
      }
      Integer divisor = 0;
      for (const auto& term : v) {
        divisor = gcd(divisor, term.coefficient);
      }
      for (auto& term : v) {
        term.coefficient = divide(term.coefficient, divisor).quotient;
      }
      Matrix<Integers> with = matrix;
      with.append_column(v);
      const bool is_in = invariant_factors_by_elimination(with).size() == rank;
      CHECK(span->contains(v) == is_in);
      ++(is_in ? members : others);
    }
  }
  CHECK(members > 800);
  CHECK(others > 500);
}

TEST_CASE("a rational span is not taken for one of its rank modulo the prime", "[sparse]") {
  const Terms<Integers> zero_modulo{{0, 1073741827}};  // the prime after 2^30
  CHECK_FALSE(RationalSpan::of(2, {zero_modulo}));
  const auto nothing = RationalSpan::of(2, {});
  REQUIRE(nothing);
  CHECK(nothing->contains({}));
  CHECK_FALSE(nothing->contains(zero_modulo));
  CHECK_FALSE(RationalSpan::of(40, {{{0, 1}}}));  // it would need many functionals
}

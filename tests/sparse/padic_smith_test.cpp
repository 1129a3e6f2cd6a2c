#include "sparse/padic_smith.hpp"

#include <algorithm>
#include <array>

#include "sparse/smith.hpp"
#include "tests/sparse/dense.hpp"
#include "tests/support/catch.hpp"

using namespace sesame::sparse;

namespace {

using Factors = std::vector<Integer>;
using Columns = std::vector<Terms<Integers>>;

Matrix<Integers> matrix_of(Index rows, const Columns& columns) {
  Matrix<Integers> matrix(Integers{}, rows, 0);
  for (const auto& column : columns) {
    matrix.append_column(column);
  }
  return matrix;
}

Columns columns_of(const Matrix<Integers>& matrix) {
  Columns columns;
  for (Index j = 0; j < matrix.columns(); ++j) {
    columns.push_back(matrix.column(j));
  }
  return columns;
}

/// Products of elementary matrices on both sides.
Columns disguised(Random& random, Index rows, Columns columns, int moves) {
  const Integers ring;
  for (int k = 0; k < moves; ++k) {
    const Index n = static_cast<Index>(columns.size());
    if (n > 1) {
      const Index to = below(random, n), from = (to + 1 + below(random, n - 1)) % n;
      add_multiple<Integers>(ring, columns[to], Integer{static_cast<int>(below(random, 5)) - 2}, columns[from]);
    }
    const Index to = below(random, rows), from = below(random, rows);
    if (to != from) {
      const Integer factor{static_cast<int>(below(random, 5)) - 2};
      for (auto& column : columns) {
        if (const auto* entry = find_term<Integers>(column, from)) {
          const Terms<Integers> more{{to, entry->coefficient}};
          add_multiple<Integers>(ring, column, factor, more);
        }
      }
    }
  }
  return columns;
}

Columns diagonal(const Factors& factors, Index columns) {
  Columns result(columns);
  for (Index k = 0; k < factors.size(); ++k) {
    result[k] = {{k, factors[k]}};
  }
  return result;
}

Integer power(std::int64_t base, int exponent) {
  Integer result = 1;
  for (int k = 0; k < exponent; ++k) {
    result *= base;
  }
  return result;
}

}  // namespace

TEST_CASE("p-adic lifting finds the invariant factors that elimination finds, for all shapes and ranks",
          "[sparse][twin]") {
  int answered = 0, deficient = 0;
  for (unsigned seed = 0; seed < 600; ++seed) {
    Random random{seed};
    const Index rows = 1 + below(random, 9), columns = 1 + below(random, 9);
    Dense dense = random_dense(random, rows, columns, 1 + below(random, 4));
    if (below(random, 2) == 0) {  // a product has a smaller rank, and more torsion
      const Index rank = 1 + below(random, 5);
      dense = product(random_dense(random, rows, rank, 1), random_dense(random, rank, columns, 1));
    }
    const auto matrix = to_sparse(Integers{}, dense);
    const Factors expected = invariant_factors_by_elimination(matrix);
    CAPTURE(seed, rows, columns);
    if (const auto found = padic_invariant_factors(rows, columns_of(matrix))) {
      REQUIRE(*found == expected);
      ++answered;
      deficient += expected.size() < std::min(rows, columns) ? 1 : 0;
    } else {
      REQUIRE(expected.empty());
    }
  }
  CHECK(answered > 500);
  CHECK(deficient > 100);
}

TEST_CASE("p-adic lifting finds the factors that a matrix was made of", "[sparse]") {
  Random random{GENERATE(range(0u, 40u))};
  const Index rows = 6 + below(random, 30), columns = 6 + below(random, 30);
  const Index rank = 1 + below(random, std::min(rows, columns));
  Factors factors(rank, Integer{1});
  Integer factor = 1;
  for (Index k = rank - std::min<Index>(rank, 4); k < rank; ++k) {  // each divides the next
    factor *= std::array<Integer, 6>{1, 2, 9, 12, power(7, 11), power(2, 61) * 15 + 1}[below(random, 6)];
    factors[k] = factor;
  }
  const Columns matrix = disguised(random, rows, diagonal(factors, columns), 60);
  CAPTURE(rows, columns, rank);
  const auto found = padic_invariant_factors(rows, matrix);
  CHECK((!found || *found == factors));
  CHECK(invariant_factors(matrix_of(rows, matrix)) == factors);
}

TEST_CASE("p-adic lifting tells prime powers apart, and gives up where they are too high for machine words",
          "[sparse]") {
  Random random{GENERATE(range(0u, 12u))};
  const std::int64_t p = std::array{2, 3, 65537}[below(random, 3)];
  const bool too_high = below(random, 3) == 0;
  Factors factors(8, Integer{1});
  const int least = too_high ? 40 : 1;
  factors[5] = power(p, least);
  factors[6] = power(p, least);
  factors[7] = power(p, least + 1) * 1'000'003;
  const auto found = padic_invariant_factors(8, disguised(random, 8, diagonal(factors, 8), 30));
  CAPTURE(p, too_high);
  CHECK(found.has_value() == !too_high);
  CHECK((!found || *found == factors));
}

TEST_CASE("a large matrix whose elimination would grow has the factors that it was made of", "[sparse]") {
  Random random{GENERATE(range(0u, 4u))};
  const Index n = 60 + below(random, 20);
  const Index rank = n - below(random, 3);
  Factors factors(rank, Integer{1});
  factors[rank - 2] = 6;
  factors[rank - 1] = Integer{6} * 1'000'003 * 998'244'353;
  const Columns matrix = disguised(random, n, diagonal(factors, n), 1500);
  CHECK(padic_invariant_factors(n, matrix) == factors);
  CHECK(invariant_factors(matrix_of(n, matrix)) == factors);
}

TEST_CASE("p-adic lifting leaves a zero matrix and empty ones alone", "[sparse]") {
  CHECK(!padic_invariant_factors(3, Columns(2)));
  CHECK(!padic_invariant_factors(0, {}));
  CHECK(!padic_invariant_factors(4, {}));
}

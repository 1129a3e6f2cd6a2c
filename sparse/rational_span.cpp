#include "sparse/rational_span.hpp"

#include <flint/ulong_extras.h>

#include <algorithm>

#include "sparse/flint_owners.hpp"

namespace sesame::sparse {

namespace {

constexpr std::size_t most_functionals = 12;

}  // namespace

std::optional<RationalSpan> RationalSpan::of(Index rows, const std::vector<Vector>& columns) {
  Block matrix(rows, columns.size());
  for (std::size_t j = 0; j < columns.size(); ++j) {
    for (const Term<Integers>& term : columns[j]) {
      set(matrix.at(term.index, j), term.coefficient);
    }
  }
  // 1. Rows and columns of a nonsingular block. The upper factor is in echelon form.
  ModularMatrix reduced(matrix, n_nextprime(1UL << 30U, 1));
  std::vector<slong> order(rows);
  const auto rank = static_cast<std::size_t>(nmod_mat_lu(order.data(), reduced, 0));
  if (rows - rank > most_functionals) {
    return std::nullopt;
  }
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0, j = 0; i < rank; ++i, ++j) {
    while (reduced.row(i)[j] == 0) {
      ++j;
    }
    chosen.push_back(j);
  }
  // 2. The other rows as combinations of these, on these columns.
  const std::size_t others = rows - rank;
  Block functionals(others, rows);
  const auto of_row = [&](std::size_t k, std::size_t i) {
    return functionals.at(k, static_cast<std::size_t>(order[i]));
  };
  if (others > 0 && rank > 0) {
    Block block(rank, rank), right(rank, others), solutions(rank, others);
    for (std::size_t j = 0; j < rank; ++j) {
      for (std::size_t i = 0; i < rows; ++i) {
        fmpz* to = i < rank ? block.at(j, i) : right.at(j, i - rank);
        fmpz_set(to, matrix.at(static_cast<std::size_t>(order[i]), chosen[j]));
      }
    }
    Number denominator;
    if (fmpz_mat_solve_dixon_den(solutions, denominator, block, right) == 0) {
      return std::nullopt;
    }
    for (std::size_t k = 0; k < others; ++k) {
      Number divisor = denominator;
      for (std::size_t i = 0; i < rank && fmpz_is_one(divisor) == 0; ++i) {
        fmpz_gcd(divisor, divisor, solutions.at(i, k));
      }
      for (std::size_t i = 0; i < rank; ++i) {
        fmpz_divexact(of_row(k, i), solutions.at(i, k), divisor);
        fmpz_neg(of_row(k, i), of_row(k, i));
      }
      fmpz_divexact(of_row(k, rank + k), denominator, divisor);
    }
  } else {
    for (std::size_t k = 0; k < others; ++k) {
      fmpz_one(of_row(k, rank + k));
    }
  }
  // 3. On all columns, lest the rank is larger.
  Number sum;
  for (std::size_t k = 0; k < others; ++k) {
    for (std::size_t j = 0; j < columns.size(); ++j) {
      fmpz_zero(sum);
      for (const Term<Integers>& term : columns[j]) {
        fmpz_addmul(sum, functionals.at(k, term.index), matrix.at(term.index, j));
      }
      if (fmpz_is_zero(sum) == 0) {
        return std::nullopt;
      }
    }
  }
  RationalSpan span;
  for (std::size_t k = 0; k < others; ++k) {
    std::vector<Integer>& functional = span.functionals_.emplace_back();
    for (std::size_t i = 0; i < rows; ++i) {
      functional.push_back(to_integer(functionals.at(k, i)));
    }
  }
  return span;
}

bool RationalSpan::contains(const Vector& v) const {
  const Integers ring;
  return std::all_of(functionals_.begin(), functionals_.end(), [&](const std::vector<Integer>& functional) {
    Integer sum = 0;
    for (const Term<Integers>& term : v) {
      ring.add_product(sum, functional[term.index], term.coefficient);
    }
    return sum.is_zero();
  });
}

}  // namespace sesame::sparse

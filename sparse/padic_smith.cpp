#include "sparse/padic_smith.hpp"

#include <flint/nmod_vec.h>
#include <flint/ulong_extras.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sparse/determinant_bounds.hpp"
#include "sparse/flint_owners.hpp"

namespace sesame::sparse {
namespace {

// ------------------------------------------------------------------------------------------------------ the matrices

using Lines = std::vector<std::size_t>;  ///< of rows, or of columns

/// Rows and columns of a block that is nonsingular, and the others.
struct Choice {
  Lines rows, other_rows, columns, other_columns;
};

Lines others(const Lines& chosen, std::size_t n) {
  std::vector<bool> is_chosen(n);
  for (const std::size_t i : chosen) {
    is_chosen[i] = true;
  }
  Lines rest;
  for (std::size_t i = 0; i < n; ++i) {
    if (!is_chosen[i]) {
      rest.push_back(i);
    }
  }
  return rest;
}

/// A largest block that is nonsingular modulo a prime, hence over Z.
Choice nonsingular_block(const Block& matrix, ulong prime) {
  ModularMatrix reduced(matrix, prime);
  std::vector<slong> order(matrix.rows());
  const auto rank = static_cast<std::size_t>(nmod_mat_lu(order.data(), reduced, 0));
  Choice choice;
  std::size_t column = 0;
  for (std::size_t i = 0; i < rank; ++i) {  // the upper factor is in echelon form
    while (reduced.row(i)[column] == 0) {
      ++column;
    }
    choice.columns.push_back(column++);
    choice.rows.push_back(static_cast<std::size_t>(order[i]));
  }
  choice.other_rows = others(choice.rows, matrix.rows());
  choice.other_columns = others(choice.columns, matrix.columns());
  return choice;
}

void copy(const Block& from, const Lines& rows, const Lines& columns, Block& to) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < columns.size(); ++j) {
      fmpz_set(to.at(i, j), from.at(rows[i], columns[j]));
    }
  }
}

/// The common denominator of a column of numerators, divided by `denominator`.
Number denominator_of(const Block& numerators, std::size_t column, const Number& denominator) {
  Number divisor = denominator;
  for (std::size_t i = 0; i < numerators.rows() && fmpz_is_one(divisor) == 0; ++i) {
    fmpz_gcd(divisor, divisor, numerators.at(i, column));
  }
  Number reduced;
  fmpz_divexact(reduced, denominator, divisor);
  return reduced;
}

double logarithm(const fmpz* value) {
  slong exponent = 0;
  const double mantissa = fmpz_get_d_2exp(&exponent, value);
  return std::log(std::abs(mantissa)) + static_cast<double>(exponent) * std::log(2.0);
}

ApproximateMatrix approximate(const Block& block) {
  ApproximateMatrix result;
  result.size = block.rows();
  result.relative_error = 0x1p-51;  // of fmpz_get_d, which cuts off
  result.entries.reserve(block.rows() * block.rows());
  for (std::size_t i = 0; i < block.rows(); ++i) {
    for (std::size_t j = 0; j < block.rows(); ++j) {
      result.entries.push_back(fmpz_get_d(block.at(i, j)));
    }
  }
  return result;
}

/// The valuations, not more than `most` each, of the diagonal entries of the Smith form at a prime p; those that are
/// divided by a higher power are left out. By elimination modulo p^(most + 1), one valuation after the other.
std::vector<int> local_valuations(const Block& matrix, ulong p, int most) {
  ulong modulus = n_pow(p, static_cast<ulong>(most) + 1);
  ModularMatrix reduced(matrix, modulus);
  const std::size_t width = matrix.columns();
  std::vector<ulong*> rows;
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    rows.push_back(reduced.row(i));
  }
  std::vector<int> valuations;
  std::size_t done = 0;  // rows that have a pivot
  for (int valuation = 0; valuation <= most && done < rows.size(); ++valuation) {
    nmod_t ring;
    nmod_init(&ring, modulus);
    // A column without units keeps none: the rows that are added to others have none in it either.
    for (std::size_t j = 0; j < width && done < rows.size(); ++j) {
      const auto at = std::find_if(rows.begin() + static_cast<std::ptrdiff_t>(done), rows.end(),
                                   [&](const ulong* row) { return row[j] % p != 0; });
      if (at == rows.end()) {
        continue;
      }
      std::iter_swap(at, rows.begin() + static_cast<std::ptrdiff_t>(done));
      const ulong* pivot = rows[done++];
      const ulong inverse = n_invmod(pivot[j], modulus);
      for (std::size_t i = done; i < rows.size(); ++i) {
        if (rows[i][j] != 0) {
          const ulong factor = nmod_neg(nmod_mul(rows[i][j], inverse, ring), ring);
          _nmod_vec_scalar_addmul_nmod(rows[i], pivot, static_cast<slong>(width), factor, ring);
        }
      }
      valuations.push_back(valuation);
    }
    modulus /= p;
    for (std::size_t i = done; i < rows.size(); ++i) {
      std::transform(rows[i], rows[i] + width, rows[i], [p](ulong entry) { return entry / p; });
    }
  }
  return valuations;
}

// --------------------------------------------------------------------------------------------------- the computation

/// Number by number what the header says, for a matrix M whose further rows or columns are none or no more than the
/// other ones are.
class Lifting {
 public:
  Lifting(const Block& matrix, Choice choice)
      : matrix_{matrix}, choice_{std::move(choice)}, size_{choice_.rows.size()}, block_{size_, size_} {
    copy(matrix_, choice_.rows, choice_.columns, block_);
  }

  std::optional<std::vector<Integer>> factors() {
    if (!solve() || !find_delta()) {
      return std::nullopt;
    }
    std::vector<Number> result(size_, Number{1});
    n_factor_t primes;
    n_factor_init(&primes);
    n_factor(&primes, delta_, 1);
    Number cyclic = denominator_;
    for (int k = 0; k < primes.num; ++k) {
      const ulong p = primes.p[k];
      if (!multiply_local(p, primes.exp[k], result)) {
        return std::nullopt;
      }
      Number power{p};
      fmpz_remove(cyclic, cyclic, power);
    }
    for (const Number& order : {order_on_other_rows(), order_of_other_columns()}) {
      Number common;
      fmpz_gcd(common, order, cyclic);  // at the primes of delta this says nothing
      fmpz_divexact(cyclic, cyclic, common);
    }
    fmpz_mul(result.back(), result.back(), cyclic);
    std::vector<Integer> factors;
    for (const Number& factor : result) {
      factors.push_back(to_integer(factor));
    }
    return factors;
  }

 private:
  /// The solutions for the further columns, and for two right sides at random; false when the rank is larger after all.
  bool solve() {
    const std::size_t further = choice_.other_columns.size();
    Block right(size_, further + 2);
    copy(matrix_, choice_.rows, choice_.other_columns, right);
    ulong state = 1;  // the same each time: what is found does not depend on it, but what is left to delta does
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t j = further; j < further + 2; ++j) {
        state = state * 6364136223846793005UL + 1442695040888963407UL;
        fmpz_set_si(right.at(i, j), static_cast<slong>(state >> 54U) - 512);
      }
    }
    if (fmpz_mat_solve_dixon_den(solutions_, common_, block_, right) == 0) {
      return false;
    }
    if (further > 0 && !holds_on_other_rows(further)) {
      return false;
    }
    find_generator(further);
    return true;
  }

  bool holds_on_other_rows(std::size_t further) {
    const Lines& rows = choice_.other_rows;
    Block values(rows.size(), further + 2);
    Block below(rows.size(), size_);
    copy(matrix_, rows, choice_.columns, below);
    fmpz_mat_mul(values, below, solutions_);
    Number product;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t j = 0; j < further; ++j) {
        fmpz_mul(product, matrix_.at(rows[i], choice_.other_columns[j]), common_);
        if (fmpz_equal(product, values.at(i, j)) == 0) {
          return false;
        }
      }
    }
    return true;
  }

  /// A combination of the last two solutions whose denominator is that of both.
  void find_generator(std::size_t further) {
    const Number first = denominator_of(solutions_, further, common_);
    const Number second = denominator_of(solutions_, further + 1, common_);
    fmpz_lcm(denominator_, first, second);
    for (std::size_t i = 0; i < size_; ++i) {
      fmpz_set(generator_.at(i, 0), solutions_.at(i, further));
    }
    for (int tries = 0; fmpz_equal(denominator_of(generator_, 0, common_), denominator_) == 0; ++tries) {
      expects(tries < 1000, "two elements of a finite group have a sum of multiples of the order of both");
      for (std::size_t i = 0; i < size_; ++i) {
        fmpz_add(generator_.at(i, 0), generator_.at(i, 0), solutions_.at(i, further + 1));
      }
    }
  }

  bool find_delta() {
    if (const auto bounds = log_determinant(approximate(block_))) {
      const double log_of_denominator = logarithm(denominator_);
      const double slack = 1e-9;  // of the logarithm, of less than 1e5, and of the exponentials
      const double least = std::exp(bounds->lower - log_of_denominator - slack);
      const double most = std::exp(bounds->upper - log_of_denominator + slack);
      if (most < 1e6 && std::floor(most) - std::ceil(least) < 0.5) {
        delta_ = static_cast<ulong>(std::floor(most));
        return delta_ > 0;
      }
    }
    Number determinant;
    fmpz_mat_det_modular_given_divisor(determinant, block_, denominator_, 1);
    fmpz_abs(determinant, determinant);
    fmpz_divexact(determinant, determinant, denominator_);
    if (fmpz_abs_fits_ui(determinant) == 0) {
      return false;
    }
    delta_ = fmpz_get_ui(determinant);
    return true;
  }

  /// Multiplies the last factors by their parts at a prime that divides delta.
  bool multiply_local(ulong p, int in_delta, std::vector<Number>& result) const {
    Number rest, prime{p};
    const auto most = static_cast<int>(fmpz_remove(rest, denominator_, prime)) + in_delta;
    if (std::log2(static_cast<double>(p)) * (most + 1) > 62) {
      return false;
    }
    const std::vector<int> valuations = local_valuations(matrix_, p, most);
    expects(valuations.size() == size_, "the torsion at a prime divides the determinant of a block");
    for (std::size_t k = 0; k < size_; ++k) {
      fmpz_mul_ui(result[k], result[k], n_pow(p, static_cast<ulong>(valuations[k])));
    }
    return true;
  }

  Number order_on_other_rows() const {
    Block below(choice_.other_rows.size(), size_);
    copy(matrix_, choice_.other_rows, choice_.columns, below);
    Block values(choice_.other_rows.size(), 1);
    fmpz_mat_mul(values, below, generator_);
    return denominator_of(values, 0, common_);
  }

  Number order_of_other_columns() const {
    Number order{1};
    for (std::size_t j = 0; j < choice_.other_columns.size(); ++j) {
      fmpz_lcm(order, order, denominator_of(solutions_, j, common_));
    }
    return order;
  }

  const Block& matrix_;
  Choice choice_;
  std::size_t size_;
  Block block_;
  Block solutions_{size_, choice_.other_columns.size() + 2};  ///< numerators
  Number common_;                                             ///< their denominator
  Block generator_{size_, 1};                                 ///< x, over the same denominator
  Number denominator_;                                        ///< of x
  ulong delta_ = 0;
};

}  // namespace

std::optional<std::vector<Integer>> padic_invariant_factors(Index rows, const std::vector<Terms<Integers>>& columns) {
  Block matrix(rows, columns.size());
  for (std::size_t j = 0; j < columns.size(); ++j) {
    for (const Term<Integers>& term : columns[j]) {
      set(matrix.at(term.index, j), term.coefficient);
    }
  }
  ulong prime = 1UL << 62U;
  for (int tries = 0; tries < 3; ++tries) {
    prime = n_nextprime(prime, 1);
    Choice choice = nonsingular_block(matrix, prime);
    if (choice.rows.empty()) {
      continue;
    }
    std::optional<std::vector<Integer>> factors;
    if (choice.other_columns.size() > choice.other_rows.size()) {
      Block transposed(columns.size(), rows);
      fmpz_mat_transpose(transposed, matrix);
      std::swap(choice.rows, choice.columns);
      std::swap(choice.other_rows, choice.other_columns);
      factors = Lifting(transposed, std::move(choice)).factors();
    } else {
      factors = Lifting(matrix, std::move(choice)).factors();
    }
    if (factors) {
      return factors;
    }
  }
  return std::nullopt;
}

}  // namespace sesame::sparse

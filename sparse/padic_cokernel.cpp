#include "sparse/padic_cokernel.hpp"

#include <flint/ulong_extras.h>

#include <algorithm>
#include <utility>

#include "sparse/contract.hpp"
#include "sparse/flint_owners.hpp"
#include "sparse/padic_smith.hpp"
#include "sparse/smith.hpp"

namespace sesame::sparse {

namespace {

using Vector = PadicCokernel::Vector;
using Row = std::vector<Integer>;

constexpr std::size_t most_summands = 4;
const Integers ring;

Block to_block(std::size_t rows, const std::vector<Vector>& columns) {
  Block block(rows, columns.size());
  for (std::size_t j = 0; j < columns.size(); ++j) {
    for (const Term<Integers>& term : columns[j]) {
      set(block.at(term.index, j), term.coefficient);
    }
  }
  return block;
}

Integer remainder(const Integer& a, const Integer& order) { return divide(a, order).remainder; }

/// A sequence that only looks random: the same each time.
class Chance {
 public:
  std::size_t below(std::size_t bound) {
    state_ = state_ * 6364136223846793005UL + 1442695040888963407UL;
    return static_cast<std::size_t>(state_ >> 33U) % bound;
  }

 private:
  std::uint64_t state_ = 1;
};

/// The images of the unit vectors under a homomorphism to (Z/d)^k.
struct Images {
  Integer d;
  std::vector<Row> of_units;  ///< by unit vector
};

/// W A = right sides at random, times the denominator.
std::optional<Images> random_images(const Block& transposed, std::size_t k, Chance& chance) {
  const std::size_t n = transposed.rows();
  Block right(n, k), solutions(n, k);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < k; ++j) {
      fmpz_set_si(right.at(i, j), static_cast<slong>(chance.below(1024)) - 512);
    }
  }
  Number denominator;
  if (fmpz_mat_solve_dixon_den(solutions, denominator, transposed, right) == 0) {
    return std::nullopt;
  }
  fmpz_abs(denominator, denominator);
  Images images{to_integer(denominator), {}};
  for (std::size_t i = 0; i < n; ++i) {
    Row row;
    for (std::size_t j = 0; j < k; ++j) {
      fmpz_mod(solutions.at(i, j), solutions.at(i, j), denominator);
      row.push_back(to_integer(solutions.at(i, j)));
    }
    images.of_units.push_back(std::move(row));
  }
  return images;
}

/// k vectors, each the sum of at most `most` unit vectors at random.
std::vector<Vector> random_vectors(std::size_t n, std::size_t k, std::size_t most, Chance& chance) {
  std::vector<Vector> vectors(k);
  for (Vector& vector : vectors) {
    RawTerms<Integers> sum;
    for (std::size_t terms = 1 + chance.below(most); terms > 0; --terms) {
      sum.push_back({static_cast<Index>(chance.below(n)), 1});
    }
    vector = std::move(sum).normal(ring);
  }
  return vectors;
}

/// The k x n matrix of columns.
Matrix<Integers> to_matrix(std::size_t k, const std::vector<Row>& columns) {
  Matrix<Integers> matrix(ring, static_cast<Index>(k), 0);
  for (const Row& column : columns) {
    Vector terms;
    for (Index i = 0; i < k; ++i) {
      if (!column[i].is_zero()) {
        terms.push_back({i, column[i]});
      }
    }
    matrix.append_column(terms);
  }
  return matrix;
}

/// The first k rows and some columns of a matrix.
Matrix<Integers> top(const Matrix<Integers>& matrix, Index k, Index from, Index to) {
  Matrix<Integers> result(ring, k, 0);
  for (Index j = from; j < to; ++j) {
    Vector column = matrix.column(j);
    std::erase_if(column, [k](const Term<Integers>& term) { return term.index >= k; });
    result.append_column(column);
  }
  return result;
}

/// Generators, and the coordinates in them of the unit vectors.
struct Summands {
  std::vector<Vector> generators;
  Matrix<Integers> coordinates;
};

/// What the vectors generate, when that is a group of this order.
std::optional<Summands> summands_of(const Images& images, const std::vector<Vector>& vectors, const Integer& order) {
  const auto k = static_cast<Index>(vectors.size());
  // 1. Their images, and d: the kernel of [images | d] are the relations.
  std::vector<Row> columns;
  for (const Vector& vector : vectors) {
    Row& image = columns.emplace_back(k, 0);
    for (const Term<Integers>& term : vector) {
      for (Index i = 0; i < k; ++i) {
        image[i] = remainder(image[i] + term.coefficient * images.of_units[term.index][i], images.d);
      }
    }
  }
  for (Index i = 0; i < k; ++i) {
    columns.emplace_back(k, 0)[i] = images.d;
  }
  const SmithForm<Integers> form = smith_form(to_matrix(k, columns));
  Integer generated = 1;
  for (const Integer& factor : form.factors) {
    generated = generated * divide(images.d, factor).quotient;
  }
  if (generated != order) {
    return std::nullopt;
  }
  // 2. The images of the unit vectors as combinations of theirs.
  Matrix<Integers> combinations = form.left * to_matrix(k, images.of_units);
  Matrix<Integers> divided(ring, k, 0);
  for (Index j = 0; j < combinations.columns(); ++j) {
    Vector column = combinations.column(j);
    for (Term<Integers>& term : column) {
      const Division by_factor = divide(term.coefficient, form.factors[term.index]);
      expects(by_factor.remainder.is_zero(), "vectors that generate a group as large as all generate all");
      term.coefficient = by_factor.quotient;
    }
    divided.append_column(column);
  }
  // 3. The relations, made diagonal.
  const SmithForm<Integers> relations = smith_form(top(form.right, k, k, 2 * k));
  Matrix<Integers> coordinates = relations.left * (top(form.right, k, 0, k) * divided);
  Summands summands{{}, Matrix<Integers>(ring, k, 0)};
  for (Index j = 0; j < k; ++j) {
    Vector generator;
    relations.left_inverse.for_each_in_column(j, [&](const Term<Integers>& term) {
      add_multiple<Integers>(ring, generator, term.coefficient, vectors[term.index]);
    });
    summands.generators.push_back(std::move(generator));
  }
  for (Index j = 0; j < coordinates.columns(); ++j) {
    RawTerms<Integers> column;
    for (const Term<Integers>& term : coordinates.column(j)) {
      column.push_back({term.index, remainder(term.coefficient, relations.factors[term.index])});
    }
    summands.coordinates.append_column(std::move(column).normal(ring));
  }
  return summands;
}

/// Puts short vectors in the place of generators: in that of the i-th one whose i-th coordinate is a unit modulo the
/// order s_i, and of which s_i times the other ones is zero. The last one is nearly always found, others where the
/// orders do not differ much.
void shorten(Summands& summands, const std::vector<Integer>& orders, Chance& chance) {
  constexpr int most_choices = 64;
  const std::size_t k = orders.size(), n = summands.coordinates.columns();
  const auto is_short = [](const Vector& v) {
    return std::all_of(v.begin(), v.end(), [](const Term<Integers>& term) { return term.coefficient.is_unit(); });
  };
  for (std::size_t i = k; i-- > 0;) {
    for (int choice = 0; choice < most_choices && !is_short(summands.generators[i]); ++choice) {
      const Vector vector = random_vectors(n, 1, choice < most_choices / 2 ? 1 : 3, chance).front();
      Row c(k, 0);
      for (const Term<Integers>& term : summands.coordinates.apply(vector)) {
        c[term.index] = remainder(term.coefficient, orders[term.index]);
      }
      const Bezout unit = extended_gcd(c[i], orders[i]);
      bool fits = unit.g == Integer{1};
      for (std::size_t j = 0; j < k; ++j) {
        fits = fits && remainder(c[j] * orders[i], orders[j]).is_zero();
      }
      if (!fits) {
        continue;
      }
      // x = y_i c + the other y_j: y_i = x_i / c_i, y_j = x_j - c_j y_i.
      Matrix<Integers> changed(ring, static_cast<Index>(k), 0);
      for (Index column = 0; column < n; ++column) {
        const Integer y = remainder(summands.coordinates.entry(static_cast<Index>(i), column) * unit.x, orders[i]);
        RawTerms<Integers> sum;
        for (std::size_t j = 0; j < k; ++j) {
          const auto row = static_cast<Index>(j);
          sum.push_back({row, j == i ? y : remainder(summands.coordinates.entry(row, column) - c[j] * y, orders[j])});
        }
        changed.append_column(std::move(sum).normal(ring));
      }
      summands.coordinates = std::move(changed);
      summands.generators[i] = vector;
    }
  }
}

}  // namespace

struct PadicCokernel::Parts {
  Block matrix;
  std::vector<Integer> orders;
  std::vector<Vector> generators;
  Matrix<Integers> coordinates;  ///< modulo the orders, of the unit vectors

  [[nodiscard]] Row coordinates_of(const Vector& v) const {
    Row row(orders.size(), 0);
    for (const Term<Integers>& term : coordinates.apply(v)) {
      row[term.index] = remainder(term.coefficient, orders[term.index]);
    }
    return row;
  }
  /// The y with A y = v. Requires: there is one.
  [[nodiscard]] Vector preimage(const Vector& v) const {
    const std::size_t n = matrix.rows();
    Block right(n, 1), solution(n, 1);
    for (const Term<Integers>& term : v) {
      set(right.at(term.index, 0), term.coefficient);
    }
    Number denominator;
    const bool is_solved = fmpz_mat_solve_dixon_den(solution, denominator, matrix, right) != 0;
    expects(is_solved, "a nonsingular system of equations has a solution");
    Vector preimage;
    for (std::size_t i = 0; i < n; ++i) {
      if (fmpz_is_zero(solution.at(i, 0)) == 0) {
        expects(fmpz_divisible(solution.at(i, 0), denominator) != 0, "what is zero in a cokernel is an image");
        fmpz_divexact(solution.at(i, 0), solution.at(i, 0), denominator);
        preimage.push_back({static_cast<Index>(i), to_integer(solution.at(i, 0))});
      }
    }
    return preimage;
  }
};

std::optional<PadicCokernel> PadicCokernel::of(const std::vector<Vector>& columns) {
  const std::size_t n = columns.size();
  std::optional<std::vector<Integer>> factors = padic_invariant_factors(static_cast<Index>(n), columns);
  if (!factors || factors->size() != n) {
    return std::nullopt;
  }
  std::erase_if(*factors, [](const Integer& factor) { return factor.is_unit(); });
  const std::size_t k = factors->size();
  if (k > most_summands) {
    return std::nullopt;
  }
  Integer order = 1;
  for (const Integer& factor : *factors) {
    order = order * factor;
  }
  Parts parts{to_block(n, columns), std::move(*factors), {}, Matrix<Integers>(ring, static_cast<Index>(k), 0)};
  std::optional<Summands> summands;
  if (k == 0) {
    summands = Summands{{}, Matrix<Integers>(ring, 0, static_cast<Index>(n))};
  }
  Block transposed(n, n);
  fmpz_mat_transpose(transposed, parts.matrix);
  constexpr int most_maps = 8, most_choices = 64;
  Chance chance;
  for (int map = 0; map < most_maps && !summands; ++map) {
    const std::optional<Images> images = random_images(transposed, k, chance);
    if (!images) {
      return std::nullopt;
    }
    if (!divide(images->d, parts.orders.back()).remainder.is_zero()) {
      continue;  // it is not injective
    }
    for (int choice = 0; choice < most_choices && !summands; ++choice) {
      summands = summands_of(*images, random_vectors(n, k, choice < most_choices / 2 ? 1 : 3, chance), order);
    }
  }
  if (!summands) {
    return std::nullopt;
  }
  shorten(*summands, parts.orders, chance);
  parts.generators = std::move(summands->generators);
  parts.coordinates = std::move(summands->coordinates);
  for (const Vector& column : columns) {
    const Row row = parts.coordinates_of(column);
    expects(std::all_of(row.begin(), row.end(), [](const Integer& a) { return a.is_zero(); }),
            "coordinates in a cokernel are zero on the columns");
  }
  for (std::size_t j = 0; j < k; ++j) {
    Row unit(k, 0);
    unit[j] = 1;
    expects(parts.coordinates_of(parts.generators[j]) == unit, "generators have unit vectors as coordinates");
  }
  PadicCokernel cokernel;
  cokernel.parts_ = std::make_shared<const Parts>(std::move(parts));
  return cokernel;
}

const std::vector<Integer>& PadicCokernel::orders() const { return parts_->orders; }

PadicCokernel::Generator PadicCokernel::generator(std::size_t k) const {
  Vector multiple;
  add_multiple<Integers>(ring, multiple, parts_->orders[k], parts_->generators[k]);
  return {parts_->generators[k], parts_->preimage(multiple)};
}

PadicCokernel::Class PadicCokernel::class_of(const Vector& v) const {
  Class result{parts_->coordinates_of(v), {}};
  Vector rest = v;
  for (std::size_t k = 0; k < result.coefficients.size(); ++k) {
    add_multiple<Integers>(ring, rest, -result.coefficients[k], parts_->generators[k]);
  }
  result.bounding = parts_->preimage(rest);
  return result;
}

bool is_independent_modulo_a_prime(Index rows, const std::vector<Terms<Integers>>& columns) {
  if (columns.empty()) {
    return true;
  }
  if (columns.size() > rows) {
    return false;
  }
  ModularMatrix reduced(to_block(rows, columns), n_nextprime(1UL << 62U, 1));
  return static_cast<std::size_t>(nmod_mat_rank(reduced)) == columns.size();
}

}  // namespace sesame::sparse

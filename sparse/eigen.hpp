/// \file
/// Matrices of ours as sparse matrices of Eigen's, and back: for what Eigen can do with a boundary, such as eigenvalues
/// of Laplacians. Header only: the library itself does without Eigen.
#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "sparse/matrix.hpp"
#include "sparse/result.hpp"

namespace sesame::sparse {

/// The numbers of a machine that an Eigen matrix may consist of: std::int64_t, double, int, ...
template <class S>
concept Scalar = std::signed_integral<S> || std::floating_point<S>;

/// The number, when a scalar of this type is exactly that.
template <Scalar S>
[[nodiscard]] std::optional<S> to_scalar(const Integer& number) {
  const std::optional<std::int64_t> word = number.to_int64();
  bool fits = word.has_value();
  if constexpr (std::integral<S>) {
    fits = fits && std::in_range<S>(*word);
  } else {
    constexpr std::int64_t most = std::int64_t{1} << std::min(std::numeric_limits<S>::digits, 62);
    fits = fits && -most <= *word && *word <= most;
  }
  return fits ? std::optional{static_cast<S>(*word)} : std::nullopt;
}

/// The same for a fraction: a floating-point number is the nearest one when numerator and denominator are exact.
template <Scalar S>
[[nodiscard]] std::optional<S> to_scalar(const Rational& number) {
  const std::optional<S> numerator = to_scalar<S>(number.numerator());
  if (!numerator || number.is_integer()) {
    return numerator;
  }
  const std::optional<S> denominator = to_scalar<S>(number.denominator());
  return std::floating_point<S> && denominator ? std::optional{*numerator / *denominator} : std::nullopt;
}

/// The matrix as one of Eigen's: `to_eigen<double>(complex.boundary(1))`.
///
/// Shape     That of the matrix, by columns, compressed. Implicit units are written out.
/// Entries   Over Z the integers; over Z/p their representatives from 0 to p - 1; over Q integers, or, when S is a
///           floating-point type, the nearest numbers to fractions. No integer is rounded.
/// Errors    refused: an entry is no S, such as one beyond 2^53 for double, or a fraction for std::int64_t (the first
///           one, by columns, is named); more than 2^31 - 1 rows, columns or entries, which Eigen counts by int.
/// Cost      O(rows + columns + nonzeros), time and memory.
template <Scalar S, Ring R>
[[nodiscard]] Result<Eigen::SparseMatrix<S>> to_eigen(const Matrix<R>& matrix) {
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<int>::max());
  const std::size_t nonzeros = matrix.nonzeros();
  if (std::max({std::size_t{matrix.rows()}, std::size_t{matrix.columns()}, nonzeros}) > most) {
    return Error{Errc::refused, "a matrix of Eigen's has up to " + std::to_string(most) +
                                    " rows, columns and entries; this one has " + std::to_string(matrix.rows()) + ", " +
                                    std::to_string(matrix.columns()) + " and " + std::to_string(nonzeros)};
  }
  Eigen::SparseMatrix<S> result(matrix.rows(), matrix.columns());
  result.reserve(static_cast<Eigen::Index>(nonzeros));
  std::optional<Error> error;
  for (Index j = 0; j < matrix.columns() && !error; ++j) {
    result.startVec(j);
    matrix.for_each_in_column(j, [&](const Term<R>& term) {
      const Rational entry = to_rational(matrix.ring(), term.coefficient);
      if (const std::optional<S> scalar = to_scalar<S>(entry)) {
        result.insertBack(term.index, j) = *scalar;
      } else if (!error) {
        error = Error{Errc::refused, "the entry in row " + std::to_string(term.index) + ", column " +
                                         std::to_string(j) + " is " + entry.to_string() +
                                         ", which is no number of the type asked for: ask for a larger one"};
      }
    });
  }
  if (error) {
    return std::move(*error);
  }
  result.finalize();
  return result;
}

/// The matrix over a ring whose entries are those of one of Eigen's, integers, modulo p over Z/p. Cost: as above.
template <Ring R, std::signed_integral S>
[[nodiscard]] Matrix<R> from_eigen(R ring, const Eigen::SparseMatrix<S>& matrix) {
  Matrix<R> result(ring, static_cast<Index>(matrix.rows()), 0);
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    RawTerms<R> terms;
    for (typename Eigen::SparseMatrix<S>::InnerIterator entry(matrix, j); entry; ++entry) {
      terms.push_back({static_cast<Index>(entry.row()), ring.from(std::int64_t{entry.value()})});
    }
    result.append_column(std::move(terms).normal(ring));
  }
  return result;
}

}  // namespace sesame::sparse

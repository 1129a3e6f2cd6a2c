/// \file
/// Proved bounds of a determinant, from floating-point numbers.
#pragma once

#include <optional>
#include <vector>

namespace sesame::sparse {

/// A square matrix of doubles by rows; each is within `relative_error` of the entry that it stands for.
struct ApproximateMatrix {
  std::size_t size = 0;
  std::vector<double> entries;
  double relative_error = 0;
};

/// lower <= log |det| <= upper.
struct LogDeterminant {
  double lower, upper;
};

/// Bounds of the natural logarithm of |det A|, or nothing where rounding errors leave no bound: always when A is
/// singular, mostly when it is so ill conditioned that doubles cannot tell.
///
/// With P A = L U in floating point, and triangular matrices X and Y close to the inverses of U and L, let E = X Y P A
/// -
/// 1. When the largest row sum e of |E| is less than 1, all eigenvalues of X Y P A are within e of 1, so that
/// |log |det(X Y P A)|| <= -n log(1 - e); and det X and det Y are products of diagonal entries. No property of the
/// factorisation is needed: E is bounded by what is computed and by the a priori bound of the rounding errors of sums
/// of products in any order, |fl(A B) - A B| <= n u / (1 - n u) |A| |B|.
///
/// Source: S. Rump, Verification methods, Acta Numerica 19 (2010), section 10.
/// Cost: a few products of matrices of that size, in doubles.
[[nodiscard]] std::optional<LogDeterminant> log_determinant(const ApproximateMatrix& matrix);

}  // namespace sesame::sparse

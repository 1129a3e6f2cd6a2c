/// \file
/// Smith normal form of sparse matrices with both transforms and their inverses.
#pragma once

#include <vector>

#include "sparse/matrix.hpp"

namespace sesame::sparse {

/// The Smith normal form of a matrix M (m x n):  left * M * right = diagonal.
///
/// `factors` are the nonzero diagonal entries d_0 | d_1 | ... (positive over Z, 1 over a field); `factors.size()` is
/// the rank. left (m x m) and right (n x n) are invertible over the ring, and their inverses come with them: the
/// columns of left_inverse are the new basis of the target, those of right the new basis of the source.
template <Ring R>
struct SmithForm {
  std::vector<typename R::Element> factors;
  Matrix<R> left;
  Matrix<R> left_inverse;
  Matrix<R> right;
  Matrix<R> right_inverse;
};

/// Cost: polynomial, output-sensitive; pivots of least absolute value and least fill first, so unit pivots go before
/// any others. Coefficients grow as they must: exact.
template <Ring R>
[[nodiscard]] SmithForm<R> smith_form(const Matrix<R>& matrix);

/// Only the invariant factors: no transforms are kept. Same order as SmithForm::factors.
/// Cost: an elimination, as long as coefficients stay small; what is left then over Z is done by p-adic lifting, at the
/// cost of a few products of dense matrices (see padic_smith.hpp).
template <Ring R>
[[nodiscard]] std::vector<typename R::Element> invariant_factors(const Matrix<R>& matrix);
/// The same by elimination alone, whatever becomes of the coefficients: the slow twin.
template <Ring R>
[[nodiscard]] std::vector<typename R::Element> invariant_factors_by_elimination(const Matrix<R>& matrix);

/// Agoston's form of a finite complex: one basis of each C_p serves both d_p and d_{p+1}.
///
/// The new basis of C_p is, in this order: `cycles` (a basis of ker d_p, of which the first `bounding` elements have a
/// multiple that is a boundary: orders[k] * cycles[k] = d(bounded_by[k])), then `moving` elements, a complement on
/// which d_p is injective. So H_p is read off: Z/orders[k] for orders[k] > 1, and one Z for each cycle from `bounding`
/// on. Source: M. Agoston, Algebraic Topology (1976); S. Peltier's thesis (2006) for the form used here.
template <Ring R>
struct AgostonBasis {
  std::vector<Terms<R>> cycles;             ///< in the old basis of C_p
  std::vector<typename R::Element> orders;  ///< of the first `orders.size()` cycles; divide one another in turn
  std::vector<Terms<R>> bounded_by;         ///< (p+1)-chains in the old basis, one per order
  std::vector<Terms<R>> moving;             ///< the complement, in the old basis
};

/// One basis per degree 0..n for the complex with boundaries d[p]: C_p -> C_{p-1} (d[0] is 0 x c_0).
/// Requires: shapes chain up and d[p-1] d[p] = 0.
template <Ring R>
[[nodiscard]] std::vector<AgostonBasis<R>> agoston_bases(const std::vector<Matrix<R>>& boundaries);

}  // namespace sesame::sparse

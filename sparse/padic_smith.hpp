/// \file
/// Invariant factors of dense integer matrices, whose elimination would end in huge coefficients, by p-adic lifting.
#pragma once

#include <optional>
#include <vector>

#include "sparse/chain.hpp"

namespace sesame::sparse {

/// The nonzero invariant factors of a matrix, each dividing the next; or nothing when this is not the way to find them:
/// an elimination still is. What is returned is proved, never probable.
///
/// 1. *Rank.* A prime finds a square block B of some size k that is nonsingular modulo it, hence over Z; so the rank is
///    at least k. It is k when there are no further rows, or no further columns; else when the solutions Y of B Y = the
///    further columns, which are exact, hold in all further rows, too. (A matrix with more columns than rows is
///    transposed.)
/// 2. *Determinant of B.* The denominator d of the solution of B x = b divides the largest invariant factor of B, hence
///    delta = |det B| / d is a whole number; floating-point bounds of |det B| that leave one such number prove it.
///    Where they do not, the determinant is found modulo enough primes for Hadamard's bound.
/// 3. *Primes that do not divide delta.* There the cokernel of B is cyclic, of the order c that d has without
///    the primes of delta, and x generates what is dual to it, the fractions x modulo Z^k with B x integral. Those
///    which are integral on the further rows as well are the torsion of the columns of B: x times the order of their
///    values there. The further columns are the boundaries of Y, and kill a subgroup of it, whose order is the common
///    denominator of Y.
/// 4. *Primes p of delta.* The torsion divides the power p^e in det B, so an elimination modulo p^(e+1) tells its
///    p-part.
///
/// Source: J. Dixon 1982; W. Eberly, M. Giesbrecht, G. Villard 2000; J. Dumas, D. Saunders, G. Villard 2001 for the
/// local forms. Cost: some twenty products of matrices of the size of B in machine words, when det B has some hundred
/// digits.
[[nodiscard]] std::optional<std::vector<Integer>> padic_invariant_factors(Index rows,
                                                                          const std::vector<Terms<Integers>>& columns);

}  // namespace sesame::sparse

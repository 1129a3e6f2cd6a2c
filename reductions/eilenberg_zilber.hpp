/// \file
/// The Eilenberg-Zilber reduction C(X x Y) => C(X) (x) C(Y) of simplicial sets, by its universal formulas.
///
/// Chains are normalised, d = sum of (-1)^i d_i, and d(a (x) b) = da (x) b + (-1)^{|a|} a (x) db. An n-simplex of X x Y
/// is a pair (x, y) of n-simplices; it is degenerate, that is 0 as a chain, when both collapse a common step i, i + 1.
/// With the maps of this file
///
///     f(x, y)    = sum of (x front) (x) (y back),   over alexander_whitney(n);
///     g(x (x) y) = sum of sign (x first, y second), over shuffles(p, q), p = |x|, q = |y|;
///     h(x, y)    = sum of sign (x first, y second), over shih(n)
///
/// is a reduction: f g = 1, g f + d h + h d = 1, f h = 0, h g = 0, h h = 0. (x theta is the face or degeneracy of x
/// along theta: its vertex i is the vertex theta(i) of x.) All three send degenerate chains to degenerate ones, so the
/// formulas hold for any two simplicial sets, degenerate faces included.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace sesame::reductions {

/// A monotone map [m] -> [n] of {0, ..., m} to {0, ..., n}, as the list of its m + 1 values.
using Vertices = std::vector<std::uint8_t>;

/// The largest n for which a Vertices can name the vertices of an n-simplex.
inline constexpr int max_simplex_dimension = 255;

/// A term of f: the front face [k] -> [n] of the first simplex, the back face [n-k] -> [n] of the second.
struct FrontAndBack {
  Vertices front;
  Vertices back;
  friend bool operator==(const FrontAndBack&, const FrontAndBack&) = default;
};

/// A term of g or h: two monotone maps from one [m], which collapse no common step, and the coefficient 1 or -1.
struct SignedPair {
  int sign;
  Vertices first;
  Vertices second;
  friend bool operator==(const SignedPair&, const SignedPair&) = default;
};

/// f on an n-simplex (x, y): the terms for k = 0, ..., n, front 0..k and back k..n, each with coefficient 1.
/// Requires: 0 <= n <= max_simplex_dimension. Size and cost: n + 1 terms, O(n^2).
/// Source: S. Eilenberg, S. Mac Lane, On the groups H(Pi, n), II, Annals of Mathematics 60 (1954), section 2.
[[nodiscard]] std::vector<FrontAndBack> alexander_whitney(int n);

/// g on x (x) y, |x| = p, |y| = q: one term for each order in which p steps of x and q steps of y can be taken, as maps
/// [p+q] -> [p] and [p+q] -> [q]; the sign is that of the permutation that brings the steps of x to the front.
/// Order: lexicographic, steps of x first; so the first term has sign 1.
/// Requires: p, q >= 0, p + q <= max_simplex_dimension. Size and cost: binomial(p+q, p) terms, O(p+q) each.
/// Source: S. Eilenberg, S. Mac Lane, On the groups H(Pi, n), I, Annals of Mathematics 58 (1953), section 5.
[[nodiscard]] std::vector<SignedPair> shuffles(int p, int q);

/// h on an n-simplex (x, y): Shih's homotopy, as pairs of maps [n+1] -> [n]. Terms that are degenerate for every (x, y)
/// are left out; no pair of maps comes twice.
/// Requires: 0 <= n < max_simplex_dimension. Size and cost: 2^(n+1) - n - 2 terms (0, 1, 4, 11, 26, 57, 120, 247, ...,
/// 2036 for n = 10, about 2 million for n = 20), O(n) each.
/// Source: S. Eilenberg, S. Mac Lane, On the groups H(Pi, n), II, section 2: the recursion
/// h_n = -(h_{n-1})' - (g f)' s_0, where ' raises the index of every face and degeneracy by one; the sign is turned to
/// g f + d h + h d = 1. Unrolled here, which gives the closed formula of R. Gonzalez-Diaz, P. Real, A combinatorial
/// method for computing Steenrod squares, Journal of Pure and Applied Algebra 139 (1999).
[[nodiscard]] std::vector<SignedPair> shih(int n);

/// Remembers shuffles and shih by dimension, for callers that apply them to simplex after simplex: making a term costs
/// about as much as using it. What it returns stays valid as long as it lives; it keeps every term that it was asked
/// for (about 120 bytes each). Not for several threads at once.
class EilenbergZilberTerms {
 public:
  /// As the functions of the same names. Cost: theirs for new dimensions, then O(log dimensions asked for).
  const std::vector<SignedPair>& shuffles(int p, int q);
  const std::vector<SignedPair>& shih(int n);

 private:
  std::map<std::pair<int, int>, std::vector<SignedPair>> shuffles_;
  std::map<int, std::vector<SignedPair>> shih_;
};

}  // namespace sesame::reductions

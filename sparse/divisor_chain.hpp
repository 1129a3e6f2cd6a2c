/// \file
/// The pivots of an elimination made into invariant factors. Part of smith.cpp and cokernel.cpp, which alone include
/// it.
#pragma once

#include <algorithm>
#include <vector>

#include "sparse/diagonal_elimination.hpp"

namespace sesame::sparse {

/// Makes two pivots a, b into gcd and lcm. With g = x a + y b:
///   [    1     1   ] [ a 0 ] [ x  -b/g ]   [ g    0   ]
///   [ -y b/g  x a/g ] [ 0 b ] [ y   a/g ] = [ 0  a b/g ]     both outer matrices have determinant 1.
template <Ring R, class Left, class Right>
void make_divide(const R& ring, Pivot<R>& a, Pivot<R>& b, Left& left, Right& right) {
  const Integer first = ring.to_integer(a.value), second = ring.to_integer(b.value);
  const Bezout bezout = extended_gcd(first, second);
  const Integer a_g = divide(first, bezout.g).quotient, b_g = divide(second, bezout.g).quotient;
  const auto in = [&](const Integer& n) { return ring.from(n); };
  const Integer u = -(bezout.y * b_g), v = bezout.x * a_g;
  const TwoByTwo<R> rows{ring.one(), ring.one(), in(u), in(v)}, of_left_inverse{in(v), in(-u), in(-1), ring.one()};
  left.combine(ring, a.row, b.row, rows, of_left_inverse);
  const TwoByTwo<R> columns{in(bezout.x), in(bezout.y), in(-b_g), in(a_g)};
  const TwoByTwo<R> of_right_inverse{in(a_g), in(b_g), in(-bezout.y), in(bezout.x)};
  right.combine(ring, a.column, b.column, columns, of_right_inverse);
  a.value = ring.from(bezout.g);
  b.value = ring.from(a_g * second);
}

[[nodiscard]] inline bool divides(const Integer& a, const Integer& b) { return divide(b, a).remainder.is_zero(); }

/// Sorts the pivots and makes each divide the next; the transforms are told. Cost: linear, after sorting, when they do
/// so already.
template <Ring R, class Left, class Right>
void chain_divisors(const R& ring, std::vector<Pivot<R>>& pivots, Left& left, Right& right) {
  const auto less = [&](const Pivot<R>& a, const Pivot<R>& b) {
    return ring.to_integer(a.value) < ring.to_integer(b.value);
  };
  std::stable_sort(pivots.begin(), pivots.end(), less);
  const auto fails = [&](const Pivot<R>& a, const Pivot<R>& b) {
    return !divides(ring.to_integer(a.value), ring.to_integer(b.value));
  };
  if (std::adjacent_find(pivots.begin(), pivots.end(), fails) == pivots.end()) {
    return;
  }
  const auto first_non_unit =
      std::find_if(pivots.begin(), pivots.end(), [&](const Pivot<R>& pivot) { return !ring.is_unit(pivot.value); });
  for (auto a = first_non_unit; a != pivots.end(); ++a) {
    for (auto b = a + 1; b != pivots.end(); ++b) {
      if (!divides(ring.to_integer(a->value), ring.to_integer(b->value))) {
        make_divide(ring, *a, *b, left, right);
      }
    }
  }
}

}  // namespace sesame::sparse

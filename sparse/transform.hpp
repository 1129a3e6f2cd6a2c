/// \file
/// Changes of basis that an elimination makes. Part of diagonal_elimination.hpp and operation_log.hpp.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "sparse/chain.hpp"

namespace sesame::sparse {

template <Ring R>
using Lines = std::vector<Terms<R>>;

template <Ring R>
Lines<R> unit_lines(const R& ring, Index n) {
  Lines<R> lines(n);
  for (Index i = 0; i < n; ++i) {
    lines[i] = {{i, ring.one()}};
  }
  return lines;
}

template <Ring R>
void scale(const R& ring, Terms<R>& terms, const typename R::Element& a) {
  for (Term<R>& term : terms) {
    term.coefficient = ring.multiply(term.coefficient, a);
  }
}

/// (x, y) becomes (a x + b y, c x + d y).
template <Ring R>
using TwoByTwo = std::array<typename R::Element, 4>;

template <Ring R>
void combine(const R& ring, Terms<R>& x, Terms<R>& y, const TwoByTwo<R>& abcd) {
  Terms<R> first, second;
  add_multiple<R>(ring, first, abcd[0], x);
  add_multiple<R>(ring, first, abcd[1], y);
  add_multiple<R>(ring, second, abcd[2], x);
  add_multiple<R>(ring, second, abcd[3], y);
  x = std::move(first);
  y = std::move(second);
}

/// A change of basis and its inverse: of one, the lines that an operation adds to; of the other, those it adds from.
template <Ring R>
struct Transform {
  Lines<R> forward;  ///< rows of left, or columns of right
  Lines<R> inverse;  ///< columns of left_inverse, or rows of right_inverse

  /// forward[k] += a forward[pivot] for each k a of `multiples`; and the inverse accordingly.
  void add(const R& ring, Index pivot, const Terms<R>& multiples, bool /*is_last*/) {
    RawTerms<R> gathered;  // what inverse[pivot] gains, added up at once
    for (const auto& [k, a] : multiples) {
      add_multiple<R>(ring, forward[k], a, forward[pivot]);
      for (const Term<R>& term : inverse[k]) {
        gathered.push_back({term.index, ring.multiply(ring.negate(a), term.coefficient)});
      }
    }
    add_multiple<R>(ring, inverse[pivot], ring.one(), std::move(gathered).normal(ring));
  }
  void scale(const R& ring, Index k, const typename R::Element& unit) {
    sparse::scale(ring, forward[k], unit);
    sparse::scale(ring, inverse[k], ring.inverse(unit));
  }
  void combine(const R& ring, Index i, Index j, const TwoByTwo<R>& lines, const TwoByTwo<R>& of_inverse) {
    sparse::combine(ring, forward[i], forward[j], lines);
    sparse::combine(ring, inverse[i], inverse[j], of_inverse);
  }
};

/// What an elimination keeps of its operations: nothing. Or, of rows and columns, a Transform, an OperationLog, or
/// nothing.
struct NoTransform {
  void add(const auto& /*ring*/, Index /*pivot*/, const auto& /*multiples*/, bool /*is_last*/) {}
  void scale(const auto& /*ring*/, Index /*k*/, const auto& /*unit*/) {}
  void combine(const auto& /*ring*/, Index /*i*/, Index /*j*/, const auto& /*lines*/, const auto& /*of_inverse*/) {}
};

}  // namespace sesame::sparse

#include "sparse/smith.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "sparse/diagonal_elimination.hpp"
#include "sparse/padic_smith.hpp"

namespace sesame::sparse {
namespace {

/// (x, y) becomes (a x + b y, c x + d y).
template <Ring R>
void combine(const R& ring, Terms<R>& x, Terms<R>& y, const std::array<typename R::Element, 4>& abcd) {
  Terms<R> first, second;
  add_multiple<R>(ring, first, abcd[0], x);
  add_multiple<R>(ring, first, abcd[1], y);
  add_multiple<R>(ring, second, abcd[2], x);
  add_multiple<R>(ring, second, abcd[3], y);
  x = std::move(first);
  y = std::move(second);
}

/// Makes two pivots a, b into gcd and lcm. With g = x a + y b:
///   [    1     1   ] [ a 0 ] [ x  -b/g ]   [ g    0   ]
///   [ -y b/g  x a/g ] [ 0 b ] [ y   a/g ] = [ 0  a b/g ]     both outer matrices have determinant 1.
template <Ring R>
void make_divide(const R& ring, Pivot<R>& a, Pivot<R>& b, DiagonalElimination<R>* elimination) {
  const Integer first = ring.to_integer(a.value), second = ring.to_integer(b.value);
  const Bezout bezout = extended_gcd(first, second);
  const Integer a_g = divide(first, bezout.g).quotient, b_g = divide(second, bezout.g).quotient;
  if (elimination != nullptr) {
    const auto in = [&](const Integer& n) { return ring.from(n); };
    const Integer u = -(bezout.y * b_g), v = bezout.x * a_g;
    Transform<R>& left = elimination->left();
    Transform<R>& right = elimination->right();
    combine<R>(ring, left.forward[a.row], left.forward[b.row], {ring.one(), ring.one(), in(u), in(v)});
    combine<R>(ring, left.inverse[a.row], left.inverse[b.row], {in(v), in(-u), in(-1), ring.one()});
    combine<R>(ring, right.forward[a.column], right.forward[b.column], {in(bezout.x), in(bezout.y), in(-b_g), in(a_g)});
    combine<R>(ring, right.inverse[a.column], right.inverse[b.column], {in(a_g), in(b_g), in(-bezout.y), in(bezout.x)});
  }
  a.value = ring.from(bezout.g);
  b.value = ring.from(a_g * second);
}

[[nodiscard]] bool divides(const Integer& a, const Integer& b) { return divide(b, a).remainder.is_zero(); }

/// Sorts the pivots and makes each divide the next. Cost: linear, after sorting, when they do so already.
template <Ring R>
void chain_divisors(const R& ring, std::vector<Pivot<R>>& pivots, DiagonalElimination<R>* elimination) {
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
        make_divide(ring, *a, *b, elimination);
      }
    }
  }
}

template <Ring R>
std::vector<typename R::Element> values(const std::vector<Pivot<R>>& pivots) {
  std::vector<typename R::Element> result;
  result.reserve(pivots.size());
  std::transform(pivots.begin(), pivots.end(), std::back_inserter(result), [](const Pivot<R>& p) { return p.value; });
  return result;
}

/// What an elimination has left over, diagonalised by other means; nothing when it had better go on. Below the least
/// size an elimination is as quick, whatever its coefficients.
template <Ring R>
std::optional<std::vector<Pivot<R>>> lifted_pivots(Lines<R> rest) {
  if constexpr (std::same_as<R, Integers>) {
    constexpr std::size_t least_size = 24;
    std::map<Index, Index> rows;
    for (const Terms<R>& column : rest) {
      for (const Term<R>& term : column) {
        rows.try_emplace(term.index, 0);
      }
    }
    if (std::min(rest.size(), rows.size()) < least_size) {
      return std::nullopt;
    }
    Index next = 0;
    for (auto& [row, number] : rows) {
      number = next++;
    }
    for (Terms<R>& column : rest) {
      for (Term<R>& term : column) {
        term.index = rows[term.index];
      }
    }
    if (const auto factors = padic_invariant_factors(next, rest)) {
      std::vector<Pivot<R>> pivots;
      for (const Integer& factor : *factors) {
        pivots.push_back({0, 0, factor});  // where, is asked by transforms only
      }
      return pivots;
    }
  }
  return std::nullopt;
}

/// The pivots' lines first, then the others in their old order.
std::vector<Index> pivots_first(std::vector<Index> order, std::size_t n) {
  std::vector<bool> is_pivot(n);
  for (const Index i : order) {
    is_pivot[i] = true;
  }
  for (Index i = 0; i < n; ++i) {
    if (!is_pivot[i]) {
      order.push_back(i);
    }
  }
  return order;
}

/// The matrix whose columns are the lines, in the given order.
template <Ring R>
Matrix<R> from_columns(const R& ring, const Lines<R>& lines, const std::vector<Index>& order) {
  Matrix<R> result(ring, static_cast<Index>(lines.size()), 0);
  for (const Index i : order) {
    result.append_column(lines[i]);
  }
  return result;
}

/// The matrix whose rows are the lines, in the given order.
template <Ring R>
Matrix<R> from_rows(const R& ring, const Lines<R>& lines, const std::vector<Index>& order) {
  return from_columns(ring, lines, order).transposed();
}

}  // namespace

template <Ring R>
SmithForm<R> smith_form(const Matrix<R>& matrix) {
  const R& ring = matrix.ring();
  DiagonalElimination<R> elimination(matrix, true);
  std::vector<Pivot<R>> pivots = elimination.run();
  chain_divisors(ring, pivots, &elimination);
  std::vector<Index> rows, columns;
  for (const Pivot<R>& pivot : pivots) {
    rows.push_back(pivot.row);
    columns.push_back(pivot.column);
  }
  rows = pivots_first(std::move(rows), matrix.rows());
  columns = pivots_first(std::move(columns), matrix.columns());
  return {values(pivots), from_rows(ring, elimination.left().forward, rows),
          from_columns(ring, elimination.left().inverse, rows),
          from_columns(ring, elimination.right().forward, columns),
          from_rows(ring, elimination.right().inverse, columns)};
}

template <Ring R>
std::vector<typename R::Element> invariant_factors(const Matrix<R>& matrix) {
  DiagonalElimination<R> elimination(matrix, false);
  std::vector<Pivot<R>> pivots = elimination.run_while_small();
  if (std::optional<std::vector<Pivot<R>>> others = lifted_pivots(elimination.rest())) {
    pivots.insert(pivots.end(), others->begin(), others->end());
  } else {
    const std::vector<Pivot<R>> further = elimination.run();
    pivots.insert(pivots.end(), further.begin(), further.end());
  }
  chain_divisors<R>(matrix.ring(), pivots, nullptr);
  return values(pivots);
}

template <Ring R>
std::vector<typename R::Element> invariant_factors_by_elimination(const Matrix<R>& matrix) {
  std::vector<Pivot<R>> pivots = DiagonalElimination<R>(matrix, false).run();
  chain_divisors<R>(matrix.ring(), pivots, nullptr);
  return values(pivots);
}

#define SESAME_INSTANTIATE(R)                                              \
  template SmithForm<R> smith_form<R>(const Matrix<R>&);                   \
  template std::vector<R::Element> invariant_factors<R>(const Matrix<R>&); \
  template std::vector<R::Element> invariant_factors_by_elimination<R>(const Matrix<R>&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::sparse

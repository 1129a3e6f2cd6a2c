#include "sparse/smith.hpp"

#include <algorithm>
#include <concepts>
#include <iterator>
#include <optional>
#include <utility>

#include "sparse/diagonal_elimination.hpp"
#include "sparse/divisor_chain.hpp"
#include "sparse/padic_smith.hpp"

namespace sesame::sparse {
namespace {

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
std::optional<std::vector<Pivot<R>>> lifted_pivots(const Residue<R>& residue) {
  if constexpr (std::same_as<R, Integers>) {
    constexpr std::size_t least_size = 24;
    if (std::min(residue.rows.size(), residue.columns.size()) < least_size) {
      return std::nullopt;
    }
    if (const auto factors = padic_invariant_factors(static_cast<Index>(residue.rows.size()), residue.entries)) {
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
  const auto unchanged = [&](Index n) { return Transform<R>{unit_lines(ring, n), unit_lines(ring, n)}; };
  DiagonalElimination elimination(matrix, unchanged(matrix.rows()), unchanged(matrix.columns()));
  std::vector<Pivot<R>> pivots = elimination.run();
  chain_divisors(ring, pivots, elimination.left(), elimination.right());
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
  DiagonalElimination<R> elimination(matrix);
  std::vector<Pivot<R>> pivots = elimination.run_while_small();
  if (std::optional<std::vector<Pivot<R>>> others = lifted_pivots(elimination.residue())) {
    pivots.insert(pivots.end(), others->begin(), others->end());
  } else {
    const std::vector<Pivot<R>> further = elimination.run();
    pivots.insert(pivots.end(), further.begin(), further.end());
  }
  chain_divisors(matrix.ring(), pivots, elimination.left(), elimination.right());
  return values(pivots);
}

template <Ring R>
std::vector<typename R::Element> invariant_factors_by_elimination(const Matrix<R>& matrix) {
  DiagonalElimination<R> elimination(matrix);
  std::vector<Pivot<R>> pivots = elimination.run();
  chain_divisors(matrix.ring(), pivots, elimination.left(), elimination.right());
  return values(pivots);
}

#define SESAME_INSTANTIATE(R)                                              \
  template SmithForm<R> smith_form<R>(const Matrix<R>&);                   \
  template std::vector<R::Element> invariant_factors<R>(const Matrix<R>&); \
  template std::vector<R::Element> invariant_factors_by_elimination<R>(const Matrix<R>&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::sparse

#include <utility>
#include <vector>

#include "sparse/smith.hpp"

namespace sesame::sparse {
namespace {

template <Ring R>
std::vector<Terms<R>> columns_of(const Matrix<R>& matrix, Index from, Index to) {
  std::vector<Terms<R>> columns;
  for (Index j = from; j < to; ++j) {
    columns.push_back(matrix.column(j));
  }
  return columns;
}

template <Ring R>
Matrix<R> from_columns(const R& ring, Index rows, const std::vector<Terms<R>>& columns) {
  Matrix<R> result(ring, rows, 0);
  for (const Terms<R>& column : columns) {
    result.append_column(column);
  }
  return result;
}

/// The last rows of a matrix, from row `from` on.
template <Ring R>
Matrix<R> lower_rows(const Matrix<R>& matrix, Index from) {
  Matrix<R> result(matrix.ring(), matrix.rows() - from, 0);
  Terms<R> kept;
  for (Index j = 0; j < matrix.columns(); ++j) {
    kept.clear();
    matrix.for_each_in_column(j, [&](const Term<R>& entry) {
      if (entry.index >= from) {
        kept.push_back({entry.index - from, entry.coefficient});
      }
    });
    result.append_column(kept);
  }
  return result;
}

}  // namespace

template <Ring R>
std::vector<AgostonBasis<R>> agoston_bases(const std::vector<Matrix<R>>& boundaries) {
  std::vector<AgostonBasis<R>> bases(boundaries.size());
  if (boundaries.empty()) {
    return bases;
  }
  const R& ring = boundaries.front().ring();
  const Index vertices = boundaries.front().columns();
  expects(boundaries.front().is_zero(), "agoston_bases: d[0] must be zero");
  // A basis of the cycles of degree p as columns, and the coordinates of a cycle in it.
  Matrix<R> cycles = Matrix<R>::identity(ring, vertices);
  Matrix<R> coordinates = cycles;
  for (std::size_t p = 0; p < boundaries.size(); ++p) {
    if (p + 1 == boundaries.size()) {
      bases[p].cycles = columns_of(cycles, 0, cycles.columns());
      break;
    }
    const Matrix<R>& next = boundaries[p + 1];
    expects(next.rows() == boundaries[p].columns(), "agoston_bases: the shapes of the boundaries must chain up");
    // The image of d[p+1] lies in the cycles: one Smith form there serves both degrees.
    SmithForm<R> form = smith_form(coordinates * next);
    const auto rank = static_cast<Index>(form.factors.size());
    const Matrix<R> new_cycles = cycles * form.left_inverse;
    bases[p].cycles = columns_of(new_cycles, 0, new_cycles.columns());
    bases[p].bounded_by = columns_of(form.right, 0, rank);
    bases[p].orders = std::move(form.factors);
    bases[p + 1].moving = bases[p].bounded_by;
    cycles = from_columns(ring, next.columns(), columns_of(form.right, rank, next.columns()));
    coordinates = lower_rows(form.right_inverse, rank);
  }
  return bases;
}

#define SESAME_INSTANTIATE(R) template std::vector<AgostonBasis<R>> agoston_bases<R>(const std::vector<Matrix<R>>&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::sparse

#include "sparse/matrix_text.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sesame::sparse {
namespace {

template <Ring R>
std::string table(const Matrix<R>& matrix) {
  const Index columns = matrix.columns();
  std::vector<std::string> cells(std::size_t{matrix.rows()} * columns, "0");
  std::vector<std::size_t> width(columns, 1);
  for (Index j = 0; j < columns; ++j) {
    matrix.for_each_in_column(j, [&](const Term<R>& entry) {
      std::string& cell = cells[std::size_t{entry.index} * columns + j];
      cell = to_rational(matrix.ring(), entry.coefficient).to_string();
      width[j] = std::max(width[j], cell.size());
    });
  }
  std::string text;
  for (Index i = 0; i < matrix.rows(); ++i) {
    text += "[";
    for (Index j = 0; j < columns; ++j) {
      const std::string& cell = cells[std::size_t{i} * columns + j];
      text += std::string(1 + width[j] - cell.size(), ' ') + cell;
    }
    text += " ]\n";
  }
  return text;
}

std::string shape(Index rows, Index columns, const std::string& ring) {
  return std::to_string(rows) + " x " + std::to_string(columns) + " over " + ring;
}

template <Ring R>
std::string list(const Matrix<R>& matrix) {
  std::string text = shape(matrix.rows(), matrix.columns(), matrix.ring().name());
  text += matrix.rest() == Rest::identity ? ", the identity but for:\n" : ", zero but for:\n";
  for (const Index j : matrix.stored()) {
    text += std::to_string(j) + ": " + to_string<R>(matrix.ring(), matrix.column(j), "e") + "\n";
  }
  return text;
}

}  // namespace

template <Ring R>
std::string to_string(const Matrix<R>& matrix) {
  constexpr Index largest_table = 16;
  if (matrix.rows() == 0 || matrix.columns() == 0) {
    return shape(matrix.rows(), matrix.columns(), matrix.ring().name()) + "\n";
  }
  return matrix.rows() <= largest_table && matrix.columns() <= largest_table ? table(matrix) : list(matrix);
}

#define SESAME_INSTANTIATE(R) template std::string to_string(const Matrix<R>&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::sparse

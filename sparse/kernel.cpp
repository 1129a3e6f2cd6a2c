#include "sparse/kernel.hpp"

#include <concepts>

#include "sparse/contract.hpp"
#include "sparse/diagonal_elimination.hpp"
#include "sparse/operation_log.hpp"
#include "sparse/padic_cokernel.hpp"

namespace sesame::sparse {

namespace {

template <Ring R>
bool is_independent(const Residue<R>& residue) {
  if constexpr (std::same_as<R, Integers>) {
    return is_independent_modulo_a_prime(static_cast<Index>(residue.rows.size()), residue.entries);
  }
  return residue.columns.empty();
}

}  // namespace

template <Ring R>
Kernel<R>::Kernel(const Matrix<R>& matrix) : number_(matrix.columns(), 1) {
  DiagonalElimination elimination(matrix, NoTransform{}, OperationLog<R>(matrix.ring(), matrix.columns()));
  for (const Pivot<R>& pivot : elimination.run_while_small_units()) {
    number_[pivot.column] = 0;
  }
  if (const Residue<R> residue = elimination.residue(); is_independent(residue)) {
    for (const Index column : residue.columns) {
      number_[column] = 0;
    }
  } else {
    for (const Pivot<R>& pivot : elimination.run()) {
      number_[pivot.column] = 0;
    }
  }
  for (Index j = 0; j < number_.size(); ++j) {
    if (number_[j] != 0) {
      free_columns_.push_back(j);
      number_[j] = size();
    }
  }
  log_ = std::make_shared<const OperationLog<R>>(std::move(elimination.right()));
}

template <Ring R>
Terms<R> Kernel<R>::combination(const Terms<R>& coordinates) const {
  Terms<R> on_columns;
  for (const Term<R>& term : coordinates) {
    on_columns.push_back({free_columns_[term.index], term.coefficient});
  }
  return log_->combination(on_columns);
}

template <Ring R>
Terms<R> Kernel<R>::coordinates(const Terms<R>& v) const {
  Terms<R> coordinates;
  for (const Term<R>& term : log_->products_with_inverse_but_last(v)) {
    if (number_[term.index] != 0) {
      coordinates.push_back({number_[term.index] - 1, term.coefficient});
    }
  }
  return coordinates;
}

#define SESAME_INSTANTIATE(R) template class Kernel<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::sparse

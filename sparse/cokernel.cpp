#include "sparse/cokernel.hpp"

#include <algorithm>
#include <concepts>
#include <optional>

#include "sparse/contract.hpp"
#include "sparse/diagonal_elimination.hpp"
#include "sparse/divisor_chain.hpp"
#include "sparse/operation_log.hpp"
#include "sparse/padic_cokernel.hpp"

namespace sesame::sparse {

namespace {

/// Below this size an elimination is as good.
constexpr std::size_t least_size_to_solve = 24;

template <Ring R>
std::optional<PadicCokernel> solve([[maybe_unused]] const Residue<R>& residue) {
  if constexpr (std::same_as<R, Integers>) {
    if (residue.rows.size() == residue.columns.size() && residue.rows.size() >= least_size_to_solve) {
      return PadicCokernel::of(residue.entries);
    }
  }
  return std::nullopt;
}

/// Terms on the lines of a block, in the numbers that these have in the whole.
template <Ring R>
Terms<R> in_whole(const std::vector<Index>& lines, Terms<R> terms) {
  for (Term<R>& term : terms) {
    term.index = lines[term.index];
  }
  return terms;
}

}  // namespace

/// left A right is zero but for the pivots and the block.
template <Ring R>
struct Cokernel<R>::Parts {
  R ring;
  Index rows;
  OperationLog<R> left, right;
  std::vector<Pivot<R>> units, others;  ///< `others` each divide the next
  std::vector<Index> block_rows, block_columns;
  std::optional<PadicCokernel> block;
  std::vector<Index> free_rows;

  [[nodiscard]] Index finite() const {
    return static_cast<Index>(others.size() + (block ? block->orders().size() : 0));
  }
};

template <Ring R>
Cokernel<R>::Cokernel(const Matrix<R>& matrix) {
  const R& ring = matrix.ring();
  DiagonalElimination elimination(matrix, OperationLog<R>(ring, matrix.rows()),
                                  OperationLog<R>(ring, matrix.columns()));
  std::vector<Pivot<R>> pivots = elimination.run_while_small_units();
  Residue<R> residue = elimination.residue();
  std::optional<PadicCokernel> block = solve(residue);
  std::vector<Pivot<R>> others;
  if (!block) {
    residue = {};
    const std::vector<Pivot<R>> further = elimination.run();
    pivots.insert(pivots.end(), further.begin(), further.end());
    chain_divisors(ring, pivots, elimination.left(), elimination.right());
    const auto first =
        std::find_if(pivots.begin(), pivots.end(), [&](const auto& p) { return !ring.is_unit(p.value); });
    others.assign(first, pivots.end());
    pivots.erase(first, pivots.end());
  }
  std::vector<bool> is_free(matrix.rows(), true);
  for (const std::vector<Pivot<R>>* list : {&pivots, &others}) {
    for (const Pivot<R>& pivot : *list) {
      is_free[pivot.row] = false;
    }
  }
  for (const Index row : residue.rows) {
    is_free[row] = false;
  }
  std::vector<Index> free_rows;
  for (Index i = 0; i < matrix.rows(); ++i) {
    if (is_free[i]) {
      free_rows.push_back(i);
    }
  }
  parts_ = std::make_shared<const Parts>(Parts{
      ring, matrix.rows(), std::move(elimination.left()), std::move(elimination.right()), std::move(pivots),
      std::move(others), std::move(residue.rows), std::move(residue.columns), std::move(block), std::move(free_rows)});
}

template <Ring R>
Index Cokernel<R>::size() const {
  return parts_->rows;
}

template <Ring R>
Index Cokernel<R>::summands() const {
  return parts_->finite() + static_cast<Index>(parts_->free_rows.size());
}

template <Ring R>
typename Cokernel<R>::Generator Cokernel<R>::generator(Index k) const {
  const Parts& parts = *parts_;
  const Element one = parts.ring.one();
  if (k >= parts.finite()) {
    return {parts.ring.zero(), parts.left.combination_of_inverse({{parts.free_rows[k - parts.finite()], one}}), {}};
  }
  if constexpr (std::same_as<R, Integers>) {
    if (parts.block) {
      const PadicCokernel::Generator found = parts.block->generator(k);
      return {parts.block->orders()[k], parts.left.combination_of_inverse(in_whole<R>(parts.block_rows, found.vector)),
              parts.right.combination(in_whole<R>(parts.block_columns, found.bounding))};
    }
  }
  const Pivot<R>& pivot = parts.others[k];
  return {pivot.value, parts.left.combination_of_inverse({{pivot.row, one}}),
          parts.right.combination({{pivot.column, one}})};
}

template <Ring R>
typename Cokernel<R>::Class Cokernel<R>::class_of(const Terms<R>& v) const {
  const Parts& parts = *parts_;
  const R& ring = parts.ring;
  std::vector<Element> values(parts.rows, ring.zero());
  for (const Term<R>& term : parts.left.products(v)) {
    values[term.index] = term.coefficient;
  }
  Class result;
  RawTerms<R> bounding;
  for (const std::vector<Pivot<R>>* list : {&parts.units, &parts.others}) {
    for (const Pivot<R>& pivot : *list) {
      const Element& value = values[pivot.row];
      const Element quotient = ring.quotient(value, pivot.value);
      bounding.push_back({pivot.column, quotient});
      if (list == &parts.others) {
        result.coefficients.push_back(ring.subtract(value, ring.multiply(quotient, pivot.value)));
      }
    }
  }
  if constexpr (std::same_as<R, Integers>) {
    if (parts.block) {
      Terms<R> on_block;
      for (Index i = 0; i < parts.block_rows.size(); ++i) {
        if (const Integer& value = values[parts.block_rows[i]]; !value.is_zero()) {
          on_block.push_back({i, value});
        }
      }
      PadicCokernel::Class found = parts.block->class_of(on_block);
      result.coefficients.insert(result.coefficients.end(), found.coefficients.begin(), found.coefficients.end());
      for (Term<R>& term : in_whole<R>(parts.block_columns, std::move(found.bounding))) {
        bounding.push_back(std::move(term));
      }
    }
  }
  for (const Index row : parts.free_rows) {
    result.coefficients.push_back(values[row]);
  }
  result.bounding = parts.right.combination(std::move(bounding).normal(ring));
  return result;
}

#define SESAME_INSTANTIATE(R) template class Cokernel<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::sparse

/// \file
/// The kernel of a sparse matrix: a basis of it, and coordinates in that.
#pragma once

#include <memory>
#include <vector>

#include "sparse/matrix.hpp"

namespace sesame::sparse {

template <Ring R>
class OperationLog;

/// A basis of the kernel of a matrix M, a direct summand. Over Z where the columns that the elimination of units leaves
/// are independent modulo a prime, this is known without eliminating them.
///
/// What it keeps is the operations of the elimination. So nothing fills up, and most coordinates are read off the
/// vector: those of the columns without a pivot change only by pivots that are no units.
template <Ring R>
class Kernel {
 public:
  /// Cost: an elimination, with its column operations kept.
  explicit Kernel(const Matrix<R>& matrix);

  [[nodiscard]] Index size() const { return static_cast<Index>(free_columns_.size()); }
  /// The combination of the basis with these coordinates. Cost: the operations of the elimination.
  [[nodiscard]] Terms<R> combination(const Terms<R>& coordinates) const;
  /// The coordinates of a vector v. Requires: v is in the kernel. Cost: the columns of M, and the operations of pivots
  /// that are no units.
  [[nodiscard]] Terms<R> coordinates(const Terms<R>& v) const;

 private:
  std::shared_ptr<const OperationLog<R>> log_;  ///< of the columns
  std::vector<Index> free_columns_;             ///< without a pivot: one for each basis element
  std::vector<Index> number_;                   ///< by column: of the basis element, from 1; 0: none
};

}  // namespace sesame::sparse

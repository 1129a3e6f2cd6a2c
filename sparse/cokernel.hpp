/// \file
/// The cokernel of a sparse matrix: its cyclic summands, with generators and what bounds their multiples.
#pragma once

#include <memory>
#include <vector>

#include "sparse/matrix.hpp"

namespace sesame::sparse {

/// R^m modulo the columns of an m x n matrix A, as a sum of cyclic modules: those of finite order, each order > 1
/// dividing the next, then the free ones.
///
/// It is what a SmithForm says, but nothing is written out before it is asked for: transforms are the operations that
/// make them, and over Z a square block that the elimination of units leaves, if it is large, and if few summands come
/// from it, is solved by p-adic lifting, not eliminated (PadicCokernel): then generators are short.
template <Ring R>
class Cokernel {
 public:
  using Element = typename R::Element;

  /// Cost: an elimination, with its operations kept; for a block that is solved, some products of matrices of its size.
  explicit Cokernel(const Matrix<R>& matrix);

  /// The number of rows of the matrix.
  [[nodiscard]] Index size() const;
  /// The number of summands.
  [[nodiscard]] Index summands() const;

  struct Generator {
    Element order;      ///< 0: free
    Terms<R> vector;    ///< of R^m
    Terms<R> bounding;  ///< A bounding = order * vector; empty for a free one
  };
  /// Of the k-th summand. Cost: the operations of the elimination; for a block that is solved, a system of equations.
  [[nodiscard]] Generator generator(Index k) const;

  struct Class {
    std::vector<Element> coefficients;  ///< by summand; less than the order, where it is finite
    Terms<R> bounding;                  ///< v = sum of coefficients times generators + A bounding
  };
  /// The class of a vector v of R^m. Cost: as a generator.
  [[nodiscard]] Class class_of(const Terms<R>& v) const;

 private:
  struct Parts;
  std::shared_ptr<const Parts> parts_;
};

}  // namespace sesame::sparse

/// \file
/// Tensor products of complexes, maps, reductions and equivalences: what a cartesian product of objects is made of.
#pragma once

#include <vector>

#include "reductions/equivalence.hpp"

namespace sesame::reductions {

/// The basis of a tensor product of two graded modules: the generators a (x) b.
///
/// Order: by the degree p of a, then by the index of a, then by that of b.
class TensorBasis {
 public:
  TensorBasis(Sizes first, Sizes second);

  [[nodiscard]] const Sizes& sizes() const { return sizes_; }
  /// The index, in degree p + q, of (generator i of degree p) (x) (generator j of degree q).
  [[nodiscard]] Index index(int p, Index i, int q, Index j) const { return offset(p, q) + i * size_at(second_, q) + j; }
  /// The index of the first generator that is a product of degrees p and q.
  [[nodiscard]] Index offset(int p, int q) const {
    return offsets_[static_cast<std::size_t>(p + q)][static_cast<std::size_t>(p)];
  }

 private:
  Sizes first_;
  Sizes second_;
  Sizes sizes_;
  std::vector<std::vector<Index>> offsets_;  // [p + q][p]
};

/// phi (x) psi, with Koszul's sign: (phi (x) psi)(a (x) b) = (-1)^{|psi| |a|} phi a (x) psi b.
template <Ring R>
[[nodiscard]] GradedMap<R> tensor(const GradedMap<R>& phi, const GradedMap<R>& psi);
/// d = d (x) 1 + 1 (x) d, so d(a (x) b) = da (x) b + (-1)^{|a|} a (x) db.
template <Ring R>
[[nodiscard]] ChainComplex<R> tensor(const ChainComplex<R>& a, const ChainComplex<R>& b);
/// (f (x) f', g (x) g', h (x) 1 + g f (x) h').
template <Ring R>
[[nodiscard]] Reduction<R> tensor(const Reduction<R>& a, const Reduction<R>& b);
/// An equivalence of the product: both big and both small complexes are multiplied.
template <Ring R>
[[nodiscard]] Equivalence<R> tensor(const Equivalence<R>& a, const Equivalence<R>& b);

}  // namespace sesame::reductions

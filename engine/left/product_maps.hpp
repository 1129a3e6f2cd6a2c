/// \file
/// The maps of a product of two bodies whose cells are pairs of cells.
#pragma once

#include "engine/left/tensor_maps.hpp"

namespace sesame::engine {

/// A cell a.b of the product is a|b itself: the tensor product of the factors' equivalences as it stands. A cell of a
/// product of maps may have the other orientation, as cells of a type have all the same one.
///
/// Cost: F as many terms as those of the factors multiplied, K too; K at some cells only as many as there are of these.
template <Ring R>
class ProductMaps final : public TensorMaps<R> {
 public:
  using typename FamilyMaps<R>::Element;
  using TensorMaps<R>::TensorMaps;

  void add_F(CellId cell, const Element& factor, RawTerms<R, GeneratorId>& out) const override;
  void add_K(CellId cell, const Element& factor, RawTerms<R, CellId>& out) const override;
  [[nodiscard]] std::uint64_t terms_of_K(CellId cell) const override;
  void add_K_at(CellId cell, std::span<const CellId> at, const Element& factor,
                RawTerms<R, CellId>& out) const override;

 protected:
  void add_pairs(const Terms<R, CellId>& left, const Terms<R, CellId>& right, const Element& factor,
                 RawTerms<R, CellId>& out) const override;
  [[nodiscard]] std::uint64_t cells_of_pair(int /*p*/, int /*q*/) const override { return 1; }
  [[nodiscard]] int sign_in_pair(const ops::LazyKey& key) const override {
    return of_maps_ ? sign_of(structure_.lazy().face(this->id_, ops::LazyPart::pair, key.left, key.right)) : 1;
  }

 private:
  [[nodiscard]] int sign_of(const ops::Incidence& pair) const { return structure_.maps().sign(pair.order); }
  /// A factor for a cell instead of the pair that it is.
  [[nodiscard]] Element signed_factor(const Element& factor, const ops::LazyKey& key) const {
    return sign_in_pair(key) < 0 ? ring_.negate(factor) : factor;
  }

  using TensorMaps<R>::ring_, TensorMaps<R>::structure_, TensorMaps<R>::factors_;
  bool of_maps_ = structure_.lazy().family(this->id_).kind == ops::FamilyKind::map_product;
};

}  // namespace sesame::engine

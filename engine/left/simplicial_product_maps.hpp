/// \file
/// The maps of a product of two simplicial bodies that is simplicial itself.
#pragma once

#include "engine/left/tensor_maps.hpp"
#include "reductions/eilenberg_zilber.hpp"

namespace sesame::engine {

/// An n-simplex of the product is a pair of values of dimension n. The equivalence is the reduction (f, g, h) of
/// Eilenberg and Zilber to the tensor product of the factors' chains, and then the one of TensorMaps:
///
///   F f,   g G,   h + g K f
///
/// Here a|b is its image under g, the sum of its shuffles. Cost: that of the formulas, 2^n terms for h, times that of F
/// and K of TensorMaps for the n + 1 terms of f.
template <Ring R>
class SimplicialProductMaps final : public TensorMaps<R> {
 public:
  using typename FamilyMaps<R>::Element;
  using TensorMaps<R>::TensorMaps;

  void add_F(CellId cell, const Element& factor, RawTerms<R, GeneratorId>& out) const override;
  void add_K(CellId cell, const Element& factor, RawTerms<R, CellId>& out) const override;
  [[nodiscard]] std::uint64_t terms_of_K(CellId cell) const override;

 protected:
  void add_pairs(const Terms<R, CellId>& left, const Terms<R, CellId>& right, const Element& factor,
                 RawTerms<R, CellId>& out) const override;
  [[nodiscard]] std::uint64_t cells_of_pair(int p, int q) const override;
  [[nodiscard]] int sign_in_pair(const ops::LazyKey& key) const override;

 private:
  using TensorMaps<R>::ring_, TensorMaps<R>::structure_, TensorMaps<R>::factors_;

  template <class Visit>
  void for_each_in_f(CellId cell, Visit visit) const;
  [[nodiscard]] ops::Value restrict(ops::Value v, const reductions::Vertices& map) const;
  void add_simplex(const reductions::SignedPair& maps, const ops::Value& left, const ops::Value& right,
                   const Element& factor, RawTerms<R, CellId>& out) const;
};

}  // namespace sesame::engine

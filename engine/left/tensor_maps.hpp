/// \file
/// What the maps of all products have in common: they are tensor products of those of the factors.
#pragma once

#include "engine/left/family_maps.hpp"
#include "engine/left/frozen_maps.hpp"
#include "engine/left/pair_table.hpp"

namespace sesame::engine {

/// The equivalence of a product of two bodies with S_A (x) S_B. On the tensor product of the factors' chains it is
///
///   F(a|b) = F a (x) F b,   G(a (x) b) = G a | G b,   K(a|b) = K a | b + (-1)^|a| G F a | K b
///
/// with the maps of the frozen factors; how a|b is a chain of cells of the product is what the kinds of products differ
/// in.
///
/// Threads: one at a time, for queries too.
template <Ring R>
class TensorMaps : public FamilyMaps<R> {
 public:
  using Element = typename R::Element;

  /// `structure` and `factors` must outlive it.
  TensorMaps(R ring, const Structure& structure, ops::FamilyId id, PairTable pairs, FrozenMaps<R>& factors)
      : ring_{ring}, structure_{structure}, id_{id}, pairs_{std::move(pairs)}, factors_{factors} {}

  void add_G(GeneratorId generator, const Element& factor, RawTerms<R, CellId>& out) const final;
  [[nodiscard]] std::uint64_t terms_of_G(GeneratorId generator) const final;
  [[nodiscard]] Terms<R, GeneratorId> transposed_G(CellId cell) const final;

 protected:
  /// left | right, both chains of the factors, times a factor, as a chain of the product.
  virtual void add_pairs(const Terms<R, CellId>& left, const Terms<R, CellId>& right, const Element& factor,
                         RawTerms<R, CellId>& out) const = 0;
  /// Of how many cells a|b is the sum, for a p-cell and a q-cell.
  [[nodiscard]] virtual std::uint64_t cells_of_pair(int p, int q) const = 0;
  /// The coefficient of a cell in a|b, for the a and b that it lies over: 1, 0 or -1.
  [[nodiscard]] virtual int sign_in_pair(const ops::LazyKey& key) const = 0;

  /// F and K of a|b, and how many terms that K adds.
  void add_F_of_pair(CellId a, CellId b, const Element& factor, RawTerms<R, GeneratorId>& out) const {
    pairs_.add_tensor(ring_, factors_.F(a), factors_.F(b), factor, out);
  }
  void add_K_of_pair(CellId a, CellId b, const Element& factor, RawTerms<R, CellId>& out) const;
  [[nodiscard]] std::uint64_t terms_of_K_of_pair(CellId a, CellId b) const;

  [[nodiscard]] const ops::LazyKey& key(CellId cell) const { return structure_.lazy().of(cell)->key; }
  [[nodiscard]] Element coefficient_at(const Terms<R, CellId>& chain, CellId cell) const;

  R ring_;
  const Structure& structure_;
  ops::FamilyId id_;
  PairTable pairs_;
  FrozenMaps<R>& factors_;
};

}  // namespace sesame::engine

/// \file
/// The maps of a cone over whole bodies.
#pragma once

#include "engine/left/family_maps.hpp"
#include "engine/left/left_maps.hpp"

namespace sesame::engine {

/// A cone is contractible to its apex v, an ordinary cell of B, so that it has no generators of its own:
///
///   F w = g v for a vertex w of the base, 0 on the rest;   K c = (-1)^(p+1) v*c for a p-cell c of the base, K v*c = 0
///
/// Cost: one term each.
///
/// Threads: one at a time, for queries too.
template <Ring R>
class ConeMaps final : public FamilyMaps<R> {
 public:
  using typename FamilyMaps<R>::Element;

  /// `structure` and `left` must outlive it.
  ConeMaps(R ring, const Structure& structure, ops::FamilyId id, const LeftMaps<R>& left)
      : ring_{ring}, structure_{structure}, id_{id}, left_{left} {}

  void add_F(CellId cell, const Element& factor, RawTerms<R, GeneratorId>& out) const override;
  void add_G(GeneratorId generator, const Element& factor, RawTerms<R, CellId>& out) const override;
  void add_K(CellId cell, const Element& factor, RawTerms<R, CellId>& out) const override;
  [[nodiscard]] std::uint64_t terms_of_G(GeneratorId generator) const override;
  [[nodiscard]] std::uint64_t terms_of_K(CellId cell) const override { return is_of_base(cell) ? 1 : 0; }
  [[nodiscard]] Terms<R, GeneratorId> transposed_G(CellId /*cell*/) const override { return {}; }

 private:
  [[nodiscard]] bool is_of_base(CellId cell) const {
    return structure_.lazy().of(cell)->key.part == ops::LazyPart::base;
  }

  R ring_;
  const Structure& structure_;
  ops::FamilyId id_;
  const LeftMaps<R>& left_;
};

}  // namespace sesame::engine

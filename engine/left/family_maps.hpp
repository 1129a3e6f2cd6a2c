/// \file
/// What the big complex has to know of a lazy family: its equivalence with a small complex, cell by cell.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <span>

#include "engine/right/symbol.hpp"
#include "ops/cells/structure.hpp"

namespace sesame::engine {

/// A homological equivalence (F, G, K) between the cells of one lazy family, as created, and a small complex whose
/// generators are generators of B:
///
///   F: cells -> generators,   G: generators -> cells,   K: p-cells -> (p+1)-cells,   d K + K d = 1 - G F
///
/// as it was when the family was made. Nothing in it changes: the bodies that the family is made of are frozen. What
/// de-identifications do to it later is the matter of Families. Lazy cells are made where a map is asked for them.
///
/// How a family knows its maps is its own affair: it is asked once per cell, not per term.
template <Ring R>
class FamilyMaps {
 public:
  using Element = typename R::Element;

  FamilyMaps() = default;
  FamilyMaps(const FamilyMaps&) = delete;
  FamilyMaps& operator=(const FamilyMaps&) = delete;
  virtual ~FamilyMaps() = default;

  /// A map of a cell of the family or of one of its generators, times a factor, added to `out`.
  virtual void add_F(CellId cell, const Element& factor, RawTerms<R, GeneratorId>& out) const = 0;
  virtual void add_G(GeneratorId generator, const Element& factor, RawTerms<R, CellId>& out) const = 0;
  virtual void add_K(CellId cell, const Element& factor, RawTerms<R, CellId>& out) const = 0;

  /// How many terms add_G and add_K add, or `uncountable`, without adding them.
  [[nodiscard]] virtual std::uint64_t terms_of_G(GeneratorId generator) const = 0;
  [[nodiscard]] virtual std::uint64_t terms_of_K(CellId cell) const = 0;

  /// As add_K, but only the terms at some cells, `at`, which are sorted. Here K is written out for that; a family that
  /// can do without does.
  virtual void add_K_at(CellId cell, std::span<const CellId> at, const Element& factor,
                        RawTerms<R, CellId>& out) const {
    RawTerms<R, CellId> all;
    add_K(cell, factor, all);
    for (const sparse::Term<R, CellId>& term : all) {
      if (std::binary_search(at.begin(), at.end(), term.index)) {
        out.push_back(term);
      }
    }
  }
  /// The generators whose G has a cell, each with the cell's coefficient there.
  [[nodiscard]] virtual Terms<R, GeneratorId> transposed_G(CellId cell) const = 0;
};

}  // namespace sesame::engine

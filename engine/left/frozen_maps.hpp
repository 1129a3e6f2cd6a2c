/// \file
/// The equivalence of bodies that lazy families are made of: it does not change any more, and is remembered.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "engine/left/big_complex.hpp"
#include "engine/right/rewriter.hpp"
#include "reductions/eilenberg_zilber.hpp"

namespace sesame::engine {

/// F, G and K of frozen bodies: no later step can touch their cells, so what these maps are on one is worked out once.
/// A body may have lazy cells itself, those of a family made before.
///
/// Invariant: what is remembered is in normal form, in current cells and symbols; a reference to it is valid until
/// `truncate`. Cost: for what is new, that of the two reductions' maps; else O(1).
///
/// Threads: one at a time, for queries too.
template <Ring R>
class FrozenMaps {
 public:
  /// Both must outlive it.
  FrozenMaps(R ring, const BigComplex<R>& big, Rewriter<R>& rewriter)
      : ring_{ring}, left_{big.maps()}, rewriter_{rewriter} {}

  /// F of a cell, in symbols.
  const Terms<R, Symbol>& F(CellId cell);
  /// G of a small generator, in cells.
  const Terms<R, CellId>& G(Symbol symbol);
  /// What the homotopy of a tensor product is made of.
  struct Homotopy {
    Terms<R, CellId> K, GF;
  };
  const Homotopy& homotopy(CellId cell);
  /// How many terms G adds up, without remembering it.
  [[nodiscard]] std::uint64_t terms_of_G(Symbol symbol);
  [[nodiscard]] int degree(Symbol symbol) const { return rewriter_.degree(symbol); }
  /// The universal formulas of simplicial products, remembered for all of them.
  [[nodiscard]] reductions::EilenbergZilberTerms& formulas() { return formulas_; }

  struct Mark {
    std::size_t images = 0, homotopies = 0, lifts = 0;
  };
  [[nodiscard]] Mark mark() const { return {images_known_.size(), homotopies_known_.size(), lifts_known_.size()}; }
  /// Forgets what has become known since a mark.
  void truncate(const Mark& mark);

 private:
  R ring_;
  const LeftMaps<R>& left_;
  Rewriter<R>& rewriter_;
  std::unordered_map<CellId, Terms<R, Symbol>> images_;
  std::unordered_map<CellId, Homotopy> homotopies_;
  std::unordered_map<Symbol, Terms<R, CellId>> lifts_;
  // In the order in which they became known: what undo takes back may name nodes that go.
  std::vector<CellId> images_known_, homotopies_known_;
  std::vector<Symbol> lifts_known_;
  reductions::EilenbergZilberTerms formulas_;
};

}  // namespace sesame::engine

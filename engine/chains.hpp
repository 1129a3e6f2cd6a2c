/// \file
/// F, G and K of a live equivalence, on chains as they are seen from outside.
#pragma once

#include <span>

#include "engine/homology_tracker.hpp"
#include "engine/left/left_maps.hpp"
#include "engine/right/rewriter.hpp"

namespace sesame::engine {

/// The maps F = fS g, G = f gS and K = f hS g of C <= B => S, with d K + K d = 1 - G F, and the boundaries of C and S.
///
/// A chain of the object is written in cells, by their canonical names, with the orientations that these stand for; one
/// of S in its generators, numbered by age. Inside they are chains of current cells as they are oriented themselves,
/// and of symbols; this class translates. It keeps nothing.
///
/// Threads: one at a time, for queries too.
template <Ring R>
class Chains {
 public:
  /// All of them must outlive it.
  Chains(R ring, const Structure& structure, const LeftMaps<R>& left, Rewriter<R>& rewriter)
      : ring_{ring}, structure_{structure}, left_{left}, rewriter_{rewriter} {}

  /// Requires of chains of cells: they are made of current cells of their degree, none of them consumed.
  [[nodiscard]] SmallChain F(const CellChain& chain) { return to_small(chain.degree, rewriter_.rewrite(g(chain))); }
  [[nodiscard]] CellChain G(const SmallChain& chain) { return f(chain.degree, rewriter_.lift(to_symbols(chain))); }
  [[nodiscard]] CellChain K(const CellChain& chain) { return bounding(chain, g(chain), {}); }
  [[nodiscard]] CellChain boundary(const CellChain& chain) const;
  [[nodiscard]] SmallChain boundary(const SmallChain& chain) const {
    return to_small(chain.degree - 1, boundary(to_symbols(chain)));
  }

  /// G y + K z, of which z - G F z + G d y is the boundary, when z is a cycle: so z, when d y = F z. `g_of_z` is g z.
  [[nodiscard]] CellChain bounding(const CellChain& z, const Terms<R, GeneratorId>& g_of_z, const Terms<R, Symbol>& y);
  /// f and g, the left reduction.
  [[nodiscard]] CellChain f(int degree, const Terms<R, GeneratorId>& chain_of_b) const {
    return to_chain(degree, left_.f(chain_of_b));
  }
  [[nodiscard]] Terms<R, GeneratorId> g(const CellChain& chain) const;
  /// dS of a chain of symbols.
  [[nodiscard]] Terms<R, Symbol> boundary(std::span<const sparse::Term<R, Symbol>> symbols) const;

 private:
  [[nodiscard]] typename R::Element in_own_orientation(CellId cell, const Rational& coefficient) const;
  [[nodiscard]] CellChain to_chain(int degree, const Terms<R, CellId>& cells) const;
  [[nodiscard]] SmallChain to_small(int degree, const Terms<R, Symbol>& symbols) const;
  [[nodiscard]] Terms<R, Symbol> to_symbols(const SmallChain& chain) const;

  R ring_;
  const Structure& structure_;
  const LeftMaps<R>& left_;
  Rewriter<R>& rewriter_;
};

}  // namespace sesame::engine

/// \file
/// The equivalences of lazy families: what F, G and K are on the cells of products and of cones over whole bodies.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/left/big_complex.hpp"
#include "engine/right/rewriter.hpp"
#include "reductions/eilenberg_zilber.hpp"

namespace sesame::engine {

/// For each lazy family X a homological equivalence (F, G, K) of its cells, as created, with a small complex whose
/// generators are appended to the big complex; computed from the frozen factors when asked for, cell by cell.
///
///   product                S_A (x) S_B;  F(a|b) = F a (x) F b,  G likewise,  K(a|b) = K a | b + (-1)^|a| G F a | K b
///   simplicial product     the same after the Eilenberg-Zilber reduction (f, g, h):  F f,  g G,  h + g K f
///   cone                   the apex;  F w = v for a vertex w, 0 on the rest;  K c = (-1)^(p+1) v*c for a p-cell c
///
/// A de-identification that moves faces of lazy cells is a perturbation chi of these equivalences with values in its
/// new generators e: F c has -chi(K c) more, the boundary of a generator s has chi(G s) more, that of a generator whose
/// boundary has the lazy cells z has -chi(K z) more; G and K stay (the basic perturbation lemma).
///
/// Source: engine/LIVE_FORM.md.
template <Ring R>
class LazyMaps {
 public:
  using Element = typename R::Element;
  using Gains = std::unordered_map<CellId, Terms<R>>;

  LazyMaps(R ring, const Window& window, BigComplex<R>& big, Rewriter<R>& rewriter);

  /// Takes in the next family: its factors' small generators leave S, those of the family are appended.
  /// Cost: the number of those.
  void add_family(ops::FamilyId family);

  /// F of a lazy cell times a factor, in generators of B; G of a generator, K of a lazy cell, in cells as created.
  void add_F(CellId cell, const Element& factor, Terms<R>& out);
  void add_G(ops::FamilyId family, Index generator, const Element& factor, Terms<R>& out);
  void add_K(CellId cell, const Element& factor, Terms<R>& out);

  /// How many terms add_G and add_K add, without adding them; of the factors K is written out, G is not.
  [[nodiscard]] std::uint64_t terms_of_G(ops::FamilyId family, Index generator);
  [[nodiscard]] std::uint64_t terms_of_K(CellId cell);

  /// K of the lazy cells in g of a current cell, times a factor, in current cells (not in normal form): the part of K
  /// of that cell that no lift has.
  void add_K_of_lazy_part(CellId cell, const Element& factor, Terms<R>& out);

  /// The boundaries of lazy cells have gained terms: adds what those of generators gain by that. `lazy_parts`: the lazy
  /// cells in the boundaries of other generators.
  void add_gains(const Gains& gains, const std::unordered_map<Index, Terms<R>>& lazy_parts,
                 std::map<Index, Terms<R>>& changes);

  struct Mark {
    std::size_t families = 0;
    std::size_t gained = 0;
    std::size_t images = 0, homotopies = 0, lifts = 0;
  };
  [[nodiscard]] Mark mark() const {
    return {families_.size(), gained_.size(), images_known_.size(), homotopies_known_.size(), lifts_known_.size()};
  }
  /// Goes back to a mark; the big complex has been truncated to `generators`.
  void truncate(const Mark& mark, Index generators);

 private:
  struct Family {
    std::vector<Symbol> left, right;  ///< the small generators of the factors, sorted
    std::vector<Index> pairs;         ///< generator of the pair (i, j), at i * |right| + j
    Index first = 0;
    std::vector<std::uint32_t> places;  ///< per generator from `first` on: its place in `pairs`
    bool has_gains = false;
  };
  /// What does not change any more on a cell of a frozen body, once known.
  struct Homotopy {
    Terms<R> K, GF;
  };

  [[nodiscard]] const Family& family(ops::FamilyId id) const { return families_[id - first_family_]; }
  [[nodiscard]] std::vector<Symbol> symbols_of(ops::BodyId body) const;
  const Terms<R>& F_of(CellId cell);
  const Homotopy& homotopy_of(CellId cell);
  const Terms<R>& G_of(Symbol symbol);
  [[nodiscard]] std::uint64_t terms_of_lift(Symbol symbol);
  [[nodiscard]] std::uint64_t terms_of_K_of_product(ops::FamilyId family, CellId left, CellId right);
  /// Of how many cells the tensor product of a p-cell and a q-cell is the sum.
  [[nodiscard]] std::uint64_t cells_of_pair(ops::FamilyId family, int p, int q) const;
  void add_tensor(const Family& family, const Terms<R>& left, const Terms<R>& right, const Element& factor,
                  Terms<R>& out) const;
  void add_pairs(ops::FamilyId family, const Terms<R>& left, const Terms<R>& right, const Element& factor,
                 Terms<R>& out);
  void add_K_of_product(ops::FamilyId family, CellId left, CellId right, const Element& factor, Terms<R>& out);
  [[nodiscard]] ops::Value restrict(ops::Value v, const reductions::Vertices& map) const;
  void add_simplicial_pair(ops::FamilyId family, const reductions::SignedPair& maps, const ops::Value& left,
                           const ops::Value& right, const Element& factor, Terms<R>& out) const;
  [[nodiscard]] Element coefficient_of_G(const ops::LazyKey& key, Symbol left, Symbol right);
  void subtract_gains(const Gains& gains, CellId cell, const Element& factor, Terms<R>& out);

  R ring_;
  const Structure& structure_;
  BigComplex<R>& big_;
  Rewriter<R>& rewriter_;
  ops::FamilyId first_family_;  ///< of the window
  std::vector<Family> families_;
  std::unordered_map<CellId, Terms<R>> images_;  ///< F of cells of frozen bodies, in symbols
  std::unordered_map<CellId, Homotopy> homotopies_;
  std::unordered_map<Symbol, Terms<R>> lifts_;  ///< G of their small generators
  // In the order in which they became known: what undo takes back may name nodes that go.
  std::vector<CellId> images_known_, homotopies_known_;
  std::vector<Symbol> lifts_known_;
  reductions::EilenbergZilberTerms terms_;
  Gains gains_;                 ///< of lazy cells, summed over all de-identifications
  std::vector<CellId> gained_;  ///< its keys, for undo
};

}  // namespace sesame::engine

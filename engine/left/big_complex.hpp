/// \file
/// The big complex B of a history of steps, append-only, and the left reduction (f, g, h): B => C onto the object.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "engine/left/window.hpp"
#include "ops/cells/structure.hpp"
#include "sparse/matrix.hpp"

namespace sesame::engine {

using sparse::Index;
using sparse::Ring;
using sparse::Terms;

template <Ring R>
class LazyMaps;

/// The big complex. It has one generator per cell ever created and one per removal of a cell, so |B| <= 2 |cells|.
///
///   a cell c created with faces c_k     generator [c] of degree dim c,      boundary g(d c)
///   a cell x removed in favour of y     generator <x> of degree dim x + 1,  boundary g(y) - g(x), or -g(y) - g(x)
///                                                                           when x became y with the opposite
///                                                                           orientation
///   a cell x that became degenerate     generator <x> of degree dim x + 1,  boundary -g(x)
///   a copy y of a cell x                generator e of degree dim x,        boundary: that of y - x in other copies
///
/// This is the cone of iB: B0 -> B1 of the exact sequence of each step, [[dB1, iB], [0, -dB0]], grown in place: the new
/// columns are appended, the old block is neither copied nor read. A de-identification is the backward sequence: the
/// boundaries of old generators gain terms in the e of its copies. The left reduction is never stored as a matrix:
///
///   f [c] = the cell that c is now or 0, f <x> = 0, f e = y - x       (the union-find forest of the structure)
///   g c   = [c] + sum over faces k of sign_k P(c_k)                   (the identity, plus corrections)
///   g y   = e + g x as it was when y was made, plus corrections since
///   h [c] = -P(c), h <x> = 0, h e = P(x) - P(y)
///
/// where P(x) is the sum of the generators <y> on the path of the forest from x to the cell that x is now, each with
/// the sign with which x had become y; f has the sign of the whole path. For a face that has moved, P runs along the
/// path of what the face was until then, and along that of what it is since.
///
/// *Changes of basis.* When all incidences of a node go to a copy, its generators go with them: G becomes G + e. Then
/// the boundaries of its cofaces need no change, and what has to change is young: the <x> that had glued it. `shifts_`
/// remembers the e that were added to a generator, `as_created_` how the generators as created are written now.
///
/// Lazy cells have no generators of their own. Those of a product have one for each pair of small generators of the
/// factors, and g of a lazy cell is its image under the tensor product of the factors' maps; so for them this is the
/// reduced big complex, and f and g are one half of a homological equivalence: see LazyMaps.
///
/// All this is about the part of the history that a Window shows: cells that were there at its beginning count as
/// created then, and the forest begins with each of them on its own.
///
/// Source: S. Peltier's habilitation (2023), section 3.3.3; see engine/LIVE_FORM.md.
template <Ring R>
class BigComplex {
 public:
  /// The big complex of a part of the history: it begins with a generator for each cell of the window's beginning.
  /// `window` must outlive it.
  BigComplex(R ring, const Window& window);

  [[nodiscard]] const R& ring() const { return ring_; }
  [[nodiscard]] Index size() const { return static_cast<Index>(origin_.size()); }
  [[nodiscard]] int degree(Index generator) const { return degree_[generator]; }
  /// The boundary of B as one square matrix over all degrees.
  [[nodiscard]] const sparse::Matrix<R>& boundary() const { return boundary_; }
  /// The number of generators of each degree, up to the largest that has one.
  [[nodiscard]] const std::vector<std::uint32_t>& counts() const { return counts_; }
  /// The body whose cells a generator belongs to.
  [[nodiscard]] ops::BodyId body_of(Index generator) const;

  /// The entries ever appended to the boundary, undone ones included.
  [[nodiscard]] std::uint64_t entries_appended() const { return entries_appended_; }
  /// The links ever followed on the paths P(x).
  [[nodiscard]] std::uint64_t links_followed() const { return links_followed_; }

  /// What gives the maps of lazy cells. Set once, before there are any.
  void set_lazy_maps(LazyMaps<R>& maps) { lazy_maps_ = &maps; }

  /// Appends the generator of the next cell (a lazy one, or one degenerate from the start, has none: then nothing), of
  /// the next removal. Cost O(faces of faces * log cells).
  std::optional<Index> append_cell(CellId cell);
  Index append_removal(LinkId link);
  /// Appends a generator for a pair of small generators of a product's factors, with its boundary (in normal form).
  Index append_pair(ops::FamilyId family, int degree, std::span<const sparse::Term<R>> boundary);
  /// Appends the generator of the next cell, a copy.
  Index append_copy(CellId copy);
  /// The boundaries of old generators gain what the moves of a de-identification give them, in the generators from
  /// `first` on, those of the copies. Returns the generators whose boundaries have changed.
  std::vector<Index> split(Index first, std::span<const Structure::MadeMove> moves);

  /// Begins to remember the columns that get an entry at the generator of a cell: it may come up where none of those
  /// who have the cell as a face or were removed next to it are appended.
  void follow(CellId cell) { columns_followed_.try_emplace(generator_of(cell)); }

  struct Mark {
    Index generators = 0;
    CellId cells = 0;
    LinkId links = 0;
    std::size_t changed = 0;
    std::size_t shifted = 0;
  };
  [[nodiscard]] Mark mark() const { return {size(), cells(), links(), changed_.size(), shifted_.size()}; }
  void truncate(const Mark& mark);

  /// g of a current cell, in normal form; times a factor, added to `out` (not in normal form).
  [[nodiscard]] Terms<R> g(CellId cell) const;
  void add_g(CellId cell, const typename R::Element& factor, Terms<R>& out) const;
  /// The lazy cells in g of a cell, as chains of the lazy families: for a lazy cell itself, with the factor.
  void add_lazy_part(CellId cell, const typename R::Element& factor, Terms<R>& out) const;
  /// P(x) times a factor, added to `out` (not in normal form); of the path up to a number of removals.
  void add_path(CellId x, LinkId links, const typename R::Element& factor, Terms<R>& out) const;
  /// A generator as it was when it was appended, in the present basis, times a factor, added to `out`.
  void add_as_created(Index generator, const typename R::Element& factor, Terms<R>& out) const;
  /// f of a generator times a factor, added to `out`: current cells, not in normal form.
  void add_f(Index generator, const typename R::Element& factor, Terms<R>& out) const;
  /// A chain of cells as created, as the current cells that they are now, added to `out` (not in normal form).
  void add_as_now(std::span<const sparse::Term<R>> nodes, Terms<R>& out) const;
  /// f of a chain of B, as a chain of current cells (indices are cell ids), in normal form.
  [[nodiscard]] Terms<R> f(std::span<const sparse::Term<R>> chain) const;
  /// How many terms `f` adds up, without writing out more than the factors of lazy families.
  [[nodiscard]] std::uint64_t terms_of_f(std::span<const sparse::Term<R>> chain) const;
  /// h of a generator, in normal form. Requires: there are no lazy families.
  [[nodiscard]] Terms<R> h(Index generator) const;

 private:
  static constexpr std::uint32_t removal = 0x8000'0000U;  ///< mark of <x> in origin_
  static constexpr std::uint32_t pair = 0x4000'0000U;     ///< mark of a pair, with its family

  Index append(std::uint32_t origin, int degree);
  [[nodiscard]] std::uint64_t terms_of_f(Index generator) const;
  void append_first_cells();
  /// The generator made for a node, or none.
  [[nodiscard]] Index generator_of(CellId node) const {
    return window_.is_first(node) ? window_.place(node) : of_cell_[node - window_.begin().created];
  }
  [[nodiscard]] Index generator_of_link(LinkId link) const { return of_link_[link - window_.begin().links]; }
  /// The number of cells, of removals that have been taken in.
  [[nodiscard]] CellId cells() const { return window_.begin().created + static_cast<CellId>(of_cell_.size()); }
  [[nodiscard]] LinkId links() const { return window_.begin().links + static_cast<LinkId>(of_link_.size()); }
  void add_g_at(CellId cell, const ops::Moment& moment, const typename R::Element& factor, Terms<R>& out) const;
  void add_cell(CellId node, const typename R::Element& factor, Terms<R>& out) const;
  [[nodiscard]] std::vector<Index> generators_of(CellId node) const;
  [[nodiscard]] std::vector<Index> columns_with(Index generator) const;
  using MoveSet = std::set<std::tuple<CellId, std::uint32_t, CellId>>;  ///< (cell, face number, copy)
  [[nodiscard]] bool moves_wholly(CellId node, CellId copy, const MoveSet& moves) const;
  void shift(CellId node, CellId copy, Index first, std::map<Index, Terms<R>>& changes);

  R ring_;
  const Window& window_;
  const Structure& structure_;
  LazyMaps<R>* lazy_maps_ = nullptr;
  sparse::Matrix<R> boundary_;
  std::vector<std::uint32_t> origin_;  ///< per generator: a cell, or removal | link, or pair | family
  std::vector<std::uint8_t> degree_;
  std::vector<Index> of_cell_, of_link_;  ///< of those made in the window
  std::vector<std::uint32_t> counts_;
  std::vector<Index> changed_;                     ///< generators whose boundaries gained terms, for undo
  std::unordered_map<Index, Terms<R>> lazy_part_;  ///< of the boundary of a generator: lazy cells as created
  struct Shift {
    CellId node, copy;
    std::vector<Index> generators;  ///< that were the node's and are the copy's since
  };
  std::vector<Shift> shifted_;                                      ///< for undo
  std::unordered_map<Index, std::vector<Index>> shifts_;            ///< per generator: the e that were added to it
  std::unordered_map<Index, std::vector<Index>> shifted_by_;        ///< per e: the generators that it was added to
  std::unordered_map<Index, Terms<R>> as_created_;                  ///< where not the generator itself
  std::unordered_map<Index, std::set<Index>> in_as_created_;        ///< the keys above whose chain has a generator
  std::unordered_map<CellId, std::vector<Index>> generators_of_;    ///< of nodes, where not the node's own alone
  std::unordered_map<Index, std::vector<Index>> columns_followed_;  ///< columns with a generator, for those followed
  std::uint64_t entries_appended_ = 0;
  mutable std::uint64_t links_followed_ = 0;
  Terms<R> column_, lazy_column_;  ///< scratch
};

}  // namespace sesame::engine

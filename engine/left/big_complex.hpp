/// \file
/// The big complex B of a history of steps, append-only: how it grows and is cut back.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "engine/left/left_maps.hpp"
#include "sparse/column_store.hpp"

namespace sesame::engine {

/// The big complex. It has one generator per cell ever created and one per removal of a cell, so |B| <= 2 |cells|.
///
///   a cell c created with faces c_k     generator [c] of degree dim c,      boundary g(d c)
///   a cell x removed in favour of y     generator <x> of degree dim x + 1,  boundary g(y) - g(x), or -g(y) - g(x)
///                                                                           when x became y with the opposite
///                                                                           orientation
///   a cell x that became degenerate     generator <x> of degree dim x + 1,  boundary -g(x)
///   a copy y of a cell x                generator e of degree dim x,        boundary: that of y - x in other copies
///   a cell z that was taken away        generator u of degree dim z - 1,    boundary 0
///
/// This is the cone of iB: B0 -> B1 of the exact sequence of each step, [[dB1, iB], [0, -dB0]], grown in place: the new
/// columns are appended, the old block is neither copied nor read. A de-identification is the backward sequence: the
/// boundaries of old generators gain terms in the e of its copies. A deletion is the sequence read for its kernel: the
/// boundary of each old generator b gains u as often as f(b) has z. For g see LeftMaps.
///
/// *Changes of basis.* When all incidences of a node go to a copy, its generators go with them: G becomes G + e. Then
/// the boundaries of its cofaces need no change, and what has to change is young: the <x> that had glued it. See
/// BasisShifts.
///
/// Lazy cells have no generators of their own. Those of a product have one for each pair of small generators of the
/// factors, and g of a lazy cell is its image under the tensor product of the factors' maps; so for them this is the
/// reduced big complex, and f and g are one half of a homological equivalence: see Families.
///
/// All this is about the part of the history that a Window shows: cells that were there at its beginning count as
/// created then, and the forest begins with each of them on its own.
///
/// Source: S. Peltier's habilitation (2023), section 3.3.3; see engine/LIVE_FORM.md.
///
/// Threads: one at a time, for queries too.
template <Ring R>
class BigComplex {
 public:
  /// The big complex of a part of the history: it begins with a generator for each cell of the window's beginning.
  /// `window` must outlive it.
  BigComplex(R ring, const Window& window);
  BigComplex(const BigComplex&) = delete;
  BigComplex& operator=(const BigComplex&) = delete;
  ~BigComplex() = default;

  [[nodiscard]] const R& ring() const { return ring_; }
  [[nodiscard]] GeneratorId size() const { return generators_.size(); }
  [[nodiscard]] int degree(GeneratorId generator) const { return generators_.degree(generator); }
  /// The boundary of B as one square matrix over all degrees.
  [[nodiscard]] const sparse::ColumnStore<R, GeneratorId>& boundary() const { return boundary_; }
  /// The number of generators of each degree, up to the largest that has one.
  [[nodiscard]] const std::vector<std::uint32_t>& counts() const { return generators_.counts(); }
  [[nodiscard]] const Generators& generators() const { return generators_; }
  /// The body whose cells a generator belongs to.
  [[nodiscard]] ops::BodyId body_of(GeneratorId generator) const { return generators_.body_of(generator); }
  /// f, g and h.
  [[nodiscard]] const LeftMaps<R>& maps() const { return maps_; }

  /// The entries ever appended to the boundary, undone ones included.
  [[nodiscard]] std::uint64_t entries_appended() const { return entries_appended_; }

  /// Appends the generator of the next cell that a step made, of the next removal. Cost O(faces of faces * log cells).
  GeneratorId append_cell(CellId cell);
  GeneratorId append_removal(LinkId link);
  /// Appends a generator of the next lazy family, with its boundary (in normal form); then the maps of that family.
  GeneratorId append_of_family(ops::FamilyId family, int degree,
                               std::span<const sparse::Term<R, GeneratorId>> boundary);
  void append_family(std::unique_ptr<FamilyMaps<R>> maps) { families_.add(std::move(maps)); }
  /// Appends the generator of the next cell, a copy.
  GeneratorId append_copy(CellId copy);
  /// The boundaries of old generators gain what the moves of a de-identification give them, in the generators from
  /// `first` on, those of the copies. Returns the generators whose boundaries have changed.
  std::vector<GeneratorId> split(GeneratorId first, ops::MoveRange moves);
  /// Appends the generator of the next removal, which is a deletion.
  GeneratorId append_deletion(LinkId link);
  /// The boundaries of old generators gain what the last one, of a deletion, gives them. Returns those generators.
  /// Cost: the nodes that the cell stands for.
  std::vector<GeneratorId> take_away(GeneratorId deletion);

  /// Begins to remember the columns that get an entry at the generator of a cell: it may come up where none of those
  /// who have the cell as a face or were removed next to it are appended.
  void follow(CellId cell) { columns_followed_.try_emplace(generators_.of(cell)); }

  struct Mark {
    Generators::Mark generators;
    std::size_t changed = 0;
    std::size_t shifts = 0;
    typename Families<R>::Mark families;
    [[nodiscard]] GeneratorId size() const { return generators.generators; }
  };
  [[nodiscard]] Mark mark() const { return {generators_.mark(), changed_.size(), shifts_.mark(), families_.mark()}; }
  /// Goes back to a mark. Cost: the generators that go, and the boundaries that splits have changed since.
  void truncate(const Mark& mark);

 private:
  using Changes = std::map<GeneratorId, Terms<R, GeneratorId>>;         ///< of boundaries, per generator
  using MoveSet = std::set<std::tuple<CellId, std::uint32_t, CellId>>;  ///< (cell, face number, copy)

  void begin_column();
  void add_to_column(CellId cell, int sign);
  void append_column(GeneratorId generator);
  [[nodiscard]] Changes gains_of_moves(GeneratorId first, ops::MoveRange moves);
  void add_gains(CellId cell, const Terms<R, GeneratorId>& gain, GeneratorId first, Changes& changes,
                 typename Families<R>::Gains& of_lazy) const;
  std::vector<GeneratorId> amend(const Changes& changes);
  void shift_basis(GeneratorId first, ops::MoveRange moves, Changes& changes);
  [[nodiscard]] bool moves_wholly(CellId node, CellId copy, const MoveSet& moves) const;
  void add_changes_of_shift(CellId node, CellId copy, GeneratorId first, Changes& changes) const;
  [[nodiscard]] std::vector<GeneratorId> columns_with(GeneratorId generator) const;

  R ring_;
  const Window& window_;
  const Structure& structure_;
  Generators generators_;
  Deletions deletions_;
  BasisShifts<R> shifts_;
  Families<R> families_;
  LeftMaps<R> maps_;
  sparse::ColumnStore<R, GeneratorId> boundary_;
  std::vector<GeneratorId> changed_;  ///< generators whose boundaries gained, for undo
  /// Columns with a generator, for those followed.
  std::unordered_map<GeneratorId, std::vector<GeneratorId>> columns_followed_;
  std::uint64_t entries_appended_ = 0;
  RawTerms<R, GeneratorId> gathered_;  ///< the next column
  RawTerms<R, CellId> gathered_lazy_;  ///< the lazy cells in it
  Terms<R, GeneratorId> column_;       ///< scratch
};

}  // namespace sesame::engine

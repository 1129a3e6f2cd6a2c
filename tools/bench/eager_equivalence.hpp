/// \file
/// The homological equivalence C <= B => S with every map an explicit matrix, changed in place by each step as the
/// theorem on short exact sequences says.
///
/// Letters as in reductions/: the left reduction (f, g, h) leads from B to the object C, the right one (fS, gS, hS)
/// from B to the small complex S.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "engine/homology_tracker.hpp"
#include "ops/plan/step_sequence.hpp"
#include "reductions/by_columns.hpp"
#include "reductions/equivalence.hpp"
#include "tools/bench/two_way_matrix.hpp"

namespace sesame::tools {

/// Which maps are kept current.
enum class Keep {
  all_maps,   ///< f, g, h, fS, gS, hS and all boundaries
  small_only  ///< what the next small complex is computed from: g, fS and the boundary of S
};

/// An equivalence that grows. Cells, which generate C, are numbered by the caller; generators of B are numbered as they
/// come, and S keeps some of them: a small generator has the number that it has in B.
///
/// Every step is made of the matrices of the theorem, with the equivalence of the small end of the sequence (new cells,
/// removed cells, copies) trivial; blocks are appended, the old ones neither copied nor read but where the formulas
/// have a product with them (`sparse::Matrix::merge`). Unit pairs of S are eliminated at once, of all possible ones the
/// pair whose row of fS is shortest: without that choice, which no source names, a step that joins a small piece to a
/// large one could rewrite all of the large one. Source: S. Peltier, habilitation (2023), theorem 4 and section 3.3.3;
/// W. Rharbaoui's thesis (2022).
template <sparse::Ring R>
class EagerEquivalence {
 public:
  using Index = sparse::Index;
  using Terms = sparse::Terms<R>;
  using Element = typename R::Element;
  /// Some columns of a matrix, each by its number.
  using Columns = std::vector<std::pair<Index, Terms>>;

  EagerEquivalence(R ring, Keep keep)
      : ring_{ring},
        keep_{keep},
        d_{ring, 0, 0},
        f_{ring},
        g_{ring, 0, 0},
        h_{ring, 0, 0},
        f_small_{ring},
        g_small_{ring},
        h_small_{ring},
        d_small_{ring} {}

  /// Backward sequence: a cell is added. `boundary` is in cells that are there.
  void add_cell(Index cell, int degree, const Terms& boundary);

  /// A removed cell x of a forward sequence. Chains of removed cells are written by their positions in the list.
  struct Removed {
    Index cell;
    int degree;
    Terms becomes;   ///< j(x), in cells that stay
    Terms boundary;  ///< d0 x, in removed cells: those of lower degree, which come first
  };
  /// Forward sequence: identification and degeneracy. `chi` lists, for each cell c that stays and has chi(c) != 0, that
  /// chain of removed cells. Cost: the rows of f of the removed cells, the columns of g and hS named, and eliminations.
  void remove_cells(const std::vector<Removed>& removed, const Columns& chi);

  /// A copy y of a cell x in a backward sequence. Chains of copies are written by their positions in the list.
  struct Copy {
    Index cell, source;
    int degree;
    Terms boundary;  ///< d0 (y - x), in copies: those of lower degree, which come first
  };
  /// Backward sequence: de-identification. `chi` as above, chains of copies. Requires: all maps are kept.
  /// Cost: the columns of hS and gS with a generator whose boundary in B changes, and eliminations.
  void split_cells(const std::vector<Copy>& copies, const Columns& chi);

  /// Betti numbers, torsion and sizes of degrees 0 to `dimensions` - 1. Cost: O(dimensions); over Z, a Smith form of
  /// the boundary of S in each degree in which that has changed.
  [[nodiscard]] engine::Homology homology(std::size_t dimensions);
  /// The generators of all homology groups as chains of cells; returns their number of terms.
  /// Requires: all maps are kept. Cost: the homology of S, and the terms of gS and f that are added up, sorted.
  [[nodiscard]] std::uint64_t map_generators();

  /// The entries of all matrices kept. Cost: the columns.
  [[nodiscard]] std::uint64_t entries_held() const;
  /// The entries that were read and written so far.
  [[nodiscard]] std::uint64_t entries_touched() const;

  /// The equivalence as matrices: the generators of C are cells, those of B and S go by their numbers.
  /// Requires: all maps are kept; `object` has these cells. Cost: the size of it all.
  [[nodiscard]] reductions::Equivalence<R> matrices(const reductions::ChainComplex<R>& object,
                                                    const ops::CellBasis& cells) const;

 private:
  [[nodiscard]] Index size() const { return static_cast<Index>(degrees_.size()); }
  [[nodiscard]] bool keeps_all() const { return keep_ == Keep::all_maps; }
  void add(Terms& into, const Element& factor, const Terms& terms);
  /// matrix * chain.
  template <class Matrix>
  [[nodiscard]] Terms image(const Terms& chain, const Matrix& matrix);
  [[nodiscard]] Terms shifted(const Terms& terms, Index by) const;

  [[nodiscard]] sparse::Matrix<R> block(Index rows, Index columns, const Columns& stored) const;
  void merge(sparse::Matrix<R>& into, const sparse::Matrix<R>& below, const sparse::Matrix<R>& corner);
  void append_to(sparse::Matrix<R>& matrix, const Terms& column) const;
  void set_g(Index cell, const Terms& column);

  /// Appends a generator with this boundary in B to the right reduction.
  void append(int degree, const Terms& boundary);
  void eliminate_units(std::set<Index> columns);
  [[nodiscard]] std::optional<Index> best_unit(Index b);
  void eliminate(Index a, Index b);
  void settle(Index b);

  [[nodiscard]] Columns pulled_back_removal(const std::vector<Removed>& removed);
  /// delta = chi f, by columns; chains of copies, the first of which is generator `first` of B.
  [[nodiscard]] Columns perturbation(const Columns& chi);
  void perturb_right(const Columns& delta, Index first, std::set<Index>& changed);

  /// Of one degree.
  struct Level {
    std::uint32_t big_size = 0;
    std::set<Index> small;          ///< generators of S
    std::set<Index> with_boundary;  ///< those whose boundary is not zero
    /// The invariant factors of these boundaries, until one of them changes.
    std::optional<std::vector<Element>> factors;
  };
  [[nodiscard]] Level& level(int degree);
  [[nodiscard]] Level& level_of(Index b) { return level(degrees_[b]); }
  [[nodiscard]] const std::vector<Element>& invariant_factors(Level& level) const;

  [[nodiscard]] reductions::Basis<Index> small_generators() const;

  R ring_;
  Keep keep_;
  std::vector<int> degrees_;  ///< of the generators of B
  sparse::Matrix<R> d_;       ///< of B
  TwoWayMatrix<R> f_;
  sparse::Matrix<R> g_;  ///< by cell
  sparse::Matrix<R> h_;
  TwoWayMatrix<R> f_small_;
  TwoWayMatrix<R> g_small_;  ///< by generator; zero for those that S does not have
  TwoWayMatrix<R> h_small_;
  TwoWayMatrix<R> d_small_;    ///< likewise
  std::vector<Level> levels_;  ///< by degree
  std::uint64_t touched_ = 0;  ///< outside of the two-way matrices
};

/// All terms first, then one sorting: adding column after column would read a long image again for each.
template <sparse::Ring R>
template <class Matrix>
auto EagerEquivalence<R>::image(const Terms& chain, const Matrix& matrix) -> Terms {
  sparse::RawTerms<R> image;
  for (const auto& term : chain) {
    matrix.for_each_in_column(term.index, [&](const sparse::Term<R>& entry) {
      image.push_back({entry.index, ring_.multiply(term.coefficient, entry.coefficient)});
    });
  }
  touched_ += image.size();
  return std::move(image).normal(ring_);
}

}  // namespace sesame::tools

/// \file
/// The lazy families that a window has seen made, as the big complex knows them.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/left/basis_shifts.hpp"
#include "engine/left/family_maps.hpp"
#include "sparse/contract.hpp"

namespace sesame::engine {

/// The maps of each family; what de-identifications have changed in them; and which generators of B are *attached* to
/// lazy cells: those whose boundary, in the big complex that is not reduced, has lazy cells.
///
/// A de-identification that moves faces of lazy cells is a perturbation chi of the families' equivalences with values
/// in its new generators e: F c has -chi(K c) more, the boundary of a generator s has chi(G s) more, that of a
/// generator attached to lazy cells z has -chi(K z) more; G and K stay (the basic perturbation lemma). chi is kept
/// summed over all de-identifications: the *gains* of the lazy cells.
///
/// Source: engine/LIVE_FORM.md.
///
/// Threads: one at a time, for queries too.
template <Ring R>
class Families {
 public:
  using Element = typename R::Element;

  /// `window` and `shifts` must outlive it.
  Families(R ring, const Window& window, const BasisShifts<R>& shifts)
      : ring_{ring}, window_{window}, structure_{window.structure()}, shifts_{shifts} {}

  /// The next family.
  void add(std::unique_ptr<FamilyMaps<R>> maps) { maps_.push_back(std::move(maps)); }
  [[nodiscard]] const FamilyMaps<R>& maps(ops::FamilyId family) const {
    const std::size_t at = family - window_.begin().families;
    sparse::expects(at < maps_.size(), "a window that begins with a family knows all cells of it");
    return *maps_[at];
  }

  /// F of a lazy cell times a factor, gains included, in the present basis of B; K of one, in cells as created.
  void add_F(CellId cell, const Element& factor, RawTerms<R, GeneratorId>& out) const;
  void add_K(CellId cell, const Element& factor, RawTerms<R, CellId>& out) const {
    maps_of(cell).add_K(cell, factor, out);
  }

  /// Attaches a generator to a chain of lazy cells as created. Requires: it is younger than those attached before.
  void attach(GeneratorId generator, Terms<R, CellId> lazy_cells) {
    attached_.emplace_back(generator, std::move(lazy_cells));
  }
  [[nodiscard]] bool has_attached() const { return !attached_.empty(); }
  /// K of the lazy cells that a generator is attached to, times a factor, in cells as created; how many terms that
  /// adds.
  void add_K_of_attached(GeneratorId generator, const Element& factor, RawTerms<R, CellId>& out) const;
  [[nodiscard]] std::uint64_t terms_of_K_of_attached(GeneratorId generator) const;

  using Gains = std::map<CellId, Terms<R, GeneratorId>>;
  /// The boundaries of lazy cells have gained chains of new generators: adds what those of generators gain by that.
  /// Cost: the generators attached to lazy cells and those of the families concerned, each times the cells that gain.
  void add_gains(const Gains& gains, std::map<GeneratorId, Terms<R, GeneratorId>>& changes);

  struct Mark {
    std::size_t families = 0;
    std::size_t gained = 0;
  };
  [[nodiscard]] Mark mark() const { return {maps_.size(), gained_.size()}; }
  /// Goes back to a mark; the generators from `first` on are to go. Cost: what goes.
  void truncate(const Mark& mark, GeneratorId first);

 private:
  using Place = std::pair<ops::FamilyId, int>;  ///< cells of one family and dimension
  using GainsByPlace = std::map<Place, Gains>;

  [[nodiscard]] const FamilyMaps<R>& maps_of(CellId cell) const { return maps(structure_.lazy().of(cell)->key.family); }
  [[nodiscard]] Place place_of(CellId cell) const {
    return {structure_.lazy().of(cell)->key.family, structure_.dimension(cell)};
  }
  [[nodiscard]] std::span<const sparse::Term<R, CellId>> attached_to(GeneratorId generator) const;
  void subtract_gains_of_K(const GainsByPlace& gains, CellId cell, const Element& factor,
                           RawTerms<R, GeneratorId>& out) const;

  R ring_;
  const Window& window_;
  const Structure& structure_;
  const BasisShifts<R>& shifts_;
  std::vector<std::unique_ptr<FamilyMaps<R>>> maps_;
  std::vector<std::pair<GeneratorId, Terms<R, CellId>>> attached_;  ///< by generator, increasing
  GainsByPlace gains_;
  std::vector<std::pair<Place, CellId>> gained_;  ///< its keys as they gained, for undo
};

}  // namespace sesame::engine

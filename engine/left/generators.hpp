/// \file
/// The generators of the big complex B: what each stands for.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/left/window.hpp"
#include "engine/right/symbol.hpp"

namespace sesame::engine {

/// One generator per cell that a window has seen made (copies are cells), one per removal of a cell, and those of lazy
/// families. They are numbered in the order in which they were appended, the cells of the window's beginning first.
///
/// Invariants: what a generator stands for never changes; a cell that is lazy, or degenerate from the start, has none.
/// Every query is O(1), that by a cell of the window's beginning by a hash.
class Generators {
 public:
  /// None yet. `window` must outlive it.
  explicit Generators(const Window& window) : window_{window}, structure_{window.structure()} {}

  [[nodiscard]] GeneratorId size() const { return GeneratorId{origin_.size()}; }
  [[nodiscard]] int degree(GeneratorId generator) const { return degree_[generator]; }
  /// The number of generators of each degree, up to the largest that has one.
  [[nodiscard]] const std::vector<std::uint32_t>& counts() const { return counts_; }
  /// The body whose cells a generator belongs to.
  [[nodiscard]] ops::BodyId body_of(GeneratorId generator) const;

  [[nodiscard]] bool is_removal(GeneratorId generator) const { return (origin_[generator] & removal_bit) != 0; }
  [[nodiscard]] bool is_of_family(GeneratorId generator) const { return (origin_[generator] & family_bit) != 0; }
  /// The cell that a generator was made for. Requires: it is neither of a removal nor of a family.
  [[nodiscard]] CellId cell(GeneratorId generator) const { return CellId{origin_[generator]}; }
  [[nodiscard]] ops::FamilyId family(GeneratorId generator) const {
    return ops::FamilyId{origin_[generator] & ~family_bit};
  }

  /// The generator made for a node that the window knows, or none.
  [[nodiscard]] GeneratorId of(CellId node) const {
    return window_.is_first(node) ? GeneratorId{window_.place(node)} : of_cell_[node - window_.begin().created];
  }
  [[nodiscard]] GeneratorId of_link(LinkId link) const { return of_link_[link - window_.begin().links]; }
  /// The number of nodes, of removals that have been taken in, those before the window included.
  [[nodiscard]] CellId cells() const { return window_.begin().created + of_cell_.size(); }
  [[nodiscard]] LinkId links() const { return window_.begin().links + of_link_.size(); }

  /// The next cell of the window's beginning; the next node, with a generator or without; the next removal; a generator
  /// of a family. All return the generator.
  GeneratorId append_first(CellId cell) { return append(cell, structure_.dimension(cell)); }
  GeneratorId append_cell(CellId cell) {
    of_cell_.push_back(size());
    return append(cell, structure_.dimension(cell));
  }
  void skip_cell() { of_cell_.push_back(ops::none); }
  GeneratorId append_removal(LinkId link) {
    of_link_.push_back(size());
    return append(removal_bit | link, structure_.dimension(structure_.forest().removed(link)) + 1);
  }
  GeneratorId append_of_family(ops::FamilyId family, int degree) { return append(family_bit | family, degree); }

  struct Mark {
    GeneratorId generators = 0;
    CellId cells = 0;
    LinkId links = 0;
  };
  [[nodiscard]] Mark mark() const { return {size(), cells(), links()}; }
  /// Cost: the generators that go.
  void truncate(const Mark& mark);

 private:
  static constexpr std::uint32_t removal_bit = 0x8000'0000U;
  static constexpr std::uint32_t family_bit = 0x4000'0000U;

  GeneratorId append(std::uint32_t origin, int degree);

  const Window& window_;
  const Structure& structure_;
  std::vector<std::uint32_t> origin_;  ///< per generator: a cell, or removal_bit | link, or family_bit | family
  std::vector<std::uint8_t> degree_;
  std::vector<GeneratorId> of_cell_, of_link_;  ///< of those made in the window
  std::vector<std::uint32_t> counts_;
};

}  // namespace sesame::engine

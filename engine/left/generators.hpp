/// \file
/// The generators of the big complex B: what each stands for.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/left/window.hpp"
#include "engine/right/symbol.hpp"
#include "sparse/growing_array.hpp"

namespace sesame::engine {

/// One generator per cell that a window has seen made (copies are cells), one per removal of a cell and per deletion,
/// and those of lazy families. That of a deleted vertex has degree -1. They are numbered in the order in which they
/// were appended, the cells of the window's beginning first.
///
/// Invariants: what a generator stands for never changes; a cell that is lazy, or degenerate from the start, has none.
/// Every query is O(1), that by a cell of the window's beginning by a hash.
///
/// Threads: one at a time, for queries too.
class Generators {
 public:
  /// None yet. `window` must outlive it.
  explicit Generators(const Window& window) : window_{window}, structure_{window.structure()} {}

  [[nodiscard]] GeneratorId size() const { return GeneratorId{origin_.size()}; }
  [[nodiscard]] int degree(GeneratorId generator) const {
    // That of a deletion is kept as the dimension of the cell.
    return (kind_and_degree_[generator] & ((1U << degree_bits) - 1)) - (is_deletion(generator) ? 1 : 0);
  }
  /// The number of generators of each degree from 0 on, up to the largest that has one.
  [[nodiscard]] const std::vector<std::uint32_t>& counts() const { return counts_; }
  /// The body whose cells a generator belongs to.
  [[nodiscard]] ops::BodyId body_of(GeneratorId generator) const;

  [[nodiscard]] bool is_removal(GeneratorId generator) const { return kind(generator) == Kind::removal; }
  [[nodiscard]] bool is_of_family(GeneratorId generator) const { return kind(generator) == Kind::family; }
  [[nodiscard]] bool is_deletion(GeneratorId generator) const { return kind(generator) == Kind::deletion; }
  [[nodiscard]] LinkId link(GeneratorId removal_or_deletion) const { return LinkId{origin_[removal_or_deletion]}; }
  /// The cell that a generator was made for. Requires: it is not of a removal, a deletion or a family.
  [[nodiscard]] CellId cell(GeneratorId generator) const { return CellId{origin_[generator]}; }
  [[nodiscard]] ops::FamilyId family(GeneratorId generator) const { return ops::FamilyId{origin_[generator]}; }

  /// The generator made for a node that the window knows, or none.
  [[nodiscard]] GeneratorId of(CellId node) const {
    return window_.is_first(node)    ? GeneratorId{window_.place(node)}
           : ops::is_asked_for(node) ? GeneratorId{ops::none}
                                     : of_cell_[node - window_.begin().created];
  }
  [[nodiscard]] GeneratorId of_link(LinkId link) const { return of_link_[link - window_.begin().links]; }
  /// Calls visit(generator) for what was made for a node in the window: its own generator, that of its removal or
  /// deletion.
  template <class Visit>
  void for_each_of(CellId node, Visit&& visit) const {
    if (!window_.is_first(node) || window_.is_cell_of_beginning(node)) {
      visit(of(node));
    }
    const LinkId link = structure_.forest().link_of(node);
    if (link != ops::none && link >= window_.begin().links) {
      visit(of_link(link));
    }
  }
  /// The number of nodes that steps made, of removals that have been taken in, those before the window included.
  [[nodiscard]] CellId cells() const { return window_.begin().created + of_cell_.size(); }
  [[nodiscard]] LinkId links() const { return window_.begin().links + of_link_.size(); }

  /// Makes room for the cells of the window's beginning.
  void reserve(std::size_t count) {
    origin_.reserve(count);
    kind_and_degree_.reserve(count);
  }
  /// The next cell of the window's beginning; the next node that a step made; the next removal, or
  /// deletion; a generator of a family. All return the generator.
  GeneratorId append_first(CellId cell) { return append(Kind::cell, cell, structure_.dimension(cell)); }
  GeneratorId append_cell(CellId cell) {
    of_cell_.push_back(size());
    return append(Kind::cell, cell, structure_.dimension(cell));
  }
  GeneratorId append_removal(LinkId link) {
    of_link_.push_back(size());
    return append(Kind::removal, link, structure_.dimension(structure_.forest().removed(link)) + 1);
  }
  GeneratorId append_deletion(LinkId link) {
    of_link_.push_back(size());
    return append(Kind::deletion, link, structure_.dimension(structure_.forest().removed(link)) - 1);
  }
  GeneratorId append_of_family(ops::FamilyId family, int degree) { return append(Kind::family, family, degree); }

  struct Mark {
    GeneratorId generators = 0;
    CellId cells = 0;
    LinkId links = 0;
  };
  [[nodiscard]] Mark mark() const { return {size(), cells(), links()}; }
  /// Cost: the generators that go.
  void truncate(const Mark& mark);

 private:
  enum class Kind : std::uint8_t { cell, removal, deletion, family };
  static constexpr int degree_bits = 6;
  static_assert(ops::largest_dimension + 1 < 1 << degree_bits);

  GeneratorId append(Kind kind, std::uint32_t origin, int degree);
  [[nodiscard]] Kind kind(GeneratorId generator) const {
    return static_cast<Kind>(kind_and_degree_[generator] >> degree_bits);
  }

  const Window& window_;
  const Structure& structure_;
  sparse::GrowingArray<std::uint32_t> origin_;  ///< per generator: a cell, a link, or a family
  sparse::GrowingArray<std::uint8_t> kind_and_degree_;
  sparse::GrowingArray<GeneratorId> of_cell_, of_link_;  ///< of those made in the window
  std::vector<std::uint32_t> counts_;
};

}  // namespace sesame::engine

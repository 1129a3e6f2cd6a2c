/// \file
/// An abstract simplicial complex that changes along a tower of simplicial maps: simplices are included, vertices
/// contracted; and simplices are taken out, along a zigzag. It keeps the present only: its size is that of the current
/// complex, however long the tower.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ops/simplicial/simplex_index.hpp"
#include "ops/simplicial/tower_rules.hpp"
#include "sparse/hash_index.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// Simplices have a *slot*, a number that is unique among the current ones of their dimension; slots are used again.
/// A simplex is oriented by the order of its vertices' slots, so its facet k, the one without vertex k, has coefficient
/// (-1)^k in its boundary.
///
/// Threads: one at a time, for queries too.
class TowerComplex {
 public:
  using Slot = SimplexIndex::Slot;
  using Fate = SimplexIndex::Fate;

  /// What a contraction makes of a simplex.
  struct Change {
    Slot slot;
    Slot survivor;  ///< when merged
    Fate fate;
    bool is_reversed;       ///< when renamed or merged: it becomes the other one with the opposite orientation
    std::uint8_t moved_at;  ///< the place of the moved vertex among its vertices
  };
  /// A contraction that has been worked out: the changes by dimension, those of the vertex itself first.
  using Changes = std::vector<std::vector<Change>>;

  /// Simplices have at most this dimension.
  static constexpr int largest_dimension = TowerRules::most_vertices - 1;

  /// Includes a simplex, whose facets must be there. Returns its slot; `facets` are those of this simplex then.
  /// Errors: see TowerRules::check_inclusion. Nothing has changed then. Cost: O(dimension^2).
  Result<Slot> include(std::span<const Label> labels);
  /// The facets of the simplex last included, facet k being the one without vertex k. None for a vertex.
  [[nodiscard]] std::span<const Slot> facets() const { return {facets_.data(), facets_size_}; }

  /// Works out the contraction of u into v, which have to be two vertices of the complex. It is carried out by
  /// `contract`, with nothing else in between. Errors: see TowerRules::check_contraction.
  /// Cost: the smaller of the two stars, times the dimension.
  Result<const Changes*> plan_contraction(Label u, Label v);
  /// Carries out the contraction worked out last; the merged vertex is called v.
  void contract();

  /// The slot of the simplex with these labels, in any order, when it is there. Cost: O(dimension^2).
  [[nodiscard]] std::optional<Slot> find(std::span<const Label> labels);
  /// Takes a simplex out. Requires: it is there, and is no face of another one.
  void exclude(int dimension, Slot slot);
  /// The number of simplices that have a vertex, itself among them. Requires: it is there.
  [[nodiscard]] std::size_t star_size(Label label);
  /// The simplices that have a vertex, by the labels of the others, which ascend; by dimension. The same.
  [[nodiscard]] std::vector<std::vector<Label>> link(Label label);
  /// Calls a vertex by another label. Requires: the vertex is there, and none is called so.
  void relabel(Label label, Label into);

  /// Which simplices are there, and what is wrong with an operation, by labels. Not longer than the complex.
  [[nodiscard]] TowerRules rules() const {
    return {simplices_, [this](Label label) { return find_vertex(label); }};
  }
  /// Calls visit(k, slot) for each facet of a current simplex of dimension >= 1, the one without its vertex k, but not
  /// for the vertex at `except`.
  template <class Visit>
  void for_each_facet(int dimension, Slot slot, std::size_t except, Visit&& visit) const;
  /// The labels of a current simplex, in the order that orients it.
  [[nodiscard]] std::vector<Label> labels(int dimension, Slot slot) const;
  /// The number of simplices of each dimension, up to the largest that has one.
  [[nodiscard]] std::span<const std::uint64_t> counts() const { return counts_; }
  /// All slots in use or free of a dimension are below this.
  [[nodiscard]] Slot slots(int dimension) const;
  /// Calls visit(slot) for each simplex of a dimension. Cost: the most that there ever were at once.
  template <class Visit>
  void for_each(int dimension, Visit&& visit) const;
  /// The incidences looked at by contractions so far: what they have cost.
  [[nodiscard]] std::uint64_t touched() const { return simplices_.touched(); }

 private:
  using Vertex = SimplexIndex::Vertex;  ///< the slot of a vertex
  static constexpr std::uint32_t nothing = SimplexIndex::nothing;

  [[nodiscard]] Vertex find_vertex(Label label) const;
  Result<Slot> include_vertex(Label label);
  [[nodiscard]] std::optional<SimplexIndex::Key> find_vertices(std::span<const Label> labels);
  bool find_facets(const SimplexIndex::Key& key);
  [[nodiscard]] Change change_of(std::size_t dimension, Slot slot);
  void carry_out(std::size_t dimension, const Change& change);
  void set_label(Vertex vertex, Label label);
  [[nodiscard]] Slot take_slot(std::size_t dimension);
  void free_slot(std::size_t dimension, Slot slot);

  SimplexIndex simplices_;       ///< of dimension 1, 2, ...
  std::vector<Label> label_of_;  ///< per vertex
  sparse::HashIndex vertices_of_labels_;
  std::vector<std::vector<Slot>> free_;  ///< slots, per dimension
  std::vector<std::uint64_t> counts_;

  std::array<Vertex, largest_dimension + 1> vertices_{};  ///< of the simplex that is being looked up, ascending
  std::array<Slot, largest_dimension + 1> facets_{};
  std::size_t facets_size_ = 0;
  Changes changes_;
  Vertex moved_ = none, kept_ = none;
  Label merged_label_ = 0;
};

template <class Visit>
void TowerComplex::for_each_facet(int dimension, Slot slot, std::size_t except, Visit&& visit) const {
  const SimplexIndex::Key key = SimplexIndex::key(simplices_.vertices(static_cast<std::size_t>(dimension), slot));
  for (std::size_t k = 0; k < key.vertices.size(); ++k) {
    if (k != except) {
      visit(k, dimension == 1 ? Slot{key.vertices[1 - k]} : simplices_.find_facet(key, k));
    }
  }
}

template <class Visit>
void TowerComplex::for_each(int dimension, Visit&& visit) const {
  std::vector<bool> is_free(slots(dimension), false);
  if (!is_free.empty()) {
    for (const Slot slot : free_[static_cast<std::size_t>(dimension)]) {
      is_free[slot] = true;
    }
  }
  for (Slot slot = 0; slot < slots(dimension); ++slot) {
    if (!is_free[slot]) {
      visit(slot);
    }
  }
}

}  // namespace sesame::ops

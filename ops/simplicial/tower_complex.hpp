/// \file
/// An abstract simplicial complex that changes along a tower of simplicial maps: simplices are included, vertices
/// contracted. It keeps the present only: its size is that of the current complex, however long the tower.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sparse/hash_index.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// The name of a vertex in a tower.
using Label = std::uint64_t;

/// Simplices have a *slot*, a number that is unique among the current ones of their dimension; slots are used again.
/// A simplex is oriented by the order of its vertices' slots, so its facet k, the one without vertex k, has coefficient
/// (-1)^k in its boundary.
class TowerComplex {
 public:
  using Slot = std::uint32_t;

  /// What becomes of a simplex when a vertex is contracted into another one.
  enum class Fate : std::uint8_t {
    renamed,   ///< it has the other vertex instead, and stays
    merged,    ///< into the simplex that it would become, which is there
    squashed,  ///< it had both vertices
  };
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
  static constexpr int largest_dimension = 63;

  /// No more faces than that are found missing.
  static constexpr std::size_t most_missing = std::size_t{1} << 20;

  /// Includes a simplex, whose facets must be there. Returns its slot; `facets` are those of this simplex then.
  /// Errors: unknown_name when a facet is missing; bad_input when a label is repeated, the simplex is there or too
  /// large. Nothing has changed then. Cost: O(dimension^2).
  Result<Slot> include(std::span<const Label> labels);
  /// The facets of the simplex last included, facet k being the one without vertex k. None for a vertex.
  [[nodiscard]] std::span<const Slot> facets() const { return {facets_.data(), facets_size_}; }

  /// Whether the simplex with these labels, in any order, is there.
  [[nodiscard]] bool contains(std::span<const Label> labels) const;
  /// The faces of a simplex that are not there, by their labels, which ascend; by dimension, then lexicographically.
  /// The simplex itself is not among them. Errors: bad_input when a label is repeated, or more than `most_missing`
  /// faces are missing.
  [[nodiscard]] Result<std::vector<std::vector<Label>>> missing_faces(std::span<const Label> labels) const;

  /// Works out the contraction of u into v, which have to be two vertices of the complex. It is carried out by
  /// `contract`, with nothing else in between. Errors: bad_input when one is not there, or both are the same.
  /// Cost: the smaller of the two stars, times the dimension.
  Result<const Changes*> plan_contraction(Label u, Label v);
  /// Carries out the contraction worked out last; the merged vertex is called v.
  void contract();

  /// The facet of a current simplex without its vertex k.
  [[nodiscard]] Slot facet(int dimension, Slot slot, std::size_t k) const;
  /// The labels of a current simplex, in the order that orients it.
  [[nodiscard]] std::vector<Label> labels(int dimension, Slot slot) const;
  /// The number of simplices of each dimension, up to the largest that has one.
  [[nodiscard]] std::span<const std::uint64_t> counts() const { return counts_; }
  /// All slots in use or free of a dimension are below this.
  [[nodiscard]] Slot slots(int dimension) const;
  /// Calls visit(slot) for each simplex of a dimension. Cost: the most that there ever were at once.
  template <class Visit>
  void for_each(int dimension, Visit&& visit) const;
  /// The terms looked at by contractions so far: what they have cost.
  [[nodiscard]] std::uint64_t touched() const { return touched_; }

 private:
  using Vertex = std::uint32_t;  ///< the slot of a vertex
  static constexpr std::uint32_t nothing = sparse::HashIndex::nothing;

  /// The simplices of a dimension >= 1.
  struct Layer {
    std::size_t stride;            ///< vertices of a simplex
    std::vector<Vertex> vertices;  ///< of each slot, ascending; the first is `nothing` when the slot is free
    std::vector<Slot> free;
    sparse::HashIndex index;
    // Stars as doubly linked lists, once there has been a contraction: a link for each vertex of each slot.
    std::vector<std::uint32_t> next, previous;  ///< links, or `nothing`
    std::vector<std::uint32_t> first;           ///< per vertex
  };

  [[nodiscard]] static std::uint64_t word(Vertex v) { return sparse::spread_bits(v); }
  [[nodiscard]] const Vertex* vertices_of(const Layer& layer, Slot slot) const {
    return layer.vertices.data() + layer.stride * slot;
  }
  [[nodiscard]] std::uint64_t hash_of(const Layer& layer, Slot slot) const;
  [[nodiscard]] Vertex find_vertex(Label label) const;
  [[nodiscard]] Slot find_without(const Layer& layer, const Vertex* vertices, std::size_t k, std::uint64_t hash) const;
  Result<Slot> include_vertex(Label label);
  Error missing(std::span<const Label> labels, std::size_t without) const;
  [[nodiscard]] Layer& layer_for(std::size_t dimension);
  Slot add_simplex(Layer& layer, std::uint64_t hash);
  void build_stars();
  void link(Layer& layer, Slot slot);
  void unlink(Layer& layer, Slot slot);
  [[nodiscard]] Change change_of(const Layer& layer, Slot slot);
  void carry_out(Layer& layer, const Change& change);
  void count_down(std::size_t dimension);

  std::vector<Label> label_of_;  ///< per vertex
  std::vector<bool> is_vertex_;
  std::vector<Vertex> free_vertices_;
  sparse::HashIndex labels_;
  std::vector<Layer> layers_;  ///< of dimension 1, 2, ...
  std::vector<std::uint64_t> counts_;
  bool has_stars_ = false;
  std::vector<std::uint32_t> star_size_;  ///< per vertex, once there are stars: simplices of dimension >= 1

  std::array<Vertex, largest_dimension + 1> vertices_{};  ///< of the simplex that is being looked up
  std::array<Slot, largest_dimension + 1> facets_{};
  std::size_t facets_size_ = 0;
  Changes changes_;
  Vertex moved_ = nothing, kept_ = nothing;
  Label merged_label_ = 0;
  std::uint64_t touched_ = 0;
};

template <class Visit>
void TowerComplex::for_each(int dimension, Visit&& visit) const {
  if (dimension == 0) {
    for (Vertex v = 0; v < label_of_.size(); ++v) {
      if (is_vertex_[v]) {
        visit(v);
      }
    }
    return;
  }
  const Layer& layer = layers_[static_cast<std::size_t>(dimension - 1)];
  for (Slot slot = 0; slot * layer.stride < layer.vertices.size(); ++slot) {
    if (*vertices_of(layer, slot) != nothing) {
      visit(slot);
    }
  }
}

}  // namespace sesame::ops

/// \file
/// What a tower may do to a complex, and how it is said what it may not.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "ops/simplicial/simplex_index.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// The name of a vertex in a tower.
using Label = std::uint64_t;

/// The view that a tower has of a complex: simplices by the labels of their vertices, whatever keeps them. An inclusion
/// adds a simplex whose facets are there; a contraction makes one of two vertices that are there.
///
/// Threads: one at a time, for queries too.
class TowerRules {
 public:
  using Vertex = SimplexIndex::Vertex;
  /// The vertex that a label denotes, or SimplexIndex::nothing.
  using VertexOf = std::function<Vertex(Label)>;

  /// Simplices have at most so many vertices.
  static constexpr std::size_t most_vertices = 64;
  /// No more faces than that are found missing.
  static constexpr std::size_t most_missing = std::size_t{1} << 20;

  /// The vertices that labels denote are simplices, whether `simplices` has those or not.
  TowerRules(const SimplexIndex& simplices, VertexOf vertex_of)
      : simplices_{simplices}, vertex_of_{std::move(vertex_of)} {}

  /// Whether the simplex with these labels, in any order, is there.
  [[nodiscard]] bool contains(std::span<const Label> labels) const;
  /// The faces of a simplex that are not there, by their labels, which ascend; by dimension, then lexicographically.
  /// The simplex itself is not among them. Errors: bad_input when a label is repeated, or more than `most_missing`
  /// faces are missing.
  [[nodiscard]] Result<std::vector<std::vector<Label>>> missing_faces(std::span<const Label> labels) const;
  /// Errors: unknown_name when a facet is missing; bad_input when a label is repeated, the simplex is there or too
  /// large.
  [[nodiscard]] Status check_inclusion(std::span<const Label> labels) const;
  /// Errors: bad_input when one of the vertices is not there, or both are the same.
  [[nodiscard]] Status check_contraction(Label u, Label v) const;

 private:
  const SimplexIndex& simplices_;
  VertexOf vertex_of_;
};

}  // namespace sesame::ops

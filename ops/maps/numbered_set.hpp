/// \file
/// Numbered semi-simplicial sets: what every model of cells here stands for.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "ops/maps/orbits.hpp"
#include "reductions/chain_complex.hpp"

namespace sesame::ops {

/// A simplex among those of its dimension, counted from 0.
using SimplexNumber = std::uint32_t;

/// A semi-simplicial set in which each vertex has a number, such that a p-simplex that is no face of another one has a
/// vertex of each number 0, ..., p. So a simplex has distinct vertices, and is *numbered* by the set I of their
/// numbers. Face k of a simplex lacks the k-th number of I in increasing order.
///
/// It has one p-cell for each vertex numbered p: the vertex with all simplices that contain it and have no larger
/// number. That is a cone, whose apex is the vertex, over the *canonical boundary* of the cell. Several simplices may
/// have the same vertices: then the cells are multi-incident. Source: P. Lienhardt, "N-dimensional generalized
/// combinatorial maps and cellular quasi-manifolds" (1994).
class NumberedSet {
 public:
  /// For p = 1, 2, ... and each p-simplex: p + 1 simplices of dimension p - 1.
  using Faces = std::vector<std::vector<std::vector<SimplexNumber>>>;

  /// The set without a simplex.
  NumberedSet() = default;
  /// The number of each vertex, and the faces of all other simplices.
  /// Errors    bad_input, naming the law that is broken and a simplex: not p + 1 faces, or no such face; faces of faces
  ///           that do not agree (d_j d_i = d_{i-1} d_j for j < i, d_i first); a face 0 of an edge without the larger
  ///           number; or a simplex that is no face and not numbered 0, ..., p.
  /// Cost: dimension^2 times the simplices.
  [[nodiscard]] static Result<NumberedSet> make(std::vector<int> numbers_of_vertices, Faces faces);

  /// -1 for the set without a simplex.
  [[nodiscard]] int dimension() const { return static_cast<int>(vertices_.size()) - 1; }
  [[nodiscard]] SimplexNumber count(int p) const;
  /// The number of simplices of each dimension.
  [[nodiscard]] std::vector<std::uint32_t> f_vector() const;
  [[nodiscard]] std::int64_t euler_characteristic() const;

  [[nodiscard]] int number_of_vertex(SimplexNumber vertex) const { return numbers_[vertex]; }
  /// The numbers of the vertices of a simplex, as bits.
  [[nodiscard]] IndexSet numbers(int p, SimplexNumber simplex) const;
  /// Its vertices by increasing number.
  [[nodiscard]] const std::vector<SimplexNumber>& vertices(int p, SimplexNumber simplex) const {
    return vertices_[static_cast<std::size_t>(p)][simplex];
  }
  /// Requires: p >= 1.
  [[nodiscard]] const std::vector<SimplexNumber>& faces(int p, SimplexNumber simplex) const {
    return faces_[static_cast<std::size_t>(p) - 1][simplex];
  }

  /// How many cells of each dimension there are.
  [[nodiscard]] std::vector<std::uint32_t> cell_counts() const;
  /// The simplices of the cell of a vertex, for each dimension 0, ..., p. Cost: all simplices.
  [[nodiscard]] std::vector<std::vector<SimplexNumber>> cell(SimplexNumber vertex) const;
  /// What the cell of a vertex is a cone over: a set of the dimension below. The simplices opposite to the vertex in
  /// those of the cell count each for itself, even where the set has them glued. Cost: all simplices.
  [[nodiscard]] NumberedSet canonical_boundary(SimplexNumber vertex) const;

  /// Two simplices with the same vertices, by dimension and numbers; nothing where cells are not multi-incident.
  struct Multiple {
    int dimension;
    SimplexNumber one;
    SimplexNumber other;
  };
  /// One of least dimension. Cost: that of sorting the simplices.
  [[nodiscard]] std::optional<Multiple> multi_incidence() const;

  friend bool operator==(const NumberedSet&, const NumberedSet&) = default;

 private:
  [[nodiscard]] Status find_vertices();
  [[nodiscard]] Status check_principal() const;

  std::vector<int> numbers_;  // of vertices
  Faces faces_;               // of the p-simplices at p - 1
  Faces vertices_;            // of the p-simplices at p
};

/// The simplices with d = sum of (-1)^k d_k.
[[nodiscard]] reductions::ChainComplex<sparse::Integers> chain_complex(const NumberedSet& set);

/// The set of dimension n whose simplices numbered I are orbits of darts, `family(I)`, for each non-empty subset I of
/// 0, ..., n. A face that keeps the largest number is the orbit that contains the simplex's; where the largest number
/// falls from p to q it is that of the dart `lower(dart, p, q)`. Cost: n 2^n times the darts.
[[nodiscard]] NumberedSet set_of_orbits(int n, const std::function<Orbits(IndexSet)>& family,
                                        const std::function<Dart(Dart, int, int)>& lower);

/// The simplicial analogue of a map: its simplices numbered I are the orbits of the involutions alpha_j with j not in
/// I. Vertices come by their numbers, then as `cells` counts them. Cost: n 2^n times the darts.
[[nodiscard]] NumberedSet simplicial_analogue(const GMap& map);

}  // namespace sesame::ops

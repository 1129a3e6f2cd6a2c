/// \file
/// Chains of maps: objects of cells glued in any way, each cell a map of its own.
#pragma once

#include <cstdint>
#include <vector>

#include "ops/maps/numbered_set.hpp"
#include "ops/maps/orbits.hpp"

namespace sesame::ops {

/// A chain of maps of dimension n: for i = 0, ..., n, darts of level i with involutions alpha_0, ..., alpha_{i-1}, and
/// for i >= 1 faces sigma_i of the darts of level i, which are darts of level i-1. The i-cells are the components of
/// level i, each given as the map of its canonical boundary. For i >= 2
///   (a) sigma_i is an isomorphism from each orbit of alpha_0, ..., alpha_{i-2} onto one of level i-1;
///   (b) alpha_{i-1} sigma_i sigma_{i-1} = sigma_i sigma_{i-1}, the leftmost first.
/// Source: H. Elter, P. Lienhardt, "Cellular complexes as structured semi-simplicial sets" (1994); (a) is stricter
/// than there: no cell is folded.
class ChainOfMaps {
 public:
  /// The chain of dimension -1, without darts.
  ChainOfMaps() = default;
  /// Level i as a map of dimension i-1, and sigma_1, ..., sigma_n as lists of images.
  /// Errors    bad_input, naming the level and a dart: a level of another dimension, not an image for each dart, no
  ///           dart, or a condition that does not hold. Cost: the dimension times the darts, sorted.
  [[nodiscard]] static Result<ChainOfMaps> make(std::vector<GMap> levels, std::vector<std::vector<Dart>> sigma);

  [[nodiscard]] int dimension() const { return static_cast<int>(levels_.size()) - 1; }
  [[nodiscard]] const GMap& level(int i) const { return levels_[static_cast<std::size_t>(i)]; }
  /// Requires: i >= 1.
  [[nodiscard]] Dart sigma(int i, Dart d) const { return sigma_[static_cast<std::size_t>(i) - 1][d]; }
  [[nodiscard]] const std::vector<std::vector<Dart>>& faces() const { return sigma_; }
  /// d sigma_from ... sigma_{to+1}, for a dart d of level `from`.
  [[nodiscard]] Dart lowered(Dart d, int from, int to) const;

  /// The i-cells.
  [[nodiscard]] Orbits cells(int i) const { return components(level(i)); }
  /// How many cells of each dimension there are.
  [[nodiscard]] std::vector<std::uint32_t> cell_counts() const;
  /// The canonical boundary of the i-cell of a dart: a map of dimension i-1. The darts are those of the cell in
  /// increasing order. Cost: level i.
  [[nodiscard]] GMap canonical_boundary(int i, Dart d) const;

  friend bool operator==(const ChainOfMaps&, const ChainOfMaps&) = default;

 private:
  std::vector<GMap> levels_;
  std::vector<std::vector<Dart>> sigma_;  // sigma_i at i - 1
};

/// The simplices numbered I, as orbits of darts: on level p, the largest number in I. Requires: I is not empty.
[[nodiscard]] Orbits orbits_numbered(const ChainOfMaps& chain, IndexSet numbers);

/// The simplices numbered I, p the largest number in I: the orbits on level p of the alpha_j with j < p and not in I.
/// A face without p is that of the image on the level of the next smaller number. Vertices come by their numbers, then
/// as `cells` counts them. Cost: n 2^n times the darts.
[[nodiscard]] NumberedSet simplicial_analogue(const ChainOfMaps& chain);

}  // namespace sesame::ops

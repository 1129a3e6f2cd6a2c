/// \file
/// Generalized maps: objects of any dimension that are cells glued along their boundaries, by their darts.
#pragma once

#include <cstdint>
#include <vector>

#include "sparse/result.hpp"

namespace sesame::ops {

/// A dart of a map, counted from 0: the smallest part of a cell. Of a G-map one for each simplex of largest dimension
/// of its simplicial analogue.
using Dart = std::uint32_t;
inline constexpr Dart no_dart = UINT32_MAX;

/// Indices of involutions, as bits.
using IndexSet = std::uint64_t;
/// No map has a larger dimension.
inline constexpr int largest_map_dimension = 30;

/// An n-G-map, n >= -1: darts with involutions alpha_0, ..., alpha_n, such that alpha_i alpha_j is an involution, too,
/// whenever |i - j| >= 2. A dart is *i-free* where alpha_i fixes it: there it has no neighbour.
///
/// It stands for cells of dimensions 0 to n: the i-cell of a dart is what all involutions but alpha_i reach from it.
/// Cells need not be balls: each is a cone over its canonical boundary. Source: P. Lienhardt, "N-dimensional
/// generalized combinatorial maps and cellular quasi-manifolds" (1994).
class GMap {
 public:
  /// The map of dimension -1 without darts.
  GMap() = default;
  /// Lists of images, one for each involution and as long as each other.
  /// Errors    bad_input, naming the law that is broken and a dart: not an image for each dart, no dart, no involution,
  ///           or alpha_i alpha_j is none. Cost: n^2 times the darts.
  [[nodiscard]] static Result<GMap> make(std::vector<std::vector<Dart>> alpha);
  /// A map of dimension -1, which is a number of points without any involution.
  [[nodiscard]] static GMap points(Dart count);

  [[nodiscard]] int dimension() const { return static_cast<int>(alpha_.size()) - 1; }
  /// How many darts there are.
  [[nodiscard]] Dart size() const { return size_; }
  [[nodiscard]] Dart alpha(int i, Dart d) const { return alpha_[static_cast<std::size_t>(i)][d]; }
  [[nodiscard]] const std::vector<std::vector<Dart>>& involutions() const { return alpha_; }
  [[nodiscard]] bool is_free(int i, Dart d) const { return alpha(i, d) == d; }
  /// 0, ..., n.
  [[nodiscard]] IndexSet indices() const { return (IndexSet{1} << alpha_.size()) - 1; }

  /// The same darts with the involutions in reverse order: its i-cells are the (n-i)-cells.
  [[nodiscard]] GMap dual() const;
  /// With alpha_{n+1} = identity: each component gets a cell, the cone over it.
  [[nodiscard]] GMap extended() const;
  /// The darts with the first involutions only, up to alpha_n.
  [[nodiscard]] GMap restricted(int n) const;

  friend bool operator==(const GMap&, const GMap&) = default;

 private:
  std::vector<std::vector<Dart>> alpha_;
  Dart size_ = 0;
};

/// Maps beside each other: the darts of the first, then those of the second. Requires: equal dimensions.
[[nodiscard]] GMap disjoint_union(const GMap& a, const GMap& b);

/// One face with a number of sides: side s has the darts 2s and 2s + 1, its ends, and follows side s - 1. All darts are
/// 2-free. Requires: sides >= 1.
[[nodiscard]] GMap polygon(Dart sides);

}  // namespace sesame::ops

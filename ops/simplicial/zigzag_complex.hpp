/// \file
/// An abstract simplicial complex that changes along a zigzag: simplices come and go, vertices are contracted.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "ops/simplicial/tower_complex.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// A TowerComplex that also knows what has cofaces. It keeps the present only.
///
/// Threads: one at a time, for queries too.
class ZigzagComplex {
 public:
  using Slot = TowerComplex::Slot;
  struct Cell {
    int dimension;
    Slot slot;
  };
  /// Who is told of single simplices that come, with their facets as `facets` has them, and go.
  struct Listener {
    std::function<void(Cell, std::span<const Slot> facets)> include;
    std::function<void(Cell)> exclude;
  };

  /// Includes a simplex, whose facets must be there. Errors: see TowerRules::check_inclusion. Nothing has changed then.
  /// Cost: O(dimension^2).
  Result<Cell> include(std::span<const Label> labels);
  /// The facets of the simplex last included, facet k being the one without vertex k. None for a vertex.
  [[nodiscard]] std::span<const Slot> facets() const { return complex_.facets(); }

  /// Takes a simplex out. Errors: bad_input when it is not there, or is a face of another one, which is named. Nothing
  /// has changed then. Cost: O(dimension^2).
  Result<Cell> exclude(std::span<const Label> labels);

  /// Contracts vertex u into v: the cone over the closed star of one of them comes, with the other as its apex, and
  /// then its open star goes; the vertex that stays is called v. The complex in between is homotopy equivalent to the
  /// one afterwards, and this is the image of the complex before under the contraction. Errors: see
  /// TowerRules::check_contraction. Nothing has changed then. Cost: the smaller of the two stars, times its logarithm
  /// and the square of the dimension. Source: T. K. Dey, F. Fan, Y. Wang, "Computing topological persistence for
  /// simplicial maps" (2014).
  Status contract(Label u, Label v, const Listener& listener);

  /// Which simplices are there, and what is wrong with an inclusion or contraction.
  [[nodiscard]] TowerRules rules() const { return complex_.rules(); }
  /// The number of simplices of each dimension, up to the largest that has one.
  [[nodiscard]] std::span<const std::uint64_t> counts() const { return complex_.counts(); }

 private:
  struct Layer {
    std::vector<Slot> facets;            ///< of slot after slot
    std::vector<std::uint32_t> cofaces;  ///< per slot: how many
  };

  Cell take_out(Cell cell);
  [[nodiscard]] Error has_coface(std::span<const Label> labels, Cell cell) const;

  TowerComplex complex_;
  std::vector<Layer> layers_;  ///< per dimension
};

}  // namespace sesame::ops

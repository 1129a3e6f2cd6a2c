/// \file
/// Cells of maps that are no balls: cones over any canonical boundary.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "ops/maps/gmap.hpp"

namespace sesame::ops {

/// What a cell of dimension n >= 2 contributes that is a cone over a connected map whose own cells are balls.
///
/// The chains of the cell, modulo its boundary, are the augmented chains of the boundary, one degree up. In their place
/// stand those of a small model S of them, with g from S to them: a generator for each generator s of S, of the same
/// degree, whose boundary is g s, less the generator of the boundary of s. A homology sphere would have one; over a
/// torus there are one of degree 3 and two of degree 2. Where there would be none of degree n, as over what is open or
/// folded, two are added that cancel, since a cell has one generator that stands for it.
struct ConeShape {
  /// A cell of the boundary, as it is seen from its least dart, with a coefficient.
  struct Term {
    int dimension;
    Dart dart;
    int coefficient;
  };
  struct Generator {
    int degree;
    std::vector<Term> terms;                             ///< of its boundary
    std::vector<std::pair<std::uint32_t, int>> of_this;  ///< and earlier generators, with coefficients
  };
  /// By degree; the last one has degree n, and stands for the cell.
  std::vector<Generator> generators;
};

/// The shape of the cone over a map. Requires: as above. Cost: that of a small model of its cells.
[[nodiscard]] ConeShape cone_shape_of(const GMap& boundary);

}  // namespace sesame::ops

/// \file
/// Objects as tiles whose sides are glued in pairs, and their assembly.
#pragma once

#include <cstdint>
#include <vector>

#include "ops/cells/cell_type.hpp"
#include "tools/bench/constructions.hpp"

namespace sesame::tools {

/// Tiles of one type. Sides with equal keys are one cell of the object, glued as their vertices are ordered.
struct Tiling {
  using Key = std::uint64_t;
  ops::CellType type;
  std::vector<std::vector<Key>> sides;  ///< of each tile, in the flattened order of its faces
};

/// The tiling of a simplicial complex by its facets, all of one dimension; every simplex has its vertices in ascending
/// order.
[[nodiscard]] Tiling tiling_of_facets(std::vector<std::vector<std::uint32_t>> facets);

/// The tiles, called t0, t1, ... as they come, and their gluings. A side is glued to the first one of its key.
/// The steps of the two orders that glue at once: each tile, then, where there is something to glue, its gluings.
[[nodiscard]] Operations assembled(const Tiling& tiling, const Assembly& assembly);

}  // namespace sesame::tools

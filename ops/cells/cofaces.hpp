/// \file
/// Which cells have a cell as a face.
#pragma once

#include <vector>

#include "ops/cells/structure.hpp"

namespace sesame::ops {

/// The current cells that have a face which is a given current cell or degenerate over it, oldest first.
/// Cost: their number and what CofaceIndex says; for a lazy cell also that of the cofaces of the factors' cells, for
/// the apex of a lazy cone all cells that the cone is taken over.
[[nodiscard]] std::vector<CellId> cofaces(const Structure& structure, CellId current);

}  // namespace sesame::ops

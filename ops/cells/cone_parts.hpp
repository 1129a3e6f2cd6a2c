/// \file
/// Cells that are no balls, and their parts. The nodes of the parts are those right before the node of the cell.
#pragma once

#include <vector>

#include "ops/cells/structure.hpp"

namespace sesame::ops {

/// What the parts of a current cell are now; none of a cell that is a ball.
[[nodiscard]] std::vector<CellId> cone_parts(const Structure& structure, CellId cell);
/// The cell that a node is a part of, as it is now. Requires: it is one.
[[nodiscard]] CellId whole_of_part(const Structure& structure, CellId part);
/// Some current cells with the parts of those that are no balls right before them, and no other parts. The others keep
/// their order. Cost: their number.
[[nodiscard]] std::vector<CellId> with_parts(const Structure& structure, const std::vector<CellId>& cells);

}  // namespace sesame::ops

/// \file
/// Cells that a step takes out of the object.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "ops/cells/structure.hpp"

namespace sesame::ops {

/// The open star of some current cells: these, in their order, then all that has one of them as a face, and so on.
/// Nothing when that would be more than `most`. Cost: the cells, with their cofaces.
[[nodiscard]] std::optional<std::vector<CellId>> open_star(const Structure& structure, std::vector<CellId> cells,
                                                           std::size_t most);

/// Cells go, each after those that have it as a face. Requires: these go as well.
void add_deletions(std::vector<CellId> cells, const Structure& structure, Plan& plan);

}  // namespace sesame::ops

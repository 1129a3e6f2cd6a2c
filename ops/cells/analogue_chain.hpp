/// \file
/// Cells of maps as chains of the simplices of their simplicial analogues.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ops/cells/structure.hpp"

namespace sesame::ops {

/// A chain of simplices, each called as maps by simplices have it: "m.<0-1>:3", after the least dart that sees it.
using AnalogueChain = std::vector<std::pair<int, std::string>>;

/// The subdivision of a current cell of a map, as the map is sewn now, oriented as the name of the cell is: the sum of
/// its simplices numbered 0 to i, each with the sign of its darts. A cell of a dimension n that is no ball is a cone,
/// whose generators are n * z over the chains z that its ConeShape says. Subdividing commutes with boundaries, so
/// cycles are cycles of the analogue, of the same class, and bound there what they bound.
/// Nothing of what is no cell of a map with darts, of a cell of a product, or of one whose darts have been removed.
/// Cost: n times the darts of the cell, for a cell that is called by a dart which is there; else the darts of all maps.
[[nodiscard]] std::optional<AnalogueChain> in_analogue(const Structure& structure, CellId cell);

}  // namespace sesame::ops

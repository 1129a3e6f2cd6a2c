/// \file
/// The order in which cells are listed: one that no query changes.
#pragma once

#include <vector>

#include "ops/cells/structure.hpp"

namespace sesame::ops {

/// Current cells by dimension, those of one by the age of their oldest members. Cost: that of a sort, times that of
/// `LazyCells::is_older`.
void sort_by_dimension_and_age(const Structure& structure, std::vector<CellId>& cells);

}  // namespace sesame::ops

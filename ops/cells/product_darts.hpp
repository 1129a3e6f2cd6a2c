/// \file
/// Which cells the darts of a product of maps belong to.
#pragma once

#include <vector>

#include "ops/cells/dart_cells.hpp"
#include "ops/cells/lazy_cells.hpp"
#include "ops/cells/value.hpp"

namespace sesame::ops {

/// The cells of the product of two maps, or, with `has_levels`, of two chains of maps, as `product` has their darts.
/// The offsets are nodes, which are made. `family`: that of the product. Cost: the darts, times their dimension.
[[nodiscard]] DartCells cells_of_product_darts(const FactorDarts& left, const FactorDarts& right, bool has_levels,
                                               FamilyId family, const LazyCells& lazy, const VertexMaps& maps);

}  // namespace sesame::ops

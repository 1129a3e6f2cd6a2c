/// \file
/// Orders of cells and the numbered sets that they stand for.
#pragma once

#include "ops/maps/numbered_set.hpp"
#include "ops/maps/order.hpp"

namespace sesame::ops {

/// The chains of the cells: a simplex for each set of cells that are comparable, numbered by their ranks. Vertex x is
/// cell x. Cost: the chains, times their length and the logarithm of their number.
[[nodiscard]] NumberedSet simplicial_analogue(const Order& order);

/// The order of the cells of a numbered set. Cell x is that of vertex x, and a face is what an edge says.
/// Errors    refused, naming the cells, where cells are multi-incident, or where each of some cells is a face of the
///           next one but no simplex has them all: then the set is not what the order would describe.
/// Cost: the simplices, sorted, and the chains of the order.
[[nodiscard]] Result<Order> order_of_cells(const NumberedSet& set);

/// The order of the simplices of a numbered set: its barycentric subdivision. The p-simplices come after those of
/// smaller dimensions.
[[nodiscard]] Order order_of_simplices(const NumberedSet& set);

}  // namespace sesame::ops

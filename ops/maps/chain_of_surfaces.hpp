/// \file
/// Chains of surfaces: orders whose cells have surfaces as boundaries, and the chains of maps that they are equivalent
/// to.
#pragma once

#include "ops/maps/chain_of_maps.hpp"
#include "ops/maps/surface_order.hpp"

namespace sesame::ops {

/// Whether an order is a chain of surfaces: it has a cell and is connected, and the boundary of each i-cell that is no
/// face, i >= 1, is an (i-1)-surface. Then that holds for all cells, and between any cell, or the fictive one below
/// all, and a cell two dimensions above it there are two or none.
/// Errors    refused, naming cells. Cost: for each cell the square of what lies below.
/// Source: S. Alayrangues, P. Lienhardt, S. Peltier, "Conversion between chains of maps and chains of surfaces;
/// application to the computation of incidence graphs homology" (2015).
[[nodiscard]] Status check_chain_of_surfaces(const Order& order);

/// The chain of maps of a chain of surfaces: its darts of level i are the cell-tuples of the i-cells, alpha_j switches
/// the j-th cell, and sigma_i forgets the i-th.
/// Errors    as check_chain_of_surfaces. Cost: n^2 times the tuples, and their logarithm.
[[nodiscard]] Result<ChainOfMaps> chain_of_maps_of_surfaces(const Order& order);
/// The same of any order whose cells pass check_boundaries, be it connected or not, from its `cell_tuples` by
/// dimension.
[[nodiscard]] ChainOfMaps chain_of_tuples(const Order& order,
                                          const std::vector<std::vector<std::vector<OrderCell>>>& tuples);

/// The chain of surfaces of the cells of a chain of maps: its 0-cells, then its 1-cells, and so on, each in the order
/// of `cells`. Errors    refused, naming darts or cells: a dart that is fixed by an involution, cells that are not
/// connected or that
///           are none, or multi-incident ones, which no order can say. Cost: n 2^n times the darts.
[[nodiscard]] Result<Order> chain_of_surfaces_of_maps(const ChainOfMaps& chain);

}  // namespace sesame::ops

/// \file
/// Surfaces of any dimension as orders of cells, and the closed G-maps that they are equivalent to.
#pragma once

#include <vector>

#include "ops/maps/gmap.hpp"
#include "ops/maps/order.hpp"

namespace sesame::ops {

/// Whether an order is an n-surface, n its dimension: for n = 0 it is two cells, neither below the other; for n > 0 it
/// is connected, and what lies below and above any one of its cells is an (n-1)-surface.
///
/// What is tested is the same, said otherwise. With a cell below all others and one above all, the cells strictly
/// between two cells whose dimensions differ by two are exactly two (the *switch*), and those between cells further
/// apart are connected. For what lies below and above a cell is the join of both parts, and a join is a surface exactly
/// when its parts are.
/// Errors    refused, naming cells. Cost: for each cell the square of what lies below.
/// Source: G. Bertrand, M. Couprie, "A model for digital topology" (1999); S. Alayrangues et al., "Equivalence between
/// closed connected n-G-maps without multi-incidence and n-surfaces" (2008).
[[nodiscard]] Status check_surface(const Order& order);

/// The same for what lies between the cells of a list and the fictive cell below all: that the boundary of each is a
/// surface. `name`: of a cell, in errors.
[[nodiscard]] Status check_boundaries(const Order& order, const std::vector<OrderCell>& cells,
                                      const OrderCellName& name = number_of_cell);

/// The cell beside x between two cells whose dimensions differ by two; `no_order_cell` as `low` or `high` stands for
/// the cells below and above all. Requires: exactly two cells lie between them, and x is one of them.
[[nodiscard]] OrderCell switched(const Order& order, OrderCell low, OrderCell x, OrderCell high);

/// The cell-tuples (c_0, ..., c_i) of the i-cells, each a face of the next, in lexicographic order.
[[nodiscard]] std::vector<std::vector<OrderCell>> cell_tuples(const Order& order, int i);

/// The place of each cell-tuple after its j-th cell is switched. Its last cell is switched among all cells next above
/// the cell before it. Requires: `cell_tuples` of an order that has exactly two cells wherever one is switched.
[[nodiscard]] std::vector<Dart> switches(const Order& order, const std::vector<std::vector<OrderCell>>& tuples,
                                         std::size_t j);

/// The G-map of an n-surface: its darts are the cell-tuples of the n-cells, alpha_i switches the i-th cell.
/// Errors    as check_surface. Cost: n^2 times the tuples, and their logarithm.
/// Source: E. Brisson, "Representing geometric structures in d dimensions: topology and order" (1993).
[[nodiscard]] Result<GMap> gmap_of_surface(const Order& surface);

/// The n-surface of the cells of a G-map: its 0-cells, then its 1-cells, and so on, each in the order of `cells`. It
/// has as many cell-tuples as the map has darts. Errors    refused, naming darts or cells: a dart that is free for some
/// involution, a map that is not connected
///           (of dimension 0: that is not two darts), or cells that are multi-incident, which no order can say.
/// Cost: n 2^n times the darts.
[[nodiscard]] Result<Order> surface_of_gmap(const GMap& map);

}  // namespace sesame::ops

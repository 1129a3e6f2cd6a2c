/// \file
/// Orders of cells from others: suborders, cones, and identifications of cells.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "ops/maps/order.hpp"

namespace sesame::ops {

/// Some cells of an order, with the order among them.
struct Suborder {
  Order order;
  std::vector<OrderCell> cells;  ///< per cell of the suborder: which one it is in the whole; increasing
};

/// The suborder of some cells, in any order and perhaps repeated. Ranks are those in the suborder.
/// Errors    bad_input for a cell that there is not; refused, naming the cells, when it has a jump in dimension.
/// Cost: the closures of the cells, each times those of its faces in the suborder.
[[nodiscard]] Result<Suborder> suborder(const Order& order, std::vector<OrderCell> cells);

/// The order with one more cell, the last, over some cells: those of them that are no faces within them are its faces.
/// Errors    bad_input for a cell that there is not, or one without its faces; refused, naming two cells, when the
///           cells are not pure: the cone would have a jump in dimension.
/// Cost: the order.
[[nodiscard]] Result<Order> cellular_cone(const Order& order, std::vector<OrderCell> base);

/// An order after cells have been identified.
struct IdentifiedOrder {
  Order order;
  std::vector<OrderCell> image;  ///< per cell of the order before: what it has become
};

/// Merges the two cells of each pair. Pairs are an isomorphism of closures: the faces of the first cell of a pair are
/// those of the second, when paired cells count as the same. Cells count by the least number merged in them. Where two
/// faces of a cell become one, it has one face less: what is multi-incident, no order can say.
/// Errors    bad_input for a cell that there is not, or that comes twice on one side of pairs; refused, naming the two
///           cells and a face, when faces do not correspond.
/// Cost: the order, and the faces of the pairs, sorted.
[[nodiscard]] Result<IdentifiedOrder> identify_cells(const Order& order,
                                                     std::span<const std::pair<OrderCell, OrderCell>> pairs);

}  // namespace sesame::ops

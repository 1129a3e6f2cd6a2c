/// \file
/// Orders of cells, which are also called incidence graphs: cells, and which are faces of which.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sparse/result.hpp"

namespace sesame::ops {

/// A cell of an order, counted from 0.
using OrderCell = std::uint32_t;
/// Where there is none.
inline constexpr OrderCell no_order_cell = UINT32_MAX;
/// What sentences call a cell.
using OrderCellName = std::function<std::string(OrderCell)>;
[[nodiscard]] std::string number_of_cell(OrderCell x);

/// A finite partial order of cells without jumps in dimension: the *rank* of a cell is the length of the longest chain
/// below it, and counts as its dimension; its faces are the cells next below it, and have the rank below its own.
///
/// The object that it describes is its simplicial analogue, the chains of its cells. So a cell is a cone over its
/// boundary, be it a ball or not, and no two cells are incident more than once. Source: G. Bertrand, "New notions for
/// discrete topology" (1999), where these are the closed CF-orders; alpha, beta and theta are the words used there.
class Order {
 public:
  /// The order without a cell.
  Order() = default;
  /// The faces of each cell; and what it is called in errors.
  /// Errors    bad_input, naming the cell and the face: a face that is no cell, one that is listed twice, a cell below
  ///           itself, a jump in dimension, a face that lies below another face, or a dimension above
  ///           `largest_map_dimension`.
  /// Cost: that of the lists, sorted; where there is a jump, the cells below too.
  [[nodiscard]] static Result<Order> make(std::vector<std::vector<OrderCell>> faces,
                                          const OrderCellName& name = number_of_cell);

  /// The largest rank, -1 for the order without a cell.
  [[nodiscard]] int dimension() const { return dimension_; }
  [[nodiscard]] OrderCell size() const { return static_cast<OrderCell>(faces_.size()); }
  [[nodiscard]] int rank(OrderCell x) const { return ranks_[x]; }
  /// How many cells of each rank there are.
  [[nodiscard]] std::vector<std::uint32_t> f_vector() const;

  // ---- what lies next to a cell; all lists of cells are increasing
  [[nodiscard]] const std::vector<OrderCell>& faces(OrderCell x) const { return faces_[x]; }
  [[nodiscard]] const std::vector<OrderCell>& cofaces(OrderCell x) const { return cofaces_[x]; }
  /// Both.
  [[nodiscard]] std::vector<OrderCell> neighbours(OrderCell x) const;

  // ---- what lies below or above. Cost: that, but for a bit for each cell
  /// alpha(x): x and all cells below.
  [[nodiscard]] std::vector<OrderCell> closure(OrderCell x) const;
  /// alpha(x) without x.
  [[nodiscard]] std::vector<OrderCell> boundary(OrderCell x) const;
  /// beta(x): x and all cells above.
  [[nodiscard]] std::vector<OrderCell> star(OrderCell x) const;
  [[nodiscard]] std::vector<OrderCell> strict_star(OrderCell x) const;
  /// theta(x): the closure and the star.
  [[nodiscard]] std::vector<OrderCell> adherence(OrderCell x) const;
  [[nodiscard]] std::vector<OrderCell> strict_adherence(OrderCell x) const;

  /// The cells that are no faces.
  [[nodiscard]] std::vector<OrderCell> principal_cells() const;
  /// Whether all those have one rank.
  [[nodiscard]] bool is_pure() const;
  /// Whether steps to neighbours lead from any cell to any other.
  [[nodiscard]] bool is_connected() const;

  friend bool operator==(const Order&, const Order&) = default;

 private:
  [[nodiscard]] Status check_lists(const OrderCellName& name);
  [[nodiscard]] Status find_ranks(const OrderCellName& name);
  [[nodiscard]] Status check_jumps(const OrderCellName& name) const;

  std::vector<std::vector<OrderCell>> faces_;
  std::vector<std::vector<OrderCell>> cofaces_;
  std::vector<int> ranks_;
  int dimension_ = -1;
};

}  // namespace sesame::ops

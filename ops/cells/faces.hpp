/// \file
/// The faces of cells, as they are and as they were, with the signs that they have in boundaries.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ops/cells/cell_store.hpp"
#include "ops/cells/forest.hpp"
#include "ops/cells/moment.hpp"
#include "ops/cells/split_history.hpp"
#include "ops/cells/value.hpp"

namespace sesame::ops {

/// The one place that says what the boundary of a cell is. Faces are those of the cell as it was created, but for the
/// incidences that have moved since; as nodes, not yet looked up in the forest.
/// Cost of every query: O(1), amortised, or as said; at a moment, the moves of the face since then.
class Faces {
 public:
  using MadeMove = SplitHistory::MadeMove;

  Faces(const CellStore& cells, const Forest& forest, const SplitHistory& splits, const VertexMaps& maps)
      : cells_{cells}, forest_{forest}, splits_{splits}, maps_{maps} {}

  [[nodiscard]] std::span<const CellId> of(CellId c) const {
    const auto moved = splits_.moved_faces(c);
    return moved ? moved->faces : cells_.faces(c);
  }
  /// Whether some of them have moved.
  [[nodiscard]] bool have_moved(CellId c) const { return splits_.moved_faces(c).has_value(); }
  /// The order in which face k of c has the vertices of the node of(c)[k].
  [[nodiscard]] OrderId order(CellId c, std::uint32_t k) const {
    if (!maps_.has_orders()) [[likely]] {
      return same_order;
    }
    const auto moved = splits_.moved_faces(c);
    return moved ? moved->orders[k] : cells_.order(c, k);
  }
  /// The sign of the node of(c)[k] in the boundary of c; of the node that was given as face k at its creation.
  [[nodiscard]] int sign(CellId c, std::uint32_t k) const { return in_order(c, k, order(c, k)); }
  [[nodiscard]] int sign_as_created(CellId c, std::uint32_t k) const {
    return in_order(c, k, maps_.has_orders() ? cells_.order(c, k) : same_order);
  }
  /// The sign of the face in the boundary of the cell after a move.
  [[nodiscard]] int sign_after(const MadeMove& made) const { return in_order(made.cell, made.slot, made.order_after); }
  /// The cell that face k of c is now, was at a moment, or none, with its sign in the boundary of c.
  [[nodiscard]] OrientedCell now(CellId c, std::uint32_t k) const {
    const OrientedCell face = forest_.find_oriented(of(c)[k]);
    return {face.cell, sign(c, k) * face.sign};
  }
  [[nodiscard]] OrientedCell at(CellId c, std::uint32_t k, const Moment& moment) const;
  /// The boundary of c, now and at a moment: calls visit(cell, sign) for each face that is not degenerate.
  template <class Visit>
  void for_each_now(CellId c, Visit&& visit) const {
    for_each_cell(
        c, [&](std::uint32_t k) { return now(c, k); }, visit);
  }
  template <class Visit>
  void for_each_at(CellId c, const Moment& moment, Visit&& visit) const {
    for_each_cell(
        c, [&](std::uint32_t k) { return at(c, k, moment); }, visit);
  }

  /// The places where a node was given as a face since a moment: at the creation of cells, and by moves. As (cell as
  /// created, number). Stops when there are more than `most`. Cost: their number, times the logarithm of the cells.
  [[nodiscard]] std::vector<std::pair<CellId, std::uint32_t>> places_of(CellId node, const Moment& since,
                                                                        std::size_t most = SIZE_MAX) const;

 private:
  template <class Face, class Visit>
  void for_each_cell(CellId c, Face&& face, Visit&& visit) const {
    const auto arity = static_cast<std::uint32_t>(cells_.faces(c).size());
    for (std::uint32_t k = 0; k < arity; ++k) {
      if (const auto [cell, sign] = face(k); cell != none) {
        visit(cell, sign);
      }
    }
  }
  [[nodiscard]] int in_order(CellId c, std::uint32_t k, OrderId order) const {
    const int sign = cells_.type(c).faces[k].sign;
    return order == same_order ? sign : sign * maps_.sign(order);
  }

  const CellStore& cells_;
  const Forest& forest_;
  const SplitHistory& splits_;
  const VertexMaps& maps_;
};

}  // namespace sesame::ops

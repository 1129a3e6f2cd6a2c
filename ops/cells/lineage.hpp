/// \file
/// What nodes were at earlier moments: identifications, degeneracies and lazy cones, one after the other.
#pragma once

#include <optional>
#include <vector>

#include "ops/cells/structure.hpp"

namespace sesame::ops {

/// The history of nodes. A node is given up at most once: for another node with which it is merged, for the cell that
/// it is squashed onto, or, when a lazy cone is taken over its body, for the cell of the cone that it is from then on.
///
/// Threads: one at a time, for queries too.
class Lineage {
 public:
  explicit Lineage(const Structure& structure) : structure_{structure} {}

  /// When a node is given up, or never.
  [[nodiscard]] Instant end_of(CellId node) const;
  /// Gives the node of a value up. Requires: that happens.
  void advance(Value& at) const;
  /// Goes on through all that happens until an instant, which is included.
  void advance_until(Value& at, Instant instant) const;
  void advance_to_now(Value& at) const { advance_until(at, never - 1); }
  /// The first instant at which two values are one cell, or degenerate alike, in whatever orders; 0 when they are so
  /// from the start. `order` is that of the one against the other: its vertex k is the other's vertex order(k). What
  /// the step has made degenerate has no order: then it is the same, in the directions that are collapsed.
  struct Meeting {
    Instant instant = never;  ///< all that one step does happens at its first instant
    OrderId order = same_order;
  };
  [[nodiscard]] Meeting meeting(Value one, Value other) const;
  /// All nodes that are by now what a value is by now, a cell or degenerate, in whatever order.
  /// Cost: the number of nodes that are its cell; of a degenerate one, of those too that are degenerate over this.
  [[nodiscard]] std::vector<CellId> nodes_that_are(Value value) const;

  static constexpr Instant never = UINT64_MAX;

 private:
  const Structure& structure_;
};

}  // namespace sesame::ops

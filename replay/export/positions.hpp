/// \file
/// Where vertices are: the positions "at" that operations give to them, which the structure does not keep.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/engine.hpp"
#include "replay/export/object_cells.hpp"

namespace sesame::replay {

/// The positions that a step gives to nodes, by node, ascending. To be called after it, with the structure after it.
[[nodiscard]] std::vector<std::pair<ops::CellId, ops::Point>> given_positions(const ops::Operation& operation,
                                                                              const engine::StepReport& report,
                                                                              const ops::Structure& structure);

/// The positions of nodes. Vertices that are glued are where the oldest of them is that has a position; one that was
/// split off, where the one is that it was split from.
class Positions {
 public:
  /// To be called after each step, with the structure after it.
  void take(const ops::Operation& operation, const engine::StepReport& report, const ops::Structure& structure);

  /// The points of the vertices of an object, and how many of these were given different ones.
  struct Points {
    std::vector<ops::Point> points;
    std::uint64_t torn = 0;
  };
  /// The points of the vertices of an object, where they are known; and how many were given different ones.
  [[nodiscard]] std::pair<std::vector<std::optional<ops::Point>>, std::uint64_t> known(const ObjectCells& cells) const;
  /// The same of all. Errors, refused: a vertex has none.
  [[nodiscard]] Result<Points> of_vertices(const ObjectCells& cells) const;

 private:
  std::vector<std::pair<ops::CellId, ops::Point>> given_;  ///< by node, ascending
};

}  // namespace sesame::replay

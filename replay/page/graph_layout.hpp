/// \file
/// Places for the vertices of a graph, in space.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ops/vocabulary/cell_list.hpp"

namespace sesame::replay {

struct LayoutVertex {
  std::optional<ops::Point> fixed;  ///< where it has to be
  std::uint32_t group = 0;          ///< of a standard cell: those of its vertices have the same one, above 0
  ops::Point shape{};               ///< where it is in that cell
};

struct LayoutEdge {
  std::uint32_t a, b;
  double length;
};

/// A place for every vertex. A component of the graph
///   - with vertices that have a place: the others are where springs along the edges would draw them, and moved out of
///     the plane where all neighbours lie in one;
///   - which is one standard cell: has the shape of that;
///   - else: lengths of shortest paths become distances as far as three dimensions can have them, by the principal axes
///     of the distances from a few vertices that are far apart, and for up to 600 vertices by minimising the stress.
/// Components of the last two kinds are set side by side. The same graph gets the same places.
/// Cost: edges times 50 and more; for small components their vertices squared.
[[nodiscard]] std::vector<ops::Point> lay_out(const std::vector<LayoutVertex>& vertices,
                                              const std::vector<LayoutEdge>& edges);

}  // namespace sesame::replay

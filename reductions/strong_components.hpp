/// \file
/// Strongly connected components, in an order in which every edge goes back or stays.
#pragma once

#include <vector>

#include "sparse/chain.hpp"

namespace sesame::reductions {

/// The strongly connected components of the graph with an edge v -> w for each w in successors[v]. A component comes
/// after every other component that its edges lead to; the vertices of each increase. In an acyclic graph without loops
/// that is a topological order, last vertex first.
/// Cost: O(vertices + edges). Deterministic.
[[nodiscard]] std::vector<std::vector<sparse::Index>> strong_components(
    const std::vector<std::vector<sparse::Index>>& successors);

}  // namespace sesame::reductions

/// \file
/// Connected parts of a graph.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

struct Parts {
  std::size_t count = 0;
  std::vector<std::uint32_t> of;  ///< the part of each node; parts are numbered by their lowest node
};

/// Cost O(nodes + links), but for the inverse of Ackermann's function.
[[nodiscard]] Parts connected_parts(std::size_t nodes, const std::vector<Edge>& links);

}  // namespace sesame::tools

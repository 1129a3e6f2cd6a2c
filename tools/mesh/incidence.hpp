/// \file
/// The edges of a mesh and what meets at them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

/// Corner c of the mesh (a position in Faces::corners) stands for the side from it to the next corner of its face.
struct Incidence {
  std::vector<Edge> edges;                    ///< lower point first; in lexicographic order, each once
  std::vector<std::uint32_t> edge_of_corner;  ///< the edge along the side of each corner
  std::vector<std::uint32_t> edge_of_line;    ///< the edge that each line of the mesh is
  std::vector<std::uint32_t> face_of_corner;  ///< the face of each corner
  std::vector<std::uint32_t> sides_begin;     ///< edges.size() + 1 positions in sides
  std::vector<std::uint32_t> sides;           ///< the corners whose sides lie along each edge, in order

  [[nodiscard]] std::span<const std::uint32_t> sides_of(std::size_t edge) const {
    return std::span{sides}.subspan(sides_begin[edge], sides_begin[edge + 1] - sides_begin[edge]);
  }
};

/// Requires a mesh as `normalise` leaves it. Cost O(n log n) for n corners.
[[nodiscard]] Incidence incidence_of(const Mesh& mesh);

/// Whether the side of a corner runs from the lower to the higher point.
[[nodiscard]] inline bool runs_upwards(const Mesh& mesh, const Incidence& incidence, std::uint32_t corner) {
  return mesh.faces.corners()[corner] == incidence.edges[incidence.edge_of_corner[corner]][0];
}

}  // namespace sesame::tools

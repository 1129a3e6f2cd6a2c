/// \file
/// A generator of the homology of a mesh, as people find it in the mesh again.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/homology_tracker.hpp"
#include "tools/mesh/measure.hpp"
#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

/// A generator of a homology group of a mesh, and where it is.
struct MeshGenerator {
  int degree = 0;
  sparse::Integer order;    ///< 0: free
  engine::CellChain chain;  ///< the generator itself, in the cells of the engine
  /// Degree 1: for order t > 0, a chain whose boundary is t times the generator.
  std::optional<engine::CellChain> bounding;
  /// Degree 0: one vertex of the component, its lowest. Degree 1: the vertices along the loop; empty when the chain is
  /// not one simple loop. Vertices are counted from 0 in the file (STL: in the order in which points first occur there,
  /// equal points once); a point that was made in the middle of a polygon has a number behind those.
  std::vector<std::uint32_t> vertices;
  Measure length;                 ///< degree 1: of its edges, with their coefficients
  bool is_short = false;          ///< degree 1: found by `short_loops`, not the engine's own
  std::size_t triangles = 0;      ///< degree 2
  Measure area;                   ///< degree 2: of its polygons, each as if it were flat
  std::optional<Measure> volume;  ///< degree 2, over Z and Q: enclosed; negative when its faces point inwards
  std::array<Point, 2> box{};     ///< lowest and highest coordinates (degree 0: of the component)
  Point centre{};                 ///< degree 0: of the box; 1: mean along the edges; 2: mean over the area
};

}  // namespace sesame::tools

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

/// On which side of its surface a loop bounds; see loop_sorting.hpp.
enum class LoopSide {
  handle,  ///< inside: round a handle, where a disc would cut it
  tunnel,  ///< outside: round a tunnel, where a disc would close it
};

/// "handle" or "tunnel".
[[nodiscard]] inline const char* side_name(LoopSide side) { return side == LoopSide::handle ? "handle" : "tunnel"; }

/// An edge of a cycle, from one point to another as it runs.
struct CycleEdge {
  std::array<std::uint32_t, 2> vertices;  ///< as MeshGenerator::vertices has them
  std::array<Point, 2> points;
  sparse::Integer times;  ///< how often; over Z/p, in [0, p)
};

/// A polygon of a surface, as the file counts it from 0, and how often: positive as the file turns it; over Z/p, in
/// [0, p).
struct SurfaceFace {
  std::uint32_t face;
  sparse::Integer times;
};

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
  std::uint32_t part = 0;        ///< degree 1: the connected part of the mesh, as Validity has them
  std::optional<LoopSide> side;  ///< degree 1: none where there is no inside, or the loop does not bound on one side
  /// Degree 1: along the loop; where it is not one closed walk, in the order of the chain.
  std::vector<CycleEdge> edges;
  Measure length;                  ///< degree 1: of its edges, with their coefficients
  bool is_short = false;           ///< degree 1: found by `short_loops`, not the engine's own
  std::size_t triangles = 0;       ///< degree 2
  std::vector<SurfaceFace> faces;  ///< degree 2: what these are parts of, if that was asked for
  Measure area;                    ///< degree 2: of its polygons, each as if it were flat
  std::optional<Measure> volume;   ///< degree 2, over Z and Q: enclosed; negative when its faces point inwards
  std::array<Point, 2> box{};      ///< lowest and highest coordinates (degree 0: of the component)
  Point centre{};                  ///< degree 0: of the box; 1: mean along the edges; 2: mean over the area
};

}  // namespace sesame::tools

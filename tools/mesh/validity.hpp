/// \file
/// Is this mesh a surface, and which one: what counting alone can tell, before any homology is computed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/mesh/mesh.hpp"
#include "tools/mesh/normalise.hpp"

namespace sesame::tools {

/// One connected part of a mesh.
struct Component {
  std::size_t vertices = 0;
  std::size_t edges = 0;
  std::size_t faces = 0;
  std::size_t lines = 0;           ///< edges on no face
  std::size_t boundary_edges = 0;  ///< edges on one face
  std::size_t boundary_loops = 0;  ///< connected parts of the boundary; circles when the component is a surface
  bool is_manifold = true;    ///< a surface, maybe with boundary: no non-manifold edge or vertex, no line, some face
  bool is_orientable = true;  ///< no chain of faces across edges of two faces comes back reversed

  [[nodiscard]] long long euler() const {
    return static_cast<long long>(vertices) - static_cast<long long>(edges) + static_cast<long long>(faces);
  }
  [[nodiscard]] bool is_closed() const { return boundary_edges == 0 && faces > 0; }
  /// Handles of an orientable surface, with its boundary loops filled in: euler = 2 - 2 genus - boundary_loops.
  /// Nothing for what is not an orientable surface.
  [[nodiscard]] std::optional<long long> genus() const;
};

/// Where a mesh is no closed surface whose faces agree; points are those that `normalise` leaves, in its order.
struct MeshPlaces {
  std::vector<Edge> lines;
  std::vector<Edge> boundary;
  std::vector<std::uint32_t> boundary_loop;  ///< of each edge of the boundary: its loop, in the order of lowest points
  std::vector<Edge> non_manifold_edges;
  std::vector<std::uint32_t> non_manifold_vertices;
  std::vector<Edge> reversed_edges;
};

/// Counts are of the cell complex that `normalise` makes of the mesh; `cleaning` says what that left out.
struct Validity {
  std::size_t points_in_file = 0;
  std::size_t faces_in_file = 0;
  Cleaning cleaning;
  std::vector<std::string> remarks;  ///< of reading and cleaning

  std::size_t vertices = 0;
  std::size_t edges = 0;
  std::size_t faces = 0;
  std::size_t polygons = 0;  ///< those of the faces that have more than three corners
  std::size_t lines = 0;     ///< edges on no face
  std::size_t boundary_edges = 0;
  std::size_t boundary_loops = 0;
  std::size_t non_manifold_edges = 0;     ///< edges on more than two faces
  std::size_t non_manifold_vertices = 0;  ///< vertices of faces whose link is neither a path nor a circle
  std::size_t reversed_edges = 0;         ///< edges whose two faces run along them in the same direction
  MeshPlaces places;                      ///< of all of these
  std::optional<std::pair<Point, Point>> first_non_manifold_edge;
  std::optional<Point> first_non_manifold_vertex;
  std::vector<Component> components;  ///< in the order of their lowest points

  [[nodiscard]] long long euler() const;
  [[nodiscard]] bool is_manifold() const;    ///< every component is; at least one
  [[nodiscard]] bool is_closed() const;      ///< every component is; at least one
  [[nodiscard]] bool is_orientable() const;  ///< every component is
  /// The faces as the file orders them agree across every edge of two faces.
  [[nodiscard]] bool is_consistently_oriented() const { return reversed_edges == 0; }
  /// How many of the faces of the file are left out, and why; empty when none is.
  [[nodiscard]] std::string left_out_faces() const;
};

/// Takes any mesh that a reader returned. Cost O(n log n) for n corners.
[[nodiscard]] Validity validate(const Mesh& mesh);

/// A paragraph of lines for people, each ending in a newline.
[[nodiscard]] std::string to_text(const Validity& validity);

}  // namespace sesame::tools

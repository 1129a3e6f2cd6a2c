/// \file
/// A mesh as its complex is built from it, and which cell of the complex is what in it.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "ops/cells/structure.hpp"
#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

/// A mesh on its way to a complex: without what `normalise` leaves out, and cut into triangles.
struct PreparedMesh {
  Mesh polygons;
  std::vector<std::uint32_t> point_in_file;  ///< per point of `polygons`
  std::vector<std::uint32_t> face_in_file;   ///< per face of `polygons`
  std::size_t points_in_file = 0;
  Mesh triangles;
  std::vector<std::uint32_t> face_of_triangle;  ///< the face of `polygons` that it is a part of
};
[[nodiscard]] PreparedMesh prepared(const Mesh& mesh);

/// Cells by the vertices, edges and triangles that they are, and back. Cost: O(1), but for the first triangle, when all
/// of them are looked up.
class MeshCells {
 public:
  /// The complex has the names of `write_complex_script` for a source. `mesh` and `structure` must outlive it.
  MeshCells(const PreparedMesh& mesh, const ops::Structure& structure, const std::string& source);

  [[nodiscard]] const PreparedMesh& mesh() const { return mesh_; }
  /// The edges of the polygons, and their cells.
  [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }
  [[nodiscard]] const std::vector<ops::CellId>& cells_of_edges() const { return cell_of_edge_; }
  [[nodiscard]] ops::CellId vertex(std::uint32_t point) const { return cell("v{}", point); }

  /// The points of an edge, the lower one first; of a triangle.
  [[nodiscard]] Edge ends(ops::CellId edge) const;
  [[nodiscard]] std::array<std::uint32_t, 3> corners(ops::CellId triangle) const;
  /// Which triangle of the mesh a cell is.
  [[nodiscard]] std::uint32_t triangle(ops::CellId cell_of_triangle) const;
  /// The number of a point in the file; of one that was made, a number behind those.
  [[nodiscard]] std::uint32_t in_file(std::uint32_t point) const;

 private:
  template <class... Numbers>
  [[nodiscard]] ops::CellId cell(fmt::format_string<Numbers&...> format, Numbers... numbers) const;

  const PreparedMesh& mesh_;
  const ops::Structure& structure_;
  std::string name_;
  std::vector<Edge> edges_;
  std::vector<ops::CellId> cell_of_edge_;
  std::unordered_map<ops::CellId, std::uint32_t> vertex_of_cell_;
  mutable std::unordered_map<ops::CellId, std::uint32_t> triangle_of_cell_;  ///< filled when first asked for
};

}  // namespace sesame::tools

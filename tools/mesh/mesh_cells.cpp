#include "tools/mesh/mesh_cells.hpp"

#include "sparse/contract.hpp"
#include "tools/mesh/incidence.hpp"
#include "tools/mesh/normalise.hpp"
#include "tools/mesh/script.hpp"
#include "tools/mesh/triangulate.hpp"

namespace sesame::tools {

using ops::CellId;

/// What is left out depends on the numbers of points alone, so they can carry their numbers through as coordinates.
PreparedMesh prepared(const Mesh& mesh) {
  PreparedMesh result;
  result.polygons = mesh;
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    result.polygons.points[p] = {static_cast<double>(p), 0, 0};
  }
  normalise(result.polygons, result.face_in_file);
  for (Point& point : result.polygons.points) {
    result.point_in_file.push_back(static_cast<std::uint32_t>(point[0]));
    point = mesh.points[result.point_in_file.back()];
  }
  result.points_in_file = mesh.points.size();
  result.triangles = result.polygons;
  result.triangles.remarks.clear();
  result.face_of_triangle = triangulate(result.triangles, Polygons::fan);
  return result;
}

MeshCells::MeshCells(const PreparedMesh& mesh, const ops::Structure& structure, const std::string& source)
    : mesh_{mesh}, structure_{structure}, name_{name_of_source(source)}, edges_{incidence_of(mesh.polygons).edges} {
  for (std::uint32_t v = 0; v < mesh_.triangles.points.size(); ++v) {
    vertex_of_cell_[vertex(v)] = v;
  }
  for (const auto& [low, high] : edges_) {
    cell_of_edge_.push_back(cell("e{}-{}", low, high));
  }
}

template <class... Numbers>
CellId MeshCells::cell(fmt::format_string<Numbers&...> format, Numbers... numbers) const {
  const auto found = structure_.lookup(name_ + "." + fmt::format(format, numbers...));
  sparse::expects(found.has_value(), "the script names every cell of the mesh");
  return *found;
}

Edge MeshCells::ends(CellId edge) const {
  const auto faces = structure_.cells().faces(edge);
  return {vertex_of_cell_.at(faces[1]), vertex_of_cell_.at(faces[0])};
}

std::array<std::uint32_t, 3> MeshCells::corners(CellId triangle) const {
  const auto faces = structure_.cells().faces(triangle);
  const auto [a, b] = ends(faces[2]);
  return {a, b, ends(faces[0])[1]};
}

std::uint32_t MeshCells::triangle(CellId cell_of_triangle) const {
  if (triangle_of_cell_.empty()) {
    for (std::uint32_t t = 0; t < mesh_.triangles.faces.size(); ++t) {
      triangle_of_cell_.emplace(cell("f{}", t), t);
    }
  }
  return triangle_of_cell_.at(cell_of_triangle);
}

std::uint32_t MeshCells::in_file(std::uint32_t point) const {
  const auto& known = mesh_.point_in_file;
  return point < known.size() ? known[point]
                              : static_cast<std::uint32_t>(mesh_.points_in_file + (point - known.size()));
}

}  // namespace sesame::tools

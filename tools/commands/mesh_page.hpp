/// \file
/// A mesh as a page: the mesh in space, what is wrong with it and where, its groups and loops.
#pragma once

#include <optional>
#include <ostream>
#include <string>

#include "tools/mesh/mesh_homology.hpp"

namespace sesame::tools {

/// What a page has at most. What is left out is counted, and the page says so.
struct MeshPageLimits {
  std::size_t triangles = 1'000'000;  ///< of more, every second, third, ... is drawn
  std::size_t loops = 5'000;          ///< the shortest ones
  std::size_t edges = 2'000'000;      ///< of all loops together
  std::size_t surfaces = 500;
  std::size_t components = 1'000;
  std::size_t meetings = 1'000;  ///< pairs of faces that meet
  std::size_t faces = 1'000;     ///< that are left out of the mesh or folded, of each kind
};

struct MeshPageOptions {
  std::string source;                  ///< the mesh file
  bool generators = true;              ///< whether they were looked for
  std::optional<double> shorter_than;  ///< the page begins with loops that are; it has all of them
  MeshPageLimits limits = {};
};

/// The data of the page, as JSON. `mesh` is what `found` was found from. Points are those of the triangles of
/// `prepared`, as floats: file = middle + scale * point. Cost: that of `prepared`, plus what is written.
[[nodiscard]] std::string mesh_page_data(const Mesh& mesh, const MeshHomology& found, const MeshPageOptions& options);

/// The page: one file of HTML that needs no other and asks for none.
void write_mesh_page(std::ostream& out, const Mesh& mesh, const MeshHomology& found, const MeshPageOptions& options);

}  // namespace sesame::tools

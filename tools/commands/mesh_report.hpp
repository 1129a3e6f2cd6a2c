/// \file
/// What `sesame mesh` prints: a page for people, or one JSON object for programs.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "tools/mesh/mesh_homology.hpp"

namespace sesame::tools {

struct MeshReportOptions {
  std::string source;  ///< the mesh file
  /// How many generators at most: of each group for people, in all for programs. Nothing: 20, and all.
  std::optional<std::size_t> generators_limit;
  std::optional<double> shorter_than;  ///< loops that are not were left out
  std::size_t loops_left_out = 0;
  double seconds = 0;
  bool cells = false;  ///< of polygons, as the file has them, instead of the triangles that they are cut into
};

void write_text(std::ostream& out, const MeshHomology& found, const MeshReportOptions& options);

/// Chains name cells as the script of `sesame import` does, so that a `class` of them can be appended to it.
void write_json(std::ostream& out, const MeshHomology& found, const MeshReportOptions& options);

}  // namespace sesame::tools

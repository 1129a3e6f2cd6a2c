/// \file
/// The loops of a mesh in files: drawn on it, or as a table.
#pragma once

#include <iosfwd>
#include <string>

#include "sparse/result.hpp"
#include "tools/mesh/mesh_homology.hpp"

namespace sesame::tools {

enum class MeshDrawing { obj, ply, vtk, vtu };

/// The mesh, cut into triangles, with its generators of H_1 as `sesame export` draws them (replay/export/drawing.hpp):
/// groups of lines in OBJ, properties of edges in PLY, data of cells in VTK. They are called H1_0, H1_1, ... in the
/// order of the report, with `_handle` or `_tunnel` behind it where they have a side. `mesh` and `source` are those
/// that `found` was found from. Errors, refused: a format that has a number for each loop and cell would have more than
/// 10^8.
[[nodiscard]] Status draw_loops(const Mesh& mesh, const std::string& source, const MeshHomology& found,
                                MeshDrawing format, std::ostream& out);

/// A row for each edge of each generator of H_1, along the loop: its number from 0, `handle` or `tunnel` or nothing,
/// the component, the order (0: free), the length; the number of the edge in the loop, its vertices, how often, and
/// where they are.
void write_loop_table(const MeshHomology& found, std::ostream& out);

}  // namespace sesame::tools

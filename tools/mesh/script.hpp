/// \file
/// Construction scripts from meshes: one `complex`, or an assembly triangle by triangle.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "ops/vocabulary/operation.hpp"
#include "sparse/result.hpp"
#include "tools/mesh/mesh.hpp"
#include "tools/mesh/triangulate.hpp"

namespace sesame::tools {

enum class BuildOrder {
  breadth_first,  ///< over the edges, then over the vertices, one component after the other: what is built stays
                  ///< connected
  as_given,       ///< in the order of the faces
};

struct ScriptOptions {
  std::string source;  ///< the mesh file; it is named in a comment, and its stem names the complex
  std::string ring = "Z";
  Polygons polygons = Polygons::fan;
  BuildOrder order = BuildOrder::breadth_first;
  bool expect = true;  ///< end with an `expect` of the numbers of cells and the Euler characteristic
};

struct ScriptSummary {
  std::size_t vertices = 0;
  std::size_t edges = 0;
  std::size_t triangles = 0;
  std::size_t steps = 0;             ///< operations written
  std::vector<std::string> remarks;  ///< of reading, cleaning and cutting polygons; the script has them as comments
};

/// Writes a script of one `complex`. With NAME the stem of the source, points are `NAME.vP`, edges `NAME.eP-Q` (P < Q)
/// and triangles `NAME.fT`, counted from 0 in the mesh that `normalise` and `triangulate` make, which is done here.
///
/// Each triangle comes after those of its vertices and edges that no earlier one has. Faces are in the order d_0, d_1,
/// d_2 with the vertices of every cell in increasing order, so the face laws hold. Errors: bad_input for a mesh without
/// points. Whether the stream has taken everything, its owner sees.
[[nodiscard]] Result<ScriptSummary> write_complex_script(const Mesh& mesh, std::ostream& out,
                                                         const ScriptOptions& options);

/// The operation of that script.
[[nodiscard]] Result<ops::MakeComplex> make_complex(const Mesh& mesh, const ScriptOptions& options);

/// Writes a script of one `simplex` per triangle `fT`, line `lL`, or, for a point cloud, point `pP`, each followed by
/// one `identify` that glues it to what is there, if anything is: shared edges, then vertices that no shared edge has.
/// A simplex has its vertices in increasing order, so shared edges glue head to head.
/// Errors: as above.
[[nodiscard]] Result<ScriptSummary> write_assembled_script(const Mesh& mesh, std::ostream& out,
                                                           const ScriptOptions& options);

/// The stem of a path as a name for cells: letters, digits, `-` and `_` stay, all else becomes `_`; "mesh" when empty.
[[nodiscard]] std::string name_of_source(std::string_view path);

}  // namespace sesame::tools

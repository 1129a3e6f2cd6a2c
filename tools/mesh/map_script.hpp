/// \file
/// A construction script of one map from a mesh, whose polygons stay polygons.
#pragma once

#include <iosfwd>

#include "tools/mesh/script.hpp"

namespace sesame::tools {

/// Writes a script of one `gmap`, called after the stem of the source: a face for each polygon of the mesh as it was
/// read, sewn to its neighbours; where there is none the boundary is free darts. Dart 2s of a polygon is at its corner
/// s, after the darts of the polygons before it. Segments and points without a polygon are left out, as remarks say;
/// so do they when the polygons around a point are no fan, and it is several vertices.
/// In the summary `triangles` are polygons. Errors: bad_input, for a mesh without polygons, a polygon without corners,
/// and a side of three polygons, which no map has.
[[nodiscard]] Result<ScriptSummary> write_map_script(const Mesh& mesh, std::ostream& out, const ScriptOptions& options);

}  // namespace sesame::tools

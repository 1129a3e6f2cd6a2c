/// \file
/// Meshes of solids as their files give them, and the readers of MEDIT and VTK.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "ops/maps/gmap.hpp"
#include "sparse/result.hpp"
#include "tools/mesh/mesh.hpp"
#include "tools/mesh/script.hpp"

namespace sesame::tools {

/// Solids by their faces: solid s has the faces [first_face[s], first_face[s + 1]).
struct Solids {
  std::vector<Point> points;
  Faces faces;  ///< of one solid after the other; a face that two have is there twice
  std::vector<std::uint32_t> first_face{0};
  std::vector<std::size_t> lines;    ///< per solid: where it is in the file
  bool has_polyhedra = false;        ///< whose faces were listed, and may close to other things than balls
  std::vector<std::string> remarks;  ///< what was left out, a sentence each

  [[nodiscard]] std::size_t size() const { return lines.size(); }
};

/// The faces of a solid with a number of corners, as both formats number them; empty for other numbers. 4 is a
/// tetrahedron, 5 a pyramid, 6 a prism, 8 a hexahedron, 10 and 12 are prisms over a pentagon and a hexagon.
[[nodiscard]] const std::vector<std::vector<std::uint32_t>>& faces_of_solid(std::size_t corners);

/// Adds a solid with such faces, whose numbers are those of its corners.
void add_solid(const std::vector<std::vector<std::uint32_t>>& faces, const std::vector<std::uint32_t>& corners,
               std::size_t line, Solids& solids);
/// Whether all corners are points, which the file counts from `first`. Errors: bad_input.
[[nodiscard]] Status check_corners(const Solids& solids, std::string_view name, std::uint32_t first);

/// MEDIT, ASCII: Vertices, Tetrahedra, Prisms, Pyramids and Hexahedra; other sections are left out.
/// Errors    bad_input, `FILE:LINE: what, and what would be right`. Ensures  corners are numbers of points.
[[nodiscard]] Result<Solids> read_medit(std::string_view bytes, std::string_view name);

/// VTK, legacy, ASCII, of any version to 5.1: an unstructured grid with linear cells and polyhedra; cells of lower
/// dimensions are left out, and data. Errors as above.
[[nodiscard]] Result<Solids> read_vtk(std::string_view bytes, std::string_view name);

/// By the format, which is one of these two.
[[nodiscard]] Result<Solids> parse_solids(std::string_view bytes, std::string_view name, Format format);

/// Solids as a 3-G-map: dart 2s of a face is at its corner s, after the darts of the faces before it, and 2s + 1 at the
/// next one. Solids with a face in common are sewn there; other faces are 3-free. `name` is that of the file.
///
/// Errors    bad_input, `NAME:LINE: what` of a solid: none at all; corners of a face that are one point; an edge that
///           is not on two faces of its solid; a face of three solids; two faces with the same corners in another
///           order, or one face that lies against several of another solid. Cost: O(n log n) for n corners.
[[nodiscard]] Result<ops::GMap> map_of_solids(const Solids& solids, std::string_view name);

struct SolidSummary {
  std::vector<std::size_t> cells;  ///< by dimension
  std::vector<std::string> remarks;
};
/// Writes a script of one `gmap`, as `write_map_script` does for polygons. Errors: those of `map_of_solids`; refused,
/// naming a dart, a polyhedron that is no ball.
[[nodiscard]] Result<SolidSummary> write_solid_script(const Solids& solids, std::ostream& out,
                                                      const ScriptOptions& options);

}  // namespace sesame::tools

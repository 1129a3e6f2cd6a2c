#include "tools/mesh/map_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <utility>
#include <vector>

#include "ops/maps/orbits.hpp"
#include "ops/maps/polygon_map.hpp"
#include "tools/mesh/text.hpp"

namespace sesame::tools {
namespace {

/// The mesh's points at the darts of its polygons.
std::vector<std::uint32_t> points_of_darts(const std::vector<std::vector<std::uint32_t>>& polygons) {
  std::vector<std::uint32_t> points;
  for (const auto& polygon : polygons) {
    for (std::size_t side = 0; side < polygon.size(); ++side) {
      points.push_back(polygon[side]);
      points.push_back(polygon[(side + 1) % polygon.size()]);
    }
  }
  return points;
}

void add_remarks(const Mesh& mesh, const std::vector<std::uint32_t>& points, std::size_t vertices,
                 std::vector<std::string>& remarks) {
  std::vector<bool> is_used(mesh.points.size(), false);
  for (const std::uint32_t point : points) {
    is_used[point] = true;
  }
  const auto used = static_cast<std::size_t>(std::ranges::count(is_used, true));
  if (used < mesh.points.size()) {
    remarks.push_back(fmt::format("{} of no polygon left out", counted(mesh.points.size() - used, "point", "points")));
  }
  if (!mesh.lines.empty()) {
    remarks.push_back(fmt::format("{} left out", counted(mesh.lines.size(), "segment", "segments")));
  }
  if (vertices > used) {
    remarks.push_back(
        fmt::format("points around which the polygons are no fan are several vertices: {} more", vertices - used));
  }
}

}  // namespace

Result<ScriptSummary> write_map_script(const Mesh& mesh, std::ostream& out, const ScriptOptions& options) {
  if (mesh.faces.empty()) {
    return Error{Errc::bad_input, "there are no polygons: a map of a mesh needs some"};
  }
  std::vector<std::vector<std::uint32_t>> polygons;
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    polygons.emplace_back(mesh.faces[face].begin(), mesh.faces[face].end());
  }
  Result<ops::GMap> map = ops::map_of_polygons(polygons);
  if (!map) {
    return map.error();
  }
  const std::vector<std::uint32_t> points = points_of_darts(polygons);
  const ops::Orbits vertices = ops::cells(*map, 0);
  ScriptSummary summary{vertices.count(), ops::cells(*map, 1).count(), polygons.size(), options.expect ? 2U : 1U,
                        mesh.remarks};
  add_remarks(mesh, points, vertices.count(), summary.remarks);
  ops::MakeGMap made{name_of_source(options.source), map->involutions(), false, {}};
  for (const ops::Dart first : vertices.first) {
    made.at.push_back(mesh.points[points[first]]);
  }
  ops::Header header;
  header.ring = options.ring;
  header.title = made.name;
  out << ops::to_text(header) << '\n';
  for (const std::string& remark : summary.remarks) {
    out << "# " << printable(remark) << '\n';
  }
  out << ops::to_text(ops::Operation{std::move(made)}) << '\n';
  if (options.expect) {  // counted on the map, so this holds of any engine that works
    ops::Expect expect;
    expect.cells = std::vector<ops::Integer>{ops::Integer{static_cast<std::int64_t>(summary.vertices)},
                                             ops::Integer{static_cast<std::int64_t>(summary.edges)},
                                             ops::Integer{static_cast<std::int64_t>(summary.triangles)}};
    out << ops::to_text(ops::Operation{std::move(expect)}) << '\n';
  }
  return summary;
}

}  // namespace sesame::tools

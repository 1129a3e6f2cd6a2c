// Construction scripts from map files.
#include <fmt/format.h>

#include <ostream>
#include <utility>

#include "ops/cells/map_cells.hpp"
#include "ops/maps/map_conversions.hpp"
#include "ops/maps/orbits.hpp"
#include "ops/vocabulary/operation.hpp"
#include "tools/mesh/map_file.hpp"
#include "tools/mesh/script.hpp"
#include "tools/mesh/text.hpp"

namespace sesame::tools {
namespace {

/// A point for each vertex, in the order of the least darts, or none at all.
Result<std::vector<ops::Point>> points_of_vertices(const MapFile& file, const ops::Orbits& vertices,
                                                   const std::string& source, std::vector<std::string>& remarks) {
  std::vector<const MapFile::Placed*> of(vertices.count(), nullptr);
  for (const MapFile::Placed& placed : file.points) {
    const MapFile::Placed*& known = of[vertices.of[placed.dart]];
    if (known != nullptr && known->point != placed.point) {
      return Error{Errc::bad_input,
                   fmt::format("{}:{}: dart {} has another point than dart {}, and both are at one vertex", source,
                               placed.line, placed.dart + 1, known->dart + 1)};
    }
    known = known != nullptr ? known : &placed;
  }
  std::vector<ops::Point> points;
  for (const MapFile::Placed* placed : of) {
    if (placed == nullptr) {
      if (!file.points.empty()) {
        remarks.emplace_back("not every vertex has a point, so all are left out");
      }
      return std::vector<ops::Point>{};
    }
    points.push_back(placed->point);
  }
  return points;
}

Status check_balls(const ops::GMap& map, const std::string& source) {
  ops::TypeTable types;
  const auto cells = ops::cells_of_map(map, types);
  return cells ? Status{Done{}}
               : Error{Errc::refused,
                       fmt::format("{}: with darts counted from 0, {}; --simplices takes it by the simplices of "
                                   "its subdivision, and --dim as a map of a smaller dimension",
                                   source, cells.error().what)};
}

ops::Operation step_of(const MapFile& file, std::string name, bool as_simplices, std::vector<ops::Point> at) {
  if (const auto* nmap = std::get_if<ops::NMap>(&file.map)) {
    return ops::MakeMap{std::move(name), nmap->images(), as_simplices, std::move(at)};
  }
  return ops::MakeGMap{std::move(name), std::get<ops::GMap>(file.map).involutions(), as_simplices, std::move(at)};
}

}  // namespace

Result<MapScriptSummary> write_script_of_map_file(const MapFile& file, std::ostream& out,
                                                  const MapScriptOptions& options) {
  const auto* nmap = std::get_if<ops::NMap>(&file.map);
  const ops::GMap map = nmap != nullptr ? ops::to_gmap(*nmap) : std::get<ops::GMap>(file.map);
  if (Status s = options.as_simplices ? Status{Done{}} : check_balls(map, options.source); !s) {
    return s.error();
  }
  MapScriptSummary summary{{}, nmap != nullptr ? nmap->size() : map.size(), file.remarks};
  Result<std::vector<ops::Point>> at = points_of_vertices(file, ops::cells(map, 0), options.source, summary.remarks);
  if (!at) {
    return at.error();
  }
  ops::Expect expect;
  expect.cells.emplace();
  for (int i = 0; i <= map.dimension(); ++i) {
    summary.cells.push_back(ops::cells(map, i).count());
    expect.cells->emplace_back(static_cast<std::int64_t>(summary.cells.back()));
  }
  ops::Header header;
  header.ring = options.ring;
  header.title = name_of_source(options.source);
  out << ops::to_text(header) << '\n';
  for (const std::string& remark : summary.remarks) {
    out << "# " << printable(remark) << '\n';
  }
  out << ops::to_text(step_of(file, header.title, options.as_simplices, std::move(*at))) << '\n';
  if (!options.as_simplices) {
    out << ops::to_text(ops::Operation{std::move(expect)}) << '\n';
  }
  return summary;
}

}  // namespace sesame::tools

#include "replay/export/map_file.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "ops/maps/map_conversions.hpp"
#include "ops/maps/nmap_cells.hpp"
#include "ops/maps/orientation.hpp"
#include "replay/text/text_buffer.hpp"

namespace sesame::replay {
namespace {

using ops::Dart;
using Points = std::vector<std::optional<ops::Point>>;

constexpr std::string_view head = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n";
/// What CGAL calls its points where it reads a file: it takes no others.
constexpr std::string_view type_of_points = "N4CGAL7Point_3INS_5EpickEEE";

/// The darts that are written, in their order, and which darts of the object's map they are.
struct Written {
  std::vector<std::vector<Dart>> images;  ///< beta_1 to beta_n or alpha_0 to alpha_n; no_dart where one is free
  std::vector<Dart> darts;
};

Written all_darts(const ops::GMap& map) {
  Written written{map.involutions(), {}};
  for (Dart d = 0; d < map.size(); ++d) {
    written.darts.push_back(d);
    for (int i = 0; i <= map.dimension(); ++i) {
      if (map.is_free(i, d)) {
        written.images[static_cast<std::size_t>(i)][d] = ops::no_dart;
      }
    }
  }
  return written;
}

/// Every component has its two orientations side by side in the turning map: the one of its first dart is kept.
Result<Written> oriented_darts(const ObjectMap& object, const ops::Structure& structure) {
  const ops::GMap& map = object.map;
  const std::string_view hint = "; --format 3map-generalized can hold it";
  if (map.dimension() == 0) {
    return Error{Errc::refused, fmt::format("\"{}\" belongs to a map of dimension 0, and a combinatorial map has "
                                            "beta_1 at least{}",
                                            object.name(0, structure), hint)};
  }
  for (const ops::ComponentOrientability& component : ops::orientability(map)) {
    if (component.is == ops::Orientability::not_orientable) {
      return Error{Errc::refused, fmt::format("what \"{}\" belongs to is not orientable, and a combinatorial map is{}",
                                              object.name(component.first, structure), hint)};
    }
    if (component.is == ops::Orientability::undefined) {
      const auto& [i, dart] = *component.obstacle;
      const std::string why = i == 0 ? "is 0-free" : fmt::format("has one image under alpha_0 and alpha_{}", i);
      return Error{Errc::refused, fmt::format("\"{}\" {}, which no dart of a combinatorial map is{}",
                                              object.name(dart, structure), why, hint)};
    }
  }
  const Result<ops::NMap> turning = ops::turning_map(map);
  if (!turning) {
    return turning.error();
  }
  const ops::Orbits parts = ops::components(map);
  const ops::Orbits halves = ops::components(*turning);
  Written written;
  std::vector<Dart> number(map.size(), ops::no_dart);
  for (Dart d = 0; d < map.size(); ++d) {
    if (halves.join(d, parts.first[parts.of[d]])) {
      number[d] = static_cast<Dart>(written.darts.size());
      written.darts.push_back(d);
    }
  }
  for (int i = 1; i <= map.dimension(); ++i) {
    std::vector<Dart>& beta = written.images.emplace_back();
    for (const Dart d : written.darts) {
      const Dart image = turning->beta(i, d);
      beta.push_back(image == ops::no_dart ? image : number[image]);
    }
  }
  return written;
}

void write_darts(const Written& written, MapFileKind kind, TextBuffer& text) {
  const bool is_general = kind == MapFileKind::generalized;
  text.add("<darts>\n");
  for (Dart d = 0; d < written.darts.size(); ++d) {
    text.add("<d>");
    for (std::size_t k = 0; k < written.images.size(); ++k) {
      if (const Dart image = written.images[k][d]; image != ops::no_dart) {
        text.add(is_general ? "<a i=\"" : "<b i=\"").add_integer(is_general ? k : k + 1).add("\">");
        text.add_integer(std::uint64_t{image} + 1).add(is_general ? "</a>" : "</b>");
      }
    }
    text.add("</d>\n");
  }
  text.add("</darts>\n");
}

/// The first dart of each vertex that is written has its point.
void write_points(const Written& written, const ObjectMap& object, const ObjectCells& cells, const Points& points,
                  TextBuffer& text) {
  std::vector<bool> is_written(points.size(), false);
  text.add("<dimension index=\"0\"><type>void</type><type_point>").add(type_of_points).add("</type_point>\n");
  for (Dart d = 0; d < written.darts.size(); ++d) {
    const std::uint32_t vertex = cells.number(object.vertices[written.darts[d]]);
    if (is_written[vertex]) {
      continue;
    }
    is_written[vertex] = true;
    const ops::Point& point = *points[vertex];
    text.add("<a><d>").add_integer(std::uint64_t{d} + 1).add("</d><p><x>").add_number(point[0]);
    text.add("</x><y>").add_number(point[1]).add("</y><z>").add_number(point[2]).add("</z></p></a>\n");
  }
  text.add("</dimension>\n");
}

/// How many vertices of the map have no point.
std::uint64_t count_without(const ObjectMap& object, const ObjectCells& cells, const Points& points) {
  std::vector<bool> is_met(points.size(), false);
  std::uint64_t count = 0;
  for (const ops::CellId vertex : object.vertices) {
    const std::uint32_t number = cells.number(vertex);
    count += !is_met[number] && !points[number] ? 1U : 0U;
    is_met[number] = true;
  }
  return count;
}

}  // namespace

Result<Remarks> write_map_file(const ObjectCells& cells, const Points& points, MapFileKind kind, std::ostream& out) {
  const Result<ObjectMap> object = map_of_object(cells);
  if (!object) {
    return object.error();
  }
  const Result<Written> written = kind == MapFileKind::generalized ? Result<Written>{all_darts(object->map)}
                                                                   : oriented_darts(*object, cells.structure());
  if (!written) {
    return written.error();
  }
  Remarks remarks;
  const std::uint64_t without = count_without(*object, cells, points);
  if (without > 0) {
    remarks.push_back(fmt::format("{} of the vertices have no position, so none is written", without));
  }
  TextBuffer text(out);
  text.add(head).add("<data>\n");
  write_darts(*written, kind, text);
  text.add("<attributes>\n");
  if (without == 0) {
    write_points(*written, *object, cells, points, text);
  }
  text.add("</attributes>\n</data>\n");
  return remarks;
}

}  // namespace sesame::replay

// The vertices, edges and faces of an object in the formats of meshes, OBJ and PLY.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>

#include "replay/export/drawing.hpp"
#include "replay/text/text_buffer.hpp"

namespace sesame::replay {
namespace {

using Polygon = std::vector<std::uint32_t>;
using Segment = std::array<std::uint32_t, 2>;

/// The corners in turn, without those that are the point before them.
Polygon polygon_of(const ObjectCells& cells, ops::CellId face) {
  Polygon corners;
  cells.corners(face, corners);
  if (corners.size() == 4 && !ops::is_of_map(cells.structure().cells().type(face).type)) {  // lexicographic
    corners = {corners[0], corners[2], corners[3], corners[1]};
  }
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  while (corners.size() > 1 && corners.front() == corners.back()) {
    corners.pop_back();
  }
  return corners;
}

/// What the formats show of an object.
struct Surface {
  explicit Surface(const ObjectCells& cells) {
    for (const ops::CellId face : cells.of(2)) {
      Polygon polygon = polygon_of(cells, face);
      if (polygon.size() < 3) {
        ++flat;
      } else {
        polygons.push_back(std::move(polygon));
      }
    }
    std::vector<std::uint32_t> ends;
    for (const ops::CellId edge : cells.of(1)) {
      cells.corners(edge, ends);
      segments.push_back({ends[0], ends[1]});
    }
    for (std::size_t dimension = 3; dimension < cells.dimensions(); ++dimension) {
      higher += cells.of(dimension).size();
    }
  }

  [[nodiscard]] Remarks remarks() const {
    Remarks all;
    if (flat > 0) {
      all.push_back(
          fmt::format("{} faces that have fewer than three corners, but for repetitions, are not shown", flat));
    }
    if (higher > 0) {
      all.push_back(fmt::format("of {} cells of dimensions above 2 only the faces are shown", higher));
    }
    return all;
  }

  std::vector<Polygon> polygons;
  std::vector<Segment> segments;
  std::uint64_t flat = 0;
  std::uint64_t higher = 0;
};

/// Those that edges can show.
std::vector<const NamedGenerator*> loops(const Drawing& drawing) {
  std::vector<const NamedGenerator*> all;
  for (const NamedGenerator& named : drawing.generators) {
    if (named.generator.degree == 1) {
      all.push_back(&named);
    }
  }
  return all;
}

std::string description(const NamedGenerator& named) {
  const sparse::Integer& order = named.generator.order;
  return fmt::format("{}, {}", named.name, order.is_zero() ? "free" : "of order " + order.to_string());
}

void add_segment(TextBuffer& text, const Segment& segment, bool is_turned) {
  text.add("l ").add_integer(segment[is_turned ? 1 : 0] + std::uint64_t{1}).add(' ');
  text.add_integer(segment[is_turned ? 0 : 1] + std::uint64_t{1}).add('\n');
}

}  // namespace

Remarks write_obj(const Drawing& drawing, std::ostream& out) {
  const Surface surface(drawing.cells);
  TextBuffer text(out);
  text.add("# ").add_integer(drawing.points.size()).add(" vertices, ").add_integer(surface.segments.size());
  text.add(" edges, ").add_integer(surface.polygons.size()).add(" faces\n");
  for (const ops::Point& point : drawing.points) {
    text.add("v ").add_number(point[0]).add(' ').add_number(point[1]).add(' ').add_number(point[2]).add('\n');
  }
  text.add("g faces\n");
  for (const Polygon& polygon : surface.polygons) {
    text.add('f');
    for (const std::uint32_t corner : polygon) {
      text.add(' ').add_integer(corner + std::uint64_t{1});
    }
    text.add('\n');
  }
  text.add("g edges\n");
  for (const Segment& segment : surface.segments) {
    add_segment(text, segment, false);
  }
  for (const NamedGenerator* loop : loops(drawing)) {
    text.add("# ").add(description(*loop)).add('\n');
    text.add("g ").add(loop->name).add('\n');
    for (const auto& [coefficient, cell] : loop->generator.cycle.terms) {
      if (!(sparse::abs(coefficient) == sparse::Rational{1})) {
        text.add("# coefficient ").add(coefficient.to_string()).add('\n');
      }
      add_segment(text, surface.segments[drawing.cells.number(cell)], coefficient.sign() < 0);
    }
  }
  return surface.remarks();
}

Remarks write_ply(const Drawing& drawing, std::ostream& out) {
  const Surface surface(drawing.cells);
  std::deque<CoefficientColumn> columns;
  TextBuffer text(out);
  text.add("ply\nformat ascii 1.0\nelement vertex ").add_integer(drawing.points.size());
  text.add("\nproperty double x\nproperty double y\nproperty double z\nelement face ");
  text.add_integer(surface.polygons.size()).add("\nproperty list uchar int vertex_indices\nelement edge ");
  text.add_integer(surface.segments.size()).add("\nproperty int vertex1\nproperty int vertex2\n");
  for (const NamedGenerator* loop : loops(drawing)) {
    columns.emplace_back(drawing.cells, loop->generator);
    text.add("comment ").add(description(*loop)).add('\n');
    text.add(columns.back().is_integral() ? "property int " : "property double ").add(loop->name).add('\n');
  }
  text.add("end_header\n");
  for (const ops::Point& point : drawing.points) {
    text.add_number(point[0]).add(' ').add_number(point[1]).add(' ').add_number(point[2]).add('\n');
  }
  for (const Polygon& polygon : surface.polygons) {
    text.add_integer(polygon.size());
    for (const std::uint32_t corner : polygon) {
      text.add(' ').add_integer(corner);
    }
    text.add('\n');
  }
  for (std::size_t k = 0; k < surface.segments.size(); ++k) {
    text.add_integer(surface.segments[k][0]).add(' ').add_integer(surface.segments[k][1]);
    for (const CoefficientColumn& column : columns) {
      text.add(' ').add_number(column[k]);
    }
    text.add('\n');
  }
  return surface.remarks();
}

}  // namespace sesame::replay

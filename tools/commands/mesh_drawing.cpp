#include "tools/commands/mesh_drawing.hpp"

#include <fmt/format.h>

#include <limits>
#include <ostream>

#include "replay/export/drawing.hpp"
#include "replay/text/text_buffer.hpp"
#include "tools/mesh/mesh_cells.hpp"

namespace sesame::tools {
namespace {

constexpr std::uint64_t most_numbers = 100'000'000;

std::vector<replay::NamedGenerator> named_loops(const MeshHomology& found) {
  std::vector<replay::NamedGenerator> loops;
  for (const MeshGenerator& generator : found.generators) {
    if (generator.degree == 1) {
      std::string name = fmt::format("H1_{}", loops.size());
      name += generator.side ? fmt::format("_{}", side_name(*generator.side)) : "";
      loops.push_back({std::move(name), {1, generator.order, generator.chain, {}}});
    }
  }
  return loops;
}

/// Of the vertices as the formats count them.
std::vector<ops::Point> points_of(const Mesh& mesh, const std::string& source, const ops::Structure& structure,
                                  const replay::ObjectCells& cells) {
  const PreparedMesh parts = prepared(mesh);
  const MeshCells of_mesh(parts, structure, source);
  std::vector<ops::Point> points(parts.triangles.points.size());
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    points[cells.number(of_mesh.vertex(v))] = parts.triangles.points[v];
  }
  return points;
}

}  // namespace

Status draw_loops(const Mesh& mesh, const std::string& source, const MeshHomology& found, MeshDrawing format,
                  std::ostream& out) {
  const ops::Structure& structure = found.engine->structure();
  const auto cells = replay::ObjectCells::list(structure, std::numeric_limits<std::uint64_t>::max());
  if (!cells) {
    return cells.error();
  }
  replay::Drawing drawing{*cells, points_of(mesh, source, structure, *cells), named_loops(found)};
  const std::uint64_t drawn = format == MeshDrawing::obj   ? 0
                              : format == MeshDrawing::ply ? cells->of(1).size()
                                                           : cells->size();
  if (drawn > 0 && drawing.generators.size() > most_numbers / drawn) {
    return Error{
        Errc::refused,
        fmt::format("{} loops with a number for each of {} cells are too much for a file; leave out long ones by "
                    "--shorter-than, or take --obj or --csv",
                    drawing.generators.size(), drawn)};
  }
  const auto write = format == MeshDrawing::obj   ? replay::write_obj
                     : format == MeshDrawing::ply ? replay::write_ply
                     : format == MeshDrawing::vtk ? replay::write_vtk
                                                  : replay::write_vtu;
  static_cast<void>(write(drawing, out));  // of triangles and lines everything is shown
  return Done{};
}

void write_loop_table(const MeshHomology& found, std::ostream& out) {
  replay::TextBuffer text(out);
  text.add("loop,side,component,order,length,edge,from,to,times,x1,y1,z1,x2,y2,z2\n");
  std::size_t number = 0;
  for (const MeshGenerator& generator : found.generators) {
    if (generator.degree != 1) {
      continue;
    }
    const std::string head = fmt::format("{},{},{},{},{}", number++, generator.side ? side_name(*generator.side) : "",
                                         generator.part, generator.order.to_string(), to_text(generator.length));
    for (std::size_t k = 0; k < generator.edges.size(); ++k) {
      const CycleEdge& edge = generator.edges[k];
      text.add(head).add(',').add_integer(k).add(',').add_integer(edge.vertices[0]).add(',');
      text.add_integer(edge.vertices[1]).add(',').add(edge.times.to_string());
      for (const Point& point : edge.points) {
        for (const double x : point) {
          text.add(',').add_number(x);
        }
      }
      text.add('\n');
    }
  }
}

}  // namespace sesame::tools

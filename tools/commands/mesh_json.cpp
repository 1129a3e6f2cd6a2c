// The report of a mesh for programs.
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "sesame/version.hpp"
#include "tools/commands/mesh_report.hpp"

namespace sesame::tools {
namespace {

using Json = nlohmann::ordered_json;
using sparse::Integer;

constexpr std::size_t most_meetings_listed = 10;

/// Integers beyond 64 bits are written as strings of digits, as everywhere in sesame's JSON.
Json number(const Integer& n) {
  const auto word = n.to_int64();
  return word ? Json(*word) : Json(n.to_string());
}

Json chain(const engine::CellChain& chain, const ops::Structure& structure) {
  Json out = Json::array();
  for (const auto& [coefficient, cell] : chain.terms) {
    out.push_back(Json::array({number(coefficient.numerator()), structure.name(cell)}));
  }
  return out;
}

/// A number, or its digits in a string where doubles do not reach.
Json number(const Measure& measure) {
  const double value = measure.to_double();
  return measure.value == 0 || std::isnormal(value) ? Json(value) : Json(to_text(measure));
}

Json validity_object(const MeshHomology& found) {
  const Validity& validity = found.validity;
  Json components = Json::array();
  for (std::size_t k = 0; k < validity.components.size(); ++k) {
    const Component& component = validity.components[k];
    const auto genus = component.genus();
    Json& object = components.emplace_back(Json({{"vertices", component.vertices},
                                                 {"edges", component.edges},
                                                 {"faces", component.faces},
                                                 {"euler", component.euler()},
                                                 {"boundary_edges", component.boundary_edges},
                                                 {"boundary_loops", component.boundary_loops},
                                                 {"manifold", component.is_manifold},
                                                 {"orientable", component.is_orientable},
                                                 {"closed", component.is_closed()},
                                                 {"genus", genus ? Json(*genus) : Json(nullptr)}}));
    if (k < found.sorting.size()) {
      const auto& [is_sorted, why_not] = found.sorting[k];
      object["loops_sorted"] = is_sorted;
      object["loops_not_sorted"] = why_not.empty() ? Json(nullptr) : Json(why_not);
    }
  }
  Json remarks = validity.remarks;
  for (const std::string& remark : found.remarks) {
    remarks.push_back(remark);
  }
  Json meetings = Json::array();
  for (const FaceMeeting& meeting : found.meetings.meetings) {
    if (meetings.size() < most_meetings_listed) {
      meetings.push_back({{"faces", meeting.faces}, {"place", meeting.place}, {"crosses", meeting.crosses}});
    }
  }
  return {{"points_in_file", validity.points_in_file},
          {"faces_in_file", validity.faces_in_file},
          {"vertices", validity.vertices},
          {"edges", validity.edges},
          {"faces", validity.faces},
          {"lines", validity.lines},
          {"manifold", validity.is_manifold()},
          {"closed", validity.is_closed()},
          {"orientable", validity.is_orientable()},
          {"consistently_oriented", validity.is_consistently_oriented()},
          {"boundary_edges", validity.boundary_edges},
          {"boundary_loops", validity.boundary_loops},
          {"non_manifold_edges", validity.non_manifold_edges},
          {"non_manifold_vertices", validity.non_manifold_vertices},
          {"self_intersections", found.meetings.meetings.size()},
          {"self_intersections_crossing", found.meetings.crossing()},
          {"self_intersections_complete", found.meetings.is_complete},
          {"first_self_intersections", std::move(meetings)},
          {"degenerate_faces", validity.cleaning.degenerate_faces},
          {"duplicate_faces", validity.cleaning.duplicate_faces},
          {"segments", validity.cleaning.segments},
          {"folded_faces", validity.cleaning.folded_faces},
          {"unused_points", validity.cleaning.unused_points},
          {"components", std::move(components)},
          {"remarks", std::move(remarks)}};
}

/// Of the vertices of a loop.
Json points_of(const MeshGenerator& generator) {
  Json points = Json::array();
  for (const CycleEdge& edge : generator.edges) {
    if (!generator.vertices.empty()) {
      points.push_back(edge.points[0]);
    }
  }
  return points;
}

/// How a cycle runs along edges: from, to and how often.
Json edges_of(const MeshGenerator& generator) {
  Json edges = Json::array();
  for (const CycleEdge& edge : generator.edges) {
    edges.push_back(Json::array({edge.vertices[0], edge.vertices[1], number(edge.times)}));
  }
  return edges;
}

/// Vertices, edges and polygons, as far as there are any: of the engine, whose cells are the triangles, or of the file.
Json cells_of(const MeshHomology& found, bool of_file) {
  if (!of_file) {
    return found.engine->cells();
  }
  Json cells = Json::array();
  for (const std::size_t count : {found.validity.vertices, found.validity.edges, found.validity.faces}) {
    cells.push_back(count);
  }
  while (!cells.empty() && cells.back() == 0) {
    cells.erase(cells.size() - 1);
  }
  return cells;
}

Json generator_object(const MeshGenerator& generator, const ops::Structure& structure) {
  Json out{{"dim", generator.degree}, {"order", number(generator.order)}};
  if (generator.degree < 2) {
    out["vertices"] = generator.vertices;
  }
  if (generator.degree == 1) {
    out["points"] = points_of(generator);
    out["loop"] = generator.side ? Json(side_name(*generator.side)) : Json(nullptr);
    out["component"] = generator.part;
    out["length"] = number(generator.length);
    out["closed"] = !generator.vertices.empty();
    out["short"] = generator.is_short;
    out["edges"] = edges_of(generator);
  }
  if (generator.degree == 2) {
    out["triangles"] = generator.triangles;
    for (const auto& [face, times] : generator.faces) {
      out["faces"].push_back(Json::array({face, number(times)}));
    }
    out["area"] = number(generator.area);
    out["volume"] = generator.volume ? number(*generator.volume) : Json(nullptr);
  }
  out["centre"] = generator.centre;
  out["box"] = generator.box;
  out["chain"] = chain(generator.chain, structure);
  if (generator.bounding) {
    out["bounds"] = chain(*generator.bounding, structure);
  }
  return out;
}

}  // namespace

void write_json(std::ostream& out, const MeshHomology& found, const MeshReportOptions& options) {
  engine::Engine& engine = *found.engine;
  Json torsion = Json::array();
  for (const auto& factors : found.homology.torsion) {
    Json& degree = torsion.emplace_back(Json::array());
    for (const Integer& factor : factors) {
      degree.push_back(number(factor));
    }
  }
  Json generators = Json::array();
  for (const MeshGenerator& generator : found.generators) {
    if (options.generators_limit && generators.size() == *options.generators_limit) {
      break;
    }
    generators.push_back(generator_object(generator, engine.structure()));
  }
  const Json object{{"mesh", options.source},
                    {"ring", sparse::ring_name(found.ring)},
                    {"version", SESAME_VERSION},
                    {"validity", validity_object(found)},
                    {"cells", cells_of(found, options.cells)},
                    {"euler", engine.euler_characteristic()},
                    {"betti", found.homology.betti},
                    {"torsion", std::move(torsion)},
                    {"loops_tried", found.loops_tried},
                    {"generators", std::move(generators)},
                    {"shorter_than", options.shorter_than ? Json(*options.shorter_than) : Json(nullptr)},
                    {"loops_left_out", options.loops_left_out},
                    {"seconds", options.seconds}};
  // The path of the mesh may be no UTF-8.
  out << object.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n';
}

}  // namespace sesame::tools

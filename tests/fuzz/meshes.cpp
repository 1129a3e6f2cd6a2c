// Mesh files and lists of facets: what is read keeps what readers promise, and comes to a script that the engine takes.
#include "tools/mesh/mesh.hpp"

#include <cmath>
#include <sstream>

#include "replay/script/facet_list.hpp"
#include "replay/script/script.hpp"
#include "tests/fuzz/engines.hpp"
#include "tools/mesh/normalise.hpp"
#include "tools/mesh/script.hpp"
#include "tools/mesh/triangulate.hpp"
#include "tools/mesh/validity.hpp"
#include "tools/mesh/weld.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

constexpr std::size_t most_corners = 400;  ///< of a mesh that is built by the engine

void demand_sound(const tools::Mesh& mesh) {
  for (const std::uint32_t corner : mesh.faces.corners()) {
    demand(corner < mesh.points.size(), "every corner is the number of a point");
  }
  for (const tools::Edge& line : mesh.lines) {
    demand(line[0] < mesh.points.size() && line[1] < mesh.points.size(), "every end of a line is one");
  }
  for (const tools::Point& point : mesh.points) {
    demand(std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]), "coordinates are finite");
  }
}

/// Takes all steps of a script. Nothing of it may be refused but for limits.
std::string state_after(const std::string& script) {
  replay::ScriptReader reader(replay::ByteSource::of_text(script, "script"));
  const Result<ops::Header> header = reader.header();
  demand(went_well(header), "a script that is written has a header");
  Engine engine(sparse::parse_ring("Z/2").value());
  while (true) {
    const auto next = reader.next();
    if (!next) {
      violation("a script that is written is read: " + next.error().what + "\n" + script);
    }
    if (!*next) {
      break;
    }
    if (const auto report = engine.apply(**next); !report) {
      violation("a script that is written is taken: " + report.error().what + "\n" + script);
    }
  }
  const engine::Homology homology = engine.homology();
  std::string text;
  for (std::size_t p = 0; p < homology.betti.size(); ++p) {
    text += std::to_string(engine.cells()[p]) + " cells, rank " + std::to_string(homology.betti[p]) + "\n";
  }
  return text;
}

/// The two ways to build a mesh, and the counts of what is to come, agree. `expect` lines check the rest.
void build(const tools::Mesh& mesh) {
  std::string states[2];
  for (const bool is_assembled : {false, true}) {
    tools::ScriptOptions options;
    options.source = "mesh";
    options.order = is_assembled ? tools::BuildOrder::breadth_first : tools::BuildOrder::as_given;
    std::ostringstream out;
    const auto written =
        is_assembled ? write_assembled_script(mesh, out, options) : write_complex_script(mesh, out, options);
    if (!went_well(written)) {
      demand(mesh.points.empty(), "every mesh with points has a script");
      return;
    }
    states[is_assembled ? 1 : 0] = state_after(out.str());
  }
  demand_equal(states[0], states[1], "a mesh is the same at once and piece by piece");
}

void look_at(tools::Mesh mesh) {
  demand_sound(mesh);
  const tools::Validity validity = validate(mesh);
  demand(!to_text(validity).empty(), "there is something to say of every mesh");
  if (mesh.faces.corners().size() + 2 * mesh.lines.size() + mesh.points.size() <= most_corners) {
    build(mesh);
  }
  tools::Mesh welded = mesh;
  weld(welded, 0.5);
  demand_sound(welded);
  demand(welded.points.size() <= mesh.points.size(), "welding makes no points");
  normalise(mesh);
  demand_sound(mesh);
  const tools::Validity clean = validate(mesh);
  demand(clean.euler() == validity.euler() && clean.vertices == validity.vertices && clean.faces == validity.faces,
         "what is normal is counted as it is");
  const std::size_t faces = mesh.faces.size();
  const auto origins = triangulate(mesh, tools::Polygons::fan);
  demand_sound(mesh);
  demand(origins.size() == mesh.faces.size() && mesh.faces.size() >= faces, "each triangle is cut from a face");
  demand(validate(mesh).euler() == clean.euler(), "triangles have the Euler characteristic of the polygons");
}

void read_facets(std::string_view text) {
  const auto facets = replay::read_facets(replay::LineSource(replay::ByteSource::of_text(text, "facets"), 4096));
  if (!went_well(facets)) {
    return;
  }
  std::size_t largest = 0;
  for (const replay::Facet& facet : *facets) {
    largest = std::max(largest, facet.labels.size());
  }
  if (largest <= 6 && facets->size() <= 40) {
    const std::string one = state_after(script_of(*facets, "Z/2", "facets", replay::FacetSteps::one));
    demand_equal(one, state_after(script_of(*facets, "Z/2", "facets", replay::FacetSteps::each)),
                 "facets are the same at once and one by one");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes = text_of(data, size);
  using tools::Format;
  for (const Format format : {Format::automatic, Format::off, Format::obj, Format::ply, Format::stl}) {
    tools::ReadOptions options;
    options.format = format;
    Result<tools::Mesh> mesh = tools::parse_mesh(bytes, "mesh", options);
    if (went_well(mesh)) {
      look_at(std::move(*mesh));
    }
  }
  read_facets(bytes);
  return 0;
}

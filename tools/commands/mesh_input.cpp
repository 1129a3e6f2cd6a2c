#include "tools/commands/mesh_input.hpp"

#include <spdlog/logger.h>

#include <charconv>
#include <cmath>
#include <iostream>

#include "replay/script/replay.hpp"
#include "tools/commands/options.hpp"
#include "tools/commands/program_log.hpp"

namespace sesame::tools {

std::string name_of(const MeshInput& input) { return input.file == "-" ? "standard input" : input.file; }

void add_mesh_input(CLI::App& command, MeshInput& input, bool takes_facets) {
  command
      .add_option(
          "MESH", input.file,
          std::string{"The mesh file (OFF, OBJ, PLY, STL)"} +
              (takes_facets ? ", list of facets, CGAL's map file (.3map), or mesh of solids (MEDIT .mesh, VTK)" : "") +
              ", gzip or not; - for standard input")
      ->required();
  Choices<Format> formats{{"auto", Format::automatic},
                          {"off", Format::off},
                          {"obj", Format::obj},
                          {"ply", Format::ply},
                          {"stl", Format::stl}};
  if (takes_facets) {
    formats.insert(formats.end(),
                   {{"facets", Format::facets}, {"map", Format::map}, {"medit", Format::medit}, {"vtk", Format::vtk}});
  }
  add_choice<Format>(command, "--format", input.format, formats,
                     "What the file is; default: by extension, else by content");
  command.add_option("--weld", input.weld, "Make one of points within this distance (STL: equal points always are)");
}

Result<Mesh> read(const MeshInput& input) {
  ReadOptions reading{input.format, {}};
  if (!input.weld.empty()) {
    double distance = 0;
    const char* const end = input.weld.data() + input.weld.size();
    const auto [stop, failed] = std::from_chars(input.weld.data(), end, distance);
    if (failed != std::errc{} || stop != end || !std::isfinite(distance) || distance < 0) {
      return Error{Errc::io, "--weld: \"" + input.weld + "\" should be a distance, a number from 0 on"};
    }
    reading.weld = distance;
  }
  Result<Mesh> mesh = read_mesh(input.file, reading);
  if (mesh) {
    tools_log().info("{}: a mesh of {} points and {} faces", name_of(input), mesh->points.size(), mesh->faces.size());
  }
  return mesh;
}

int refuse(const Error& error) {
  std::cerr << error.what << '\n';
  return static_cast<int>(replay::outcome_of(error.code));
}

}  // namespace sesame::tools

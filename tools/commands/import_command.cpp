#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>

#include "replay/script/facet_list.hpp"
#include "replay/script/replay.hpp"
#include "replay/tower/tower_format.hpp"
#include "sparse/ring.hpp"
#include "tools/commands/commands.hpp"
#include "tools/commands/mesh_input.hpp"
#include "tools/commands/options.hpp"
#include "tools/commands/output_file.hpp"
#include "tools/mesh/map_script.hpp"
#include "tools/mesh/script.hpp"
#include "tools/mesh/text.hpp"

namespace sesame::tools {
namespace {

using replay::Outcome;

struct Arguments {
  MeshInput mesh;
  std::string out = "-";
  std::string ring = "Z";
  Polygons polygons = Polygons::fan;
  BuildOrder order = BuildOrder::breadth_first;
  bool assemble = false;
  bool cells = false;
  bool quiet = false;
};

int fail(const std::string& what, Outcome outcome) {
  std::cerr << what << '\n';
  return static_cast<int>(outcome);
}

/// Said, or found out from the content of a file, which can be read twice.
bool is_facet_list(const MeshInput& input) {
  std::error_code unknown;
  if (input.format != Format::automatic || format_of_extension(input.file) != Format::automatic ||
      !std::filesystem::is_regular_file(input.file, unknown)) {
    return input.format == Format::facets;
  }
  Result<replay::ByteSource> source = replay::ByteSource::open(input.file);
  const auto format = source ? replay::find_format(*source) : source.error();
  return format && *format == replay::TowerFormat::facets;  // else the readers of meshes say what is wrong
}

/// Calls `write` with the output, which takes its place when that returns 0. Returns the exit status.
int write_script(const Arguments& arguments, const std::function<int(std::ostream&)>& write) {
  OutputFiles outputs({arguments.mesh.file});
  const Result<std::ostream*> opened = outputs.open(arguments.out);
  if (!opened) {
    return fail("sesame import: " + opened.error().what, Outcome::wrong_usage);
  }
  if (const int status = write(**opened); status != 0) {
    return status;
  }
  const Status written = outputs.commit();
  return written ? 0 : fail("sesame import: " + written.error().what, Outcome::wrong_usage);
}

/// One insertion of all facets, or one for each.
int import_facets(const Arguments& arguments) {
  const std::string name = name_of(arguments.mesh);
  if (!arguments.mesh.weld.empty()) {
    return fail("sesame import: --weld is for meshes, and " + name + " is a list of facets", Outcome::wrong_usage);
  }
  Result<replay::ByteSource> source = replay::ByteSource::open(arguments.mesh.file);
  if (!source) {
    return refuse(source.error());
  }
  Result<std::vector<replay::Facet>> facets = replay::read_facets(replay::LineSource(std::move(*source)));
  if (!facets) {
    return refuse(facets.error());
  }
  const std::size_t count = facets->size();
  const int status = write_script(arguments, [&](std::ostream& out) {
    out << replay::script_of(*facets, arguments.ring, name,
                             arguments.assemble ? replay::FacetSteps::each : replay::FacetSteps::one);
    return 0;
  });
  if (status == 0 && !arguments.quiet) {
    std::cerr << name << ": read as a list of facets: " << counted(count, "facet", "facets") << "; "
              << counted(arguments.assemble ? count : 1, "step", "steps") << '\n';
  }
  return status;
}

int run_import(const Arguments& arguments) {
  if (const Result<sparse::AnyRing> ring = sparse::parse_ring(arguments.ring); !ring) {
    return fail("sesame import: --ring: " + ring.error().what, Outcome::wrong_usage);
  }
  if (is_facet_list(arguments.mesh)) {
    if (arguments.cells) {
      return fail("sesame import: --cells is for meshes, and " + name_of(arguments.mesh) + " is a list of facets",
                  Outcome::wrong_usage);
    }
    return import_facets(arguments);
  }
  const Result<Mesh> mesh = read(arguments.mesh);
  if (!mesh) {
    return refuse(mesh.error());
  }
  const std::string name = name_of(arguments.mesh);
  const ScriptOptions options{name, arguments.ring, arguments.polygons, arguments.order, true};
  ScriptSummary summary;
  const int status = write_script(arguments, [&](std::ostream& out) {
    Result<ScriptSummary> made = arguments.cells      ? write_map_script(*mesh, out, options)
                                 : arguments.assemble ? write_assembled_script(*mesh, out, options)
                                                      : write_complex_script(*mesh, out, options);
    if (!made) {
      return fail(name + ": " + made.error().what, Outcome::wrong_script);
    }
    summary = std::move(*made);
    return 0;
  });
  if (status == 0 && !arguments.quiet) {
    for (const std::string& remark : summary.remarks) {
      std::cerr << name << ": " << remark << '\n';
    }
    std::cerr << name << ": " << counted(summary.vertices, "vertex", "vertices") << ", "
              << counted(summary.edges, "edge", "edges") << ", "
              << (arguments.cells ? counted(summary.triangles, "polygon", "polygons")
                                  : counted(summary.triangles, "triangle", "triangles"))
              << "; " << counted(summary.steps, "step", "steps") << '\n';
  }
  return status;
}

}  // namespace

void add_import_command(CLI::App& app, int& status) {
  CLI::App* command =
      app.add_subcommand("import", "Make a construction script from a mesh (OFF, OBJ, PLY, STL) or a list of facets");
  auto arguments = std::make_shared<Arguments>();
  add_mesh_input(*command, arguments->mesh, true);
  command->add_option("-o,--output", arguments->out, "The script; default: standard output")->capture_default_str();
  command->add_flag(
      "--assemble", arguments->assemble,
      "One simplex per triangle, each glued to what is there, or one insertion per facet, instead of one step");
  command
      ->add_flag("--cells", arguments->cells, "One map, whose faces are the polygons as they are, instead of triangles")
      ->excludes("--assemble");
  command->add_option("--ring", arguments->ring, "The ring named in the script")->capture_default_str();
  add_choice<Polygons>(
      *command, "--polygons", arguments->polygons, {{"fan", Polygons::fan}, {"cone", Polygons::cone}},
      "Cut polygons of more than 3 corners as a fan from one corner (default), or as a cone over their boundary from a "
      "new point in the middle");
  add_choice<BuildOrder>(
      *command, "--order", arguments->order, {{"connected", BuildOrder::breadth_first}, {"file", BuildOrder::as_given}},
      "Build breadth first, so that what is built stays connected (default), or as the file lists faces");
  command->add_flag("--quiet", arguments->quiet, "No remarks on standard error");
  command->footer("Exit status: 0 done, 1 wrong usage or unreadable file, 2 the mesh or list is wrong.");
  command->callback([arguments, &status] { status = run_import(*arguments); });
}

}  // namespace sesame::tools

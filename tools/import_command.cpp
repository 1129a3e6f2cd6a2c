#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>

#include "replay/replay.hpp"
#include "sparse/ring.hpp"
#include "tools/commands.hpp"
#include "tools/mesh/mesh.hpp"
#include "tools/mesh/script.hpp"

namespace sesame::tools {
namespace {

using replay::Outcome;

struct Arguments {
  std::string mesh;
  std::string out = "-";
  std::string ring = "Z";
  Format format = Format::automatic;
  Polygons polygons = Polygons::fan;
  BuildOrder order = BuildOrder::breadth_first;
  double weld = -1;
  bool assemble = false;
  bool quiet = false;
};

int fail(const std::string& what, Outcome outcome) {
  std::cerr << what << '\n';
  return static_cast<int>(outcome);
}

int run_import(const Arguments& arguments) {
  if (const Result<sparse::AnyRing> ring = sparse::parse_ring(arguments.ring); !ring) {
    return fail("sesame import: --ring: " + ring.error().what, Outcome::wrong_usage);
  }
  ReadOptions reading{arguments.format, {}};
  if (arguments.weld >= 0) {
    reading.weld = arguments.weld;
  }
  const Result<Mesh> mesh = read_mesh(arguments.mesh, reading);
  if (!mesh) {
    return fail(mesh.error().what, mesh.error().code == Errc::io ? Outcome::wrong_usage : Outcome::wrong_script);
  }
  std::ofstream file;
  if (arguments.out != "-") {
    if (is_same_file(arguments.mesh, arguments.out)) {
      return fail("sesame import: -o would write over the mesh; give it another file", Outcome::wrong_usage);
    }
    file.open(arguments.out, std::ios::trunc);
    if (!file) {
      return fail("sesame import: cannot write " + arguments.out, Outcome::wrong_usage);
    }
  }
  std::ostream& out = arguments.out == "-" ? std::cout : file;
  const ScriptOptions options{arguments.mesh, arguments.ring, arguments.polygons, arguments.order, true};
  const Result<ScriptSummary> summary =
      arguments.assemble ? write_assembled_script(*mesh, out, options) : write_complex_script(*mesh, out, options);
  if (!summary) {
    return fail(arguments.mesh + ": " + summary.error().what,
                summary.error().code == Errc::io ? Outcome::wrong_usage : Outcome::wrong_script);
  }
  out << std::flush;
  if (!out) {
    return fail("sesame import: cannot write " + arguments.out, Outcome::wrong_usage);
  }
  if (!arguments.quiet) {
    for (const std::string& remark : summary->remarks) {
      std::cerr << arguments.mesh << ": " << remark << '\n';
    }
    std::cerr << arguments.mesh << ": " << summary->vertices << " vertices, " << summary->edges << " edges, "
              << summary->triangles << " triangles; " << summary->steps << " steps\n";
  }
  return 0;
}

}  // namespace

bool is_same_file(const std::string& one, const std::string& other) {
  std::error_code missing;
  return std::filesystem::equivalent(one, other, missing);
}

void add_import_command(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("import", "Make a construction script from a mesh (OFF, OBJ, PLY, STL)");
  auto arguments = std::make_shared<Arguments>();
  command->add_option("MESH", arguments->mesh, "The mesh file")->required();
  command->add_option("-o,--output", arguments->out, "The script; default: standard output")->capture_default_str();
  command->add_flag("--assemble", arguments->assemble,
                    "One simplex per triangle, each glued to what is there, instead of one complex");
  command->add_option("--ring", arguments->ring, "The ring named in the script")->capture_default_str();
  command->add_option("--format", arguments->format, "The mesh format; default: by extension, else by content")
      ->transform(CLI::CheckedTransformer(std::map<std::string, Format>{{"auto", Format::automatic},
                                                                        {"off", Format::off},
                                                                        {"obj", Format::obj},
                                                                        {"ply", Format::ply},
                                                                        {"stl", Format::stl}}));
  command
      ->add_option("--polygons", arguments->polygons,
                   "Cut polygons of more than 3 corners as a fan from one corner (default), or as a cone over their "
                   "boundary from a new point in the middle")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, Polygons>{{"fan", Polygons::fan}, {"cone", Polygons::cone}}));
  command
      ->add_option("--order", arguments->order,
                   "Build breadth first, so that what is built stays connected (default), or as the file lists faces")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, BuildOrder>{{"connected", BuildOrder::breadth_first}, {"file", BuildOrder::as_given}}));
  command
      ->add_option("--weld", arguments->weld,
                   "Make one of points within this distance (STL: equal points are always welded)")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--quiet", arguments->quiet, "No remarks on standard error");
  command->footer("Exit status: 0 done, 1 wrong usage or unreadable file, 2 the mesh is wrong.");
  command->callback([arguments, &status] { status = run_import(*arguments); });
}

}  // namespace sesame::tools

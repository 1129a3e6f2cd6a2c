#include <chrono>
#include <iostream>
#include <memory>
#include <optional>

#include "replay/script/replay.hpp"
#include "sparse/ring.hpp"
#include "tools/commands/commands.hpp"
#include "tools/commands/mesh_drawing.hpp"
#include "tools/commands/mesh_input.hpp"
#include "tools/commands/mesh_page.hpp"
#include "tools/commands/mesh_report.hpp"
#include "tools/commands/options.hpp"
#include "tools/commands/output_file.hpp"

namespace sesame::tools {
namespace {

using replay::Outcome;

/// An output, and what goes there.
struct LoopFile {
  std::string path;
  std::ostream* out = nullptr;
};

struct Arguments {
  MeshInput mesh;
  LoopFile obj, ply, vtk, csv, html;
  std::optional<double> shorter_than;
  std::string ring = "Z";
  std::optional<std::size_t> generators_limit;
  bool json = false;
  bool cells = false;
};

int fail(const std::string& what, Outcome outcome) {
  std::cerr << what << '\n';
  return static_cast<int>(outcome);
}

/// Opens the files. Errors: those of OutputFiles; one would go where the report goes.
Status open_files(Arguments& arguments, OutputFiles& outputs) {
  for (LoopFile* file : {&arguments.obj, &arguments.ply, &arguments.vtk, &arguments.csv, &arguments.html}) {
    if (is_standard_output(file->path)) {
      return Error{Errc::io,
                   "sesame mesh: the report goes to standard output; --obj, --ply, --vtk, --csv and --html "
                   "should name files"};
    }
    const Result<std::ostream*> out = outputs.open(file->path);
    if (!out) {
      return out.error();
    }
    file->out = *out;
  }
  return Done{};
}

Status write_files(const Arguments& arguments, const Mesh& mesh, const MeshHomology& found, OutputFiles& outputs) {
  const MeshDrawing grid = arguments.vtk.path.ends_with(".vtu") ? MeshDrawing::vtu : MeshDrawing::vtk;
  const std::string name = name_of(arguments.mesh);
  for (const auto& [file, format] :
       {std::pair{&arguments.obj, MeshDrawing::obj}, {&arguments.ply, MeshDrawing::ply}, {&arguments.vtk, grid}}) {
    if (file->out == nullptr) {
      continue;
    }
    if (const Status drawn = draw_loops(mesh, name, found, format, *file->out); !drawn) {
      return drawn;
    }
  }
  if (arguments.csv.out != nullptr) {
    write_loop_table(found, *arguments.csv.out);
  }
  return outputs.commit();
}

/// Leaves out the loops that are not shorter than a length, and returns how many these were.
std::size_t leave_out_long_loops(MeshHomology& found, double length) {
  return std::erase_if(found.generators, [length](const MeshGenerator& generator) {
    return generator.degree == 1 && !is_less(generator.length, {length, 0});
  });
}

int run_mesh(Arguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const Result<sparse::AnyRing> ring = sparse::parse_ring(arguments.ring);
  if (!ring) {
    return fail("sesame mesh: --ring: " + ring.error().what, Outcome::wrong_usage);
  }
  OutputFiles outputs({arguments.mesh.file});
  if (const Status opened = open_files(arguments, outputs); !opened) {
    return refuse(opened.error());
  }
  const Result<Mesh> mesh = read(arguments.mesh);
  if (!mesh) {
    return refuse(mesh.error());
  }
  const std::string name = name_of(arguments.mesh);
  auto found = mesh_homology(*mesh, {name, *ring, arguments.generators_limit != std::size_t{0}, arguments.cells});
  if (!found) {
    return refuse(found.error());
  }
  if (const std::string left_out = found->validity.left_out_faces(); !left_out.empty()) {
    std::cerr << name << ": " << left_out << '\n';
  }
  if (arguments.html.out != nullptr) {
    const bool has_generators = arguments.generators_limit != std::size_t{0};
    write_mesh_page(*arguments.html.out, *mesh, *found, {name, has_generators, arguments.shorter_than, {}});
  }
  const std::size_t left_out = arguments.shorter_than ? leave_out_long_loops(*found, *arguments.shorter_than) : 0;
  if (const Status written = write_files(arguments, *mesh, *found, outputs); !written) {
    return refuse(written.error());
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  const auto write = arguments.json ? write_json : write_text;
  write(std::cout, *found,
        {name, arguments.generators_limit, arguments.shorter_than, left_out, took.count(), arguments.cells});
  return 0;
}

}  // namespace

void add_mesh_command(CLI::App& app, int& status) {
  CLI::App* command =
      app.add_subcommand("mesh", "Where are the tunnels? Validity, homology and short generators of a mesh");
  auto arguments = std::make_shared<Arguments>();
  add_mesh_input(*command, arguments->mesh);
  command->add_flag("--json", arguments->json, "One JSON object on standard output");
  command->add_flag(
      "--cells", arguments->cells,
      "Count and list cells as the file has them, polygons, and not the triangles that they are cut into");
  command->add_option("--ring", arguments->ring, "Compute over Z, Q or Z/p")->capture_default_str();
  command
      ->add_option("--generators-limit", arguments->generators_limit,
                   "How many generators to list: of each group (default 20), or in all with --json (default: all); 0 "
                   "saves looking for them")
      ->check(from_zero_on());
  command
      ->add_option("--shorter-than", arguments->shorter_than,
                   "List only loops shorter than this, in units of the file, and say how many are left out")
      ->check(above_zero());
  command->add_option("--obj", arguments->obj.path, "Write the mesh with its loops as groups of lines (OBJ)");
  command->add_option("--ply", arguments->ply.path, "Write the mesh with its loops as properties of edges (PLY)");
  command->add_option("--vtk", arguments->vtk.path,
                      "Write the mesh with its loops as data of cells (VTK; .vtu: as XML)");
  command->add_option("--csv", arguments->csv.path,
                      "Write the loops as a table, a row for each edge, with coordinates");
  command->add_option("--html", arguments->html.path,
                      "Write the mesh as a page for a browser: in space, with what is wrong with it, and its loops");
  command->footer(
      "A loop on a closed surface in space is a handle loop when it bounds inside, a tunnel loop when it bounds "
      "outside.\n"
      "Chains in the JSON name cells as `sesame import` does, so that `class` and other steps can be appended there.\n"
      "Exit status: 0 done, 1 wrong usage or unreadable file, 2 the mesh is wrong.");
  command->callback([arguments, &status] { status = run_mesh(*arguments); });
}

}  // namespace sesame::tools

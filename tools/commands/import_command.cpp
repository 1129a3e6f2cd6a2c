#include <array>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <string_view>

#include "replay/script/facet_list.hpp"
#include "replay/script/replay.hpp"
#include "replay/tower/tower_format.hpp"
#include "sparse/ring.hpp"
#include "tools/commands/commands.hpp"
#include "tools/commands/mesh_input.hpp"
#include "tools/commands/options.hpp"
#include "tools/commands/output_file.hpp"
#include "tools/mesh/map_file.hpp"
#include "tools/mesh/map_script.hpp"
#include "tools/mesh/script.hpp"
#include "tools/mesh/solids.hpp"
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
  bool simplices = false;
  std::optional<int> dimension;  ///< of a map file
  bool quiet = false;
};

int fail(const std::string& what, Outcome outcome) {
  std::cerr << what << '\n';
  return static_cast<int>(outcome);
}

/// Said, by the name, or found out from the content of a file, which can be read twice. Automatic where the readers of
/// meshes say what is wrong.
Format format_of(const MeshInput& input) {
  if (input.format != Format::automatic) {
    return input.format;
  }
  std::error_code unknown;
  const Format by_name = format_of_extension(input.file);
  if (by_name != Format::automatic || !std::filesystem::is_regular_file(input.file, unknown)) {
    return by_name;
  }
  Result<replay::ByteSource> source = replay::ByteSource::open(input.file);
  if (!source || !source->more()) {
    return Format::automatic;
  }
  const Format by_content = format_of_content(source->window());
  if (by_content == Format::map || by_content == Format::medit || by_content == Format::vtk) {
    return by_content;
  }
  const auto format = replay::find_format(*source);
  return format && *format == replay::TowerFormat::facets ? Format::facets : Format::automatic;
}

/// Which options do not belong to a format, or an empty text.
std::string objection(const Arguments& arguments, Format format) {
  const std::string name = name_of(arguments.mesh);
  const bool is_solid = format == Format::medit || format == Format::vtk;
  const bool is_mesh = format != Format::facets && format != Format::map;
  if (!is_mesh && arguments.cells) {
    return "--cells is for meshes, and " + name + (format == Format::map ? " is a map file" : " is a list of facets");
  }
  if (format != Format::map && (arguments.simplices || arguments.dimension)) {
    return "--simplices and --dim are for map files, and " + name + " is none";
  }
  if (format == Format::map && arguments.assemble) {
    return "--assemble is for meshes and lists of facets, and " + name + " is a map file";
  }
  if (is_solid && !arguments.cells) {
    return name + " is a mesh of solids, which are taken as cells: say --cells";
  }
  if ((is_solid || !is_mesh) && !arguments.mesh.weld.empty()) {
    return "--weld is for meshes of polygons, and " + name + " is none";
  }
  return {};
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

/// "8 vertices, 12 edges, 6 faces".
std::string counts(const std::vector<std::size_t>& cells) {
  static constexpr std::array<std::array<std::string_view, 2>, 4> words{
      {{"vertex", "vertices"}, {"edge", "edges"}, {"face", "faces"}, {"volume", "volumes"}}};
  std::string text;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    text += i == 0 ? "" : ", ";
    text += i < words.size() ? counted(cells[i], words[i][0], words[i][1])
                             : counted(cells[i], std::to_string(i) + "-cell", std::to_string(i) + "-cells");
  }
  return text;
}

/// Writes the script that `write` makes of a whole file, and says what it has: remarks, then a line.
int import_file(const Arguments& arguments,
                const std::function<Result<std::vector<std::string>>(const std::string& bytes, std::ostream&)>& write) {
  const Result<std::string> bytes = replay::read_file(arguments.mesh.file);
  if (!bytes) {
    return refuse(bytes.error());
  }
  std::vector<std::string> said;
  const int status = write_script(arguments, [&](std::ostream& out) {
    Result<std::vector<std::string>> written = write(*bytes, out);
    if (!written) {
      return refuse(written.error());
    }
    said = std::move(*written);
    return 0;
  });
  for (std::size_t k = 0; status == 0 && !arguments.quiet && k < said.size(); ++k) {
    std::cerr << name_of(arguments.mesh) << ": " << said[k] << '\n';
  }
  return status;
}

/// One map, as the file has it.
int import_map(const Arguments& arguments) {
  const std::string name = name_of(arguments.mesh);
  return import_file(arguments, [&](const std::string& bytes, std::ostream& out) -> Result<std::vector<std::string>> {
    const std::optional<int> by_name = map_dimension_of_extension(name);
    const Result<MapFile> file = parse_map_file(bytes, name, arguments.dimension ? arguments.dimension : by_name);
    if (!file) {
      return file.error();
    }
    Result<MapScriptSummary> summary =
        write_script_of_map_file(*file, out, {name, arguments.ring, arguments.simplices});
    if (!summary) {
      return summary.error();
    }
    summary->remarks.push_back(counted(summary->darts, "dart", "darts") + ": " + counts(summary->cells));
    return std::move(summary->remarks);
  });
}

/// One map, of all solids.
int import_solids(const Arguments& arguments, Format format) {
  const std::string name = name_of(arguments.mesh);
  return import_file(arguments, [&](const std::string& bytes, std::ostream& out) -> Result<std::vector<std::string>> {
    const Result<Solids> solids = parse_solids(bytes, name, format);
    if (!solids) {
      return solids.error();
    }
    Result<SolidSummary> summary = write_solid_script(*solids, out, {name, arguments.ring});
    if (!summary) {
      return summary.error();
    }
    summary->remarks.push_back(counts(summary->cells));
    return std::move(summary->remarks);
  });
}

int run_import(const Arguments& arguments) {
  if (const Result<sparse::AnyRing> ring = sparse::parse_ring(arguments.ring); !ring) {
    return fail("sesame import: --ring: " + ring.error().what, Outcome::wrong_usage);
  }
  const Format format = format_of(arguments.mesh);
  if (const std::string objected = objection(arguments, format); !objected.empty()) {
    return fail("sesame import: " + objected, Outcome::wrong_usage);
  }
  if (format == Format::facets) {
    return import_facets(arguments);
  }
  if (format == Format::map) {
    return import_map(arguments);
  }
  if (format == Format::medit || format == Format::vtk) {
    return import_solids(arguments, format);
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
      app.add_subcommand("import", "Make a construction script from a mesh, a list of facets or a map file");
  auto arguments = std::make_shared<Arguments>();
  add_mesh_input(*command, arguments->mesh, true);
  command->add_option("-o,--output", arguments->out, "The script; default: standard output")->capture_default_str();
  command->add_flag(
      "--assemble", arguments->assemble,
      "One simplex per triangle, each glued to what is there, or one insertion per facet, instead of one step");
  command
      ->add_flag("--cells", arguments->cells,
                 "One map, whose cells are the polygons or solids as they are, instead of triangles")
      ->excludes("--assemble");
  command->add_flag("--simplices", arguments->simplices,
                    "Of a map file: by the simplices of its subdivision, for cells that are no balls");
  command
      ->add_option("--dim", arguments->dimension,
                   "Of a map file: the dimension of the map; default: that of its name (.3map), or the largest index")
      ->check(from_zero_on());
  command->add_option("--ring", arguments->ring, "The ring named in the script")->capture_default_str();
  add_choice<Polygons>(
      *command, "--polygons", arguments->polygons, {{"fan", Polygons::fan}, {"cone", Polygons::cone}},
      "Cut polygons of more than 3 corners as a fan from one corner (default), or as a cone over their boundary from a "
      "new point in the middle");
  add_choice<BuildOrder>(
      *command, "--order", arguments->order, {{"connected", BuildOrder::breadth_first}, {"file", BuildOrder::as_given}},
      "Build breadth first, so that what is built stays connected (default), or as the file lists faces");
  command->add_flag("--quiet", arguments->quiet, "No remarks on standard error");
  command->footer("Exit status: 0 done, 1 wrong usage or unreadable file, 2 the mesh, list or map is wrong.");
  command->callback([arguments, &status] { status = run_import(*arguments); });
}

}  // namespace sesame::tools

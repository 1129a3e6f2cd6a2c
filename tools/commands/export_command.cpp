#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

#include "replay/export/boundary_matrices.hpp"
#include "replay/export/drawing.hpp"
#include "replay/export/facets.hpp"
#include "replay/export/map_file.hpp"
#include "replay/export/object_cells.hpp"
#include "replay/export/plain_script.hpp"
#include "replay/export/positions.hpp"
#include "replay/script/replay.hpp"
#include "tools/commands/commands.hpp"
#include "tools/commands/interrupt.hpp"
#include "tools/commands/options.hpp"
#include "tools/commands/output_file.hpp"

namespace sesame::tools {
namespace {

using replay::ObjectCells;
using replay::Outcome;

enum class ExportFormat { script, phat, phat_binary, matrix_market, vtk, vtu, obj, ply, facets, map, general_map };

struct Arguments {
  std::unique_ptr<engine::Engine> engine;  ///< of the replay, once there is one: as long as the command
  std::string file;
  std::string out = "-";
  std::string ring;
  ExportFormat format = ExportFormat::script;
  std::optional<std::uint64_t> until;
  std::optional<std::size_t> dimension;  ///< of a boundary matrix
  std::optional<replay::GeneratorOptions> generators;
  std::uint64_t most_cells = 5'000'000;
  std::size_t longest_line = replay::longest_line;
  bool without_undone = false;
  bool quiet = false;

  [[nodiscard]] bool is_grid() const { return format == ExportFormat::vtk || format == ExportFormat::vtu; }
  [[nodiscard]] bool is_surface() const { return format == ExportFormat::obj || format == ExportFormat::ply; }
  [[nodiscard]] bool is_drawing() const { return is_grid() || is_surface(); }
  [[nodiscard]] bool is_map() const { return format == ExportFormat::map || format == ExportFormat::general_map; }
  /// Whether there is a file for each dimension.
  [[nodiscard]] bool is_series() const { return format == ExportFormat::matrix_market && !dimension; }
};

int fail(const std::string& what, Outcome outcome) {
  std::cerr << "sesame export: " << what << '\n';
  return static_cast<int>(outcome);
}

int refuse(const Error& error) { return fail(error.what, replay::outcome_of(error.code)); }

/// What is wrong with the options for this format, or an empty text.
std::string objection(const Arguments& arguments) {
  const bool is_script = arguments.format == ExportFormat::script;
  if (arguments.out.empty()) {
    return "-o should be the name of a file, or - for standard output";
  }
  if (arguments.without_undone && !is_script) {
    return "--without-undone is for --format script; other formats have nothing that was undone";
  }
  if (!arguments.ring.empty() && is_script) {
    return "--ring is for formats for which the script is replayed; --format script keeps its header";
  }
  if (arguments.dimension && arguments.format != ExportFormat::matrix_market) {
    return "--dim is for --format matrix-market";
  }
  if (arguments.is_series() && is_standard_output(arguments.out)) {
    return "--format matrix-market makes a file for each dimension; give -o PREFIX for PREFIX.1.mtx and so on, or "
           "--dim";
  }
  if (!arguments.generators) {
    return {};
  }
  if (!arguments.is_drawing()) {
    return "--generators is for --format vtk, vtu, obj and ply";
  }
  const auto& degrees = arguments.generators->degrees;
  const bool is_of_loops = std::all_of(degrees.begin(), degrees.end(), [](const auto& range) {
    return range == std::pair{1, 1};
  });
  return is_of_loops || arguments.is_grid() ? "" : "--format obj and ply show the generators of dimension 1 only";
}

Result<replay::ScriptReader> open_script(const Arguments& arguments) {
  Result<replay::ByteSource> source = replay::ByteSource::open(arguments.file, {&stop_requested()});
  if (!source) {
    return source.error();
  }
  return replay::ScriptReader{std::move(*source), arguments.longest_line};
}

/// Replays the script and keeps the positions that it gives.
Outcome build(Arguments& arguments, replay::ScriptReader& script, replay::Positions& positions) {
  replay::ReplayOptions options;
  if (!arguments.ring.empty()) {
    options.ring = sparse::parse_ring(arguments.ring).value();
  }
  options.until = arguments.until;
  options.engine = &arguments.engine;
  options.stop = &stop_requested();
  options.notes = arguments.quiet ? nullptr : &std::cerr;
  if (arguments.is_drawing() || arguments.is_map()) {
    options.observer = [&](const ops::Operation& operation, const engine::StepReport& report) {
      positions.take(operation, report, arguments.engine->structure());
    };
  }
  std::unique_ptr<replay::Progress> progress;
  if (!arguments.quiet && isatty(STDERR_FILENO) == 1) {
    progress = std::make_unique<replay::Progress>(std::cerr, arguments.until);
  }
  return replay::replay(script, options, nullptr, std::cerr, progress.get());
}

/// The generators that are drawn: of a grid all, if nothing is said; of surfaces loops, and only when asked for.
Result<std::vector<replay::NamedGenerator>> generators_of(Arguments& arguments, const ObjectCells& cells) {
  replay::GeneratorOptions options = arguments.generators.value_or(replay::GeneratorOptions{});
  if (!arguments.is_grid() && !arguments.generators) {
    return std::vector<replay::NamedGenerator>{};
  }
  if (arguments.is_surface()) {
    options.degrees = {{1, 1}};
  }
  std::uint64_t cells_drawn = arguments.format == ExportFormat::ply ? cells.of(1).size() : 0;
  for (std::size_t dimension = 0; arguments.is_grid() && dimension <= 3; ++dimension) {
    cells_drawn += cells.of(dimension).size();
  }
  return replay::named_generators(*arguments.engine, options, 3, cells_drawn, &stop_requested());
}

void say(const Arguments& arguments, replay::Remarks remarks, std::uint64_t torn) {
  if (torn > 0) {
    remarks.push_back(std::to_string(torn) +
                      " vertices that were glued from several places are shown where the oldest was");
  }
  for (const std::string& remark : remarks) {
    if (!arguments.quiet) {
      std::cerr << "sesame export: " << remark << '\n';
    }
  }
}

Status draw(Arguments& arguments, const replay::Positions& positions, const ObjectCells& cells, std::ostream& out) {
  Result<replay::Positions::Points> points = positions.of_vertices(cells);
  if (!points) {
    return points.error();
  }
  Result<std::vector<replay::NamedGenerator>> generators = generators_of(arguments, cells);
  if (!generators) {
    return generators.error();
  }
  const replay::Drawing drawing{cells, std::move(points->points), std::move(*generators)};
  replay::Remarks remarks = arguments.format == ExportFormat::vtk   ? write_vtk(drawing, out)
                            : arguments.format == ExportFormat::vtu ? write_vtu(drawing, out)
                            : arguments.format == ExportFormat::obj ? write_obj(drawing, out)
                                                                    : write_ply(drawing, out);
  say(arguments, std::move(remarks), points->torn);
  return Done{};
}

Status write_map(const Arguments& arguments, const replay::Positions& positions, const ObjectCells& cells,
                 std::ostream& out) {
  const auto [points, torn] = positions.known(cells);
  Result<replay::Remarks> remarks = write_map_file(
      cells, points,
      arguments.format == ExportFormat::map ? replay::MapFileKind::combinatorial : replay::MapFileKind::generalized,
      out);
  if (!remarks) {
    return remarks.error();
  }
  say(arguments, std::move(*remarks), torn);
  return Done{};
}

/// Of the object, in one file.
Status write_object(Arguments& arguments, const replay::Positions& positions, const ObjectCells& cells,
                    std::ostream& out) {
  switch (arguments.format) {
    case ExportFormat::phat:
      write_phat(cells, out);
      return Done{};
    case ExportFormat::phat_binary:
      write_phat_binary(cells, out);
      return Done{};
    case ExportFormat::matrix_market:
      write_matrix_market(cells, *arguments.dimension, out);
      return Done{};
    case ExportFormat::facets:
      return write_facets(cells, out);
    case ExportFormat::map:
    case ExportFormat::general_map:
      return write_map(arguments, positions, cells, out);
    default:
      return draw(arguments, positions, cells, out);
  }
}

/// The largest dimension of a boundary matrix: 1 of points alone, whose number is that of its rows.
std::size_t last_matrix(const ObjectCells& cells) { return std::max(cells.dimensions(), std::size_t{2}) - 1; }

Status write_series(const Arguments& arguments, const ObjectCells& cells, OutputFiles& outputs) {
  for (std::size_t dimension = 1; dimension <= last_matrix(cells); ++dimension) {
    const Result<std::ostream*> out = outputs.open(arguments.out + "." + std::to_string(dimension) + ".mtx");
    if (!out) {
      return out.error();
    }
    write_matrix_market(cells, dimension, **out);
  }
  return Done{};
}

Status export_object(Arguments& arguments, const replay::Positions& positions, OutputFiles& outputs,
                     std::ostream* out) {
  const Result<ObjectCells> cells = ObjectCells::list(arguments.engine->structure(), arguments.most_cells);
  if (!cells) {
    return cells.error();
  }
  if (arguments.is_series()) {
    return write_series(arguments, *cells, outputs);
  }
  if (arguments.dimension && *arguments.dimension > last_matrix(*cells)) {
    return Error{Errc::refused, "--dim should be at most " + std::to_string(last_matrix(*cells)) +
                                    ", the last dimension in which this object has a boundary matrix"};
  }
  return write_object(arguments, positions, *cells, *out);
}

int commit(OutputFiles& outputs) {
  if (stop_requested().load()) {
    return static_cast<int>(Outcome::interrupted);
  }
  const Status written = outputs.commit();
  return written ? 0 : refuse(written.error());
}

int export_script(const Arguments& arguments, replay::ScriptReader& script, OutputFiles& outputs, std::ostream& out) {
  const Result<bool> written =
      write_plain_script(script, {arguments.without_undone, arguments.until, &stop_requested()}, out);
  if (!written) {
    std::cerr << written.error().what << '\n';  // it has its place
    return static_cast<int>(replay::outcome_of(written.error().code));
  }
  return commit(outputs);
}

int run_export(Arguments& arguments) {
  if (const std::string objected = objection(arguments); !objected.empty()) {
    return fail(objected, Outcome::wrong_usage);
  }
  if (const auto ring = sparse::parse_ring(arguments.ring.empty() ? "Z" : arguments.ring); !ring) {
    return fail("--ring: " + ring.error().what, Outcome::wrong_usage);
  }
  catch_interrupt();
  Result<replay::ScriptReader> script = open_script(arguments);
  if (!script) {
    return refuse(script.error());
  }
  OutputFiles outputs({arguments.file});
  const Result<std::ostream*> out = outputs.open(arguments.is_series() ? "" : arguments.out);
  if (!out) {
    return refuse(out.error());
  }
  if (arguments.format == ExportFormat::script) {
    return export_script(arguments, *script, outputs, **out);
  }
  replay::Positions positions;
  if (const Outcome outcome = build(arguments, *script, positions); outcome != Outcome::done) {
    return static_cast<int>(outcome);
  }
  if (const Status written = export_object(arguments, positions, outputs, *out); !written) {
    return refuse(written.error());
  }
  return commit(outputs);
}

void add_options_of_formats(CLI::App& command, Arguments& arguments) {
  command.add_flag("--without-undone", arguments.without_undone,
                   "script: leave out the steps that are undone later, and the undos");
  command
      .add_option("--dim", arguments.dimension, "matrix-market: the boundary from this dimension to the one below only")
      ->check(from_one_on());
  add_generators_option(command, arguments.generators,
                        "obj, ply: the generators of dimension 1 too; vtk, vtu: =1 or =0-2 instead of all generators");
  command
      .add_option("--max-cells", arguments.most_cells,
                  "Write products and large cones out when there are up to N cells")
      ->capture_default_str()
      ->check(from_zero_on());
}

}  // namespace

void add_export_command(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("export", "Write what a script builds for other programs");
  auto arguments = std::make_shared<Arguments>();
  command->add_option("FILE", arguments->file, "The script or log, JSON Lines; - for standard input")->required();
  add_choice<ExportFormat>(*command, "--format", arguments->format,
                           {{"script", ExportFormat::script},
                            {"phat", ExportFormat::phat},
                            {"phat-binary", ExportFormat::phat_binary},
                            {"matrix-market", ExportFormat::matrix_market},
                            {"vtk", ExportFormat::vtk},
                            {"vtu", ExportFormat::vtu},
                            {"obj", ExportFormat::obj},
                            {"ply", ExportFormat::ply},
                            {"facets", ExportFormat::facets},
                            {"3map", ExportFormat::map},
                            {"3map-generalized", ExportFormat::general_map}},
                           "The steps; boundary matrices; drawings with generators; facets of a simplicial complex; "
                           "maps for CGAL")
      ->required();
  command->add_option("-o,--output", arguments->out, "The file; default: standard output")->capture_default_str();
  command->add_option("--ring", arguments->ring,
                      "Generators over Z, Q or Z/p instead of the ring that the script names");
  command->add_option("--until", arguments->until, "Stop after that many steps")->check(from_one_on());
  add_options_of_formats(*command, *arguments);
  command->add_option("--max-line", arguments->longest_line, "Refuse lines of more bytes")
      ->capture_default_str()
      ->check(from_one_on());
  command->add_flag("--quiet", arguments->quiet, "Errors only, no remarks on what a format does not show");
  command->footer(
      "Exit status: 0 done, 1 wrong usage or unreadable file, 2 the script is wrong or the format cannot hold what it\n"
      "builds, 3 an expect failed, 130 interrupted by Ctrl-C.");
  command->callback([arguments, &status] { status = run_export(*arguments); });
}

}  // namespace sesame::tools

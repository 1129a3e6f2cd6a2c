#include <memory>

#include "tools/commands/barcode_options.hpp"
#include "tools/commands/commands.hpp"
#include "tools/commands/options.hpp"
#include "tools/commands/tower_loops.hpp"

namespace sesame::tools {

using replay::TowerFormat;

namespace {

replay::Outcome run_tower(const TowerArguments& arguments) {
  TowerRun run(arguments);
  if (const replay::Outcome opened = run.open(); opened != replay::Outcome::done) {
    return opened;
  }
  return run.finish(run.is_script()     ? run_script_as_tower(run)
                    : run.is_integral() ? run_groups(run)
                                        : run_barcodes(run));
}

}  // namespace

void add_tower_command(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("tower", "The barcode of a tower or a filtration, computed online");
  auto arguments = std::make_shared<TowerArguments>();
  command->add_option("FILE", arguments->file, "The tower, gzip or not; - for standard input")->required();
  add_choice<TowerFormat>(*command, "--format", arguments->format,
                          {{"auto", TowerFormat::automatic},
                           {"tower", TowerFormat::tower},
                           {"phat", TowerFormat::phat},
                           {"phat-binary", TowerFormat::phat_binary},
                           {"gudhi", TowerFormat::gudhi},
                           {"facets", TowerFormat::facets},
                           {"script", TowerFormat::script}},
                          "What the file is; default: by content");
  CLI::Option* ring = command->add_option(
      "--ring", arguments->ring, "Coefficients Z/p (default Z/2) or Q; Z gives the sequence of groups instead");
  command->add_option("--rings", arguments->rings, "Several of them side by side, Z/2,Z/3,...: where do they differ?")
      ->delimiter(',')
      ->excludes(ring);
  command->add_flag("--json", arguments->json,
                    "One JSON object on standard output; with --every more of them before it");
  add_barcode_outputs(*command, *arguments);
  command->add_option("--points", arguments->points,
                      "Where the vertices are, a point a line, that of vertex 0 first: the page draws complex and "
                      "classes there");
  add_generator_options(*command, arguments->generators,
                        "For each bar the cycle that is born, and the chain that it comes to bound; =1 or =0-2,4: of "
                        "these dimensions only");
  command->add_flag("--add-faces", arguments->add_faces,
                    "Add the faces that a simplex lacks, at its time; those that are there already are counted");
  add_bar_choices(*command, *arguments);
  command->footer(
      "Exit status: 0 done, 1 wrong usage or unreadable file, 2 the input is wrong, 3 an expect of a script failed,\n"
      "4 internal error,\n"
      "130 interrupted by Ctrl-C (what was read until then is reported).");
  command->callback([arguments, &status] { status = static_cast<int>(run_tower(*arguments)); });
}

}  // namespace sesame::tools

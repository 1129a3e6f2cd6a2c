#include <iostream>
#include <memory>

#include "tools/commands/barcode_options.hpp"
#include "tools/commands/commands.hpp"
#include "tools/commands/options.hpp"
#include "tools/commands/tower_loops.hpp"

namespace sesame::tools {

namespace {

replay::Outcome run_command(const TowerArguments& arguments) {
  TowerRun run(arguments);
  if (const replay::Outcome opened = run.open(); opened != replay::Outcome::done) {
    return opened;
  }
  return run.finish(run.is_script() ? run_script_as_tower(run) : run_zigzag(run));
}

}  // namespace

void add_zigzag_command(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand(
      "zigzag",
      "The barcode of complexes in which simplices come and go, computed online; or of a script with splits and "
      "removals");
  auto arguments = std::make_shared<TowerArguments>();
  arguments->command = "zigzag";
  arguments->format = replay::TowerFormat::zigzag;
  command
      ->add_option(
          "FILE", arguments->file,
          "Lines `i v0 ... vd` (a simplex is included), `d v0 ... vd` or `r v0 ... vd` (it is deleted), `c u v` "
          "(vertex u is contracted into v), or a script; gzip or not; - for standard input")
      ->required();
  add_choice<replay::TowerFormat>(
      *command, "--format", arguments->format,
      {{"auto", replay::TowerFormat::zigzag}, {"script", replay::TowerFormat::script}},
      "What the file is; default: by content. In a script, splits and removals map the object after them to the one "
      "before");
  command->add_option("--ring", arguments->ring, "Coefficients Z/p (default Z/2) or Q");
  command->add_flag("--json", arguments->json,
                    "One JSON object on standard output; with --every more of them before it");
  add_barcode_outputs(*command, *arguments);
  add_generator_options(*command, arguments->generators,
                        "For each bar a cycle at each time of it, in pieces; =1 or =0-2,4: of these dimensions only");
  command->add_flag("--add-faces", arguments->add_faces,
                    "Add the faces that a simplex lacks, at its time; those that are there already are counted");
  add_bar_choices(*command, *arguments);
  command->add_flag(
      "--verify", arguments->verifies,
      "Compute the barcode in two independent ways, of a script prove it by the cycles of all bars, and fail when "
      "something differs");
  command->footer(
      "Exit status: 0 done, 1 wrong usage or unreadable file, 2 the input is wrong, 3 an expect of a script failed,\n"
      "4 internal error, or --verify found something wrong,\n"
      "130 interrupted by Ctrl-C (what was read until then is reported).");
  command->callback([arguments, &status] { status = static_cast<int>(run_command(*arguments)); });
}

}  // namespace sesame::tools

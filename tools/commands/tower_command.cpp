#include <memory>

#include "engine/towers/time.hpp"
#include "replay/text/line_words.hpp"
#include "replay/text/time_reader.hpp"
#include "tools/commands/commands.hpp"
#include "tools/commands/options.hpp"
#include "tools/commands/tower_loops.hpp"

namespace sesame::tools {

using replay::TowerFormat;

namespace {

Result<engine::Time> length_of(const std::string& text) {
  constexpr const char* what = "a length, from 0 on";
  Result<engine::Time> length = replay::TimeReader().read(text, what, "--min-length", 0);
  return !length || *length >= 0 ? length : Error{Errc::bad_input, replay::shown(text) + " should be " + what};
}

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
  command->add_option("--pers", arguments->pers,
                      "Write the bars, a line `dim birth death` for each as it ends; - for standard output, instead of "
                      "the table");
  command->add_option("--csv", arguments->csv, "Write the Betti numbers, a row for each time at which they change");
  command->add_option("--svg", arguments->svg, "Draw barcode, persistence diagram and Betti curves");
  command->add_option("--html", arguments->html,
                      "A page to look at: barcode, diagram and Betti curves, linked, and the class of each bar");
  command->add_option("--points", arguments->points,
                      "Where the vertices are, a point a line, that of vertex 0 first: the page draws complex and "
                      "classes there");
  command->add_flag("--all-bars", arguments->all_bars,
                    "In --svg draw each bar by itself, also where many of a dimension have one length");
  add_generator_options(*command, arguments->generators,
                        "For each bar the cycle that is born, and the chain that it comes to bound; =1 or =0-2,4: of "
                        "these dimensions only");
  command->add_flag("--add-faces", arguments->add_faces,
                    "Add the faces that a simplex lacks, at its time; those that are there already are counted");
  command
      ->add_option_function<std::string>(
          "--min-length",
          [arguments](const std::string& text) { arguments->selection.min_length = length_of(text).value(); },
          "Leave out bars that are shorter (not from --csv and Betti curves)")
      ->check([](const std::string& text) {
        const Result<engine::Time> length = length_of(text);
        return length ? std::string{} : length.error().what;
      })
      ->option_text("LENGTH");
  command->add_flag("--no-open", arguments->selection.leaves_out_open,
                    "Leave out bars that never end (not from --csv and Betti curves)");
  command->add_option("--max-dim", arguments->max_dimension, "Nothing above dimension D: bars, Betti numbers, groups")
      ->check(from_zero_on())
      ->option_text("D");
  command->add_option("--until", arguments->until, "Stop after that many operations")->check(from_one_on());
  command->add_option("--every", arguments->every, "Report cells and Betti numbers every N operations")
      ->check(from_one_on());
  command->add_option("--max-line", arguments->longest_line, "Refuse lines of more bytes")
      ->capture_default_str()
      ->check(from_one_on());
  command->add_flag("--partial", arguments->partial, "After an error, report what there was before it");
  command->add_flag("--quiet", arguments->quiet, "No table and no progress: errors only (and what --json prints)");
  command->footer(
      "Exit status: 0 done, 1 wrong usage or unreadable file, 2 the input is wrong, 3 an expect of a script failed,\n"
      "4 internal error,\n"
      "130 interrupted by Ctrl-C (what was read until then is reported).");
  command->callback([arguments, &status] { status = static_cast<int>(run_tower(*arguments)); });
}

}  // namespace sesame::tools

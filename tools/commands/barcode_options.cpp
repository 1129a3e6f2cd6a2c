#include "tools/commands/barcode_options.hpp"

#include "engine/towers/time.hpp"
#include "replay/text/line_words.hpp"
#include "replay/text/time_reader.hpp"
#include "tools/commands/options.hpp"

namespace sesame::tools {
namespace {

Result<engine::Time> length_of(const std::string& text) {
  constexpr const char* what = "a length, from 0 on";
  Result<engine::Time> length = replay::TimeReader().read(text, what, "--min-length", 0);
  return !length || *length >= 0 ? length : Error{Errc::bad_input, replay::shown(text) + " should be " + what};
}

}  // namespace

void add_barcode_outputs(CLI::App& command, TowerArguments& arguments) {
  command.add_option("--pers", arguments.pers,
                     "Write the bars, a line `dim birth death` for each as it ends; - for standard output, instead of "
                     "the table");
  command.add_option("--csv", arguments.csv, "Write the Betti numbers, a row for each time at which they change");
  command.add_option("--svg", arguments.svg, "Draw barcode, persistence diagram and Betti curves");
  command.add_option("--html", arguments.html,
                     "A page to look at: barcode, diagram and Betti curves, linked, and the class of each bar");
  command.add_flag("--all-bars", arguments.all_bars,
                   "In --svg draw each bar by itself, also where many of a dimension have one length");
}

void add_bar_choices(CLI::App& command, TowerArguments& arguments) {
  command
      .add_option_function<std::string>(
          "--min-length",
          [&arguments](const std::string& text) { arguments.selection.min_length = length_of(text).value(); },
          "Leave out bars that are shorter (not from --csv and Betti curves)")
      ->check([](const std::string& text) {
        const Result<engine::Time> length = length_of(text);
        return length ? std::string{} : length.error().what;
      })
      ->option_text("LENGTH");
  command.add_flag("--no-open", arguments.selection.leaves_out_open,
                   "Leave out bars that never end (not from --csv and Betti curves)");
  command.add_option("--max-dim", arguments.max_dimension, "Nothing above dimension D: bars, Betti numbers, groups")
      ->check(from_zero_on())
      ->option_text("D");
  command.add_option("--until", arguments.until, "Stop after that many operations")->check(from_one_on());
  command.add_option("--every", arguments.every, "Report cells and Betti numbers every N operations")
      ->check(from_one_on());
  command.add_option("--max-line", arguments.longest_line, "Refuse lines of more bytes")
      ->capture_default_str()
      ->check(from_one_on());
  command.add_flag("--partial", arguments.partial, "After an error, report what there was before it");
  command.add_flag("--quiet", arguments.quiet, "No table and no progress: errors only (and what --json prints)");
}

}  // namespace sesame::tools

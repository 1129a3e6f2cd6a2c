#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <memory>

#include "replay/script/replay.hpp"
#include "tools/bench/comparison.hpp"
#include "tools/bench/mesh_scenario.hpp"
#include "tools/bench/method.hpp"
#include "tools/bench/report.hpp"
#include "tools/bench/runner.hpp"
#include "tools/bench/runs.hpp"
#include "tools/bench/scaling.hpp"
#include "tools/commands/commands.hpp"
#include "tools/commands/options.hpp"
#include "tools/commands/output_file.hpp"

namespace sesame::tools {
namespace {

using replay::Outcome;

constexpr std::string_view scaling_name = "scaling";

struct Arguments {
  std::vector<std::string> scenarios, methods, meshes;
  unsigned repeat = 5;
  std::optional<std::uint64_t> size;
  double time_limit = 60;
  std::string from, compare, against, counts, out, html, svg;
  bool list = false, quick = false, large = false, json = false;
};

int wrong_usage(const Error& error) {
  std::cerr << "sesame bench: " << error.what << '\n';
  return static_cast<int>(Outcome::wrong_usage);
}

void write_list() {
  for (const Scenario& scenario : scenarios()) {
    std::cout << fmt::format("{:<28} {}; size {}{}: {}; {}\n", scenario.name, scenario.what, scenario.size,
                             scenario.quick_size > 0 ? fmt::format(" ({} with --quick)", scenario.quick_size) : "",
                             scenario.size_name, fmt::join(methods_of(scenario), ", "));
  }
  for (const Experiment& experiment : experiments()) {
    std::cout << fmt::format("{:<28} {}: {} from {} to {}, expected exponent {}; {}\n", scaling_name, experiment.name,
                             experiment.x_name, experiment.smallest, experiment.largest, experiment.expected,
                             fmt::join(experiment.methods, ", "));
  }
  for (const MethodEntry& method : methods()) {
    std::cout << fmt::format("method {:<21} {}\n", method.name, method.what);
  }
}

/// One run of the command.
class Bench {
 public:
  explicit Bench(const Arguments& arguments) : arguments_{arguments} {}

  int run() {
    if (const Status prepared = prepare(); !prepared) {
      return wrong_usage(prepared.error());
    }
    if (arguments_.from.empty()) {
      measure_everything();
    } else if (prints_table()) {
      write_tables();
    }
    if (const Status written = write_files(); !written) {
      return wrong_usage(written.error());
    }
    return conclude();
  }

 private:
  [[nodiscard]] bool counts_only() const { return !arguments_.against.empty() || !arguments_.counts.empty(); }
  [[nodiscard]] bool prints_table() const { return !arguments_.json && !counts_only(); }

  void measure_everything() {
    report_.machine = this_machine();
    report_.build = this_build();
    report_.date = time_stamp();
    if (prints_table()) {
      write_facts(std::cout, report_);
    }
    measure_all();
    if (wants_scaling_) {
      measure_scaling();
    }
  }

  void write_tables() const {
    write_facts(std::cout, report_);
    write_measurement_head(std::cout);
    for (const Measurement& measurement : report_.measurements) {
      write_measurement(std::cout, measurement);
    }
    for (const Scaling& scaling : report_.scalings) {
      write_scaling(std::cout, scaling);
    }
  }

  /// Reads and opens everything that there is to read and to open.
  Status prepare() {
    std::vector<std::string> names = arguments_.scenarios;
    wants_scaling_ = std::erase(names, scaling_name) > 0;
    for (const std::string& path : arguments_.meshes) {
      auto scenario = mesh_scenario(path);
      if (!scenario) {
        return scenario.error();
      }
      meshes_.push_back(*std::move(scenario));
    }
    if (!names.empty() || (!wants_scaling_ && meshes_.empty())) {
      const auto found = find_scenarios(names);
      if (!found) {
        return found.error();
      }
      scenarios_ = *found;
    }
    for (const Scenario& mesh : meshes_) {
      scenarios_.push_back(&mesh);
    }
    if (const Status known = check_method_names(arguments_.methods); !known) {
      return known.error();
    }
    if (arguments_.size && scenarios_.size() != 1) {
      return Error{Errc::refused, "--size is for one scenario; name it"};
    }
    if (!arguments_.from.empty()) {
      auto stored = read_report(arguments_.from);
      if (!stored) {
        return stored.error();
      }
      report_ = *std::move(stored);
    }
    if (!arguments_.compare.empty()) {
      auto old = read_report(arguments_.compare);
      if (!old) {
        return old.error();
      }
      old_ = *std::move(old);
    }
    if (!arguments_.against.empty()) {
      auto golden = read_counts(arguments_.against);
      if (!golden) {
        return golden.error();
      }
      golden_ = *std::move(golden);
    }
    return open_outputs();
  }

  Status open_outputs() {
    std::vector<std::string> inputs = arguments_.meshes;
    inputs.insert(inputs.end(), {arguments_.from, arguments_.compare, arguments_.against});
    outputs_.emplace(std::move(inputs));
    for (const auto& [path, file] : {std::pair{&arguments_.out, &out_}, std::pair{&arguments_.html, &html_},
                                     std::pair{&arguments_.svg, &svg_}, std::pair{&arguments_.counts, &counts_}}) {
      const Result<std::ostream*> opened = outputs_->open(*path);
      if (!opened) {
        return opened.error();
      }
      *file = *opened;
    }
    return Done{};
  }

  /// The methods that a scenario is run with now.
  [[nodiscard]] std::vector<std::string> chosen_methods(const Scenario& scenario) const {
    std::vector<std::string> chosen = methods_of(scenario);
    if (arguments_.methods.empty()) {
      std::erase_if(chosen, [](const std::string& name) {
        return std::ranges::any_of(methods(),
                                   [&](const MethodEntry& m) { return m.name == name && m.only_when_named; });
      });
      chosen.resize(scenario.all_methods ? chosen.size() : 1);
    } else {
      std::erase_if(chosen, [&](const std::string& name) {
        return std::ranges::find(arguments_.methods, name) == arguments_.methods.end();
      });
    }
    if (counts_only()) {  // other programs count nothing
      std::erase_if(chosen, [](const std::string& name) {
        return std::ranges::find(program_methods(), name) != program_methods().end();
      });
    }
    return chosen;
  }

  void measure_all() {
    if (prints_table() && !scenarios_.empty()) {
      write_measurement_head(std::cout);
    }
    const RunnerOptions options{counts_only() ? 0 : arguments_.repeat, counts_only() ? 1e5 : arguments_.time_limit};
    for (const Scenario* scenario : scenarios_) {
      const std::uint64_t usual = arguments_.quick ? scenario->quick_size : scenario->size;
      const std::uint64_t size = arguments_.size.value_or(usual);
      for (const std::string& method : size > 0 ? chosen_methods(*scenario) : std::vector<std::string>{}) {
        report_.measurements.push_back(measure(*scenario, size, method, options));
        if (prints_table()) {
          write_measurement(std::cout, report_.measurements.back());
        }
      }
    }
  }

  void measure_scaling() {
    const Extent extent = arguments_.quick ? Extent::quick : arguments_.large ? Extent::large : Extent::normal;
    for (const Experiment& experiment : experiments()) {
      for (const std::string& method : experiment.methods) {
        const bool is_wanted =
            arguments_.methods.empty() || std::ranges::find(arguments_.methods, method) != arguments_.methods.end();
        if (is_wanted) {
          report_.scalings.push_back(run_experiment(experiment, method, extent, arguments_.time_limit));
          if (prints_table()) {
            write_scaling(std::cout, report_.scalings.back());
          }
        }
      }
    }
  }

  Status write_files() {
    if (out_ != nullptr) {
      *out_ << to_text(report_);
    }
    if (html_ != nullptr) {
      write_page(*html_, report_);
    }
    if (svg_ != nullptr) {
      write_figure(*svg_, report_);
    }
    if (counts_ != nullptr) {
      *counts_ << to_text(count_rows(report_));
    }
    if (arguments_.json) {
      std::cout << to_text(report_);
    }
    return outputs_->commit();
  }

  /// Says what is to be said at the end. The exit status.
  int conclude() {
    if (old_ && !arguments_.json) {
      write_time_changes(std::cout, compare_times(*old_, report_));
    }
    bool is_failed = false, is_wrong = false;
    for (const Measurement& m : report_.measurements) {
      if (m.verdict == Verdict::wrong || m.verdict == Verdict::failed) {
        (m.verdict == Verdict::wrong ? is_wrong : is_failed) = true;
        complain(m.scenario, m.method, verdict_name(m.verdict), m.remark);
      }
    }
    for (const Scaling& scaling : report_.scalings) {
      if (scaling.is_wrong) {
        is_wrong = true;
        complain(scaling.experiment, scaling.method, verdict_name(Verdict::wrong), scaling.remark);
      }
    }
    if (!is_failed && golden_ && !holds(*golden_)) {
      is_wrong = true;
    }
    return static_cast<int>(is_wrong ? Outcome::expectation_failed : is_failed ? Outcome::law_failed : Outcome::done);
  }

  static void complain(const std::string& of, const std::string& method, std::string_view verdict,
                       const std::string& remark) {
    std::cerr << fmt::format("sesame bench: {}, {}: {}: {}\n", of, method, verdict, remark);
  }

  bool holds(const std::vector<CountRow>& golden) {
    const std::vector<CountRow> rows = count_rows(report_);
    const bool is_whole = arguments_.scenarios.empty() && arguments_.methods.empty() && meshes_.empty();
    const CountComparison comparison = compare_counts(golden, rows, is_whole);
    write_count_comparison(std::cerr, comparison);
    const bool holds = comparison.grown.empty() && comparison.incomparable.empty();
    if (!arguments_.json) {
      std::cout << fmt::format("{} rows of counts compared with {}: {}\n", rows.size(), arguments_.against,
                               holds ? "nothing has grown" : "see above");
    }
    return holds;
  }

  const Arguments& arguments_;
  std::vector<Scenario> meshes_;
  std::vector<const Scenario*> scenarios_;
  bool wants_scaling_ = false;
  std::optional<Report> old_;
  std::optional<std::vector<CountRow>> golden_;
  std::optional<OutputFiles> outputs_;
  std::ostream *out_ = nullptr, *html_ = nullptr, *svg_ = nullptr, *counts_ = nullptr;
  Report report_;
};

}  // namespace

void add_bench_command(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("bench", "Measure methods for incremental homology side by side");
  auto arguments = std::make_shared<Arguments>();
  CLI::Option* from = command->add_option("--from", arguments->from, "Show an older report, and measure nothing");
  command
      ->add_option("SCENARIO", arguments->scenarios,
                   "Names of scenarios or families, or `scaling`; default: all scenarios")
      ->excludes(from);
  command->add_option("--mesh", arguments->meshes, "Meshes to assemble triangle by triangle; others only if named too")
      ->delimiter(',')
      ->excludes(from);
  command->add_flag("--list", arguments->list, "List scenarios, experiments and methods");
  command->add_option("--method", arguments->methods, "Methods, separated by commas; default: see --list")
      ->delimiter(',')
      ->excludes(from);
  command->add_option("--repeat", arguments->repeat, "Timed runs, after one that warms up")
      ->check(from_one_on())
      ->capture_default_str();
  command->add_option("--size", arguments->size, "Another size for one scenario")->check(from_one_on())->excludes(from);
  command->add_option("--time-limit", arguments->time_limit, "Seconds after which a run is cut off")
      ->check(above_zero())
      ->capture_default_str();
  CLI::Option* quick = command->add_flag("--quick", arguments->quick, "Small sizes");
  command->add_flag("--large", arguments->large, "Scaling up to ten million cells")->excludes(quick);
  command->add_flag("--json", arguments->json, "One JSON object on standard output, as --out writes it");
  command->add_option("--out", arguments->out, "Write the report as JSON");
  command->add_option("--html", arguments->html, "Write a page with tables, scaling plots and latencies");
  command->add_option("--svg", arguments->svg, "Write the scaling plots as one picture");
  command->add_option("--compare", arguments->compare, "An older report: what is faster, what slower");
  command->add_option("--counts", arguments->counts, "Count only, no times; write the counts, for --against")
      ->excludes(from);
  command
      ->add_option("--against", arguments->against,
                   "Count only; fails when a count is larger by more than 2 % (and 2) than in this file")
      ->excludes(from);
  command->footer(
      "A run of its own checks the answers on the way, as the column `checked` says; every run checks the last one.\n"
      "Exit status: 0 done, 1 wrong usage or unreadable file, 3 a wrong answer or a count that grew, 4 a run that "
      "broke "
      "off.");
  command->callback([arguments, &status] {
    if (arguments->list) {
      write_list();
      status = 0;
    } else {
      status = Bench(*arguments).run();
    }
  });
}

}  // namespace sesame::tools

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <span>
#include <thread>

#include "replay/script/facet_list.hpp"
#include "replay/script/replay.hpp"
#include "replay/tower/tower_format.hpp"
#include "tools/commands/commands.hpp"
#include "tools/commands/interrupt.hpp"
#include "tools/commands/log_file.hpp"
#include "tools/commands/options.hpp"
#include "tools/commands/output_file.hpp"
#include "tools/commands/replay_arguments.hpp"
#include "tools/commands/replay_pages.hpp"

namespace sesame::tools {
namespace {

using replay::Outcome;

/// What somebody types at a terminal, who is asked for it.
class PromptedInput final : public replay::ByteInput {
 public:
  explicit PromptedInput(std::unique_ptr<replay::ByteInput> input) : input_{std::move(input)} {}

  Result<std::size_t> read(std::span<char> to) override {
    std::cerr << "sesame> " << std::flush;
    Result<std::size_t> got = input_->read(to);
    if (!got || *got == 0) {
      std::cerr << '\n';
    }
    return got;
  }
  [[nodiscard]] bool is_stopped() const override { return input_->is_stopped(); }

 private:
  std::unique_ptr<replay::ByteInput> input_;
};

using Arguments = ReplayArguments;

constexpr std::uint64_t most_steps_reported_by_default = 200;

int wrong_usage(const std::string& what) {
  std::cerr << "sesame replay: " << what << '\n';
  return static_cast<int>(Outcome::wrong_usage);
}

bool is_prompted(const Arguments& arguments) {
  return arguments.file == "-" && !arguments.quiet && isatty(STDIN_FILENO) == 1;
}

/// The number of operations of a file that can be read twice; of many, no more are counted than it takes to know that.
std::optional<std::uint64_t> operations_of(const Arguments& arguments, bool shows_progress) {
  std::error_code unknown;
  if (arguments.follow || !std::filesystem::is_regular_file(arguments.file, unknown)) {
    return std::nullopt;
  }
  Result<replay::ByteSource> source = replay::ByteSource::open(arguments.file, {&stop_requested()});
  if (!source) {
    return std::nullopt;
  }
  const Result<std::uint64_t> operations =
      shows_progress ? replay::count_operations(std::move(*source))
                     : replay::count_operations(std::move(*source), most_steps_reported_by_default + 1);
  if (!operations) {
    return std::nullopt;  // what is wrong, the replay will tell
  }
  return arguments.until > 0 ? std::min(*operations, arguments.until) : *operations;
}

Result<replay::ByteSource> open_script(const Arguments& arguments) {
  const replay::InputOptions options{&stop_requested(), arguments.follow};
  if (!is_prompted(arguments)) {
    return replay::ByteSource::open(arguments.file, options);
  }
  Result<std::unique_ptr<replay::ByteInput>> input = replay::open_input("-", "standard input", options);
  if (!input) {
    return input.error();
  }
  return replay::ByteSource::from(std::make_unique<PromptedInput>(std::move(*input)), "standard input");
}

struct Script {
  replay::ByteSource source;
  bool is_list_of_facets = false;
};

/// A list of facets becomes the script that inserts them; anything else stays what it is.
Result<Script> as_script(replay::ByteSource source, const Arguments& arguments) {
  if (arguments.follow || is_prompted(arguments)) {
    return Script{std::move(source)};
  }
  const Result<replay::TowerFormat> format = replay::find_format(source, arguments.longest_line);
  if (!format || *format != replay::TowerFormat::facets) {
    return Script{std::move(source)};  // what is wrong with it, the reader of scripts will tell
  }
  const std::string name = source.name();
  Result<std::vector<replay::Facet>> facets =
      replay::read_facets(replay::LineSource(std::move(source), arguments.longest_line));
  if (!facets) {
    return facets.error();
  }
  if (!arguments.quiet) {
    std::cerr << fmt::format("{}: read as a list of facets: {} facets, in one insertion\n", name, facets->size());
  }
  const std::string script = script_of(*facets, "Z", name, replay::FacetSteps::one);
  return Script{replay::ByteSource::of_text(script, name + " as a script"), true};
}

/// The exit status, that of the outcome unless the log could not be kept. `goes_on`: behind steps that are refused.
int close_log(LogFile* log, const std::string& path, Outcome outcome, bool goes_on) {
  if (log != nullptr) {
    // A script without a header has no log, and no end to come to.
    const bool passed_over =
        goes_on && !log->part().empty() && (outcome == Outcome::wrong_script || outcome == Outcome::expectation_failed);
    const bool is_whole = outcome == Outcome::done || outcome == Outcome::interrupted || passed_over;
    if (const Status closed = log->close(is_whole); !closed) {
      return wrong_usage(closed.error().what);
    }
    if (const std::string part = log->part(); !part.empty()) {
      std::cerr << path << " is as it was; the log of the steps until here is " << part << '\n';
    }
  }
  return static_cast<int>(outcome);
}

/// Waits until there is a file of this name again; false when somebody stops that.
bool waits_for(const std::string& path) {
  std::error_code unknown;
  while (!stop_requested()) {
    if (std::filesystem::exists(path, unknown)) {
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return false;
}

/// One script; whether it is a log that is followed, and that another one has taken the name of.
int run_replay(Arguments& arguments, LivePages& pages, bool& is_superseded) {
  is_superseded = false;
  replay::ReplayOptions options;
  if (!arguments.ring.empty()) {
    Result<sparse::AnyRing> ring = sparse::parse_ring(arguments.ring);
    if (!ring) {
      return wrong_usage("--ring: " + ring.error().what);
    }
    options.ring = *ring;
  }
  catch_interrupt();
  std::error_code unknown;
  const bool may_be_superseded = arguments.follow && std::filesystem::is_regular_file(arguments.file, unknown);
  Result<replay::ByteSource> source = open_script(arguments);
  Result<Script> found = source ? as_script(std::move(*source), arguments) : source.error();
  if (!found && stop_requested().load()) {
    return static_cast<int>(Outcome::interrupted);
  }
  if (!found && found.error().code == Errc::io) {
    return wrong_usage(found.error().what);
  }
  if (!found) {
    std::cerr << found.error().what << '\n';
    return static_cast<int>(Outcome::wrong_script);
  }
  std::unique_ptr<LogFile> log;
  if (!arguments.log.empty()) {
    Result<std::unique_ptr<LogFile>> opened =
        LogFile::open(arguments.log, arguments.old_log, arguments.sync, {arguments.file}, arguments.longest_line);
    if (!opened) {
      return wrong_usage(opened.error().what);
    }
    log = std::move(*opened);
    options.log = log->writer();
    options.older_steps = log->older();
    options.has_snapshots = log->has_place() && !arguments.no_snapshots;
  }
  const bool shows_progress = !arguments.quiet && isatty(STDERR_FILENO) == 1 && !is_prompted(arguments);
  const std::optional<std::uint64_t> operations =
      found->is_list_of_facets ? 1 : operations_of(arguments, shows_progress);
  const std::uint64_t shown = operations.value_or(most_steps_reported_by_default);
  if (arguments.every > 0) {
    options.every = arguments.every;
  } else {
    options.every = shown <= most_steps_reported_by_default ? 1 : 0;
    if (!operations) {
      options.report_at_most = most_steps_reported_by_default;
    }
  }
  if (arguments.until > 0) {
    options.until = arguments.until;
  }
  options.verify = arguments.verify;
  options.limits.cells_of_explicit_cone = arguments.explicit_cones;
  options.undoable = arguments.undoable;
  options.forgets_cells = arguments.forgets_cells;
  options.resources = arguments.resources;
  if (arguments.most_seconds > 0) {
    options.most_time = std::chrono::duration<double>(arguments.most_seconds);
  }
  options.generators = arguments.generators;
  options.engine = &arguments.engine;
  options.stop = &stop_requested();
  options.keep_going = arguments.keep_going || is_prompted(arguments);
  options.notes = arguments.quiet ? nullptr : &std::cerr;

  if (arguments.json && is_standard_output(arguments.html)) {
    return wrong_usage("--json and --html - would both go to standard output");
  }
  PageOutput page(arguments);
  if (const Status opened = page.open(options); !opened) {
    return wrong_usage(opened.error().what);
  }
  pages.open(arguments, options);
  std::unique_ptr<replay::Reporter> reporter;
  if (arguments.json) {
    reporter =
        arguments.in_simplices ? replay::json_reporter_in_simplices(std::cout) : replay::json_reporter(std::cout);
  } else if (!arguments.quiet && !is_standard_output(arguments.html)) {
    reporter = replay::table_reporter(std::cout, isatty(STDOUT_FILENO) == 1);
  }
  std::unique_ptr<replay::Progress> progress;
  if (shows_progress) {
    progress = std::make_unique<replay::Progress>(std::cerr, operations);
  }
  replay::ScriptReader script(std::move(found->source), arguments.longest_line);
  const Outcome outcome = replay::replay(script, options, reporter.get(), std::cerr, progress.get());
  is_superseded = may_be_superseded && log == nullptr && outcome == Outcome::done && script.is_at_end();
  const bool passed_over = options.keep_going && !script.is_broken() && arguments.engine != nullptr;
  const int status = close_log(log.get(), arguments.log, outcome, options.keep_going && !script.is_broken());
  if (outcome == Outcome::done || outcome == Outcome::interrupted || passed_over) {
    if (const Status written = page.write(outcome == Outcome::interrupted); !written) {
      return wrong_usage(written.error().what);
    }
  }
  return status;
}

/// With --follow, one log after another that has the name.
int run_replays(Arguments& arguments) {
  LivePages pages;
  if (const Status started = pages.start(arguments); !started) {
    return wrong_usage(started.error().what);
  }
  bool is_superseded = false;
  int status = run_replay(arguments, pages, is_superseded);
  while (is_superseded && waits_for(arguments.file)) {
    std::cout << std::flush;
    std::cerr << arguments.file << ": another log has this name now; going on with that, from its beginning\n";
    status = run_replay(arguments, pages, is_superseded);
  }
  return is_superseded ? static_cast<int>(Outcome::interrupted) : status;
}

}  // namespace

void add_replay_command(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("replay", "Replay a construction script, with the homology after every step");
  auto arguments = std::make_shared<Arguments>();
  command->add_option("FILE", arguments->file, "The script, JSON Lines, or a list of facets; - for standard input")
      ->required();
  command->add_option("--ring", arguments->ring, "Compute over Z, Q or Z/p instead of the ring that the script names");
  command->add_option("--until", arguments->until, "Stop after that many steps")->check(from_one_on());
  command
      ->add_option("--every", arguments->every,
                   "Report every N steps; default: every step of up to 200, else only answers to class")
      ->check(from_one_on());
  command->add_flag("--json", arguments->json, "One JSON object per reported step on standard output");
  add_generator_options(*command, arguments->generators,
                        "The generators of the homology groups at the end; =1 or =0-2,4: of these dimensions only");
  CLI::Option* verify = command->add_flag("--verify", arguments->verify, "Check every law after every step (slow)");
  command
      ->add_option("--explicit-cones", arguments->explicit_cones,
                   "Write cones over whole bodies of up to N cells out; of larger ones only the cells that are used")
      ->capture_default_str()
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1'000'000'000}));
  CLI::Option* undo_limit =
      command
          ->add_option("--undo-limit", arguments->undoable,
                       "Keep what it takes to undo the last N steps only: less memory in long sessions; default: all")
          ->check(from_one_on());
  add_size(*command, "--max-memory", arguments->resources.most_bytes,
           "Refuse a step that would bring the program beyond so much memory: 500M, 2G");
  command
      ->add_option("--max-cells", arguments->resources.most_cells,
                   "Refuse a step after which the object would have more cells")
      ->check(from_one_on());
  command->add_option("--max-time", arguments->most_seconds, "Take no further step after so many seconds")
      ->check(above_zero());
  CLI::Option* log = command->add_option("--log", arguments->log, "Keep the steps that were applied in this file");
  CLI::Option* forget =
      command
          ->add_flag("--forget", arguments->forgets_cells,
                     "With --undo-limit: forget cells that are gone, and their names, when no undo can bring them back")
          ->needs(undo_limit)
          ->excludes(log)
          ->excludes(verify);
  const auto old_log = [&](const char* name, LogFile::Old old, const char* description) {
    const auto choose = [arguments, old](std::int64_t) { arguments->old_log = old; };
    return command->add_flag_function(name, choose, description)->needs(log);
  };
  CLI::Option* append = old_log("--append", LogFile::Old::goes_on,
                                "If there is a log, take its steps first, then those of FILE, and add these to it");
  old_log("--overwrite", LogFile::Old::is_replaced, "If there is a log, replace it at the end")->excludes(append);
  using engine::SyncPolicy;
  add_choice<SyncPolicy>(
      *command, "--sync", arguments->sync,
      {{"always", SyncPolicy::always()}, {"batch", SyncPolicy::batch()}, {"never", SyncPolicy::never()}},
      "When the log is put where a power cut leaves it: before a step counts as done, at most a second "
      "or 4 MiB later (the default), or at the end")
      ->needs(log);
  command->add_flag("--no-snapshots", arguments->no_snapshots, "Neither read nor write LOG.snapshot")->needs(log);
  command
      ->add_flag("--as-simplices", arguments->in_simplices,
                 "Write chains of cells of maps in the simplices that the maps stand for")
      ->needs("--json");
  command->add_flag("--keep-going", arguments->keep_going,
                    "After a step that is refused go on with the next one; exit status 2 at the end");
  command->add_option("--max-line", arguments->longest_line, "Refuse lines of more bytes")
      ->capture_default_str()
      ->check(from_one_on());
  CLI::Option* follow = command->add_flag("--follow", arguments->follow, "Go on as the file grows, until Ctrl-C");
  command
      ->add_option("--html", arguments->html,
                   "A page to look at: the object in space after each step, its groups, its generators")
      ->excludes(append)
      ->excludes(follow)
      ->excludes(forget);
  CLI::Option* serve =
      command
          ->add_option(
              "--serve", arguments->serve,
              "Show the page while the replay goes on, and after its end, until Ctrl-C: PORT of this machine, or "
              "ADDRESS:PORT; port 0: any that is free")
          ->option_text("PORT")
          ->excludes("--html")
          ->excludes(append)
          ->excludes(forget)
          ->excludes(verify)
          ->check([](const std::string& text) {
            const Result<ServerAddress> address = parse_server_address(text);
            return address ? std::string{} : address.error().what;
          });
  command
      ->add_flag("--writable", arguments->is_writable,
                 "With --serve: the page can send steps, with the token of the address that is printed")
      ->needs(serve);
  command->add_flag("--quiet", arguments->quiet, "No table and no progress: errors only (and what --json prints)");
  command->footer(
      "Exit status: 0 done, 1 wrong usage or unreadable file, 2 the script is wrong, 3 an expect failed,\n"
      "4 a law failed under --verify or an internal error, 5 it would take more memory, cells or time than there is, "
      "or\n"
      "than was allowed, 130 interrupted by Ctrl-C.");
  command->callback([arguments, &status] { status = run_replays(*arguments); });
}

}  // namespace sesame::tools

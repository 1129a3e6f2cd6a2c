#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <fstream>
#include <iostream>
#include <memory>
#include <streambuf>
#include <thread>
#include <vector>

#include "replay/replay.hpp"
#include "tools/commands.hpp"
#include "tools/interrupt.hpp"
#include "tools/log_file.hpp"
#include "tools/options.hpp"

namespace sesame::tools {
namespace {

using replay::Outcome;

/// Standard input that ends at Ctrl-C; std::cin would go on waiting.
class StandardInput final : public std::streambuf {
 public:
  [[nodiscard]] bool is_unreadable() const { return is_unreadable_; }

 protected:
  int_type underflow() override {
    const ssize_t got = stop_requested().load() ? 0 : ::read(STDIN_FILENO, buffer_.data(), buffer_.size());
    is_unreadable_ = is_unreadable_ || (got < 0 && errno != EINTR);
    if (got <= 0) {
      return traits_type::eof();
    }
    setg(buffer_.data(), buffer_.data(), buffer_.data() + got);
    return traits_type::to_int_type(*gptr());
  }

 private:
  bool is_unreadable_ = false;
  std::vector<char> buffer_ = std::vector<char>(1 << 16);
};

struct Arguments {
  std::string file;
  std::string ring;
  std::uint64_t until = 0;
  std::uint64_t every = 0;
  std::int64_t explicit_cones = ops::Limits{}.cells_of_explicit_cone;
  std::string log;
  LogFile::Old old_log = LogFile::Old::is_refused;
  bool json = false;
  bool generators = false;
  bool verify = false;
  bool follow = false;
  bool quiet = false;
};

constexpr std::uint64_t most_steps_reported_by_default = 200;

int wrong_usage(const std::string& what) {
  std::cerr << "sesame replay: " << what << '\n';
  return static_cast<int>(Outcome::wrong_usage);
}

/// The number of operations of a file, when it can be counted before it is read.
std::optional<std::uint64_t> operations_of(const Arguments& arguments) {
  if (arguments.file == "-" || arguments.follow) {
    return std::nullopt;
  }
  std::ifstream file(arguments.file);
  if (!file) {
    return std::nullopt;
  }
  const std::uint64_t operations = replay::count_operations(file);
  return arguments.until > 0 ? std::min(operations, arguments.until) : operations;
}

/// Waits for a followed file to grow, until Ctrl-C.
bool wait_for_growth() {
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  return !stop_requested().load();
}

/// The exit status, that of the outcome unless the log could not be kept.
int close_log(LogFile* log, const std::string& path, Outcome outcome) {
  if (log != nullptr) {
    const bool is_whole = outcome == Outcome::done || outcome == Outcome::interrupted;
    if (const Status closed = log->close(is_whole); !closed) {
      return wrong_usage(closed.error().what);
    }
    if (const std::string part = log->part(); !part.empty()) {
      std::cerr << path << " is as it was; the log of the steps until here is " << part << '\n';
    }
  }
  return static_cast<int>(outcome);
}

int run_replay(const Arguments& arguments) {
  replay::ReplayOptions options;
  if (!arguments.ring.empty()) {
    Result<sparse::AnyRing> ring = sparse::parse_ring(arguments.ring);
    if (!ring) {
      return wrong_usage("--ring: " + ring.error().what);
    }
    options.ring = *ring;
  }
  std::ifstream file;
  if (arguments.file != "-") {
    file.open(arguments.file);
    // A directory opens but cannot be read.
    if (!file || (file.peek() == std::char_traits<char>::eof() && file.bad())) {
      return wrong_usage("cannot read " + arguments.file);
    }
    file.clear();
  }
  std::unique_ptr<LogFile> log;
  std::ifstream older_log;
  std::optional<replay::ScriptReader> older_steps;
  if (!arguments.log.empty()) {
    Result<std::unique_ptr<LogFile>> opened = LogFile::open(arguments.log, arguments.old_log, {arguments.file});
    if (!opened) {
      return wrong_usage(opened.error().what);
    }
    log = std::move(*opened);
    options.log = &log->stream();
    if (log->goes_on()) {
      older_log.open(arguments.log);
      options.older_steps = &older_steps.emplace(older_log, arguments.log);
    }
  }
  const std::optional<std::uint64_t> operations = operations_of(arguments);
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
  options.generators = arguments.generators;
  options.stop = &stop_requested();
  catch_interrupt();

  std::unique_ptr<replay::Reporter> reporter;
  if (arguments.json) {
    reporter = replay::json_reporter(std::cout);
  } else if (!arguments.quiet) {
    reporter = replay::table_reporter(std::cout, isatty(STDOUT_FILENO) == 1);
  }
  std::unique_ptr<replay::Progress> progress;
  if (!arguments.quiet && isatty(STDERR_FILENO) == 1) {
    progress = std::make_unique<replay::Progress>(std::cerr, operations);
  }
  StandardInput standard_input;
  std::istream standard_stream(&standard_input);
  replay::ScriptReader script(arguments.file == "-" ? standard_stream : file,
                              arguments.file == "-" ? "standard input" : arguments.file,
                              arguments.follow ? wait_for_growth : std::function<bool()>{});
  Outcome outcome = replay::replay(script, options, reporter.get(), std::cerr, progress.get());
  if (standard_input.is_unreadable()) {
    outcome = static_cast<Outcome>(wrong_usage("cannot read standard input"));
  }
  return close_log(log.get(), arguments.log, outcome);
}

}  // namespace

void add_replay_command(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("replay", "Replay a construction script, with the homology after every step");
  auto arguments = std::make_shared<Arguments>();
  command->add_option("FILE", arguments->file, "The script, JSON Lines; - for standard input")->required();
  command->add_option("--ring", arguments->ring, "Compute over Z or Z/p instead of the ring that the script names");
  command->add_option("--until", arguments->until, "Stop after that many steps")->check(from_one_on());
  command
      ->add_option("--every", arguments->every,
                   "Report every N steps; default: every step of up to 200, else only answers to class")
      ->check(from_one_on());
  command->add_flag("--json", arguments->json, "One JSON object per reported step on standard output");
  command->add_flag("--generators", arguments->generators, "The generators of the homology groups at the end");
  command->add_flag("--verify", arguments->verify, "Check every law after every step (slow)");
  command
      ->add_option("--explicit-cones", arguments->explicit_cones,
                   "Write cones over whole bodies of up to N cells out; of larger ones only the cells that are used")
      ->capture_default_str()
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1'000'000'000}));
  CLI::Option* log = command->add_option("--log", arguments->log, "Keep the steps that were applied in this file");
  const auto old_log = [&](const char* name, LogFile::Old old, const char* description) {
    const auto choose = [arguments, old](std::int64_t) { arguments->old_log = old; };
    return command->add_flag_function(name, choose, description)->needs(log);
  };
  CLI::Option* append = old_log("--append", LogFile::Old::goes_on,
                                "If there is a log, take its steps first, then those of FILE, and add these to it");
  old_log("--overwrite", LogFile::Old::is_replaced, "If there is a log, replace it at the end")->excludes(append);
  command->add_flag("--follow", arguments->follow, "Go on as the file grows, until Ctrl-C");
  command->add_flag("--quiet", arguments->quiet, "No table and no progress: errors only (and what --json prints)");
  command->footer(
      "Exit status: 0 done, 1 wrong usage or unreadable file, 2 the script is wrong, 3 an expect failed,\n"
      "4 a law failed under --verify or an internal error, 130 interrupted by Ctrl-C.");
  command->callback([arguments, &status] { status = run_replay(*arguments); });
}

}  // namespace sesame::tools

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
  bool json = false;
  bool generators = false;
  bool verify = false;
  bool follow = false;
  bool quiet = false;
};

/// A file that is emptied when the first thing is written to it: a script that turns out to be none costs no old log.
class FreshFile final : public std::filebuf {
 public:
  explicit FreshFile(std::string path) : path_{std::move(path)} {}

 protected:
  int_type overflow(int_type c) override { return ensure_open() ? std::filebuf::overflow(c) : traits_type::eof(); }
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    return ensure_open() ? std::filebuf::xsputn(text, size) : 0;
  }

 private:
  bool ensure_open() { return is_open() || open(path_, std::ios::out | std::ios::trunc) != nullptr; }

  std::string path_;
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
  FreshFile log_file(arguments.log);
  std::ostream log(&log_file);
  if (!arguments.log.empty()) {
    if (is_same_file(arguments.file, arguments.log)) {
      return wrong_usage("--log would write over the script; give it another file");
    }
    if (!std::ofstream(arguments.log, std::ios::app)) {
      return wrong_usage("cannot write " + arguments.log);
    }
    options.log = &log;
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
  const Outcome outcome = replay::replay(script, options, reporter.get(), std::cerr, progress.get());
  std::cout << std::flush;
  if (standard_input.is_unreadable()) {
    return wrong_usage("cannot read standard input");
  }
  if (!std::cout) {
    return wrong_usage("cannot write to standard output");
  }
  if (options.log != nullptr && !log) {
    return wrong_usage("cannot write " + arguments.log);
  }
  return static_cast<int>(outcome);
}

}  // namespace

CLI::Validator from_one_on() {
  return CLI::Validator(
      [](const std::string& text) {
        const bool is_number = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
        return is_number && text.find_first_not_of('0') != std::string::npos
                   ? std::string{}
                   : "\"" + text + "\" should be a whole number from 1 on";
      },
      "");
}

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
  command->add_option("--log", arguments->log, "Keep the operations that were applied in this file");
  command->add_flag("--follow", arguments->follow, "Go on as the file grows, until Ctrl-C");
  command->add_flag("--quiet", arguments->quiet, "No table and no progress: errors only (and what --json prints)");
  command->footer(
      "Exit status: 0 done, 1 wrong usage or unreadable file, 2 the script is wrong, 3 an expect failed,\n"
      "4 a law failed under --verify or an internal error, 130 interrupted by Ctrl-C.");
  command->callback([arguments, &status] { status = run_replay(*arguments); });
}

}  // namespace sesame::tools

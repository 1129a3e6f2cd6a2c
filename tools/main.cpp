// sesame: the program. Results go to standard output, messages and progress to standard error.
#include <fcntl.h>
#include <flint/flint.h>
#include <gmp.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <new>

#include "replay/script/replay.hpp"
#include "sesame/version.hpp"
#include "sparse/contract.hpp"
#include "tools/commands/command_line.hpp"
#include "tools/commands/commands.hpp"
#include "tools/commands/log_file.hpp"
#include "tools/commands/program_log.hpp"

namespace {

using sesame::replay::Outcome;

constexpr int wrong_usage = static_cast<int>(Outcome::wrong_usage);

std::function<bool(CLI::App*)> is_named(const std::string& name) {
  return [name](CLI::App* command) { return command->get_name() == name; };
}

/// `sesame help [COMMAND]`, as everyone expects beside `--help`.
void add_help_command(CLI::App& app, int& status) {
  CLI::App* help = app.add_subcommand("help", "Explain a command");
  auto topic = std::make_shared<std::string>();
  help->add_option("COMMAND", *topic, "The command to explain");
  help->callback([&app, &status, topic] {
    if (topic->empty()) {
      std::cout << app.get_formatter()->make_help(&app, app.get_name(),
                                                  CLI::AppFormatMode::Normal);  // help() would explain this
      return;
    }
    const std::vector<CLI::App*> found = app.get_subcommands(is_named(*topic));
    if (found.empty()) {
      std::cerr << "sesame help: " << sesame::tools::unknown_command(app, *topic) << '\n';
      status = wrong_usage;
      return;
    }
    std::cout << found.front()->help(app.get_name());
  });
}

[[noreturn]] void end_for_want_of_memory() {
  sesame::tools::settle_log_at_sudden_end();
  std::cerr << "sesame: out of memory\n";
  std::_Exit(static_cast<int>(Outcome::limit_reached));
}

/// Memory for where no exception can pass: it is let go when there is no other, so that a computation comes to the next
/// place from where one can. There allocations fail, a step is given up, and then there is room for the reserve again.
class Reserve {
 public:
  static Reserve& instance() {
    static Reserve reserve;
    return reserve;
  }
  /// Whether there was something to let go.
  bool let_go() {
    const bool was_there = memory_ != nullptr;
    std::free(memory_);
    memory_ = nullptr;
    waits_ = calls_between_tries;
    return was_there;
  }
  /// After an allocation that was a success.
  void restore_now_and_then() {
    if (memory_ == nullptr && --waits_ <= 0) {
      memory_ = std::malloc(size);
      waits_ = calls_between_tries;
    }
  }

 private:
  Reserve() : memory_{std::malloc(size)} {}

  static constexpr std::size_t size = std::size_t{4} << 20;
  static constexpr int calls_between_tries = 10'000;
  void* memory_;
  int waits_ = calls_between_tries;
};

template <class Allocate>
void* checked(Allocate&& allocate) {
  void* memory = allocate();
  if (memory == nullptr && Reserve::instance().let_go()) {
    memory = allocate();
  }
  if (memory == nullptr) {
    end_for_want_of_memory();
  }
  Reserve::instance().restore_now_and_then();
  return memory;
}

std::terminate_handler default_end = nullptr;

/// Where no exception can pass: in GMP and FLINT, which would abort without a word of ours, and in destructors that
/// allocate, as those of nlohmann::json do. What was written stays, but for a step that was not done: logs are written
/// step by step.
void expect_memory_to_run_out_anywhere() {
  (void)Reserve::instance();
  mp_set_memory_functions([](std::size_t size) { return checked([size] { return std::malloc(size); }); },
                          [](void* memory, std::size_t /*old*/, std::size_t size) {
                            return checked([memory, size] { return std::realloc(memory, size); });
                          },
                          [](void* memory, std::size_t /*size*/) { std::free(memory); });
  __flint_set_memory_functions(
      [](std::size_t size) { return checked([size] { return std::malloc(size); }); },
      [](std::size_t count, std::size_t size) { return checked([count, size] { return std::calloc(count, size); }); },
      [](void* memory, std::size_t size) {
        return checked([memory, size] { return std::realloc(memory, size + (size == 0)); });
      },
      std::free);
  default_end = std::set_terminate([] {
    try {
      if (const std::exception_ptr error = std::current_exception()) {
        std::rethrow_exception(error);
      }
    } catch (const std::bad_alloc&) {
      end_for_want_of_memory();
    } catch (...) {
    }
    default_end();
  });
}

int run(int argc, char** argv, sesame::tools::ProgramLog& log) {
  // Never destroyed: what a command has left in it, such as the engine of a replay, takes long to free, and the program
  // ends.
  static CLI::App& app = *new CLI::App{"sesame: integer homology, live, while an object is built", "sesame"};
  app.set_version_flag("--version", std::string{"sesame "} + SESAME_VERSION);
  app.require_subcommand(1);
  int status = 0;
  sesame::tools::add_replay_command(app, status);
  sesame::tools::add_verify_command(app, status);
  sesame::tools::add_info_command(app, status);
  sesame::tools::add_import_command(app, status);
  sesame::tools::add_export_command(app, status);
  sesame::tools::add_mesh_command(app, status);
  sesame::tools::add_generate_command(app, status);
  sesame::tools::add_tower_command(app, status);
  sesame::tools::add_zigzag_command(app, status);
  sesame::tools::add_distance_command(app, status);
  sesame::tools::add_bench_command(app, status);
  for (CLI::App* command : app.get_subcommands({})) {
    log.add_options(*command);
  }
  add_help_command(app, status);
  app.parse_complete_callback([&] {  // comes before the command's own callback
    if (const sesame::Status started = log.start(*app.get_subcommands().front()); !started) {
      throw CLI::ValidationError("--log-file", started.error().what);
    }
  });
  if (argc < 2) {
    std::cerr << app.help();
    return wrong_usage;
  }
  if (argv[1][0] != '-' && app.get_subcommands(is_named(argv[1])).empty()) {
    std::cerr << "sesame: " << sesame::tools::unknown_command(app, argv[1]) << '\n';
    return wrong_usage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) {
      return app.exit(e);
    }
    // What was not expected comes first: it explains whatever else is missing.
    const std::string unexpected = sesame::tools::unexpected_arguments(app);
    const std::string name = sesame::tools::name_of_chosen(app);
    std::cerr << name << ": " << (unexpected.empty() ? e.what() : unexpected) << "; see " << name << " --help\n";
    return wrong_usage;
  }
  return status;
}

/// A standard stream that is closed would lend its number to the next file that is opened, and what is meant for the
/// stream would go there. It becomes one that can be neither read nor written.
void keep_numbers_of_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) == -1) {
      (void)open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);  // takes the lowest number that is free
    }
  }
}

/// The exit status, when all that went to standard output and to the log has got there.
int after_output(int status, sesame::tools::ProgramLog& log) {
  std::cout << std::flush;
  const sesame::Status logged = log.finish();
  if (!std::cout) {
    std::cerr << "sesame: cannot write to standard output\n";
  } else if (!logged) {
    std::cerr << "sesame: --log-file: " << logged.error().what << '\n';
  }
  return std::cout && (logged || status != 0) ? status : wrong_usage;
}

}  // namespace

int main(int argc, char** argv) {
  keep_numbers_of_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow any more is an error of writing like any other
  std::ios::sync_with_stdio(false);
  expect_memory_to_run_out_anywhere();
  try {
    sesame::tools::ProgramLog log;
    return after_output(run(argc, argv, log), log);
  } catch (const std::bad_alloc&) {
    end_for_want_of_memory();
  } catch (const std::exception& e) {
    std::cerr << "sesame: internal error: " << e.what() << '\n';
  }
  return static_cast<int>(Outcome::law_failed);
}

// sesame: the program. Results go to standard output, messages and progress to standard error.
#include <spdlog/cfg/env.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <exception>
#include <functional>
#include <iostream>
#include <new>

#include "replay/replay.hpp"
#include "sesame/version.hpp"
#include "sparse/contract.hpp"
#include "tools/commands.hpp"

namespace {

using sesame::replay::Outcome;

std::function<bool(CLI::App*)> is_named(const std::string& name) {
  return [name](CLI::App* command) { return command->get_name() == name; };
}

/// `sesame help [COMMAND]`, as everyone expects beside `--help`.
void add_help_command(CLI::App& app) {
  CLI::App* help = app.add_subcommand("help", "Explain a command");
  auto topic = std::make_shared<std::string>();
  help->add_option("COMMAND", *topic, "The command to explain");
  help->callback([&app, topic] {
    if (topic->empty()) {
      std::cout << app.help();
      return;
    }
    const std::vector<CLI::App*> found = app.get_subcommands(is_named(*topic));
    if (found.empty()) {
      throw CLI::ValidationError("help", "there is no command \"" + *topic + "\"; see sesame --help");
    }
    std::cout << found.front()->help(app.get_name());
  });
}

int run(int argc, char** argv) {
  CLI::App app{"sesame: integer homology, live, while an object is built", "sesame"};
  app.set_version_flag("--version", std::string{"sesame "} + SESAME_VERSION);
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::simple);
  int status = 0;
  sesame::tools::add_replay_command(app, status);
  sesame::tools::add_import_command(app, status);
  sesame::tools::add_mesh_command(app, status);
  sesame::tools::add_generate_command(app, status);
  sesame::tools::add_tower_command(app, status);
  sesame::tools::add_distance_command(app, status);
  sesame::tools::add_bench_command(app, status);
  add_help_command(app);
  if (argc > 1 && argv[1][0] != '-' && app.get_subcommands(is_named(argv[1])).empty()) {
    std::cerr << "sesame: there is no command \"" << argv[1] << "\"; see sesame --help\n";
    return static_cast<int>(Outcome::wrong_usage);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : static_cast<int>(Outcome::wrong_usage);
  }
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  std::ios::sync_with_stdio(false);
  try {
    spdlog::set_default_logger(spdlog::stderr_color_st("sesame"));
    spdlog::cfg::load_env_levels();
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    std::cerr << "sesame: out of memory\n";
  } catch (const std::exception& e) {
    std::cerr << "sesame: internal error: " << e.what() << '\n';
  }
  return static_cast<int>(Outcome::law_failed);
}

/// \file
/// Runs of a subcommand inside a test.
#pragma once

#include <iostream>
#include <string>

#include "tests/support/captured.hpp"
#include "tools/commands/commands.hpp"

namespace sesame::tools {

struct CommandRun {
  int status = 0;
  std::string out, errors;
};

/// Runs the subcommand that `add` adds, with a line of arguments that begins with its name.
inline CommandRun run_command(void (*add)(CLI::App&, int&), const std::string& line) {
  CLI::App app{"", "sesame"};
  CommandRun run;
  add(app, run.status);
  const tests::Captured out(std::cout), errors(std::cerr);
  app.parse(line);
  run.out = out.text();
  run.errors = errors.text();
  return run;
}

}  // namespace sesame::tools

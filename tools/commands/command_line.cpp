#include "tools/commands/command_line.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace sesame::tools {
namespace {

/// The least number of letters to insert, leave out, replace, or swap with their neighbours, each letter once.
/// Source: the optimal string alignment distance.
std::size_t slips(const std::string& from, const std::string& to) {
  std::vector<std::size_t> before_last, last(to.size() + 1), row(to.size() + 1);
  std::iota(row.begin(), row.end(), 0U);
  for (std::size_t i = 1; i <= from.size(); ++i) {
    before_last = std::exchange(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1]) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
  }
  return row.back();
}

/// The subcommand that was chosen, or the program.
const CLI::App& chosen(const CLI::App& app) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  return parsed.empty() ? app : *parsed.front();
}

std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      names.push_back("--" + name);
    }
  }
  return names;
}

}  // namespace

std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
  const std::string* nearest = nullptr;
  std::size_t least = 1 + std::max<std::size_t>(1, word.size() / 3);
  for (const std::string& each : known) {
    if (const std::size_t distance = slips(word, each); distance < least) {
      least = distance;
      nearest = &each;
    }
  }
  return nearest == nullptr ? "" : "did you mean " + *nearest + "?";
}

std::string unknown_command(const CLI::App& app, const std::string& name) {
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands({})) {
    commands.push_back(command->get_name());
  }
  const std::string meant = suggestion(name, commands);
  return "there is no command \"" + name + "\"; " + (meant.empty() ? "see sesame --help" : meant);
}

std::string unexpected_arguments(const CLI::App& app) {
  const std::vector<std::string> options = options_of(chosen(app));
  std::string list;
  for (const std::string& argument : app.remaining(true)) {
    if (argument == "--") {
      continue;  // it stays among them when it did what it is for
    }
    list += (list.empty() ? "" : ", ") + argument;
    const std::string name = argument.substr(0, argument.find('='));
    if (std::find(options.begin(), options.end(), name) != options.end()) {
      list += " (it goes behind the command)";
    } else if (const std::string meant = name.starts_with("--") ? suggestion(name, options) : ""; !meant.empty()) {
      list += " (" + meant + ")";
    }
  }
  return list.empty() ? "" : "not expected: " + list;
}

std::string name_of_chosen(const CLI::App& app) {
  const CLI::App& command = chosen(app);
  return &command == &app ? app.get_name() : app.get_name() + " " + command.get_name();
}

}  // namespace sesame::tools

/// \file
/// What is said of a command line that names something that there is not.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace sesame::tools {

/// "did you mean replay?" for "repaly": the nearest of the known words, when it is a slip or two away, or nothing.
[[nodiscard]] std::string suggestion(const std::string& word, const std::vector<std::string>& known);

/// "there is no command \"repaly\"; did you mean replay?"
[[nodiscard]] std::string unknown_command(const CLI::App& app, const std::string& name);

/// What a parse has left over, in the order in which it came, with suggestions for misspelt options; nothing when
/// everything was taken.
[[nodiscard]] std::string unexpected_arguments(const CLI::App& app);

/// "sesame replay", or "sesame" when no command was recognised.
[[nodiscard]] std::string name_of_chosen(const CLI::App& app);

}  // namespace sesame::tools

/// \file
/// Kinds of options that several subcommands have, with one wording for what is wrong with their values.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "replay/script/generators.hpp"

namespace sesame::tools {

/// Accepts whole numbers from 0 on, or from 1 on.
[[nodiscard]] CLI::Validator from_zero_on();
[[nodiscard]] CLI::Validator from_one_on();

/// Reads sizes in bytes, "500M", "1.5 GB", into an option; k, M, G and T are powers of 1024.
CLI::Option* add_size(CLI::App& command, const std::string& name, std::uint64_t& bytes, const std::string& description);

/// Accepts numbers above 0.
[[nodiscard]] CLI::Validator above_zero();

/// Accepts these words only.
[[nodiscard]] CLI::Validator one_of(const std::vector<std::string>& words);

/// "auto|tower|phat": the words as the help shows them.
[[nodiscard]] std::string alternatives(const std::vector<std::string>& words);

template <class T>
using Choices = std::vector<std::pair<std::string, T>>;

/// An option whose value has a name. CLI11's own transformers would take numbers too, and say `{auto->0,...}`.
template <class T>
CLI::Option* add_choice(CLI::App& command, const std::string& name, T& value, const Choices<T>& choices,
                        const std::string& description) {
  std::vector<std::string> words;
  for (const auto& choice : choices) {
    words.push_back(choice.first);
  }
  const auto choose = [&value, choices](const std::string& word) {
    value = std::find_if(choices.begin(), choices.end(), [&](const auto& c) { return c.first == word; })->second;
  };
  return command.add_option_function<std::string>(name, choose, description)
      ->check(one_of(words))
      ->type_name(alternatives(words));
}

/// Adds --generators[=DEGREES]. `options` stays empty when no generators are asked for.
CLI::Option* add_generators_option(CLI::App& command, std::optional<replay::GeneratorOptions>& options,
                                   const std::string& description);

/// Adds --generators[=DEGREES] and --max-terms.
void add_generator_options(CLI::App& command, std::optional<replay::GeneratorOptions>& options,
                           const std::string& description);

}  // namespace sesame::tools

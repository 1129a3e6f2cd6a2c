#include "tools/commands/options.hpp"

#include <cmath>

namespace sesame::tools {
namespace {

bool is_whole_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

std::string should_be(const std::string& text, const std::string& what) { return "\"" + text + "\" should be " + what; }

}  // namespace

CLI::Validator from_zero_on() {
  return {
      [](const std::string& text) { return is_whole_number(text) ? "" : should_be(text, "a whole number from 0 on"); },
      ""};
}

CLI::Validator from_one_on() {
  return {[](const std::string& text) {
            const bool is_right = is_whole_number(text) && text.find_first_not_of('0') != std::string::npos;
            return is_right ? "" : should_be(text, "a whole number from 1 on");
          },
          ""};
}

CLI::Option* add_size(CLI::App& command, const std::string& name, std::uint64_t& bytes,
                      const std::string& description) {
  return command.add_option(name, bytes, description)->transform(CLI::AsSizeValue(false))->type_name("SIZE");
}

CLI::Validator above_zero() {
  return {[](const std::string& text) {
            double number = 0;
            const bool is_right = CLI::detail::lexical_cast(text, number) && std::isfinite(number) && number > 0;
            return is_right ? "" : should_be(text, "a number above 0");
          },
          ""};
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  return {[words](const std::string& text) {
            if (std::find(words.begin(), words.end(), text) != words.end()) {
              return std::string{};
            }
            std::string list;
            for (const std::string& word : words) {
              list += (list.empty() ? "" : word == words.back() ? " or " : ", ") + word;
            }
            return should_be(text, list);
          },
          ""};
}

CLI::Option* add_generators_option(CLI::App& command, std::optional<replay::GeneratorOptions>& options,
                                   const std::string& description) {
  const auto choose = [&options](const CLI::results_t& given) {
    options.emplace();
    if (given.front() != "true") {  // which is what stands for no value
      auto degrees = replay::parse_degrees(given.front());
      if (!degrees) {
        throw CLI::ValidationError("--generators", degrees.error().what);
      }
      options->degrees = std::move(*degrees);
    }
    return true;
  };
  return command.add_option("--generators", choose, description)
      ->expected(0)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast)
      ->option_text("[=DEGREES]");
}

void add_generator_options(CLI::App& command, std::optional<replay::GeneratorOptions>& options,
                           const std::string& description) {
  CLI::Option* generators = add_generators_option(command, options, description);
  const auto limit = [&options](std::uint64_t terms) {
    if (options) {
      options->most_terms = terms;
    }
  };
  command.add_option_function<std::uint64_t>("--max-terms", limit, "Give chains of more terms by their length only")
      ->check(from_zero_on())
      ->type_name("N")
      ->needs(generators);
}

std::string alternatives(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) {
    list += (list.empty() ? "" : "|") + word;
  }
  return list;
}

}  // namespace sesame::tools

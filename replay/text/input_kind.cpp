#include "replay/text/input_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "replay/text/line_words.hpp"

namespace sesame::replay {
namespace {

constexpr std::string_view mesh_commands = "a mesh: `sesame mesh` reports on it, `sesame import` makes a script of it";
constexpr std::string_view tower_command = "a tower, which `sesame tower` reads";
constexpr std::string_view script_command = "a script, which `sesame replay` reads";
constexpr std::string_view number_commands =
    "a list of numbers: `sesame tower` reads towers, boundary matrices and filtrations, `sesame distance` barcodes";

std::string lower(std::string_view text) {
  std::string small{text};
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return small;
}

bool has_mesh_name(std::string_view name) {
  constexpr std::array<std::string_view, 4> extensions{".off", ".obj", ".ply", ".stl"};
  const std::string small = lower(name);
  return std::ranges::any_of(extensions, [&](std::string_view extension) {
    return small.ends_with(extension) || small.ends_with(std::string{extension} + ".gz");
  });
}

/// Of the formats that sesame reads; OBJ files start with any of many words.
bool starts_mesh(std::string_view first_word) {
  constexpr std::array<std::string_view, 9> words{"ply", "solid", "v", "vn", "vt", "mtllib", "usemtl", "o", "g"};
  return std::ranges::find(words, first_word) != words.end() || lower(first_word).ends_with("off");
}

bool is_operation(std::string_view word) { return word == "i" || word == "c"; }

/// By the first line that says something; nothing when it is not known.
std::optional<std::string_view> kind_of(LineWords words) {
  const std::string_view first = words.take();
  if (first.starts_with('{')) {
    return script_command;
  }
  if (is_operation(first)) {
    return tower_command;
  }
  if (starts_mesh(first)) {
    return mesh_commands;
  }
  double number = 0;
  if (!LineWords(first).take_number(number)) {
    return std::nullopt;
  }
  return is_operation(words.word()) ? tower_command : number_commands;
}

std::optional<std::string_view> kind_of_text(std::string_view text) {
  text = without_mark(text);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const LineWords words(text.substr(0, end));
    if (!words.is_done()) {
      return kind_of(words);
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return std::nullopt;
}

}  // namespace

std::string advice_on(std::string_view beginning, std::string_view name, std::string_view command) {
  std::optional<std::string_view> kind = kind_of_text(beginning);
  if (!kind && has_mesh_name(name)) {
    kind = mesh_commands;
  }
  if (!kind || kind->find(command) != std::string_view::npos) {
    return "";
  }
  return fmt::format(" (it looks like {})", *kind);
}

}  // namespace sesame::replay

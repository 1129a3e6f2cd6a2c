#include "replay/text/line_words.hpp"

#include <fmt/format.h>

namespace sesame::replay {

std::string shown(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text{word.substr(0, longest)};
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return fmt::format("\"{}{}\"", text, word.size() > longest ? "..." : "");
}

std::string_view without_mark(std::string_view line) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (line.starts_with(byte_order_mark)) {
    line.remove_prefix(byte_order_mark.size());
  }
  return line;
}

}  // namespace sesame::replay

#include "replay/text_buffer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace sesame::replay {
namespace {

constexpr std::size_t longest_number = 32;

/// Writes at `to`, which has room for longest_number characters; returns the end.
char* write_number(char* to, double x) {
  // By itself to_chars would write 2000000 as 2e+06.
  if (std::abs(x) < 1e15 && x == std::trunc(x)) {
    return std::to_chars(to, to + longest_number, static_cast<std::int64_t>(x)).ptr;
  }
  return std::to_chars(to, to + longest_number, x).ptr;
}

}  // namespace

std::string number_text(double x) {
  char text[longest_number];
  return {text, write_number(text, x)};
}

std::string short_number_text(double x) { return x == std::trunc(x) ? number_text(x) : fmt::format("{:.6g}", x); }

TextBuffer& TextBuffer::add_number(double x) {
  char text[longest_number];
  return add(std::string_view{text, write_number(text, x)});
}

void TextBuffer::flush() {
  out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
  text_.clear();
}

}  // namespace sesame::replay

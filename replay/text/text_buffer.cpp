#include "replay/text/text_buffer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace sesame::replay {
namespace {

constexpr std::size_t longest_number = 32;

/// Writes at `to`, which has room for longest_number characters; returns the end.
char* write_number(char* to, double x) {
  constexpr double two_to_53 = 9007199254740992.0;
  if (std::abs(x) > two_to_53) {
    return std::to_chars(to, to + longest_number, x, std::chars_format::scientific).ptr;
  }
  // By itself to_chars would write 2000000 as 2e+06.
  return x == std::trunc(x) ? std::to_chars(to, to + longest_number, static_cast<std::int64_t>(x)).ptr
                            : std::to_chars(to, to + longest_number, x).ptr;
}

char* write_number(char* to, engine::Time time) {
  if (!time.is_large()) {
    return write_number(to, time.nearest());
  }
  const std::uint64_t digits = time.modulo_2_64();
  return time.nearest() < 0 ? std::to_chars(to, to + longest_number, static_cast<std::int64_t>(digits)).ptr
                            : std::to_chars(to, to + longest_number, digits).ptr;
}

}  // namespace

std::string number_text(double x) {
  char text[longest_number];
  return {text, write_number(text, x)};
}

std::string short_number_text(double x) { return x == std::trunc(x) ? number_text(x) : fmt::format("{:.6g}", x); }

std::string short_number_text(engine::Time time) {
  return time.is_large() ? number_text(time) : short_number_text(time.nearest());
}

std::string number_text(engine::Time time) {
  char text[longest_number];
  return {text, write_number(text, time)};
}

std::string json_number_text(engine::Time time) {
  return time.is_large() ? '"' + number_text(time) + '"' : number_text(time);
}

TextBuffer& TextBuffer::add_number(double x) {
  char text[longest_number];
  return add(std::string_view{text, write_number(text, x)});
}

TextBuffer& TextBuffer::add_number(engine::Time time) {
  char text[longest_number];
  return add(std::string_view{text, write_number(text, time)});
}

TextBuffer& TextBuffer::add_json_number(engine::Time time) {
  return time.is_large() ? add('"').add_number(time).add('"') : add_number(time);
}

void TextBuffer::flush() {
  out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
  text_.clear();
}

}  // namespace sesame::replay

/// \file
/// Text on its way to a stream, for outputs with millions of numbers.
#pragma once

#include <charconv>
#include <concepts>
#include <ostream>
#include <string>
#include <string_view>

namespace sesame::replay {

/// The shortest text that reads back as the same double: "3", "0.1", "1e-07", "inf", "-inf".
[[nodiscard]] std::string number_text(double x);

/// To six digits, for people: "0.333333", "1e-07", "3"; whole numbers in full.
[[nodiscard]] std::string short_number_text(double x);

/// Collects text and hands it to a stream in large pieces, the last one when it is destroyed. Numbers are written as
/// by number_text, whatever the locale: streams and formatting libraries take several times as long.
class TextBuffer {
 public:
  explicit TextBuffer(std::ostream& out) : out_{out} { text_.reserve(capacity); }
  TextBuffer(const TextBuffer&) = delete;
  TextBuffer& operator=(const TextBuffer&) = delete;
  ~TextBuffer() { flush(); }

  TextBuffer& add(std::string_view text) {
    text_ += text;
    return ended();
  }
  TextBuffer& add(char c) {
    text_ += c;
    return ended();
  }
  template <std::integral Integer>
  TextBuffer& add_integer(Integer x) {
    char digits[24];
    return add(std::string_view{digits, std::to_chars(digits, digits + sizeof digits, x).ptr});
  }
  TextBuffer& add_number(double x);

  void flush();

 private:
  static constexpr std::size_t capacity = std::size_t{1} << 16;

  TextBuffer& ended() {
    if (text_.size() >= capacity - 64) flush();
    return *this;
  }

  std::ostream& out_;
  std::string text_;
};

}  // namespace sesame::replay

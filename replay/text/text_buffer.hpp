/// \file
/// Text on its way to a stream, for outputs with millions of numbers.
#pragma once

#include <charconv>
#include <concepts>
#include <ostream>
#include <string>
#include <string_view>

#include "engine/towers/time.hpp"

namespace sesame::replay {

/// A short text that reads back as the same double: "3", "2000000", "0.1", "1e-07", "inf", "-inf". Beyond 2^53 it has
/// an exponent: digits alone are for whole numbers that are known exactly.
[[nodiscard]] std::string number_text(double x);
/// All digits of a whole number, and other times as doubles.
[[nodiscard]] std::string number_text(engine::Time time);
/// The same as JSON, whose readers take numbers for doubles: a whole number beyond 2^53 is a string of digits.
[[nodiscard]] std::string json_number_text(engine::Time time);

/// To six digits, for people: "0.333333", "1e-07", "3"; whole numbers in full.
[[nodiscard]] std::string short_number_text(double x);
[[nodiscard]] std::string short_number_text(engine::Time time);

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
  TextBuffer& add_number(engine::Time time);
  /// As by json_number_text.
  TextBuffer& add_json_number(engine::Time time);

  void flush();

 private:
  static constexpr std::size_t capacity = std::size_t{1} << 16;

  TextBuffer& ended() {
    if (text_.size() >= capacity - 64) {
      flush();
    }
    return *this;
  }

  std::ostream& out_;
  std::string text_;
};

}  // namespace sesame::replay

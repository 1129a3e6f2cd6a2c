/// \file
/// The words of a line of text, taken from the front.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>

namespace sesame::replay {

/// A word as messages show it: in quotes, printable, and cut when it is long.
[[nodiscard]] std::string shown(std::string_view word);

/// The first line of a text without the byte order mark that may be there.
[[nodiscard]] std::string_view without_mark(std::string_view line);

/// Words lie between white space; a `#` at the beginning of a word starts a comment, which has none.
class LineWords {
 public:
  explicit LineWords(std::string_view line) : at_{line.data()}, end_{line.data() + line.size()} { skip_space(); }

  [[nodiscard]] bool is_done() const { return at_ == end_; }
  /// The first word; empty when there is none.
  [[nodiscard]] std::string_view word() const {
    return {at_, static_cast<std::size_t>(std::find_if(at_, end_, is_space) - at_)};
  }
  std::string_view take() {
    const std::string_view taken = word();
    at_ += taken.size();
    skip_space();
    return taken;
  }
  /// Takes the first word when all of it is a number of this type; otherwise nothing happens.
  template <class Number>
  bool take_number(Number& number) {
    const auto [stop, problem] = std::from_chars(at_, end_, number);
    if (problem != std::errc{} || (stop != end_ && !is_space(*stop))) {
      return false;
    }
    at_ = stop;
    skip_space();
    return true;
  }
  [[nodiscard]] std::size_t count() const {
    std::size_t count = 0;
    for (LineWords rest = *this; !rest.is_done(); rest.take()) {
      ++count;
    }
    return count;
  }

 private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  void skip_space() {
    at_ = std::find_if_not(at_, end_, is_space);
    if (at_ != end_ && *at_ == '#') {
      at_ = end_;
    }
  }

  const char* at_;
  const char* end_;
};

}  // namespace sesame::replay

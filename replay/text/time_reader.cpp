#include "replay/text/time_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "replay/text/line_words.hpp"
#include "replay/text/text_buffer.hpp"

namespace sesame::replay {
namespace {

using engine::Time;

template <class Number>
bool parse_as(std::string_view word, Time& time) {
  Number number{};
  const char* const end = word.data() + word.size();
  const auto [stop, problem] = std::from_chars(word.data(), end, number);
  if (problem != std::errc{} || stop != end) {
    return false;
  }
  time = number;
  return true;
}

/// What a word is; of a whole number that is too large, the time is the nearest double.
enum class Spelling { whole, too_large, other, no_number };

Spelling parse(std::string_view word, Time& time) {
  const bool has_digits_only = std::all_of(word.begin() + (word.starts_with('-') ? 1 : 0), word.end(),
                                           [](char c) { return c >= '0' && c <= '9'; });
  if (has_digits_only && (parse_as<std::int64_t>(word, time) || parse_as<std::uint64_t>(word, time))) {
    return Spelling::whole;
  }
  if (!parse_as<double>(word, time) || std::isnan(time.nearest())) {
    return Spelling::no_number;
  }
  return has_digits_only ? Spelling::too_large : Spelling::other;
}

}  // namespace

Result<Time> TimeReader::read(std::string_view word, std::string_view what, const std::string& name,
                              std::uint64_t line) {
  Time time;
  const Spelling spelling = parse(word, time);
  if (spelling == Spelling::no_number) {
    return Error{Errc::bad_input, fmt::format("{} should be {}", shown(word), what)};
  }
  if (spelling == Spelling::too_large) {
    return Error{Errc::bad_input,
                 fmt::format("{} should be {}: whole numbers have 64 bits at most, larger ones are written with an "
                             "exponent, as doubles, {}",
                             shown(word), what, number_text(time))};
  }
  if (!time.is_large() && (time.is_whole() || !time.is_finite())) {
    return time;
  }
  std::string& same = time.is_large() ? large_ : rounded_;
  const std::string& other = time.is_large() ? rounded_ : large_;
  if (same.empty()) {
    same = fmt::format("{}:{} has {}", name, line, word);
  }
  if (!other.empty()) {
    return Error{Errc::bad_input,
                 fmt::format("{}, but {}: whole numbers beyond 2^53 are exact, numbers with a point or an exponent are "
                             "rounded, and together they have no order; write all of them in one of the two ways",
                             word, other)};
  }
  return time;
}

}  // namespace sesame::replay

#include "tools/mesh/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <system_error>

namespace sesame::tools {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

std::string_view without_plus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') {
    word.remove_prefix(1);
  }
  return word;
}

}  // namespace

bool LineReader::next() {
  if (next_ >= text_.size()) {
    return false;
  }
  std::size_t end = next_;
  while (end < text_.size() && text_[end] != '\n' && text_[end] != '\r') {
    ++end;
  }
  line_ = text_.substr(next_, end - next_);
  const bool two = end + 1 < text_.size() && text_[end] == '\r' && text_[end + 1] == '\n';
  next_ = end + (two ? 2 : 1);
  ++number_;
  return true;
}

bool LineReader::next_with_words() {
  while (next()) {
    auto rest = without_comment(line_);
    if (!next_word(rest).empty()) {
      return true;
    }
  }
  return false;
}

Error LineReader::error_at(std::size_t line, std::string_view what) const {
  return {Errc::bad_input, fmt::format("{}:{}: {}", name_, line, what)};
}

std::string_view WordReader::next() {
  auto word = next_word(rest_);
  while (word.empty() && lines_.next()) {
    rest_ = comments_ == Comments::hash ? without_comment(lines_.line()) : lines_.line();
    word = next_word(rest_);
  }
  return word;
}

std::string_view WordReader::next_in_line() { return next_word(rest_); }

void WordReader::skip_lines_to_blank() {
  rest_ = {};
  for (std::string_view rest = "x"; !rest.empty() && lines_.next();) {
    rest = lines_.line();
    rest = next_word(rest);
  }
}

std::size_t WordReader::remaining() const {
  const auto text = lines_.text();
  if (!rest_.empty()) {
    return static_cast<std::size_t>(text.data() + text.size() - rest_.data());
  }
  return text.size() - std::min(lines_.offset(), text.size());
}

Error error_at_byte(std::string_view name, std::size_t byte, std::string_view what) {
  return {Errc::bad_input, fmt::format("{}: byte {}: {}", name, byte, what)};
}

std::string lower_case(std::string_view text) {
  std::string result{text};
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') {
      c = static_cast<char>(c - 'A' + 'a');
    }
  }
  return result;
}

std::string_view next_word(std::string_view& rest) {
  std::size_t begin = 0;
  while (begin < rest.size() && is_blank(rest[begin])) {
    ++begin;
  }
  std::size_t end = begin;
  while (end < rest.size() && !is_blank(rest[end])) {
    ++end;
  }
  const auto word = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return word;
}

std::string_view without_comment(std::string_view line) { return line.substr(0, line.find('#')); }

bool parse_integer(std::string_view word, std::int64_t& value) {
  word = without_plus(word);
  const auto* end = word.data() + word.size();
  const auto [stop, problem] = std::from_chars(word.data(), end, value);
  return problem == std::errc{} && stop == end;
}

bool parse_real(std::string_view word, double& value) {
  word = without_plus(word);
  const auto* end = word.data() + word.size();
  const auto [stop, problem] = std::from_chars(word.data(), end, value);
  if (stop != end || problem == std::errc::invalid_argument) {
    return false;
  }
  // from_chars reports numbers that are too large and too small alike; strtod tells them apart.
  if (problem == std::errc::result_out_of_range) {
    value = std::strtod(std::string{word}.c_str(), nullptr);
  }
  return true;
}

bool parse_coordinate(std::string_view word, double& value) { return parse_real(word, value) && std::isfinite(value); }

std::string printable(std::string_view text) {
  std::string result{text};
  for (char& c : result) {
    if (c < ' ' || c > '~') {
      c = '?';
    }
  }
  return result;
}

std::string shown(std::string_view word) {
  constexpr std::size_t longest = 40;
  if (word.empty()) {
    return "nothing";
  }
  return fmt::format("`{}{}`", printable(word.substr(0, longest)), word.size() > longest ? "..." : "");
}

std::string not_a_coordinate(std::string_view word) {
  double value = 0;
  if (parse_real(word, value)) {
    return fmt::format("{} is not finite, a coordinate is a finite number", shown(word));
  }
  return fmt::format("{} is not a number, a coordinate is one like 0.25 or -1e-3", shown(word));
}

std::string counted(std::size_t n, std::string_view thing, std::string_view things) {
  return fmt::format("{} {}", n, n == 1 ? thing : things);
}

}  // namespace sesame::tools

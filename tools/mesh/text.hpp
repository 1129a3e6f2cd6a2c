/// \file
/// Lines, words and numbers of mesh files in text form.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "sparse/result.hpp"

namespace sesame::tools {

/// A cursor over the lines of a text. A line ends with \n, \r\n, or a lone \r.
class LineReader {
 public:
  LineReader(std::string_view text, std::string_view name) : text_{text}, name_{name} {}

  /// Moves to the next line; false, and nothing changes, at the end of the text.
  bool next();
  /// Moves to the next line that has a word before any `#`.
  bool next_with_words();

  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] std::size_t number() const { return number_; }
  /// Where the text after the present line begins.
  [[nodiscard]] std::size_t offset() const { return next_; }
  /// The text as a whole, not only what is left.
  [[nodiscard]] std::string_view text() const { return text_; }

  /// `NAME:LINE: what`, for the present line or a given one.
  [[nodiscard]] Error error(std::string_view what) const { return error_at(number_, what); }
  [[nodiscard]] Error error_at(std::size_t line, std::string_view what) const;

 private:
  std::string_view text_;
  std::string_view name_;
  std::string_view line_;
  std::size_t next_ = 0;
  std::size_t number_ = 0;
};

/// A cursor over the words of a text in which lines may break anywhere.
class WordReader {
 public:
  enum class Comments { none, hash };  ///< whether `#` begins a comment up to the end of the line

  /// Starts with what follows the present line.
  WordReader(LineReader lines, Comments comments) : lines_{lines}, comments_{comments} {}

  /// The next word; empty at the end of the text.
  std::string_view next();
  /// The next word of the present line; empty at its end.
  std::string_view next_in_line();
  /// Skips what is left of the present line.
  void skip_line() { rest_ = {}; }
  /// Skips that and all lines up to one without words.
  void skip_lines_to_blank();

  /// How many bytes of the text are left.
  [[nodiscard]] std::size_t remaining() const;
  /// The line that the last word stands on.
  [[nodiscard]] const LineReader& lines() const { return lines_; }
  /// `NAME:LINE: what`, for that line.
  [[nodiscard]] Error error(std::string_view what) const { return lines_.error(what); }

 private:
  LineReader lines_;
  Comments comments_;
  std::string_view rest_;
};

/// `NAME: byte N: what`, for binary files.
[[nodiscard]] Error error_at_byte(std::string_view name, std::size_t byte, std::string_view what);

/// The text with the letters A to Z in lower case.
[[nodiscard]] std::string lower_case(std::string_view text);

/// Cuts the first word off `rest`; empty when none is left.
[[nodiscard]] std::string_view next_word(std::string_view& rest);
/// The part of a line before `#`.
[[nodiscard]] std::string_view without_comment(std::string_view line);

/// The whole word as a number; a leading `+` is allowed. A number too close to 0 for a double reads as 0.
[[nodiscard]] bool parse_integer(std::string_view word, std::int64_t& value);
[[nodiscard]] bool parse_real(std::string_view word, double& value);
/// As parse_real, but finite.
[[nodiscard]] bool parse_coordinate(std::string_view word, double& value);

/// A word as messages show it: in quotes, printable, cut when long; `nothing` when empty.
[[nodiscard]] std::string shown(std::string_view word);
/// The text with everything but printable ASCII replaced by `?`.
[[nodiscard]] std::string printable(std::string_view text);
/// The sentence for a word that parse_coordinate refused, or for a missing one.
[[nodiscard]] std::string not_a_coordinate(std::string_view word);

/// "1 face", "2 faces".
[[nodiscard]] std::string counted(std::size_t n, std::string_view thing, std::string_view things);

}  // namespace sesame::tools

/// \file
/// The lines of a text of any length.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "replay/text/byte_source.hpp"
#include "sparse/result.hpp"

namespace sesame::replay {

/// The most bytes of a line, unless the caller says otherwise. A mesh is one line of a script (`sesame import`), and
/// one of a million triangles takes 170 MB; a file that has no lines at all should not take all the memory.
inline constexpr std::size_t longest_line = std::size_t{1} << 30;

/// Where the line that begins at `begin` ends in the window of a source: at a line feed, or where the input ends.
/// Errors: those of the source; bad_input for a line, of this number, that is longer than `longest`, or has a zero
/// byte: data that are no text may have no lines, and are not to be read to their end.
Result<std::size_t> find_line_end(ByteSource& source, std::size_t begin, std::uint64_t line, std::size_t longest);

/// Reads line by line, nothing after an error. A line that was still being written when the input was stopped is none.
class LineSource {
 public:
  explicit LineSource(ByteSource source, std::size_t longest = longest_line)
      : source_{std::move(source)}, longest_{longest} {}

  /// To be called before `next`: the first line that says something, and those before it; but not what comes behind a
  /// zero byte, which no text has, or behind 64 KiB. It does not depend on the pieces in which the input comes.
  /// Errors: those of the source.
  Result<std::string_view> beginning();
  /// The next line without its line feed, the first one without a byte order mark; nothing at the end. Valid until the
  /// next one is read. Errors: those of the source; bad_input, with its place, when a line is too long or has a zero
  /// byte.
  Result<std::optional<std::string_view>> next();
  /// Gives back the memory that the line read last has taken, if it was a long one; then it is not valid any more.
  void drop() { source_.shrink(); }
  /// The line read last, or that could not be read, counted from 1.
  [[nodiscard]] std::uint64_t line() const { return line_; }
  /// `NAME:LINE: ` of the line read last.
  [[nodiscard]] std::string place() const;
  /// Whether it had a line feed behind it; the last one of an input may have none.
  [[nodiscard]] bool has_end() const { return has_end_; }
  [[nodiscard]] const std::string& name() const { return source_.name(); }
  [[nodiscard]] bool is_stopped() const { return source_.is_stopped(); }
  /// Whether there is no further line.
  [[nodiscard]] bool is_done() const { return is_done_; }
  /// Whether it ended by an error.
  [[nodiscard]] bool is_broken() const { return is_broken_; }

 private:
  ByteSource source_;
  std::size_t longest_;
  std::uint64_t line_ = 0;
  bool is_done_ = false, is_broken_ = false, has_end_ = false;
};

}  // namespace sesame::replay

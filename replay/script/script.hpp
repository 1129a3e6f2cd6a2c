/// \file
/// Reading a construction script: JSON Lines with blank lines and comments, one operation at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "ops/vocabulary/operation.hpp"
#include "ops/vocabulary/operation_reader.hpp"
#include "replay/text/line_source.hpp"
#include "sparse/result.hpp"

namespace sesame::replay {

/// Reads a script line by line. Errors carry `NAME:LINE: what, and what would be right`, but for an input that cannot
/// be read (io). A script that was stopped ends before a line that has no end yet.
class ScriptReader {
 public:
  explicit ScriptReader(ByteSource source, std::size_t longest = longest_line) : lines_{std::move(source), longest} {}

  /// The header: the first object. To be called once, before `next`.
  Result<ops::Header> header();
  /// The next operation, or nothing at the end. After an error in a line it goes on behind it.
  Result<std::optional<ops::Operation>> next();
  /// The line that was read last, counted from 1.
  [[nodiscard]] std::uint64_t line() const { return lines_.line(); }
  /// `NAME:LINE: ` of the line read last.
  [[nodiscard]] std::string place() const { return lines_.place(); }
  /// Whether the input ended by an error, so that nothing can be read behind it.
  [[nodiscard]] bool is_broken() const { return lines_.is_broken(); }

 private:
  Result<std::optional<std::string_view>> next_object();

  LineSource lines_;
  ops::OperationReader reader_;
};

/// The number of operations in a script, its object lines but the header, or `most` when there are more.
/// Errors: those of the source.
Result<std::uint64_t> count_operations(ByteSource source,
                                       std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

}  // namespace sesame::replay

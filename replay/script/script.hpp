/// \file
/// Reading a construction script: JSON Lines with blank lines and comments, one operation at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "engine/durable/log_reader.hpp"
#include "ops/vocabulary/operation.hpp"
#include "replay/text/line_source.hpp"
#include "sparse/result.hpp"

namespace sesame::replay {

/// Reads a script line by line, and checks the lines of a log. Errors carry `NAME:LINE: what, and what would be right`,
/// but for an input that cannot be read (io). A script that was stopped ends before a line that has no end yet.
class ScriptReader {
 public:
  explicit ScriptReader(ByteSource source, std::size_t longest = longest_line) : lines_{std::move(source), longest} {}

  /// The header: the first object. To be called once, before `next`.
  Result<ops::Header> header();
  /// The next operation, or nothing at the end. After an error in a line it goes on behind it.
  Result<std::optional<ops::Operation>> next();
  /// What a log says of the steps before the operation read last, or before its end; once.
  std::optional<engine::Binding> binding() { return std::exchange(binding_, std::nullopt); }
  /// The line that was read last, counted from 1.
  [[nodiscard]] std::uint64_t line() const { return lines_.line(); }
  /// `NAME:LINE: ` of the line read last.
  [[nodiscard]] std::string place() const { return lines_.place(); }
  /// Whether it has been read to its end.
  [[nodiscard]] bool is_at_end() const { return lines_.is_done(); }
  /// Whether the input ended by an error, or is a log that is damaged, so that nothing can be read behind it.
  [[nodiscard]] bool is_broken() const { return lines_.is_broken() || records_.is_damaged(); }

 private:
  Result<engine::RecordReader::Entry> next_entry();

  LineSource lines_;
  engine::RecordReader records_;
  std::optional<engine::Binding> binding_;
};

/// The number of operations in a script, its object lines but the header, or `most` when there are more.
/// Errors: those of the source.
Result<std::uint64_t> count_operations(ByteSource source,
                                       std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

}  // namespace sesame::replay

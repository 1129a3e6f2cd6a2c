/// \file
/// Reading a construction script: JSON Lines with blank lines and comments, one operation at a time.
#pragma once

#include <cstdint>
#include <functional>
#include <istream>
#include <optional>
#include <string>

#include "ops/operation.hpp"
#include "sparse/result.hpp"

namespace sesame::replay {

/// Reads a script line by line. Errors carry `NAME:LINE: what, and what would be right`. A stream that becomes bad()
/// ends the script; why, is for its owner to say.
class ScriptReader {
 public:
  /// `name` is what errors call the input. `wait_for_more` (optional) is called at the end of the input; while it
  /// returns true the reader tries again, so that a file can be followed as it grows.
  ScriptReader(std::istream& input, std::string name, std::function<bool()> wait_for_more = {});

  /// The header: the first object. To be called once, before `next`.
  Result<ops::Header> header();
  /// The next operation, or nothing at the end.
  Result<std::optional<ops::Operation>> next();
  /// The line that was read last, counted from 1.
  [[nodiscard]] std::uint64_t line() const { return line_; }
  /// `NAME:LINE: ` of the line read last.
  [[nodiscard]] std::string place() const;

 private:
  bool read_object_line();

  std::istream& input_;
  std::string name_;
  std::function<bool()> wait_for_more_;
  std::string text_;
  std::uint64_t line_ = 0;
};

/// The number of operations in a script: its object lines but the header. Reads the input to its end.
std::uint64_t count_operations(std::istream& input);

}  // namespace sesame::replay

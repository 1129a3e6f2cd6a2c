/// \file
/// The common operations straight from the text of a line.
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "ops/vocabulary/operation.hpp"

namespace sesame::ops {

/// Reads lines as parse_operation does, and gives the same, but those of which scripts are long without a JSON value
/// in between: by simdjson, field after field, into the operation. It does so for lines that begin with the field "op",
/// say one of those operations, and have nothing wrong with them; every other line is left to parse_operation, which
/// is what tells a writer what is wrong.
class OperationReader {
 public:
  OperationReader();
  OperationReader(OperationReader&&) noexcept;
  OperationReader& operator=(OperationReader&&) noexcept;
  ~OperationReader();

  /// Errors: see parse_operation. Cost: that of the text.
  Result<Operation> read(std::string_view line);
  /// What `read` does not leave to parse_operation.
  [[nodiscard]] std::optional<Operation> read_common(std::string_view line);

 private:
  struct Text;
  std::unique_ptr<Text> text_;
};

}  // namespace sesame::ops

/// \file
/// One line of a log as a JSON value.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "ops/vocabulary/json_fields.hpp"

namespace sesame::ops {

/// The object that a line says.
class JsonLine {
 public:
  /// Throws Wrong: for what is no object, for a field that stands twice in one object, as one of the two would be lost
  /// without a word, and for lists deeper within one another than any operation has them. Cost: that of the text, n log
  /// n for an object with n fields.
  explicit JsonLine(std::string_view line);
  JsonLine(const JsonLine&) = delete;
  JsonLine& operator=(const JsonLine&) = delete;
  /// Wants no memory, as the destructor of a list or an object that is not empty would: it ends the program when there
  /// is none.
  ~JsonLine();

  [[nodiscard]] const Json& object() const { return object_; }

 private:
  JsonLine() = default;

  Json object_;
};

}  // namespace sesame::ops

/// \file
/// One line of a log as a JSON value.
#pragma once

#include <string_view>

#include "ops/vocabulary/json_fields.hpp"

namespace sesame::ops {

/// The object that a line says. Throws Wrong: for what is no object, and for a field that stands twice in one object,
/// as one of the two would be lost without a word. Cost: that of the text, n log n for an object with n fields.
[[nodiscard]] Json parse_json_line(std::string_view line);

}  // namespace sesame::ops

/// \file
/// Values that fields of several operations have: points and labels.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ops/vocabulary/cell_list.hpp"
#include "ops/vocabulary/json_fields.hpp"
#include "ops/vocabulary/json_text.hpp"

namespace sesame::ops {

/// Of the field "at", or a part of it: [x,y] or [x,y,z]. Throws Wrong.
[[nodiscard]] Point read_point(Fields& in, const Json& value);
/// The field "at" as a list of points, or an empty one. Throws Wrong.
[[nodiscard]] std::vector<Point> read_points(Fields& in);
/// The field "at", if there is one. Throws Wrong.
[[nodiscard]] std::optional<Point> read_point(Fields& in);

/// A label as a text: integers in decimal. Throws Wrong.
[[nodiscard]] std::string read_label(Fields& in, const std::string& field, const Json& value);
/// An integer that 64 bits can say as a number, any other label as a string.
void write_label(std::string_view label, JsonText& out);

}  // namespace sesame::ops

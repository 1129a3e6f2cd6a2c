/// \file
/// Lines that say operations on maps, of which scripts are long.
#pragma once

#include <string_view>

#include "ops/vocabulary/line_fields.hpp"
#include "ops/vocabulary/operation.hpp"

namespace sesame::ops::line {

/// An operation of a name, "polygon", "gmap", "sew" or "unsew". Throws LeftToOthers: it is another one, or something is
/// wrong with it.
[[nodiscard]] Operation read_of_maps(std::string_view op, json::object object);

}  // namespace sesame::ops::line

/// \file
/// Points in space as text, one a line.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "replay/text/byte_source.hpp"
#include "sparse/result.hpp"

namespace sesame::replay {

/// What a file of points says.
struct PointList {
  std::string name;                           ///< what messages call the file
  std::size_t coordinates = 0;                ///< on each line; 0 without lines
  std::vector<std::array<double, 3>> points;  ///< the first three of them; those that are not there are 0
};

/// Reads a point a line, that of vertex k on line k, counted from 0: 1 coordinate or more, finite numbers with blanks
/// or commas between them, as many on each line. Comments after `#`, and lines with nothing else, are no lines. Errors:
/// `NAME:LINE: what, and what would be right` (bad_input); those of the source.
[[nodiscard]] Result<PointList> read_points(ByteSource source);

}  // namespace sesame::replay

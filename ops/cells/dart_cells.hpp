/// \file
/// Which cells the darts of a map belong to.
#pragma once

#include <cstdint>
#include <vector>

#include "ops/maps/gmap.hpp"

namespace sesame::ops {

/// The cells of the darts of a map, by dimension and dart.
struct DartCells {
  struct Seen {
    std::uint32_t offset;  ///< of the cell among those of the map, or UINT32_MAX: it is gone, or degenerate
    Dart dart;             ///< which dart of its type it is
  };
  std::vector<std::vector<Seen>> of;
};

}  // namespace sesame::ops

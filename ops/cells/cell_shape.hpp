/// \file
/// The cells of maps, whose types are the maps of which they are balls' boundaries.
#pragma once

#include <cstdint>
#include <vector>

#include "ops/maps/gmap.hpp"

namespace sesame::ops {

/// What a cell of a map looks like that counts as a ball: its canonical boundary, a homology sphere, as one dart of it
/// sees it, its root. The darts are numbered from there (see rooted_at), and the cell is oriented so that the root
/// counts +1.
struct CellShape {
  /// A dart of a face, as the face sees it.
  struct Place {
    std::uint32_t face;
    Dart dart;
  };

  GMap boundary;
  std::vector<std::int8_t> signs;  ///< per dart
  std::vector<Dart> face_roots;    ///< per face: its least dart, from which it is seen
  std::vector<Place> places;       ///< per dart
};

/// The shape of a cell. Requires: the boundary is a homology sphere of dimension 1 at least, rooted at dart 0.
/// Cost: darts times involutions.
[[nodiscard]] CellShape shape_of(GMap boundary);

}  // namespace sesame::ops

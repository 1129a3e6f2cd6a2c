/// \file
/// The cells of a map, with their types and faces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ops/cells/cell_type.hpp"
#include "ops/cells/dart_cells.hpp"
#include "ops/maps/gmap.hpp"
#include "ops/maps/orbits.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// The cells of one dimension of a map, numbered in the order of their least darts. Each is of the canonical type of
/// its kind, so a dart of the map is some dart of that; the root is the least dart of the map that is its dart 0.
struct CellsOfMap {
  /// A cell of one dimension less, as it is seen from a dart of its type.
  struct Face {
    std::uint32_t cell;
    Dart dart;
  };

  Orbits orbits;
  std::vector<TypeId> types;  ///< per cell
  std::vector<Dart> roots;    ///< per cell: a dart of the map
  std::vector<Dart> places;   ///< per dart of the map: which dart of the type of its cell it is
  std::vector<Face> faces;    ///< of cell after cell
  std::vector<std::uint32_t> face_ends;

  [[nodiscard]] std::span<const Face> faces_of(std::uint32_t cell) const {
    const std::uint32_t begin = cell == 0 ? 0 : face_ends[cell - 1];
    return std::span{faces}.subspan(begin, face_ends[cell] - begin);
  }
};

/// The cells of a map by dimension.
/// Errors    refused, naming a dart: a cell whose canonical boundary is no homology sphere. Cost: n^2 times the darts,
///           and what new types cost.
[[nodiscard]] Result<std::vector<CellsOfMap>> cells_of_map(const GMap& map, TypeTable& types);

/// Which cells the darts belong to when the cells are put one after the other, by dimension.
[[nodiscard]] DartCells dart_cells(const std::vector<CellsOfMap>& cells);

}  // namespace sesame::ops

/// \file
/// The cells of a map or a chain of maps, with their types and faces.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "ops/cells/cell_type.hpp"
#include "ops/cells/dart_cells.hpp"
#include "ops/maps/chain_of_maps.hpp"
#include "ops/maps/gmap.hpp"
#include "ops/maps/orbits.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// The cells of one dimension of a map, numbered in the order of their least darts. Each is of the canonical type of
/// its kind, so a dart of the map is some dart of that; the root is the least dart of the map that is its dart 0. Of a
/// chain of maps the darts are those of a level.
///
/// A cell that is no ball has the shape of its `cones`, and its darts are those of that.
struct CellsOfMap {
  /// A cell of one dimension less, as it is seen from a dart of its type.
  struct Face {
    std::uint32_t cell;
    Dart dart;
  };

  Orbits orbits;
  std::vector<TypeId> types;  ///< per cell; none where it is no ball
  std::vector<Dart> roots;    ///< per cell: a dart of the map
  std::vector<Dart> places;   ///< per dart of the map: which dart of the type of its cell it is
  std::vector<Face> faces;    ///< of cell after cell
  std::vector<std::uint32_t> face_ends;
  std::map<std::uint32_t, const ConeShape*> cones;  ///< of the cells that are no balls

  [[nodiscard]] std::span<const Face> faces_of(std::uint32_t cell) const {
    const std::uint32_t begin = cell == 0 ? 0 : face_ends[cell - 1];
    return std::span{faces}.subspan(begin, face_ends[cell] - begin);
  }
};

/// From this dimension on a cell may be no ball, if it is one of the largest dimension of its map.
inline constexpr int least_cone_dimension = 2;

/// The cells of a map by dimension. Those of the largest need be no balls where `any_on_top` says so.
/// Errors    refused, naming a dart: a cell whose canonical boundary is no homology sphere. Cost: n^2 times the darts,
///           and what new types cost.
[[nodiscard]] Result<std::vector<CellsOfMap>> cells_of_map(const GMap& map, TypeTable& types, bool any_on_top = false);

/// How the i-cells of a chain of maps are looked at, each given by its least dart.
struct CellsSeen {
  /// The dart from which the cell is seen first: it is dart 0 of the type if the cell looks from there as the type
  /// does.
  std::function<Dart(int i, Dart least)> from;
  std::function<std::string(int i, Dart least)> title;  ///< "the 2-cell of dart 5", in errors
};
/// From their least darts, which name them.
[[nodiscard]] CellsSeen cells_seen_from_least_darts();
/// The cells of a chain of maps by dimension. Errors and cost: the same.
[[nodiscard]] Result<std::vector<CellsOfMap>> cells_of_chain(const ChainOfMaps& chain, const CellsSeen& seen,
                                                             TypeTable& types);

/// Of a canonical boundary over which there is no ball, as the rest of a sentence: "is not orientable".
[[nodiscard]] const char* why_no_sphere(const GMap& boundary);

/// Which cells the darts belong to when the cells are put one after the other, by dimension.
[[nodiscard]] DartCells dart_cells(const std::vector<CellsOfMap>& cells);

}  // namespace sesame::ops

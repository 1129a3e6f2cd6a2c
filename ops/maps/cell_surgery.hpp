/// \file
/// Local operations on the cells of maps: removal and insertion of a cell, and their duals, contraction and splitting.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "ops/maps/gmap.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// An n-G-map as these operations look at it, dart by dart, wherever it is kept.
struct DartView {
  int dimension;
  Dart size;  ///< new darts are numbered from here
  std::function<Dart(int i, Dart d)> alpha;
  std::function<std::string(Dart d)> name;  ///< for sentences
};
[[nodiscard]] DartView view_of(const GMap& map);

/// What becomes of the darts of a map. Those that are gone belong to the cell that was taken out, or shrunk; those that
/// are made to the new one.
struct CellSurgery {
  struct Image {
    int i;
    Dart dart, image;
  };
  std::vector<Dart> gone;
  Dart made = 0;
  std::vector<Image>
      images;  ///< where they are others, of darts that stay; of new darts, where they are no fixed points
};

/// The map without the i-cell of a dart, 0 <= i < n: what it lay between comes together. A dart b of another cell that
/// alpha_i led into the cell gets the first dart outside of it as its image that alpha_{i+1} and alpha_i, in turns,
/// reach from there. Where alpha_{i+1} fixes a dart on the way, this is b itself.
///
/// The homology is kept where (i+1)-cells that come together are different balls, as two faces on the two sides of an
/// edge are, and where the edge hangs loose in its face. Where a cell is on both sides it may fall apart, or another
/// one come about: then it is that of another object.
///
/// Source: G. Damiand, P. Lienhardt, "Removal and contraction for n-dimensional generalized maps" (2003).
/// Errors    refused, naming a dart: i is n or more; i < n - 1, and at a dart of the cell alpha_{i+1} and alpha_{i+2}
///           do not commute; there is nothing else in its component. Cost: the darts of the cell, times n.
[[nodiscard]] Result<CellSurgery> removal_of_cell(const DartView& map, int i, Dart d);

/// The map in which the i-cell of a dart, 1 <= i <= n, has shrunk, so that its (i-1)-cells come together: the removal
/// of the (n-i)-cell from the dual map. Where i > 1, alpha_{i-1} and alpha_{i-2} have to commute on the cell.
/// Source, errors and cost: likewise.
[[nodiscard]] Result<CellSurgery> contraction_of_cell(const DartView& map, int i, Dart d);

/// The map with a new i-cell that cuts an (i+1)-cell, so that its removal leads back.
///   i = 0   one dart: a vertex within its edge
///   i = 1   two darts: an edge across the 2-cell of both, from the corner of the one, between it and its image under
///           alpha_1, to the corner of the other; if they are of one corner, a loop. One dart: an edge from its corner
///           that hangs loose, with a new vertex
///   i = 2   darts d_1, ..., d_m, one for each edge of a closed path in the boundary of a 3-cell, all on one side of
///   the
///           path, with alpha_0(d_k) and d_{k+1} at one vertex: a face across the 3-cell
/// The first new darts are at d_1: the images under alpha_i of it and of what the involutions above alpha_{i+1} reach
/// from it, each followed by its image under alpha_{i+1}; and so on along the path, d_1, alpha_0(d_1), d_2, ....
///
/// Source: M. Baba-ali, G. Damiand, X. Skapin, D. Marcheix, "Insertion and expansion operations for n-dimensional
/// generalized maps" (2008).
/// Errors    refused, naming a dart: another i, or i >= n; not so many darts; darts that are i-free, or not of one
/// cell,
///           or no closed path; one that would be met twice. Cost: the darts of the (i+1)-cell, times n.
[[nodiscard]] Result<CellSurgery> insertion_of_cell(const DartView& map, int i, std::span<const Dart> darts);

/// The map in which an (i-1)-cell has been drawn apart into an i-cell, so that its contraction leads back: the
/// insertion of an (n-i)-cell into the dual map. i = n: of one dart; i = n - 1: of two, or one; i = n - 2: of a closed
/// path of the dual map. Source, errors and cost: likewise.
[[nodiscard]] Result<CellSurgery> splitting_of_cell(const DartView& map, int i, std::span<const Dart> darts);

/// The darts that stay, in their order, then those that are made. Requires: a surgery of that map. Cost: the map.
[[nodiscard]] GMap after_surgery(const GMap& map, const CellSurgery& surgery);

// ---- all of it at once. Errors as above. Cost: the map.
[[nodiscard]] Result<GMap> removed(const GMap& map, int i, Dart d);
[[nodiscard]] Result<GMap> contracted(const GMap& map, int i, Dart d);
[[nodiscard]] Result<GMap> inserted(const GMap& map, int i, std::span<const Dart> darts);
[[nodiscard]] Result<GMap> split(const GMap& map, int i, std::span<const Dart> darts);

}  // namespace sesame::ops

/// \file
/// Chains of maps from others and from G-maps, and the way back.
#pragma once

#include <vector>

#include "ops/maps/chain_of_maps.hpp"

namespace sesame::ops {

/// Chains beside each other, of any dimensions: on each level the darts of the first, then those of the second.
[[nodiscard]] ChainOfMaps disjoint_union(const ChainOfMaps& a, const ChainOfMaps& b);

/// The chain of a G-map of dimension n >= 0, which has the same simplicial analogue: its darts of level i are the
/// orbits of alpha_{i+1}, ..., alpha_n, in the order of `orbits`, so those of level n are the darts of the map.
/// Errors    bad_input for a map of dimension -1; refused, naming two darts, where a cell is sewn to itself such that
///           (a) does not hold. Cost: n^2 times the darts.
[[nodiscard]] Result<ChainOfMaps> chain_of_gmap(const GMap& map);

/// The G-map whose darts are those of level n, of a chain of dimension n >= 0 that comes from one: two darts with the
/// same face are joined by alpha_n. A chain of dimension 0 comes from a map without any sewing.
/// Errors    bad_input for a chain of dimension -1; refused, naming the level and darts, where the cells are assembled
///           to something else than a quasi-manifold: a dart of a level below n that is no face, one that is the face
///           of three or more darts, or one below darts that the involutions alpha_{i+1}, ..., alpha_n do not join.
/// Cost: n^2 times the darts.
[[nodiscard]] Result<GMap> gmap_of_chain(const ChainOfMaps& chain);

/// A chain after cells have been glued.
struct GluedChain {
  ChainOfMaps chain;
  std::vector<std::vector<Dart>> image;  ///< per level and dart before: what it has become
};

/// Glues the i-cell of one dart to that of another, with all their faces, such that the darts become one. Darts count
/// by the least one that they are glued from.
/// Errors    bad_input for a dart that there is not; refused, naming darts: cells that are one, cells whose involutions
///           do not correspond, or a result with a folded cell, for which (a) does not hold.
/// Cost: the chain.
[[nodiscard]] Result<GluedChain> glue_cells(const ChainOfMaps& chain, int i, Dart one, Dart other);

}  // namespace sesame::ops

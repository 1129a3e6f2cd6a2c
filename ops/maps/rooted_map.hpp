/// \file
/// Connected maps with a dart that is told apart: how their darts are numbered from there, and isomorphism.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ops/maps/gmap.hpp"

namespace sesame::ops {

/// The darts that some involutions reach from a root, in the order in which a depth first search meets them that takes
/// the least index first: from dart 0 of a polygon that is 0, 1, 2, and so on. Isomorphisms preserve this order, so the
/// place of a dart in it says which dart it is. Cost: their number, times the involutions.
[[nodiscard]] std::vector<Dart> darts_from(const GMap& map, Dart root, IndexSet generators);
[[nodiscard]] inline std::vector<Dart> darts_from(const GMap& map, Dart root) {
  return darts_from(map, root, map.indices());
}

/// The map on some darts, which are numbered as they are listed, with the first involutions only, up to alpha_n.
/// Requires: these keep to those darts.
[[nodiscard]] GMap restricted_to(const GMap& map, std::span<const Dart> darts, int n);

/// A connected map as a dart of it sees it: the darts are numbered from there, so two of these are equal if and only if
/// an isomorphism takes the one dart to the other.
[[nodiscard]] inline GMap rooted_at(const GMap& map, Dart root) {
  return restricted_to(map, darts_from(map, root), map.dimension());
}

/// The root from which a connected map looks least, the smallest such dart: from there isomorphic maps look alike. What
/// is compared are the images of the darts in the order in which a breadth first search numbers them, that takes the
/// least index first. Cost: the darts times the involutions, times the logarithm of the number of automorphisms; and for
/// each dart as much of the map as looks from there as from the least one so far, if it is not alike all over.
[[nodiscard]] Dart canonical_root(const GMap& map);

/// The isomorphism of two connected maps that takes one dart to another, as the image of each dart, or nothing.
/// Cost: the darts, times the involutions.
[[nodiscard]] std::optional<std::vector<Dart>> isomorphism(const GMap& from, Dart root, const GMap& to, Dart image);
/// Any isomorphism of two connected maps. Cost: that of canonical_root.
[[nodiscard]] std::optional<std::vector<Dart>> isomorphism(const GMap& from, const GMap& to);
/// The darts to which automorphisms of a connected map take dart 0; each makes one. Cost: the square of the darts.
[[nodiscard]] std::vector<Dart> automorphisms(const GMap& map);

}  // namespace sesame::ops

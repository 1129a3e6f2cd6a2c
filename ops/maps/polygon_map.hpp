/// \file
/// The map of polygons that have corners in common.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ops/maps/gmap.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// A 2-G-map with a face for each polygon, a list of its corners; sides between the same two corners are sewn. Side s
/// of a polygon goes from its corner s to the next one; its two darts, at these, follow those of the sides before it,
/// polygon after polygon. Where the polygons around a corner are no fan, what was one corner is several vertices.
/// Errors    bad_input, naming polygons: a polygon without sides; three sides between the same two corners.
/// Cost      Sides, times their logarithm.
[[nodiscard]] Result<GMap> map_of_polygons(std::span<const std::vector<std::uint32_t>> polygons);

}  // namespace sesame::ops

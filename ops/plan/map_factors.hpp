/// \file
/// Bodies as factors of products of maps.
#pragma once

#include <string>

#include "ops/cells/structure.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// The darts of a body: those of its maps, one after the other in the order in which they were made, but for darts that
/// were taken out of them. Of chains of maps the same on each level.
struct MapFactor {
  enum class Kind { no_darts, map, chain };
  Kind kind = Kind::no_darts;  ///< it has none, or maps of several dimensions, or maps and chains of maps
  GMap map;                    ///< of maps: all of them as one
  FactorDarts darts;
};
/// Cost: the maps that were made, and the darts of the body.
[[nodiscard]] MapFactor map_factor(BodyId body, const Structure& structure);

/// Whether all cells of a body can be factors: vertices, edges, and cells of maps that are balls, whose faces are not
/// degenerate. Errors    refused, naming a cell. Cost: the cells of the body, with their faces.
Status check_map_factor(BodyId body, const Structure& structure);

}  // namespace sesame::ops

/// \file
/// An object that consists of maps, as one map.
#pragma once

#include <string>
#include <vector>

#include "ops/maps/gmap.hpp"
#include "replay/export/object_cells.hpp"

namespace sesame::replay {

/// The darts of all maps of an object, in the order in which they were made, as one map.
struct ObjectMap {
  ops::GMap map;
  std::vector<ops::Dart> darts;       ///< per dart: which one of the structure's it is
  std::vector<ops::CellId> vertices;  ///< per dart: its vertex

  /// "m:3".
  [[nodiscard]] std::string name(ops::Dart dart, const ops::Structure& structure) const;
};

/// Their cells, or simplices, have to be those of the object, one for one, with the faces that the darts see: what was
/// glued, split, squashed or taken away cell by cell is no map any more.
///
/// Errors    refused, naming a cell or a dart: of no map; not as the darts have it; maps of different dimensions; there
///           are no maps. Cost: the darts, times the dimension; of maps by simplices their simplices.
[[nodiscard]] Result<ObjectMap> map_of_object(const ObjectCells& cells);

}  // namespace sesame::replay

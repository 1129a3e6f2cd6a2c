/// \file
/// Maps in the format of CGAL's combinatorial and generalized maps, XML: what is called .3map there.
#pragma once

#include <optional>
#include <ostream>
#include <vector>

#include "ops/vocabulary/operation.hpp"
#include "replay/export/drawing.hpp"
#include "replay/export/object_map.hpp"

namespace sesame::replay {

/// Which of CGAL's maps: by the beta of half of the darts, with an orientation, or by the alpha of all.
enum class MapFileKind { combinatorial, generalized };

/// Writes the map of an object. In a combinatorial map the darts of a component are those that have the orientation of
/// its first one. Points, per vertex of the object, are written when each vertex of the map has one.
///
/// Returns what the file does not say. Errors, refused, before anything is written: those of `map_of_object`; for a
/// combinatorial map, a component that has no orientation, or a dart that is 0-free or where alpha_0 agrees with
/// another involution.
[[nodiscard]] Result<Remarks> write_map_file(const ObjectCells& cells,
                                             const std::vector<std::optional<ops::Point>>& points, MapFileKind kind,
                                             std::ostream& out);

}  // namespace sesame::replay

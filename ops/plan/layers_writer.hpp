/// \file
/// The cells of maps and of chains of maps, written into plans.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ops/cells/map_cells.hpp"
#include "ops/cells/structure.hpp"
#include "ops/plan/limits.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// Adds cells to a plan, layer by layer, with the parts of those that are no balls, named "name.i:k" after their roots:
/// `dart_text` says what a dart is called. Returns which of the new cells each dart belongs to.
/// Errors    refused, when there are too many. Cost: the faces, and the darts of cells that are no balls.
[[nodiscard]] Result<std::shared_ptr<const DartCells>> write_layers(const std::string& name,
                                                                    const std::vector<CellsOfMap>& layers,
                                                                    const std::function<std::string(Dart)>& dart_text,
                                                                    const Structure& structure, const Limits& limits,
                                                                    Plan& plan);

}  // namespace sesame::ops

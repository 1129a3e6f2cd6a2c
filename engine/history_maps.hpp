/// \file
/// The maps that the steps of a history are.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/history_zigzag.hpp"
#include "ops/cells/structure.hpp"
#include "ops/vocabulary/operation.hpp"

namespace sesame::engine {

/// A map between the object at one moment and that at the next one: a step, or half of one.
struct HistoryMap {
  std::uint64_t step;
  ops::StepKind kind;
  ops::Moment before, after;
};

/// What a step is made of: one map, or, where it replaces cells, the inclusions of the objects before and after it into
/// one with the cells of both and what lies between them. They are deformation retracts of that, so all classes live
/// on.
[[nodiscard]] std::vector<ops::Operation> maps_of(const ops::Operation& operation);

/// The cell that a map sends a cell to, or none where that is degenerate. Requires: the structure has done it.
[[nodiscard]] ops::OrientedCell image_by(const HistoryMap& map, const ops::Structure& structure, ops::CellId cell);

}  // namespace sesame::engine

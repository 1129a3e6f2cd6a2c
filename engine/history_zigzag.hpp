/// \file
/// The barcode of a history in which cells are split and taken away.
#pragma once

#include <cstdint>
#include <span>

#include "engine/equivalences.hpp"
#include "engine/towers/barcode.hpp"
#include "ops/cells/plan.hpp"
#include "ops/plan/limits.hpp"
#include "ops/vocabulary/operation.hpp"
#include "sparse/result.hpp"
#include "sparse/ring.hpp"

namespace sesame::engine {

/// A step of a history, and its number among all that there were.
struct NumberedStep {
  std::uint64_t number;
  ops::Operation operation;
};

/// Whether a step maps the object after it to the one before; or a replacement to a third one.
[[nodiscard]] constexpr bool maps_backward(ops::StepKind kind) {
  return kind == ops::StepKind::split || kind == ops::StepKind::deletion || kind == ops::StepKind::replacement;
}
/// Why a step is no map between the objects before and after it, as the end of a sentence; null when it is one.
[[nodiscard]] const char* why_no_map(ops::StepKind kind);
/// Why it is no map of the object before it to that after it.
[[nodiscard]] const char* why_no_map_forward(ops::StepKind kind);

/// The barcode of the spaces after each step and the maps between them: a zigzag. A gluing, a squashing or a collapse
/// maps the object before it to that after it, and so does whatever adds cells; a de-identification maps the object
/// after it to the one before (its copies to what they are copies of), and so does a removal (it leaves a part). A
/// replacement maps both to one that has the new cells and the old ones. Times are the numbers of steps, bars are
/// half-open.
///
/// Each map is that of homology, in the bases of generators that an engine has before the step and another one after
/// it: the steps are done twice, by two engines that are a step apart. SpaceZigzag makes the barcode of the matrices.
///
/// Errors    refused, over Z, and when a step is no map in either direction: a product, or a cone that is a lazy
///           family; those of steps.
/// Cost      that of the steps, twice; for each of them the class of every generator, and what SpaceZigzag does.
[[nodiscard]] Result<Barcode> barcode_of_history(const sparse::AnyRing& ring, const ops::Limits& limits,
                                                 const RebasePolicy& rebases, std::span<const NumberedStep> steps);

}  // namespace sesame::engine

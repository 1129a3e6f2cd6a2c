/// \file
/// What a step did, and what is kept of history.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "engine/homology_tracker.hpp"
#include "ops/cells/moment.hpp"
#include "ops/cells/plan.hpp"
#include "ops/plan/step_sequence.hpp"

namespace sesame::engine {

/// The sizes of a step's exact sequence 0 -> C0 -> C1 -> C2 -> 0, in generators of all degrees; of a replacement, those
/// of the second one, by which the old cells go.
struct SequenceSizes {
  ops::Direction direction;
  std::uint64_t c0, c1, c2;
};

/// What a step did.
struct StepReport {
  std::uint64_t step = 0;          ///< counted from 1, over all steps that were applied
  std::string_view op;             ///< the keyword of its operation
  ops::StepKind kind{};            ///< what it was to the object
  ops::Moment before, after;       ///< cells created and removed until then
  ops::EventCounts events;         ///< of the journal, that it made or, an undo, took back
  std::uint64_t steps_undone = 0;  ///< by an undo
  std::uint64_t already = 0;       ///< simplices of an insertion that were there; see Plan::already
  bool rebased = false;            ///< the equivalence was begun afresh: see Engine::rebases
  /// The step ended with another object in the place of the one before: see HistoryPolicy::forgets_cells. References to
  /// parts of the engine, ids of cells and moments, those in this report too, are those of the one before.
  bool renewed = false;
  std::optional<SequenceSizes> sequence;  ///< of a step that added or removed cells
  std::optional<ClassAnswer> answer;      ///< to a `class`
};

/// What an engine keeps of its history. The object, the groups and the witnesses do not depend on it.
struct HistoryPolicy {
  /// So many steps can be undone, the last ones. What was kept to undo older ones is freed: see Engine::undo.
  std::uint64_t undoable = UINT64_MAX;
  /// Whether `Engine::log` has all operations that were applied, or only the last one.
  bool keeps_log = true;
  /// Whether cells are forgotten that are gone and that no undo can bring back. Then memory does not grow with the
  /// history: see Renewal. Names of such cells need not denote anything any more, nor names of products, cones and
  /// simplices other than those that cells are called by; ids of cells become others now and then: see
  /// StepReport::renewed. Only where there is a limit on undo, and neither a log in memory nor one beside it.
  bool forgets_cells = false;
};

}  // namespace sesame::engine

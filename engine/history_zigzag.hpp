/// \file
/// The barcode of a history in which cells are split and taken away.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/equivalences.hpp"
#include "engine/towers/barcode.hpp"
#include "ops/cells/plan.hpp"
#include "ops/plan/limits.hpp"
#include "ops/vocabulary/operation.hpp"
#include "sparse/rational_chain.hpp"
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

/// A chain of cells by the canonical names that they have, sorted by these cells' age.
using NameChain = sparse::RationalChain<std::string>;

/// What the cycle of a bar is after a step and the next ones, until the next piece or the end of the bar. Names are
/// those at the beginning; until the end of the piece they denote its cells.
struct NamedCycle {
  Time from;
  NameChain cycle;
};

/// What else is wanted of the barcode of a history.
struct HistoryOptions {
  /// The dimensions of the bars whose cycles are kept; empty: none.
  std::function<bool(int dimension)> wants;
  /// Works out the cycles of a bar, in order; neighbours differ. Together those of all bars are an interval
  /// decomposition: after each step the cycles of the bars that are alive are a basis of the homology; the map of a
  /// step sends the cycle of a bar to one that is homologous to its next one (where it leads back, the next one to such
  /// a one as is before it), and the first and last ones that no neighbour has to 0, or they have no preimage.
  using Cycles = std::function<std::vector<NamedCycle>()>;
  /// Called when a bar ends of which there are cycles, and in the end of those that have not. They can be had during
  /// this call.
  std::function<void(const Bar&, const Cycles&)> on_cycles;
  /// Whether to check it all, with cycles of all dimensions: see HistoryAudit.
  bool verifies = false;
  /// Set from outside: the barcode of the steps until then, which is not checked.
  const std::atomic<bool>* stop = nullptr;
  /// Where the number of the last of these steps goes then, 0 when there is none.
  std::uint64_t* stopped_after = nullptr;

  [[nodiscard]] bool want_cycles() const { return verifies || wants; }
};

/// The barcode of the spaces after each step and the maps between them: a zigzag. A gluing, a squashing or a collapse
/// maps the object before it to that after it, and so does whatever adds cells; a de-identification maps the object
/// after it to the one before (its copies to what they are copies of), and so does a removal (it leaves a part). A
/// replacement maps both to one that has the new cells and the old ones. Times are the numbers of steps, bars are
/// half-open.
///
/// Each map is that of homology, in the bases of generators that an engine has before the step and another one after
/// it: the steps are done twice, by two engines that are a step apart. SpaceZigzag makes the barcode of the matrices.
/// For cycles each of its vectors is the class of a chain, which stays as it is while it can: see OpenChains.
///
/// Errors    refused, over Z, and when a step is no map in either direction: a product, or a cone that is a lazy
///           family; those of steps; law_broken when it verifies and something is wrong.
/// Cost      that of the steps, twice; for each of them the class of every generator that it changes, and what
///           SpaceZigzag does. With cycles, also the chains of bars and what they have been.
[[nodiscard]] Result<Barcode> barcode_of_history(const sparse::AnyRing& ring, const ops::Limits& limits,
                                                 const RebasePolicy& rebases, std::span<const NumberedStep> steps,
                                                 const HistoryOptions& options = {});

}  // namespace sesame::engine

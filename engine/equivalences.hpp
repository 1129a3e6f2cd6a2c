/// \file
/// The equivalence of the object, begun afresh whenever its history has come to weigh more than the object.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/homology_tracker.hpp"

namespace sesame::engine {

/// When an equivalence is begun afresh. What it says changes the cost of steps and the representatives of classes,
/// never a group or a witness.
struct RebasePolicy {
  // After so many splits since the last time: this many, and one more for so many cells of the object.
  std::uint64_t least_splits = 4;
  std::uint64_t cells_per_split = 12;
  // When a step after a split would cost more terms than this, and so many for each face of a cell of the object: about
  // what reducing it takes.
  std::uint64_t least_terms = 4096;
  std::uint64_t terms_per_face = 8;

  /// Never: every step is taken in by the equivalence of the whole history, whatever that costs.
  [[nodiscard]] static RebasePolicy never() { return {UINT64_MAX / 2, 1, UINT64_MAX / 2, 1}; }
};

/// A stack of trackers of one structure: the last describes the present, the others are as they were when the next took
/// their place, for undo.
///
/// De-identifications make the big complex of a history differ from that of any filtration: it describes cells that are
/// no more, rules of its right reduction are composed of perturbations of perturbations, and their coefficients grow.
/// So a *rebase* begins a tracker that knows only the present object:
///
///   when a step would cost more than reducing the object afresh, in terms that are read (its budget);
///   when there have been so many splits since the last rebase that one more costs little beside them.
///
/// So a step costs at most O(object), and splits cost on average what they would near the beginning of a history. While
/// there are no splits there is never a rebase.
class Equivalences {
 public:
  Equivalences(std::unique_ptr<HomologyTracker> first, const RebasePolicy& policy);

  [[nodiscard]] HomologyTracker& now() { return *trackers_.back(); }
  [[nodiscard]] const HomologyTracker& now() const { return *trackers_.back(); }

  /// Takes in what one step has changed; the moment before it is the last mark. `counts`: of the cells after it, by
  /// dimension. True when that was a rebase: representatives of classes may be others since.
  bool extend(std::span<const std::uint64_t> counts);
  void push_mark() { now().push_mark(); }
  /// As HomologyTracker::undo_to_mark, through any number of rebases.
  void undo_to_mark();

  /// What all of them have done, those that were undone included.
  [[nodiscard]] Work work() const { return done_by_others_ + now().work(); }
  /// The rebases that are not undone.
  [[nodiscard]] std::size_t rebases() const { return trackers_.size() - 1; }

 private:
  RebasePolicy policy_;
  std::vector<std::unique_ptr<HomologyTracker>> trackers_;
  Work done_by_others_;
};

}  // namespace sesame::engine

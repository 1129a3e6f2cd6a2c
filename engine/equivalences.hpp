/// \file
/// The equivalence of the object, begun afresh whenever its history has come to weigh more than the object.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>

#include "engine/homology_tracker.hpp"

namespace sesame::engine {

/// When an equivalence is begun afresh. What it says changes the cost of steps and the representatives of classes,
/// never a group or a witness.
struct RebasePolicy {
  // After so many splits since the last time: this many, and one more for so many cells of the object.
  std::uint64_t least_splits = 4;
  std::uint64_t cells_per_split = 50;
  // Whenever cells are split in an object of at most so many, and so many for each incidence that the step moves: that
  // takes no longer than taking the split in.
  std::uint64_t cells_begun_at_once = 64;
  std::uint64_t cells_per_move = 20;
  // When a step after a split would cost more terms than this, and so many for each face of a cell of the object: about
  // what reducing it takes.
  std::uint64_t least_terms = 4096;
  std::uint64_t terms_per_face = 8;
  // Equivalences are kept for undo while their objects have together no more cells than this, and as often those of the
  // present object; the last one always is.
  std::uint64_t least_cells_kept = 500;
  std::uint64_t objects_kept = 8;
  // After so many deletions since the last time: this many, and so many for each cell of the object.
  std::uint64_t least_deletions = 64;
  std::uint64_t deletions_per_cell = 4;

  /// Never: every step is taken in by the equivalence of the whole history, whatever that costs.
  [[nodiscard]] static RebasePolicy never() {
    return {UINT64_MAX / 2, 1, 0, 0, UINT64_MAX / 2, 1, 0, 0, UINT64_MAX / 2, 0};
  }
};

/// A stack of trackers of one structure: the last describes the present, the others are as they were when the next took
/// their place, for undo.
///
/// De-identifications and deletions make the big complex of a history differ from that of any filtration: it describes
/// cells that are no more, rules of its right reduction are composed of perturbations of perturbations, and their
/// coefficients grow. So a *rebase* begins a tracker that knows only the present object:
///
///   when a step would cost more than reducing the object afresh, in terms that are read (its budget);
///   when there have been so many splits since the last rebase, or so many deletions, that one more costs little beside
///   them;
///   at each split while the object is small, or not much larger than what the split moves.
///
/// So a step costs at most O(object), and splits cost on average what they would near the beginning of a history. While
/// there are no splits and no deletions there is never a rebase.
///
/// Undoing past a rebase resumes the tracker before it exactly. Of a long history only the last ones are kept; going
/// back further is a rebase there. So that this costs what the object of that time does, and not a look at all cells
/// ever made, its cells are noted at some rebases, at the cost of half a byte for each cell made.
///
/// Threads: one at a time, for queries too.
class Equivalences {
 public:
  Equivalences(const sparse::AnyRing& ring, const ops::Structure& structure, const RebasePolicy& policy);

  [[nodiscard]] HomologyTracker& now() { return *parts_.back().tracker; }
  [[nodiscard]] const HomologyTracker& now() const { return *parts_.back().tracker; }

  /// Takes in what one step has changed; the moment before it is the last mark. `moves`: the incidences that it moved.
  /// True when that was a rebase: representatives of classes may be others since.
  bool extend(std::uint64_t moves);
  void push_mark();
  /// Goes back over the last `marks` marks, through any number of rebases; the structure has been truncated to that
  /// moment. Requires: there are so many.
  void undo(std::uint64_t marks);
  /// Nobody will go back to the oldest mark: what was kept for it is freed. Requires: there is one.
  void forget_oldest_mark();

  /// Begins with the present object, as if there had been nothing before. Requires: nothing is remembered. Cost: that
  /// of reducing the object, and a look at all cells ever made.
  /// With a record of the reduction, half of that.
  void begin_afresh(const EliminationRecord* record = nullptr);
  /// A record for that. Changes nothing. Nothing when there is no short one. Cost: that of reducing the object.
  [[nodiscard]] std::optional<EliminationRecord> record_afresh() const;

  /// What all of them have done, those that were undone included.
  [[nodiscard]] Work work() const { return done_by_others_ + now().work(); }
  /// The rebases that are not undone.
  [[nodiscard]] std::size_t rebases() const { return forgotten_ + parts_.size() - 1; }

 private:
  /// The history from one rebase to the next.
  struct Part {
    std::unique_ptr<HomologyTracker> tracker;  ///< null: given up
    std::uint64_t marks = 0;
    std::uint64_t cells = 0;  ///< that it is reckoned with while it is kept for undo
  };

  /// The cells that there were when a part began whose tracker is given up.
  struct Note {
    std::size_t part;  ///< its number, those forgotten included
    CellsToLookAt cells;
  };
  static constexpr std::uint64_t made_for_each_noted = 8;  ///< from one note to the next

  void begin_part(std::unique_ptr<HomologyTracker> tracker);
  void end_last_part();
  void give_up_oldest();
  void give_up(std::size_t part);

  const sparse::AnyRing ring_;
  const ops::Structure& structure_;
  RebasePolicy policy_;
  std::deque<Part> parts_;
  std::size_t forgotten_ = 0;     ///< parts that were before them
  std::size_t first_kept_ = 0;    ///< of `parts_`: those before it are given up
  std::uint64_t cells_kept_ = 0;  ///< of the parts that are kept, but for the last
  std::deque<Note> notes_;        ///< by part
  Work done_by_others_;
};

}  // namespace sesame::engine

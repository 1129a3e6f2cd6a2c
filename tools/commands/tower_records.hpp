/// \file
/// What a run of `sesame tower` keeps of a tower beside its bars.
#pragma once

#include <cstdint>
#include <optional>

#include "replay/tower/operation_list.hpp"
#include "replay/tower/tower_history.hpp"
#include "replay/tower/tower_replay.hpp"
#include "replay/tower/tower_trace.hpp"
#include "tools/commands/tower_run.hpp"

namespace sesame::tools {

/// What is kept of a tower for its cycles and its page: all of it when --generators asks for that; for a page alone as
/// much as is cheap.
class TowerRecords {
 public:
  /// `options`: those of the trackers of the run, which outlives this.
  TowerRecords(const TowerRun& run, const engine::TrackerOptions& options);

  /// Who has to be told of each operation too, or null.
  [[nodiscard]] engine::TowerTracker* told() { return trace_ ? &*trace_ : nullptr; }
  [[nodiscard]] replay::TowerHistory* history() { return history_ ? &*history_ : nullptr; }

  /// A tower that these are the records of, as a FaceAdder takes it.
  class Recorded {
   public:
    Recorded(replay::TowerReplay& tower, TowerRecords& records) : tower_{tower}, records_{records} {}
    [[nodiscard]] ops::TowerRules rules() const { return tower_.rules(); }
    /// Errors: those of the tower; bad_input for a vertex without a point.
    Status apply(const replay::TowerOperation& operation);

   private:
    replay::TowerReplay& tower_;
    TowerRecords& records_;
  };

  /// The cycles over the first ring, whose tracker is `first`, or null when they are not kept.
  [[nodiscard]] engine::BarcodeTracker* cycles(engine::BarcodeTracker& first) {
    return asks_for_cycles_ ? &first : is_traced() ? trace_->tracker() : nullptr;
  }
  /// Requires: cycles are kept.
  [[nodiscard]] const replay::TowerHistory& kept_history() const { return *history_; }
  /// All operations, or null when there were too many to keep them.
  [[nodiscard]] const replay::OperationList* operations() const { return operations_ ? &*operations_ : nullptr; }

 private:
  /// Whether the tower is still small enough for a second look.
  [[nodiscard]] bool is_traced() const { return trace_ && trace_->is_kept(); }
  [[nodiscard]] Status check_points(const replay::TowerOperation& operation) const;
  void add(const replay::TowerOperation& operation, replay::TowerReplay& tower);

  const TowerRun& run_;
  bool asks_for_cycles_, has_page_;
  std::optional<replay::TowerHistory> history_;
  std::optional<replay::OperationList> operations_;
  std::optional<replay::TowerTrace> trace_;  ///< stays where it is, as the tower tells it of each operation
};

}  // namespace sesame::tools

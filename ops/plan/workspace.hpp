/// \file
/// An object under construction: the structure, the planner and the steps that can be taken back. Without homology.
#pragma once

#include <cstdint>
#include <deque>

#include "ops/cells/structure.hpp"
#include "ops/plan/planner.hpp"
#include "ops/vocabulary/operation.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// Plans steps, carries them out and takes them back. What a step is, is said once, here: everybody else reads it.
/// Threads: one at a time, for queries too.
class Workspace {
 public:
  /// A step that is not taken back, in one word.
  struct Step {
    static constexpr Journal::Position largest = (Journal::Position{1} << 56) - 1;
    Step(Journal::Position position, StepKind what) : begin{position & largest}, kind{what} {}
    Journal::Position begin : 56;  ///< its events come from here on
    StepKind kind : 8;
  };

  explicit Workspace(const Limits& limits = {}) : planner_{structure_, limits} {}
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
  ~Workspace() = default;

  [[nodiscard]] const Structure& structure() const { return structure_; }
  [[nodiscard]] const Planner& planner() const { return planner_; }

  /// Whether an operation makes or changes cells, as opposed to questions, notes and undo.
  [[nodiscard]] static bool is_construction(const Operation& operation);
  /// Works out what an operation would do, into `planned()`; a note would do nothing. Errors: those of the planner;
  /// refused for questions and for undo.
  Status plan(const Operation& operation);
  /// What the last `plan` found.
  [[nodiscard]] const Plan& planned() const { return plan_; }
  /// Does what is planned, as a step. Requires: nothing has happened since it was planned. Cost: the size of the plan.
  void carry_out();
  /// A step that does nothing to the object.
  void pass() { steps_.emplace_back(structure_.journal().end(), StepKind::nothing); }

  /// Those that can be taken back here, oldest first.
  [[nodiscard]] const std::deque<Step>& steps() const { return steps_; }
  /// The moment before the step with this number, from 0. Cost: what has happened since.
  [[nodiscard]] Moment before(std::size_t step) const;
  /// The moment after it. Cost: likewise.
  [[nodiscard]] Moment after(std::size_t step) const {
    return step + 1 == steps_.size() ? structure_.now() : before(step + 1);
  }

  /// How many steps come before those, of a workspace that was loaded: only who does them all again can take them back.
  [[nodiscard]] std::uint64_t steps_below() const { return below_; }

  /// Whether the last steps can be taken back. Errors: refused when there are fewer, or when some are below.
  [[nodiscard]] Status can_take_back(std::uint64_t steps) const;
  /// Takes them back. Errors: likewise. Cost: what they did.
  Status take_back(std::uint64_t steps);
  /// The oldest step can't be taken back from now on; the events of the journal that were kept for it are forgotten.
  /// Requires: there is one.
  void forget_oldest_step();
  /// Forgets what queries have made since the journal was at a position. Requires: no step since then.
  void forget_since(Journal::Position position);

  /// Begins with the present object of another workspace, none of whose steps can be taken back here: see
  /// Structure::begin_with. Names stay of what its steps have removed that can still be taken back. Requires: nothing
  /// has happened here, and the limits are the same.
  void begin_with(const Workspace& other);

  // ---- archives
  /// Changes nothing.
  void save(sparse::ArchiveWriter& to) const;
  /// Into a new workspace; fails what is unsound. All steps are below it then.
  void load(sparse::ArchiveReader& from);

 private:
  Structure structure_;
  Planner planner_;
  Plan plan_;
  std::deque<Step> steps_;
  std::uint64_t below_ = 0;      ///< steps
  std::uint64_t forgotten_ = 0;  ///< steps
};

}  // namespace sesame::ops

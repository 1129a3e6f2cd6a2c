/// \file
/// The object that a log of operations describes, with its homology: what an engine gives up and makes anew when an
/// exception has cut a step off.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/equivalences.hpp"
#include "engine/homology_tracker.hpp"
#include "engine/resources.hpp"
#include "engine/step_numbers.hpp"
#include "engine/step_report.hpp"
#include "engine/towers/barcode.hpp"
#include "ops/plan/workspace.hpp"
#include "ops/vocabulary/operation.hpp"
#include "sparse/archive.hpp"
#include "sparse/result.hpp"
#include "sparse/ring.hpp"

namespace sesame::engine {

/// A workspace and its equivalences, step by step. What its functions say of errors and cost, Engine says. After an
/// exception it is void, and can only be destroyed.
///
/// Threads: one at a time, for queries too.
class LiveObject {
 public:
  /// `undoable`: so many steps can be undone.
  LiveObject(const sparse::AnyRing& ring, const ops::Limits& limits, const RebasePolicy& rebases,
             std::uint64_t undoable);
  LiveObject(const LiveObject&) = delete;
  LiveObject& operator=(const LiveObject&) = delete;
  ~LiveObject() = default;

  /// Called when an operation can be refused no more, before anything of it happens. When it fails, nothing does.
  using WriteAhead = std::function<Status(const ops::Operation&)>;

  /// From now on steps that would take more than this are refused; until then, none is.
  void watch(const Resources& resources) { resources_.emplace(resources); }

  // ---- steps
  Result<StepReport> apply(const ops::Operation& operation, const WriteAhead& write_ahead);
  Result<ops::Plan> plan(const ops::Operation& operation);
  /// The operations applied, undos included.
  [[nodiscard]] std::uint64_t applied() const { return applied_; }

  // ---- snapshots: what an object is, without how it came about
  /// A record of the reduction of the object makes `begin_equivalence` cost half, and making one costs the other half.
  enum class Reduction : std::uint8_t { recorded, left_out };
  /// Writes it down. Changes nothing.
  void save(sparse::ArchiveWriter& to, Reduction reduction = Reduction::recorded) const;
  /// Into a new object; fails what is unsound. If that went well, `begin_equivalence` has to be called before anything
  /// else. Requires: the ring, the limits and the number of undoable steps are those of the object that was saved.
  /// Cost: what was made.
  void load(sparse::ArchiveReader& from);
  /// Into a new object: the cells of another one as they are, and nothing of how they came about. None of its steps can
  /// be undone here; its names stay as ops::Workspace::begin_with says. Requires: both were made on the same terms.
  /// Cost: a look at all cells that the other one has known, and that of reducing the object.
  void begin_with(const LiveObject& other);
  /// Begins the equivalence afresh. Cost: that of reducing the object.
  void begin_equivalence();
  /// How many of the undoable steps this object itself can take back: those since it was loaded.
  [[nodiscard]] std::uint64_t undoable_here() const { return workspace_.steps().size(); }
  /// Whether an operation that could happen needs an object that has done all its steps itself: it would take back some
  /// from before this one was loaded. `apply` refuses it.
  [[nodiscard]] bool needs_earlier_steps(const ops::Operation& operation) const;
  /// Whether the barcode needs one. `barcode` is refused then.
  [[nodiscard]] bool barcode_needs_earlier_steps() const;

  // ---- state
  [[nodiscard]] const ops::Workspace& workspace() const { return workspace_; }
  [[nodiscard]] const ops::Structure& structure() const { return workspace_.structure(); }
  [[nodiscard]] std::span<const std::uint64_t> cells() const { return structure().counts(); }
  [[nodiscard]] std::uint64_t undoable() const { return workspace_.steps_below() + workspace_.steps().size(); }
  [[nodiscard]] std::int64_t euler_characteristic() const;
  [[nodiscard]] Equivalences& equivalences() { return equivalences_; }
  [[nodiscard]] HomologyTracker& tracker() { return equivalences_.now(); }

  // ---- questions
  [[nodiscard]] Homology homology() { return tracker().homology(cells().size()); }
  [[nodiscard]] Result<CellChain> chain(const std::vector<std::pair<Integer, std::string>>& terms) const;
  /// `visit` does not throw.
  void visit_generators(int degree, std::uint64_t most_terms, const GeneratorVisitor& visit);
  [[nodiscard]] Result<Barcode> barcode() const;
  /// Whether some step maps the object after it to the one before.
  [[nodiscard]] bool is_zigzag() const;
  [[nodiscard]] std::optional<std::string> first_defect();

 private:
  Result<StepReport> carry_out(const ops::Operation& operation, const WriteAhead& write_ahead);
  Result<StepReport> construct(const ops::Operation& operation, const WriteAhead& write_ahead);
  Result<StepReport> take_back(const ops::Undo& operation, const WriteAhead& write_ahead);
  /// A step that does nothing to the object.
  Result<StepReport> pass(const ops::Operation& operation, const WriteAhead& write_ahead);
  Status check_room(const ops::Operation& operation);
  StepReport begin_report(const ops::Operation& operation) const;
  void remember();
  void forget_old_steps();

  sparse::AnyRing ring_;
  ops::Workspace workspace_;
  Equivalences equivalences_;
  std::uint64_t most_undoable_;
  std::optional<ResourceCheck> resources_;
  std::uint64_t applied_ = 0;                ///< operations
  StepNumbers numbers_;                      ///< of these, from 1, the steps that can be undone
  bool has_forgotten_ = false;               ///< steps that could be undone
  std::optional<EliminationRecord> record_;  ///< between `load` and `begin_equivalence`
};

}  // namespace sesame::engine

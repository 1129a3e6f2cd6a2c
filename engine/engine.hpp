/// \file
/// The engine: applies construction steps, keeps the homology of the workspace current, answers queries, undoes.
/// This is the header that most users of the library need.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/durable/step_log.hpp"
#include "engine/history_zigzag.hpp"
#include "engine/live_object.hpp"
#include "engine/step_report.hpp"
#include "engine/towers/barcode.hpp"
#include "ops/cells/structure.hpp"
#include "ops/plan/step_sequence.hpp"
#include "ops/plan/workspace.hpp"
#include "ops/vocabulary/operation.hpp"
#include "sparse/result.hpp"
#include "sparse/ring.hpp"

namespace sesame::engine {

template <sparse::Ring R>
class LiveEquivalence;
class LogSnapshots;
class Renewal;
class View;
struct OpenOptions;
struct OpenedLog;

/// Called after each step that was applied, with the operation as it stands in the log. When one throws, the step has
/// happened all the same, the other observers are called, and then `apply` throws what the first one threw.
using Observer = std::function<void(const ops::Operation&, const StepReport&)>;

/// A workspace: several bodies of cells, their log, and their homology over one ring.
///
/// State is the fold of the log: two engines given the same operations over the same ring, and asked the same between
/// them, answer every query alike, to the byte. (What was asked matters only to when a step after a split becomes too
/// dear, so that the equivalence is begun afresh, and then only to representatives: see Equivalences.) An operation
/// happens wholly or, on an error, not at all.
///
/// The same holds when memory runs out, or any other exception cuts a step or a query off: the object is given up then
/// and, at the next call, made anew from the log, which has every step that was applied and no other. That takes as
/// long as these steps did; groups are what they were, representatives as after a rebase. References to parts of the
/// engine (`structure`, `maps`, `live`) are not valid any longer. An engine that keeps no log of its own
/// (HistoryPolicy) and has none beside it (`write_to`) cannot do that: there the exception leaves `apply` as well, and
/// the engine takes no further call.
///
/// Not thread-safe, as queries bring memoised results up to date: one thread at a time calls an engine. Others ask a
/// View. Several engines may be used by as many threads.
class Engine {
 public:
  explicit Engine(sparse::AnyRing ring = sparse::Integers{}, ops::Limits limits = {}, const RebasePolicy& rebases = {},
                  const HistoryPolicy& history = {}, const Resources& resources = {});
  /// An engine that goes on from a log, or begins one, and writes its steps there: see engine/open.hpp.
  /// Errors    io, also when another process writes it; bad_input when a record is damaged, of which nothing is lost:
  ///           the file is as it was; law_broken when the homology is not the one that it was bound to; those of steps.
  /// Cost      that of the steps.
  static Result<OpenedLog> open(const std::string& path, const OpenOptions& options);
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  ~Engine();

  // ---- steps
  /// Carries out one operation.
  /// Errors    what the planner refuses (nothing has happened then); `expectation` when an Expect differs from the
  ///           state; `refused` when an Undo asks for more steps than there are; `limit` when memory runs out; `io`
  ///           when the log cannot be written.
  /// Cost      the cells that the step touches, times their dimension, plus the vectors that are rewritten: independent
  ///           of the size of the object, and of the length of the history as far as the equivalence is begun afresh
  ///           when splits weigh more than the object (see Equivalences).
  ///           An Undo costs what the steps taken back did.
  Result<StepReport> apply(ops::Operation operation);
  /// What a construction operation would do, without doing it.
  Result<ops::Plan> plan(const ops::Operation& operation);
  /// Takes back the last n steps (an Undo operation without the operation's text).
  /// When only so many can be undone, memory still grows with the cells ever made: names of those that are no more go
  /// on denoting what became of them, unless HistoryPolicy::forgets_cells.
  Result<StepReport> undo(std::uint64_t steps = 1) { return apply(ops::Undo{steps}); }
  /// The number of steps that can be undone: those applied, undos and the undone not counted, the last ones of them if
  /// there is a limit.
  [[nodiscard]] std::uint64_t undoable() const { return object().undoable(); }
  /// Every operation that was applied, undos included, in order; or the last one only: see HistoryPolicy.
  [[nodiscard]] const std::deque<ops::Operation>& log() const { return log_; }
  void observe(Observer observer) { observers_.push_back(std::move(observer)); }
  /// From now on every step is appended to this log before anything of it happens; null: to none. The log has the steps
  /// that were applied until now. After every thousand steps it is bound to the answers, and a snapshot taken if it is
  /// time.
  void write_to(std::shared_ptr<StepLog> log, std::shared_ptr<LogSnapshots> snapshots = nullptr);
  /// Goes on with an object that a snapshot had. Steps from before it can be undone, and have a barcode, by doing the
  /// steps of the log again. Requires: no step has been applied; the object was made on the terms of this engine.
  void resume(std::unique_ptr<LiveObject> object);
  /// Puts all steps on the disk, binds them to the answers, and takes a snapshot of many steps, as at the end of a
  /// session. Cost: that of the homology, and of a snapshot. Errors: those of the log.
  Status bind_log();

  // ---- state
  [[nodiscard]] const sparse::AnyRing& ring() const { return ring_; }
  [[nodiscard]] const ops::Structure& structure() const { return object().structure(); }
  /// The number of cells of each dimension, up to the largest that has one.
  [[nodiscard]] std::span<const std::uint64_t> cells() const { return object().cells(); }
  [[nodiscard]] std::int64_t euler_characteristic() const { return object().euler_characteristic(); }
  /// Betti numbers, torsion, sizes of the small and the big complex; an entry per dimension that has cells.
  [[nodiscard]] Homology homology();

  /// How often the equivalence was begun afresh from the object as it was, undone times not counted: see Equivalences.
  /// Then, and when such a step is undone, the representatives of classes may change, and the basis in which classes
  /// are written.
  [[nodiscard]] std::uint64_t rebases() const { return rebases_of_others_ + object().equivalences().rebases(); }

  /// What has been done so far, in terms and entries. The difference over a step is that step's cost.
  [[nodiscard]] Work work() const { return work_of_others_ + object().equivalences().work(); }

  // ---- chains
  /// A chain from names; terms of one cell are added up. Errors: unknown_name; bad_input when the cells differ in
  /// dimension.
  [[nodiscard]] Result<CellChain> chain(const std::vector<std::pair<Integer, std::string>>& terms) const;
  /// The generators of H_p: torsion by increasing order, then the free ones. Cost: their expansion.
  [[nodiscard]] std::vector<Generator> generators(int degree);
  /// The generators of H_p one after another, as HomologyTracker::visit_generators. The cells of products and cones
  /// that are written out for one are forgotten before the next, so memory is that of one; chains are not to be kept.
  /// When `visit` throws, there is no further one, and this throws the same. It may ask the engine, but apply no step.
  void visit_generators(int degree, std::uint64_t most_terms, const GeneratorVisitor& visit);
  /// The class of a chain, if it is a cycle, and what it bounds. Cost: its expansion in S, and a coefficient for each
  /// generator of its degree; of the first one after a step, an elimination of the core too.
  [[nodiscard]] ClassAnswer classify(const CellChain& chain);
  /// F, G, K and the boundaries, applied to chains: see HomologyTracker. When an exception cuts one of them off, call
  /// `give_up` before anything else.
  [[nodiscard]] HomologyTracker& maps() { return object().tracker(); }
  /// The equivalence C <= B => S itself, for its matrices; null when the engine computes over another ring.
  template <sparse::Ring R>
  [[nodiscard]] LiveEquivalence<R>* live() {
    return dynamic_cast<LiveEquivalence<R>*>(&maps());
  }

  // ---- persistence
  /// The barcode of the spaces after each step that is not undone, and the maps between them; times are the numbers of
  /// the steps among all those of the log, as in their reports. With de-identifications and removals, which map the
  /// object after them to the one before, it is that of a zigzag: see engine/history_zigzag.hpp. Cycles of its bars can
  /// be had by `options`, of whatever steps; when it verifies, the barcode of steps that all lead forward is worked out
  /// in two ways.
  ///
  /// Errors    refused, over Z, and when a step is no map: a product, or a cone that is a lazy family; without a
  ///           de-identification or a removal, when not all steps can be undone any more; with one, when there is no
  ///           log (HistoryPolicy), and with cycles; law_broken when it verifies and something is wrong.
  /// Cost      The size of the big complex, times the logarithm of the number of steps; of a zigzag, or with cycles,
  ///           that of doing all steps again twice, and more: see barcode_of_history.
  [[nodiscard]] Result<Barcode> barcode(const HistoryOptions& options = {}) const;

  // ---- the last step as an exact sequence, and the laws
  /// The moment before the step with this number among those not undone (1: the first). Requires: 1 <= n <= undoable().
  /// Cost: what has happened since.
  [[nodiscard]] ops::Moment before_step(std::uint64_t n) const;
  /// The exact sequence of a step that is not undone; of a replacement there are two, and none when the step changed no
  /// cells or was a product. Cost: the size of the object.
  template <sparse::Ring R>
  [[nodiscard]] std::vector<ops::StepSequence<R>> sequences(std::uint64_t n, const R& ring) const {
    const ops::Moment before = before_step(n);
    const ops::Workspace& workspace = object().workspace();
    const std::uint64_t k = n - 1 - workspace.steps_below();
    return ops::step_sequences(structure(), workspace.steps()[k].kind, before, workspace.after(k), ring);
  }
  /// Checks every law of the present state. Slow. Returns the first that fails and where.
  [[nodiscard]] std::optional<std::string> first_defect();

  // ---- after an exception
  /// Gives the object up, as an exception in a query does: the next call makes it anew from the log.
  void give_up() const;

 private:
  friend class View;  // which has the object as it is now

  LiveObject& object() const;
  LiveObject& object_with_all_steps() const;
  [[nodiscard]] bool has_log() const {
    return history_.keeps_log || (written_to_ != nullptr && written_to_->can_be_read_back());
  }
  template <class Question>
  auto ask(Question&& question) const;
  Status settle_log() const;
  Status for_each_logged(const std::function<Status(const ops::Operation&)>& visit) const;
  void make_anew() const;
  Result<StepReport> attempt(ops::Operation& operation);
  Status write_ahead(const ops::Operation& operation);
  void keep(ops::Operation&& operation);
  Status bind(bool syncs);
  void bind_now_and_then();
  void call_observers(const StepReport& report) const;
  bool renew();

  sparse::AnyRing ring_;
  ops::Limits limits_;
  RebasePolicy rebases_;
  HistoryPolicy history_;
  Resources resources_;
  mutable std::unique_ptr<LiveObject> object_;
  mutable bool is_void_ = false;         ///< the object: something was cut off
  mutable std::uint32_t questions_ = 0;  ///< that are being answered, one within the other
  mutable bool is_ahead_ = false;        ///< `written_to_` has a step that has not happened
  std::uint64_t applied_ = 0;            ///< operations, as the log has them
  std::deque<ops::Operation> log_;
  std::shared_ptr<StepLog> written_to_;
  std::shared_ptr<LogSnapshots> snapshots_;
  std::vector<Observer> observers_;
  std::unique_ptr<Renewal> renewal_;     ///< or null
  std::uint64_t rebases_of_others_ = 0;  ///< of the objects before this one
  Work work_of_others_;                  ///< likewise
};

}  // namespace sesame::engine

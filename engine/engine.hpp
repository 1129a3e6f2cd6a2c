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

#include "engine/equivalences.hpp"
#include "engine/homology_tracker.hpp"
#include "engine/step_numbers.hpp"
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

/// The sizes of a step's exact sequence 0 -> C0 -> C1 -> C2 -> 0, in generators of all degrees.
struct SequenceSizes {
  ops::Direction direction;
  std::uint64_t c0, c1, c2;
};

/// What a step did.
struct StepReport {
  std::uint64_t step = 0;                 ///< counted from 1, over all steps that were applied
  std::string_view op;                    ///< the keyword of its operation
  ops::StepKind kind{};                   ///< what it was to the object
  ops::Moment before, after;              ///< cells created and removed until then
  ops::EventCounts events;                ///< of the journal, that it made or, an undo, took back
  std::uint64_t steps_undone = 0;         ///< by an undo
  std::uint64_t already = 0;              ///< simplices of an insertion that were there; see Plan::already
  bool rebased = false;                   ///< the equivalence was begun afresh: see Engine::rebases
  std::optional<SequenceSizes> sequence;  ///< of a step that added or removed cells
  std::optional<ClassAnswer> answer;      ///< to a `class`
};

/// What an engine keeps of its history. The object, the groups and the witnesses do not depend on it.
struct HistoryPolicy {
  /// So many steps can be undone, the last ones. What was kept to undo older ones is freed: see Engine::undo.
  std::uint64_t undoable = UINT64_MAX;
  /// Whether `Engine::log` has all operations that were applied, or only the last one.
  bool keeps_log = true;
};

/// Called after each step that was applied, with the operation as it stands in the log.
using Observer = std::function<void(const ops::Operation&, const StepReport&)>;

/// A workspace: several bodies of cells, their log, and their homology over one ring.
///
/// State is the fold of the log: two engines given the same operations over the same ring, and asked the same between
/// them, answer every query alike, to the byte. (What was asked matters only to when a step after a split becomes too
/// dear, so that the equivalence is begun afresh, and then only to representatives: see Equivalences.) An operation
/// happens wholly or, on an error, not at all. When an exception cuts it off, such as memory that runs out, the log has
/// every step before it; the engine takes no further one, and its answers are void. So are they when a query is cut
/// off.
///
/// Not thread-safe: queries bring memoised results up to date.
class Engine {
 public:
  explicit Engine(sparse::AnyRing ring = sparse::Integers{}, ops::Limits limits = {}, const RebasePolicy& rebases = {},
                  const HistoryPolicy& history = {});
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  ~Engine();

  // ---- steps
  /// Carries out one operation.
  /// Errors    what the planner refuses (nothing has happened then); `expectation` when an Expect differs from the
  ///           state; `refused` when an Undo asks for more steps than there are.
  /// Cost      the cells that the step touches, times their dimension, plus the vectors that are rewritten: independent
  ///           of the size of the object, and of the length of the history as far as the equivalence is begun afresh
  ///           when splits weigh more than the object (see Equivalences).
  ///           An Undo costs what the steps taken back did.
  Result<StepReport> apply(ops::Operation operation);
  /// What a construction operation would do, without doing it.
  Result<ops::Plan> plan(const ops::Operation& operation);
  /// Takes back the last n steps (an Undo operation without the operation's text).
  /// When only so many can be undone, memory still grows with the cells ever made: names of those that are no more go
  /// on denoting what became of them.
  Result<StepReport> undo(std::uint64_t steps = 1) { return apply(ops::Undo{steps}); }
  /// The number of steps that can be undone: those applied, undos and the undone not counted, the last ones of them if
  /// there is a limit.
  [[nodiscard]] std::uint64_t undoable() const { return workspace_.steps().size(); }
  /// Every operation that was applied, undos included, in order; or the last one only: see HistoryPolicy.
  [[nodiscard]] const std::deque<ops::Operation>& log() const { return log_; }
  void observe(Observer observer) { observers_.push_back(std::move(observer)); }

  // ---- state
  [[nodiscard]] const sparse::AnyRing& ring() const { return ring_; }
  [[nodiscard]] const ops::Structure& structure() const { return workspace_.structure(); }
  /// The number of cells of each dimension, up to the largest that has one.
  [[nodiscard]] std::span<const std::uint64_t> cells() const { return workspace_.structure().counts(); }
  [[nodiscard]] std::int64_t euler_characteristic() const;
  /// Betti numbers, torsion, sizes of the small and the big complex; an entry per dimension that has cells.
  [[nodiscard]] Homology homology() { return equivalences_.now().homology(cells().size()); }

  /// How often the equivalence was begun afresh from the object as it was, undone times not counted: see Equivalences.
  /// Then, and when such a step is undone, the representatives of classes may change, and the basis in which classes
  /// are written.
  [[nodiscard]] std::uint64_t rebases() const { return equivalences_.rebases(); }

  /// What has been done so far, in terms and entries. The difference over a step is that step's cost.
  [[nodiscard]] Work work() const { return equivalences_.work(); }

  // ---- chains
  /// A chain from names; terms of one cell are added up. Errors: unknown_name; bad_input when the cells differ in
  /// dimension.
  [[nodiscard]] Result<CellChain> chain(const std::vector<std::pair<Integer, std::string>>& terms) const;
  /// The generators of H_p: torsion by increasing order, then the free ones. Cost: their expansion.
  [[nodiscard]] std::vector<Generator> generators(int degree) { return equivalences_.now().generators(degree); }
  /// The generators of H_p one after another, as HomologyTracker::visit_generators. The cells of products and cones
  /// that are written out for one are forgotten before the next, so memory is that of one; chains are not to be kept.
  void visit_generators(int degree, std::uint64_t most_terms, const GeneratorVisitor& visit);
  /// The class of a chain, if it is a cycle, and what it bounds. Cost: its expansion in S, and a coefficient for each
  /// generator of its degree; of the first one after a step, an elimination of the core too.
  [[nodiscard]] ClassAnswer classify(const CellChain& chain) { return equivalences_.now().classify(chain); }
  /// F, G, K and the boundaries, applied to chains: see HomologyTracker.
  [[nodiscard]] HomologyTracker& maps() { return equivalences_.now(); }
  /// The equivalence C <= B => S itself, for its matrices; null when the engine computes over another ring.
  template <sparse::Ring R>
  [[nodiscard]] LiveEquivalence<R>* live() {
    return dynamic_cast<LiveEquivalence<R>*>(&equivalences_.now());
  }

  // ---- persistence
  /// The barcode of the spaces after each step that is not undone, and the maps between them; times are the numbers of
  /// the steps among all those of the log, as in their reports.
  ///
  /// Errors    refused, over Z, and when a step is no map of the object before it to that after it: a de-identification
  ///           or a product; or a cone that is a lazy family; and when not all steps can be undone any more.
  /// Cost      The size of the big complex, times the logarithm of the number of steps.
  [[nodiscard]] Result<Barcode> barcode() const;

  // ---- the last step as an exact sequence, and the laws
  /// The moment before the step with this number among those not undone (1: the first). Requires: 1 <= n <= undoable().
  /// Cost: what has happened since.
  [[nodiscard]] ops::Moment before_step(std::uint64_t n) const;
  /// The exact sequence of a step that is not undone; nothing when the step changed no cells or was a
  /// product. Cost: the size of the object.
  template <sparse::Ring R>
  [[nodiscard]] std::optional<ops::StepSequence<R>> sequence(std::uint64_t n, const R& ring) const {
    const ops::Moment before = before_step(n);
    return ops::step_sequence(structure(), workspace_.steps()[n - 1].kind, before, workspace_.after(n - 1), ring);
  }
  /// Checks every law of the present state. Slow. Returns the first that fails and where.
  [[nodiscard]] std::optional<std::string> first_defect();

 private:
  Result<StepReport> carry_out(const ops::Operation& operation);
  Result<StepReport> construct(const ops::Operation& operation);
  Status check_room(const ops::Operation& operation) const;
  Status check(const ops::Expect& expected);
  Result<StepReport> take_back(const ops::Undo& operation);
  StepReport begin_report(const ops::Operation& operation) const;
  StepReport pass(const ops::Operation& operation);
  void remember();
  void keep(ops::Operation&& operation);

  sparse::AnyRing ring_;
  ops::Workspace workspace_;
  Equivalences equivalences_;
  HistoryPolicy history_;
  std::deque<ops::Operation> log_;
  std::uint64_t applied_ = 0;   ///< operations
  StepNumbers numbers_;         ///< of these, from 1, the steps that can be undone
  bool has_forgotten_ = false;  ///< steps that could be undone
  std::vector<Observer> observers_;
  bool is_broken_ = false;  ///< a step began and has not come to its end
};

}  // namespace sesame::engine

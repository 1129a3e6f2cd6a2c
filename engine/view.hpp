/// \file
/// Views: the object as it was at one moment, for questions from any thread while steps go on.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/homology_tracker.hpp"
#include "engine/snapshot.hpp"
#include "ops/cells/structure.hpp"
#include "ops/vocabulary/operation.hpp"
#include "sparse/result.hpp"

namespace sesame::engine {

class Engine;

/// The object of an engine after one of its steps. What the engine does later does not show in it, and it stays when
/// the engine goes.
///
/// Groups, witnesses and the answers about chains are those of the engine at that moment; representatives, and the
/// basis in which classes are written, are those of an equivalence that is begun afresh, as after a rebase. (So the
/// chain of a generator that the engine gave can be asked about here, and the other way round.) Cells have the same
/// names, and the same ids, but for those of lazy cells where steps are copied (see `of`): these depend on what was
/// asked on the way, and chains are to be told by names.
///
/// Thread-safe: any number of threads may ask one view, and one after another they are answered; views of one engine
/// share nothing, and are asked side by side. Taking a view is for the thread of the engine.
class View {
 public:
  /// Cost: a copy of the cells ever made, with their faces and names, some 150 bytes for each; not of their homology,
  /// which the first question reduces afresh, in its own thread. Of an object most of whose cells are lazy, the steps
  /// are copied instead, and the first question does them again.
  /// Errors: refused, of such an object when the engine keeps no log in memory (HistoryPolicy).
  static Result<std::shared_ptr<const View>> of(const Engine& engine);
  View(const View&) = delete;
  View& operator=(const View&) = delete;
  ~View();

  /// The operations that had been applied, undos included: the moment.
  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  [[nodiscard]] const sparse::AnyRing& ring() const { return terms_.ring; }
  /// The number of cells of each dimension.
  [[nodiscard]] const std::vector<std::uint64_t>& cells() const { return cells_; }

  // ---- questions, answered as Engine does. When memory runs out in one it throws, and the next one begins afresh.
  [[nodiscard]] Homology homology() const;
  [[nodiscard]] Result<CellChain> chain(const std::vector<std::pair<Integer, std::string>>& terms) const;
  [[nodiscard]] std::vector<Generator> generators(int degree) const;
  /// `visit` asks this view nothing.
  void visit_generators(int degree, std::uint64_t most_terms, const GeneratorVisitor& visit) const;
  [[nodiscard]] ClassAnswer classify(const CellChain& chain) const;
  /// Calls `look` with the cells, for names, faces and positions; nothing of them is to be kept. It asks this view
  /// nothing.
  void look_at_cells(const std::function<void(const ops::Structure&)>& look) const;
  /// Checks every law. Slow.
  [[nodiscard]] std::optional<std::string> first_defect() const;

 private:
  View(std::uint64_t steps, const ObjectTerms& terms, const RebasePolicy& rebases, std::vector<std::uint64_t> cells);

  template <class Question>
  auto ask(Question&& question) const;
  [[nodiscard]] std::unique_ptr<LiveObject> made() const;

  std::uint64_t steps_;
  ObjectTerms terms_;
  RebasePolicy rebases_;
  std::vector<std::uint64_t> cells_;
  std::vector<char> archive_;              ///< of the object, or empty
  std::vector<ops::Operation> its_steps_;  ///< else
  mutable std::recursive_mutex asking_;    ///< one that a question from within another can be told by
  mutable bool is_asked_ = false;
  mutable std::unique_ptr<LiveObject> object_;  ///< when it has been asked for
};

}  // namespace sesame::engine

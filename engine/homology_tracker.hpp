/// \file
/// What the engine asks of a live equivalence, whatever the ring: the type-erased face of LiveEquivalence.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/left/saturating.hpp"
#include "engine/left/window.hpp"
#include "engine/right/elimination_record.hpp"
#include "ops/cells/structure.hpp"
#include "ops/plan/step_sequence.hpp"
#include "sparse/rational_chain.hpp"
#include "sparse/ring.hpp"

namespace sesame::engine {

using sparse::Integer;
using sparse::Rational;

/// A chain of current cells, by the age of the cells' canonical names, with the orientations that these stand for:
/// ops::Directory::sign_of_name.
using CellChain = sparse::RationalChain<ops::CellId>;

/// A generator of the small complex, among those of its degree, counted from 0, oldest first.
using SmallId = ops::Id<struct GeneratorOfSmallComplex>;
/// A chain of the small complex, by age.
using SmallChain = sparse::RationalChain<SmallId>;

/// A generator of a homology group.
struct Generator {
  int degree = 0;
  Integer order;  ///< 0: free
  CellChain cycle;
  CellChain bounding;  ///< for order t > 0: its boundary is t * cycle; empty for a free generator
  /// Of a chain that was not written out (it is empty then): a number of terms that it does not exceed; else 0.
  std::uint64_t terms_of_cycle = 0, terms_of_bounding = 0;
};

/// Takes a generator; whether it wants the next.
using GeneratorVisitor = std::function<bool(Generator)>;

/// The answer to "what class is this chain in?".
struct ClassAnswer {
  bool is_cycle = false;
  bool is_zero = false;                ///< a boundary
  std::vector<Rational> coefficients;  ///< of the generators of this degree, in the order in which they are listed
  std::optional<CellChain> bounds;     ///< when it is zero: a chain whose boundary it is
};

/// The homology of the whole workspace, by degree.
struct Homology {
  std::vector<std::int64_t> betti;
  std::vector<std::vector<Integer>> torsion;  ///< invariant factors > 1, each dividing the next
  std::vector<std::uint32_t> small;           ///< generators of the small complex
  std::vector<std::uint32_t> big;             ///< generators of the big complex
};

/// A class of homology: the steps that are remembered, counted from 0, at which it was born and died.
struct Lifetime {
  static constexpr std::size_t never = SIZE_MAX;
  int degree;
  std::size_t born, died;
};

/// How much has been done, in terms and entries: what a step costs, independent of the machine. Only grows.
struct Work {
  std::uint64_t boundary_entries = 0;  ///< appended to the boundary of the big complex
  std::uint64_t rewritten_terms = 0;   ///< read while boundaries and chains were rewritten, memos included
  std::uint64_t rule_terms = 0;        ///< on the right-hand sides of rules that were made: the fill-in
  std::uint64_t path_links = 0;        ///< followed from faces as they were to the cells that they are

  Work& operator+=(const Work& more) {
    boundary_entries += more.boundary_entries;
    rewritten_terms += more.rewritten_terms;
    rule_terms += more.rule_terms;
    path_links += more.path_links;
    return *this;
  }
  Work& operator-=(const Work& less) {
    boundary_entries -= less.boundary_entries;
    rewritten_terms -= less.rewritten_terms;
    rule_terms -= less.rule_terms;
    path_links -= less.path_links;
    return *this;
  }
  friend Work operator+(Work a, const Work& b) { return a += b; }
};

/// Among which cells those of the present object are: some, and all that were made and asked for since.
struct CellsToLookAt {
  std::vector<ops::CellId> cells;
  ops::CellId made_since = 0, asked_since = ops::asked_node(0);  ///< the first of these
};

/// Keeps the homological equivalence C <= B => S of a structure current over one ring.
class HomologyTracker {
 public:
  HomologyTracker() = default;
  HomologyTracker(const HomologyTracker&) = delete;
  HomologyTracker& operator=(const HomologyTracker&) = delete;
  virtual ~HomologyTracker() = default;

  static constexpr std::uint64_t unlimited = UINT64_MAX;

  /// Takes in the cells or the removals that the structure has gained since: those of one step. Cost: that of the step.
  ///
  /// False when there have been de-identifications and the step would cost more than a budget, in terms that are read:
  /// then the tracker is as it was at its last mark, which must be the moment before the step, and can only be undone.
  [[nodiscard]] virtual bool extend(std::uint64_t budget) = 0;
  /// Remembers this moment; `undo_to_mark` goes back to the last one remembered and forgets it. The structure must have
  /// been truncated to the same moment first.
  virtual void push_mark() = 0;
  virtual void undo_to_mark() = 0;
  /// Nobody will go back to the oldest moment that is remembered. Requires: there is one.
  virtual void forget_oldest_mark() = 0;

  /// A tracker of the structure as it is now that knows nothing of its history, and so cannot go back in it: what it
  /// describes is an equivalence of the same object, with a big complex of one generator for each cell. The present one
  /// may not have taken in the last step. Cost: that of reducing the object, lazy cells written out.
  [[nodiscard]] virtual std::unique_ptr<HomologyTracker> afresh() const = 0;
  /// What a tracker that was begun afresh, and has taken in nothing since, has done to the object, if it consists of
  /// eliminations: another one need not work it out again.
  [[nodiscard]] virtual std::optional<EliminationRecord> record() const = 0;
  /// The part of the history that it describes.
  [[nodiscard]] virtual const Window& window() const = 0;
  /// The copies made since the tracker began.
  [[nodiscard]] virtual std::uint32_t copies() const = 0;
  /// The cells taken away since.
  [[nodiscard]] virtual std::uint32_t deletions() const = 0;

  /// Betti numbers, torsion and sizes, with an entry for each of the first `dimensions` degrees: those that have cells.
  /// Cost O(dimensions), plus a Smith form of the core when that changed.
  [[nodiscard]] virtual Homology homology(std::size_t dimensions) = 0;
  /// The number of small generators of a body: a product has as many as those of its factors multiplied.
  [[nodiscard]] virtual std::uint64_t small_of(ops::BodyId body) const = 0;
  /// The generators of H_p one after another: those of finite order by increasing order, then the free ones. Each is
  /// worked out when it is its turn. A chain for which more than `most_terms` terms would have to be added up is not
  /// written out.
  virtual void visit_generators(int degree, std::uint64_t most_terms, const GeneratorVisitor& visit) = 0;
  /// All of them.
  [[nodiscard]] std::vector<Generator> generators(int degree) {
    std::vector<Generator> all;
    visit_generators(degree, uncountable, [&all](Generator generator) {
      all.push_back(std::move(generator));
      return true;
    });
    return all;
  }
  [[nodiscard]] virtual ClassAnswer classify(const CellChain& chain) = 0;

  /// F: C -> S, G: S -> C, K: C -> C of degree 1, with d K + K d = 1 - G F; and the boundaries of C and S.
  [[nodiscard]] virtual SmallChain apply_F(const CellChain& chain) = 0;
  [[nodiscard]] virtual CellChain apply_G(const SmallChain& chain) = 0;
  [[nodiscard]] virtual CellChain apply_K(const CellChain& chain) = 0;
  [[nodiscard]] virtual CellChain boundary(const CellChain& chain) const = 0;
  [[nodiscard]] virtual SmallChain boundary(const SmallChain& chain) = 0;

  /// Which class was born and died at which step. Requires: the ring is a field; every step not undone is remembered by
  /// `push_mark`, and no cells were split or consumed. Cost: the generators of B.
  [[nodiscard]] virtual std::vector<Lifetime> lifetimes() const = 0;

  [[nodiscard]] virtual Work work() const = 0;

  /// Checks every law of the equivalence and of the last step's exact sequence, and the homology against a Smith form
  /// computed from scratch. Returns the first that fails and where. Slow: for tests and audits.
  [[nodiscard]] virtual std::optional<std::string> first_defect(ops::StepKind last_step, ops::Moment before_it) = 0;
};

}  // namespace sesame::engine

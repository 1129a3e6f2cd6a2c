/// \file
/// The right reduction B => S as rewriting rules: eliminations of unit pairs, applied lazily, with memoised results.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/right/deletion_gains.hpp"
#include "engine/right/dependents.hpp"
#include "engine/right/effort.hpp"
#include "engine/right/elimination_record.hpp"
#include "engine/right/lifts.hpp"
#include "engine/right/memos.hpp"
#include "engine/right/perturbations.hpp"
#include "engine/right/rules.hpp"
#include "engine/right/settling.hpp"
#include "sparse/column_store.hpp"

namespace sesame::engine {

/// The right reduction (f, g, h): B => S, kept while B grows, and the small complex S. Each of its parts has a class of
/// its own:
///
///   Rules           symbols, and the rules that write one in later ones, as they were made
///   Perturbations   what rules have gained since by de-identifications
///   Dependents      where one can be felt
///   Lifts           h and g, by the rules as they were made
///   DeletionGains   what small symbols gain by deletions
///   Memos           f, by memoised results of the rules
///   Settling        dS: eliminations, and over Z the core of what has no unit
///
/// Source: engine/LIVE_FORM.md.
template <Ring R>
class Rewriter {
 public:
  using TermType = sparse::Term<R, Symbol>;
  using TermOfB = sparse::Term<R, GeneratorId>;

  /// `boundary` is dB; it grows outside, a column before the generator is announced here by `append`.
  Rewriter(R ring, const sparse::ColumnStore<R, GeneratorId>& boundary);
  Rewriter(const Rewriter&) = delete;
  Rewriter& operator=(const Rewriter&) = delete;

  /// Makes room for generators of B.
  void reserve(std::size_t generators) {
    rules_.reserve(generators);
    memos_.reserve(generators);
  }
  /// Takes the next generator of B: rewrites its boundary, and eliminates or keeps it.
  /// Cost: the length of the vectors that are rewritten.
  void append(int degree);
  /// Takes the first generators of B, those of a reduction that was recorded: their boundaries need not be rewritten.
  /// Requires: there are none yet, and `record` is one of a reduction of this boundary. What it says is checked as far
  /// as rules could otherwise not be followed.
  void append_recorded(std::span<const int> degrees, const EliminationRecord& record);
  /// The eliminations and the core, when there is nothing else: no changes of basis, perturbations or consumptions.
  [[nodiscard]] std::optional<EliminationRecord> record() const;

  /// Takes note that the boundaries of some old generators have gained terms in generators that were appended since
  /// `time`, the first of them `first`: a de-identification. The boundaries of those must not have changed.
  /// Cost: when the changed generators are in no rule, their number. Else that of the lifts of the small generators
  /// that may have one of them, as far as rules made after the oldest changed one are concerned, and of finding these.
  void perturb(RuleId time, GeneratorId first, std::span<const GeneratorId> changed);
  /// The same of a deletion, whose only new generator is `deletion`, with boundary 0. Lifts that were worked out
  /// for one deletion are known to the next as long as there are only these and new generators.
  void take_away(RuleId time, GeneratorId deletion, std::span<const GeneratorId> changed);
  /// Takes small generators out of S, with their boundaries: what they generate is no longer part of the object. They
  /// stay what chains of B that have them are rewritten to.
  void consume(std::span<const Symbol> symbols);

  /// f: the image in S of a chain of B, in symbols. Cost: amortised, the length of the memoised vectors that it reads.
  [[nodiscard]] Terms<R, Symbol> rewrite(std::span<const TermOfB> chain_of_b);
  /// h, as a trace, of a chain of B. Cost: the rules that apply, each once, times the logarithm of their number.
  [[nodiscard]] Trace<R> trace(std::span<const TermOfB> chain_of_b) { return lifts_.trace(chain_of_b); }
  /// g of a chain of S (in symbols) plus sum trace[a] V(b_a): a chain of B in normal form.
  /// Cost: each rule involved is expanded once; one that is `known` by its trace only.
  [[nodiscard]] Terms<R, GeneratorId> lift(std::span<const TermType> chain_of_s, const Trace<R>& trace = {},
                                           KnownTraces<R>* known = nullptr) {
    return lifts_.lift(chain_of_s, trace, known);
  }

  /// From now on work may cost this much, in terms that are read, each as often as its coefficient has words; what
  /// would go beyond throws OverBudget. After that only `undo` to a mark made before is allowed, once `drop_work` was
  /// called.
  void set_budget(std::uint64_t terms) { effort_.set_budget(terms); }
  /// Forgets what an OverBudget has cut off.
  void drop_work();

  /// The small generators of a degree, oldest first.
  [[nodiscard]] std::vector<Symbol> small(int degree) const { return rules_.small(degree); }
  /// Calls visit(x) for all of them, by degree.
  template <class Visit>
  void for_each_small(Visit visit) const {
    for (int p = 0; p < static_cast<int>(small_counts().size()); ++p) {
      for (const Symbol x : small(p)) {
        visit(x);
      }
    }
  }
  /// The number of small generators of each degree.
  [[nodiscard]] const std::vector<std::uint32_t>& small_counts() const { return rules_.small_counts(); }
  /// dS of a small generator, in symbols.
  [[nodiscard]] const TorsionCore<R>& core() const { return settling_.core(); }
  [[nodiscard]] int degree(Symbol x) const { return rules_.degree(x); }
  /// The generator of B that a symbol is, or one of those that it is a combination of.
  [[nodiscard]] GeneratorId generator_in(Symbol x) const { return rules_.generator_in(x); }
  /// The small generator of which one of B is that one; no_symbol when there is none.
  [[nodiscard]] Symbol small_of(GeneratorId generator) const { return rules_.small_of(generator); }
  /// Calls visit(a, b) for each elimination, with the two generators of B. Requires: the ring is a field, so that every
  /// symbol is a generator.
  template <class Visit>
  void for_each_pair(Visit visit) const {
    rules_.for_each_pair(visit);
  }
  /// The terms ever read while rewriting: what rewriting has cost.
  [[nodiscard]] std::uint64_t terms_read() const { return effort_.terms_read(); }
  /// The terms of all rules ever made, undone ones included.
  [[nodiscard]] std::uint64_t rule_terms() const { return rules_.terms_made(); }
  [[nodiscard]] RuleId rules() const { return rules_.size(); }
  /// All rules as they were made: what has become of the small generators.
  [[nodiscard]] const Rules<R>& all_rules() const { return rules_; }
  /// Grows whenever S has changed otherwise than by new generators and new rules: by a split, a deletion that changes
  /// the column of an older symbol, a consumption, undo.
  [[nodiscard]] std::uint64_t breaks() const { return breaks_; }

  /// How much there was of everything at some moment.
  struct Mark {
    typename Rules<R>::Mark rules;
    std::size_t perturbations = 0;
    typename TorsionCore<R>::Mark core = 0;
    std::size_t memos = 0;
  };
  /// A mark to which `undo` can go back.
  [[nodiscard]] Mark mark();
  /// Goes back to a mark. Cost: what was done since.
  void undo(const Mark& mark);
  /// Undo will not go back beyond a mark.
  void forget_before(const Mark& mark) { memos_.forget_before(mark.memos); }

 private:
  [[nodiscard]] std::uint64_t candidates(std::span<const GeneratorId> changed) const;
  [[nodiscard]] typename Perturbations<R>::Reached lifts_with(std::span<const GeneratorId> changed);
  using Reached = typename Perturbations<R>::Reached;
  void extend_dependents(std::span<const GeneratorId> changed, Symbol first);
  typename Perturbations<R>::Concerned record_perturbation(RuleId time, Symbol first,
                                                           std::span<const GeneratorId> changed, const Reached& reached,
                                                           bool is_deletion);
  void extend_column_of(Symbol x, const Terms<R, Symbol>& gain);
  bool settle_gains(Symbol e);
  [[nodiscard]] bool is_index_worth_it(std::span<const GeneratorId> changed) const;

  const sparse::ColumnStore<R, GeneratorId>& boundary_;
  Effort effort_;
  Rules<R> rules_;
  Perturbations<R> perturbations_;
  Dependents<R> dependents_;
  Lifts<R> lifts_;
  Memos<R> memos_;
  Settling<R> settling_;
  DeletionGains<R> deletion_gains_;
  static constexpr std::uint64_t few = 4;               ///< small symbols: not worth a search
  static constexpr std::uint64_t terms_of_a_lift = 16;  ///< that are read for a small symbol, at least
  std::uint64_t looked_at_ = 0;                         ///< small symbols, for want of `dependents_`
  std::uint64_t searched_ = 0;                          ///< by `dependents_`, for want of an index of deletions
  Terms<R, Symbol> column_;                             ///< scratch
  std::uint64_t breaks_ = 0;
};

}  // namespace sesame::engine

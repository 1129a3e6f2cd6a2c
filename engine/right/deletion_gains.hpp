/// \file
/// What small symbols gain when cells are taken away.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "engine/right/correctable_deletions.hpp"
#include "engine/right/corrected_lifts.hpp"
#include "engine/right/effort.hpp"
#include "engine/right/known_lifts.hpp"
#include "engine/right/lift_index.hpp"
#include "engine/right/lifts.hpp"
#include "engine/right/perturbations.hpp"
#include "engine/right/rules.hpp"
#include "engine/right/torsion_core.hpp"
#include "sparse/column_store.hpp"

namespace sesame::engine {

/// A deletion appends a generator e with boundary 0, and the boundaries of some generators gain multiples of it. So
/// that of a small x gains a multiple, too: delta(V(x)), the sum over the coefficients of these generators in its lift.
///
/// Lifts that were worked out for one deletion are known to the next (KnownLifts, CorrectedLifts).
///
/// Invariant: what is known was true for the small symbols then, and is for those that were eliminated with an e.
/// Source: engine/LIVE_FORM.md.
template <Ring R>
class DeletionGains {
 public:
  using Element = typename R::Element;
  using TermOfB = sparse::Term<R, GeneratorId>;

  /// All of them must outlive it.
  DeletionGains(R ring, const sparse::ColumnStore<R, GeneratorId>& boundary, const Rules<R>& rules,
                const TorsionCore<R>& core, Lifts<R>& lifts, Effort& effort)
      : ring_{ring},
        boundary_{boundary},
        rules_{rules},
        core_{core},
        lifts_{lifts},
        effort_{effort},
        known_{ring},
        corrected_{ring, boundary, rules, lifts, effort, known_, correctable_} {}

  /// A new generator is there. Cost: its boundary.
  void append(GeneratorId generator);
  /// A cell was taken away: `deletion` is the generator, and the boundaries of `changed` have gained multiples of it.
  void begin(GeneratorId deletion, std::span<const GeneratorId> changed);
  /// The small symbols whose lifts may have a changed generator, by increasing number; nothing: it is not known which.
  [[nodiscard]] typename Perturbations<R>::Reached small_with();
  /// From now on that is known for the degree of the changed generators: all small symbols of it are looked at next.
  void begin_index();

  /// Looks at a small symbol. Cost: that of its lift, unless that is known.
  void add(Symbol x);
  /// Of those that were looked at, the ones that gain something, with the coefficient of e in it; one with a short lift
  /// first: if that is eliminated with e, its lift is added to those of the others.
  [[nodiscard]] std::vector<sparse::Term<R, Symbol>> gained();
  /// What was gained has been settled, by rules from `since` on. `concerns_rules`: rules have to take the deletion in.
  void finish(RuleId since, bool concerns_rules);

  /// Lifts have changed, or rules were undone.
  void clear();

 private:
  struct Gained {
    Symbol x;
    Element coefficient;
    Terms<R, GeneratorId> lift;  ///< unless it is known
  };

  /// The small symbols of a degree by the generators in their lifts. The lift of one with a boundary changes when rules
  /// eliminate what is in that: then its column in the core is another one, and never again what it was.
  struct Index {
    LiftIndex lifts;
    Symbol until{};                            ///< small symbols before are in it,
    std::map<Symbol, Terms<R, Symbol>> loose;  ///< these if they have this column still; an empty one is nobody's
  };

  [[nodiscard]] int degree() const { return rules_.degree(rules_.symbol_of(deletion_)); }
  [[nodiscard]] Index* index();
  [[nodiscard]] std::vector<Symbol> changed_loose();
  void add_to_index(Symbol x, const Terms<R, GeneratorId>& lift);
  [[nodiscard]] Terms<R, GeneratorId> learn(Symbol x);
  void follow(RuleId since);
  void subtract(Gained& x, const Gained& z);

  R ring_;
  const sparse::ColumnStore<R, GeneratorId>& boundary_;
  const Rules<R>& rules_;
  const TorsionCore<R>& core_;
  Lifts<R>& lifts_;
  Effort& effort_;
  KnownLifts<R> known_;
  CorrectableDeletions correctable_;
  CorrectedLifts<R> corrected_;
  std::map<int, Index> indices_;  ///< by the degree of e
  RuleId seen_{};                 ///< all rules before are taken account of
  // Of the deletion at hand.
  GeneratorId deletion_;
  std::span<const GeneratorId> changed_;
  std::vector<Gained> gained_;
};

}  // namespace sesame::engine

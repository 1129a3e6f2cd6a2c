/// \file
/// The perturbations of B's boundary, and what the rules have gained by them.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "engine/right/rules.hpp"

namespace sesame::engine {

/// *A perturbation* is what a de-identification does: boundaries of old generators b gain terms delta(b) in new
/// generators e, the copies. Then the rule that b made has -e^-1 delta(V(b)) more, for the e are eliminated after it;
/// and the boundary of a small x has delta(V(x)) more. The latter is worked out at once, the former when a rule is
/// read.
///
/// This is the record: which perturbations there were, seen by degree, and for each rule the sum of the delta(V(b))
/// that it has *taken in*, its gain, with their number. What delta(V(b)) is, Lifts work out.
///
/// Invariants: a rule has taken in an initial part of the perturbations of its degree, those made before it included;
/// the terms of a gain, and those that columns of combinations gained, are in symbols from the first new one of their
/// perturbation on, so that undo cuts them off there.
///
/// Source: the basic perturbation lemma; see engine/LIVE_FORM.md.
template <Ring R>
class Perturbations {
 public:
  using Element = typename R::Element;
  using TermType = sparse::Term<R, Symbol>;

  /// `rules` must outlive it.
  Perturbations(R ring, Rules<R>& rules) : ring_{ring}, rules_{rules} {}

  /// Whose boundaries a perturbation may change.
  struct Concerned {
    std::set<Symbol> small;
    std::vector<std::size_t> combinations;  ///< by their place in Rules::combinations
  };
  /// The symbols whose lifts may have a changed generator, by increasing number; nothing: any may.
  using Reached = std::optional<std::vector<Symbol>>;
  /// Boundaries have gained terms in symbols from one on, by a perturbation that is not recorded yet: until it is,
  /// rules do not take these terms in, as they would do so twice.
  void expect(Symbol first) { expected_ = first; }
  /// Takes note of a perturbation of the boundaries of `changed`, in symbols from `first` on, which were made at `time`
  /// or later. Cost: the changed generators, the combinations, and, when a changed one may be in a lift, the symbols
  /// that are reached, or the small symbols of its degree.
  Concerned record(RuleId time, Symbol first, std::span<const GeneratorId> changed, const Reached& reached = {},
                   bool is_deletion = false);
  /// Grows with each `record`.
  [[nodiscard]] std::uint64_t version() const { return recorded_; }

  /// The serial number of the last perturbation that concerns a rule and is felt, made before or after it; 0: none.
  [[nodiscard]] std::uint64_t last(RuleId rule) const {
    const std::size_t q = degree_of_b(rule);
    if (q >= of_degree_.size() || of_degree_[q].empty() || of_degree_[q].back().last_felt == nobody) {
      return 0;
    }
    return of_degree_[q][of_degree_[q].back().last_felt].serial;
  }
  /// A perturbation with one new symbol is not felt once that is rewritten to 0: it changes no image then, and results
  /// from before it stand. Looks at the last ones, down to one that is felt. To be called after the last `record`, as
  /// it is undone with that. Cost: those that are felt no more, and the degrees.
  void forget_those_not_felt();
  /// How many perturbations there had been at a time of the degree that concerns a rule.
  [[nodiscard]] std::size_t until(RuleId rule, RuleId time) const {
    return of_degree_.empty() ? 0 : until(degree_of_b(rule), time);
  }
  /// How many there are of the degree that concerns a rule whose new symbols are older than one.
  [[nodiscard]] std::size_t before(RuleId rule, Symbol first) const;
  /// Whether the last one concerns any rule.
  [[nodiscard]] bool last_concerns_rules() const { return !steps_.back().degrees.empty(); }
  /// Whether one of the first `count` of them is one that the rule has not taken in.
  [[nodiscard]] bool lacks_any_of(std::size_t count, RuleId rule) const {
    if (count == 0) {
      return false;
    }
    const Gain* gained = find_gain(rule);
    return gained != nullptr ? count > gained->taken_in : of_degree_[degree_of_b(rule)][count - 1].time > rule;
  }
  /// Whether there has been a perturbation that a rule has not taken in and that may change it.
  [[nodiscard]] bool is_behind(RuleId rule) const;
  /// The first symbol that rules do not take in yet.
  [[nodiscard]] Symbol expected() const { return expected_; }
  /// The first new symbol of the perturbations that a rule has not taken in. Requires: there is one.
  [[nodiscard]] Symbol first_missing(RuleId rule) const { return of_degree_[degree_of_b(rule)][taken_in(rule)].first; }

  /// delta(V(b)) for the b of a rule, by all perturbations that it has taken in; in normal form.
  [[nodiscard]] std::span<const TermType> gain(RuleId rule) const {
    const Gain* gained = find_gain(rule);
    return gained != nullptr ? std::span<const TermType>{gained->terms} : std::span<const TermType>{};
  }
  /// Calls visit(rule, gain) for all that have taken something in, in no order.
  template <class Visit>
  void for_each_gain(Visit visit) const {
    for (const Gain& gained : gains_) {
      visit(gained.rule, std::span<const TermType>{gained.terms});
    }
  }
  /// The value of a rule, with what it has gained: visit(symbol, coefficient). Gains are in younger symbols, so this is
  /// normal form.
  template <class Visit>
  void for_each_in_value(RuleId rule, Visit visit) const {
    for (const TermType& term : rules_.value(rule)) {
      visit(term.index, term.coefficient);
    }
    if (const std::span<const TermType> gained = gain(rule); !gained.empty()) {
      const Element factor = ring_.negate(rules_[rule].inverse);
      for (const TermType& term : gained) {
        visit(term.index, ring_.multiply(factor, term.coefficient));
      }
    }
  }

  /// A rule takes in all that it lacks: `more` is delta(V(b)) in symbols from `first_missing` on.
  void take_in(RuleId rule, const Terms<R, Symbol>& more);
  /// The column of a combination gains what the last perturbation gives it.
  void extend_column(std::size_t combination, const Terms<R, Symbol>& more);

  [[nodiscard]] std::size_t size() const { return steps_.size(); }
  /// Goes back to a number of perturbations; the rules from `rules` on are still there, and about to be undone.
  void undo(std::size_t size, RuleId rules);

 private:
  /// A perturbation as one degree of changed generators sees it.
  struct Perturbation {
    RuleId time;
    RuleId since;             ///< rules made before cannot depend on a changed generator
    Symbol first;             ///< of the new symbols
    std::uint32_t last_felt;  ///< the place of the last one until this that is felt, or nobody
    std::uint64_t serial;     ///< from 1
    bool is_deletion;         ///< with one new symbol
  };
  /// A perturbation, for undo.
  struct Step {
    Symbol first;
    std::vector<int> degrees;
    std::vector<RuleId> rules;                                       ///< that took it in while it was the last
    std::vector<std::size_t> combinations;                           ///< whose column it changed
    std::vector<std::pair<std::size_t, std::uint32_t>> felt_before;  ///< by degree, of those not its own
  };
  struct Gain {
    RuleId rule;
    Terms<R, Symbol> terms;
    std::size_t taken_in = 0;
  };

  [[nodiscard]] std::size_t degree_of_b(RuleId rule) const {
    return static_cast<std::size_t>(rules_.degree(rules_[rule].a)) + 1;
  }
  [[nodiscard]] std::size_t until(std::size_t degree, RuleId time) const;
  /// As the b of a rule, or as the a of one without a value.
  [[nodiscard]] bool is_rewritten_to_zero(Symbol x) const {
    const RuleId rule = rules_.removed_by(x);
    return rule != no_rule && (!rules_.is_rewritten(x) || (rules_.value(rule).empty() && gain(rule).empty()));
  }
  [[nodiscard]] std::size_t taken_in(RuleId rule) const;
  [[nodiscard]] const Gain* find_gain(RuleId rule) const {
    return rule < place_.size() && place_[rule] != no_place ? &gains_[place_[rule]] : nullptr;
  }
  [[nodiscard]] Gain* find_gain(RuleId rule) { return const_cast<Gain*>(std::as_const(*this).find_gain(rule)); }
  void forget_gain(RuleId rule);
  void undo_last();

  R ring_;
  Rules<R>& rules_;
  std::vector<std::vector<Perturbation>> of_degree_;  ///< by the degree of the changed generators
  std::vector<Step> steps_;
  static constexpr std::uint32_t no_place = UINT32_MAX, nobody = UINT32_MAX;
  std::vector<Gain> gains_;
  std::vector<std::uint32_t> place_;  ///< per rule, as far as needed: of its gain
  std::uint64_t last_serial_ = 0, recorded_ = 0;
  Symbol expected_ = no_symbol;
};

}  // namespace sesame::engine

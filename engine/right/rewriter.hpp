/// \file
/// The right reduction B => S as rewriting rules: eliminations of unit pairs, applied lazily, with memoised results.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/right/torsion_core.hpp"
#include "sparse/accumulator.hpp"
#include "sparse/matrix.hpp"

namespace sesame::engine {

/// Rules are counted from 0 in the order in which they were made; time t is the moment when t of them existed.
using RuleId = std::uint32_t;
using sparse::Integer;
inline constexpr RuleId no_rule = UINT32_MAX;

/// Thrown by a Rewriter whose work has come to cost more than it was given: not an error, but a way out of nested work
/// whose results are worth less than a fresh start.
struct OverBudget {};

/// Coefficients of a rewriting by rule: what the homotopy h is made of.
template <Ring R>
using Trace = std::vector<std::pair<RuleId, typename R::Element>>;

/// The sequence of elementary reductions that leads from B to the small complex S.
///
/// *Symbols* are the generators of B, in order, mixed with those that changes of basis made. A rule says how one symbol
/// is written in later ones:
///
///   elimination of (a, b), d b = e a + rest, e a unit:   a -> -e^-1 rest,   b -> 0
///   change of basis x' = x - q y (over Z only):          x -> x' + q y
///
/// Over a field b is paired with the youngest symbol of its rewritten boundary, and dS = 0. Over Z the boundaries
/// without a unit are the TorsionCore. They are brought towards Hermite form, so that units hidden in them appear and
/// are eliminated, as far as coefficients stay small and within a number of moves for each generator: see LIVE_FORM.md.
///
/// *Rewriting* a chain of B gives its image under f: B -> S. Results are memoised per rule and brought up to date when
/// they are read. The homotopy h and the lift g: S -> B use the rules as they were made, through *traces*:
/// h(v) = sum trace[a] V(b_a), and V_t(x) = x - sum trace_t(d x)[a] V(b_a) with the rules made before t.
///
/// *A perturbation* is what a de-identification does: boundaries of old generators b gain terms delta(b) in new
/// generators e, the copies. Then the rule that b made has -e^-1 delta(V(b)) more, for the e are eliminated after it;
/// and the boundary of a small x has delta(V(x)) more. The latter is worked out at once, the former when a rule is
/// read: a rule keeps the sum of its changes and the number of perturbations that it has taken in.
///
/// Source: for rules, traces, lifts and perturbations see engine/LIVE_FORM.md.
template <Ring R>
class Rewriter {
 public:
  using Element = typename R::Element;
  using TermType = sparse::Term<R>;

  /// `boundary` is dB; it grows outside, a column before the generator is announced here by `append`.
  Rewriter(R ring, const sparse::Matrix<R>& boundary) : ring_{ring}, boundary_{boundary}, sum_{ring} {}

  /// Takes the next generator of B: rewrites its boundary, and eliminates or keeps it.
  /// Cost: the length of the vectors that are rewritten.
  void append(int degree);

  /// Takes note that the boundaries of some old generators have gained terms in generators that were appended since
  /// `time`, the first of them `first`: a de-identification. The boundaries of those must not have changed.
  /// Cost: when the changed generators are in no rule, their number. Else that of the lifts of the small generators
  /// whose degree is that of a changed one, as far as rules made after the oldest changed one are concerned.
  void perturb(RuleId time, Index first, std::span<const Index> changed);
  /// Takes small generators out of S, with their boundaries: what they generate is no longer part of the object. They
  /// stay what chains of B that have them are rewritten to.
  void consume(std::span<const Symbol> symbols);

  /// f: the image in S of a chain of B, in symbols. Cost: amortised, the length of the memoised vectors that it reads.
  [[nodiscard]] Terms<R> rewrite(std::span<const TermType> chain_of_b);
  /// h, as a trace, of a chain of B. Cost: the rules that apply, each once, times the logarithm of their number.
  [[nodiscard]] Trace<R> trace(std::span<const TermType> chain_of_b);
  /// g of a chain of S (in symbols) plus sum trace[a] V(b_a): a chain of B in normal form.
  /// Cost: each rule involved is expanded once.
  [[nodiscard]] Terms<R> lift(std::span<const TermType> chain_of_s, const Trace<R>& trace = {});

  /// From now on work may cost this much, in terms that are read, each as often as its coefficient has words; what
  /// would go beyond throws OverBudget. After that only `undo` to a mark made before is allowed, once `drop_work` was
  /// called.
  void set_budget(std::uint64_t terms);
  /// Forgets what an OverBudget has cut off.
  void drop_work();

  /// The small generators of a degree, oldest first.
  [[nodiscard]] std::vector<Symbol> small(int degree) const;
  /// The number of small generators of each degree.
  [[nodiscard]] const std::vector<std::uint32_t>& small_counts() const { return small_counts_; }
  /// dS of a small generator, in symbols.
  [[nodiscard]] const TorsionCore<R>& core() const { return core_; }
  [[nodiscard]] int degree(Symbol x) const { return degree_[x]; }
  /// The generator of B that a symbol is, or one of those that it is a combination of.
  [[nodiscard]] Index generator_in(Symbol x) const;
  /// Calls visit(a, b) for each elimination, with the two generators of B. Requires: the ring is a field, so that every
  /// symbol is a generator.
  template <class Visit>
  void for_each_pair(Visit visit) const {
    for (const Rule& rule : rules_) {
      if (rule.b != no_symbol) {
        visit(Index{generator_[rule.a]}, Index{generator_[rule.b]});
      }
    }
  }
  /// The terms ever read while rewriting: what rewriting has cost.
  [[nodiscard]] std::uint64_t terms_read() const { return terms_read_; }
  /// The terms of all rules ever made, undone ones included.
  [[nodiscard]] std::uint64_t rule_terms() const { return rule_terms_; }
  [[nodiscard]] RuleId rules() const { return static_cast<RuleId>(rules_.size()); }

  /// How much there was of everything at some moment.
  struct Mark {
    Symbol symbols = 0;
    RuleId rules = 0;
    std::uint32_t generators = 0;
    std::size_t values = 0;
    std::size_t memo_writes = 0;
    std::size_t core_journal = 0;
    std::size_t perturbations = 0;
  };
  /// A mark to which `undo` can go back.
  [[nodiscard]] Mark mark();
  /// Goes back to a mark. Cost: what was done since.
  void undo(const Mark& mark);

 private:
  struct Rule {
    Symbol a;
    Symbol b;         ///< no_symbol for a change of basis and for a symbol that was consumed
    Element inverse;  ///< e^-1; unused by a change of basis
    std::size_t value_begin;
    std::uint32_t value_size;
  };
  struct Memo {
    Terms<R> terms;
    std::uint64_t checked = 0;    ///< the version at which it was known to be in small symbols only
    std::uint64_t perturbed = 0;  ///< the serial number of the last perturbation that it takes into account
    std::uint32_t epoch = 0;      ///< in which it was last written
    bool written = false;         ///< else the value of the rule stands
  };
  /// A change of basis x' = x - q y made by rule `rule`; `column` is dS x' then.
  struct Combination {
    Symbol x, y;
    Element q;
    RuleId rule;
    Terms<R> column;
  };
  struct Neighbours {
    Symbol before, after;
  };
  /// A perturbation as one degree of changed generators sees it.
  struct Perturbation {
    RuleId time;
    RuleId since;  ///< rules made before cannot depend on a changed generator
    Symbol first;  ///< of the new generators
    std::uint64_t serial;
  };
  /// A perturbation, for undo.
  struct PerturbationStep {
    Symbol first;
    std::vector<int> degrees;
    std::vector<RuleId> rules;                ///< that took it in while it was the last
    std::vector<std::uint32_t> combinations;  ///< whose column it changed
  };
  /// The change of V(b)'s boundary for the b of a rule, and how many perturbations it takes into account.
  struct Change {
    Terms<R> terms;
    std::size_t taken_in = 0;
  };
  /// V_t(x) = generators - sum trace[a] V(b_a).
  struct Expansion {
    Terms<R> generators;
    Trace<R> trace;
  };

  [[nodiscard]] std::uint64_t effort() const { return terms_read_ + other_effort_; }
  void check_budget() const {
    if (effort() > effort_limit_) [[unlikely]] {
      throw OverBudget{};
    }
  }
  static std::uint64_t words(const Element& coefficient);
  static std::uint64_t words(const Terms<R>& terms);

  Symbol add_symbol(int degree, std::uint32_t generator);
  void drop_last_symbol();
  void unlink(Symbol x);
  void relink(Symbol x);
  RuleId push_rule(Symbol a, Symbol b, Element inverse, std::span<const TermType> value);
  void pop_rule();

  void eliminate(Symbol a, Symbol b, const Terms<R>& column);
  void settle();
  void settle_column(Symbol x);
  [[nodiscard]] const TermType* mild_unit(const Terms<R>& column) const;
  [[nodiscard]] Integer largest(const Terms<R>& column) const;
  [[nodiscard]] Integer content(const Terms<R>& column) const;
  bool reduce_rows(Symbol x);
  bool combine(Symbol x, const Element& q, Symbol y);
  void substitute_row(Symbol row, std::span<const TermType> value);

  [[nodiscard]] std::span<const TermType> value(RuleId rule) const {
    return {values_.data() + rules_[rule].value_begin, rules_[rule].value_size};
  }
  template <class Visit>
  void for_each_in_value(RuleId rule, Visit visit) const;
  [[nodiscard]] std::uint64_t last_perturbation(RuleId rule) const;
  [[nodiscard]] std::size_t perturbations_until(int degree, RuleId time) const;
  [[nodiscard]] std::size_t taken_in(RuleId rule) const;
  [[nodiscard]] bool is_behind(RuleId rule) const;
  void take_in(RuleId rule);
  [[nodiscard]] Terms<R> change_now(Symbol x, RuleId time, Symbol first);
  [[nodiscard]] Expansion expansion(Symbol x, RuleId time);
  [[nodiscard]] Terms<R> change_of(const Expansion& v, Symbol first);
  void undo_last_perturbation();
  [[nodiscard]] Terms<R> rewrite_symbols(std::span<const TermType> chain);
  Memo& writable_memo(RuleId rule);
  void refresh_memo(RuleId rule);
  std::span<const TermType> memoised(RuleId rule);
  [[nodiscard]] bool is_eliminated_a(Symbol x) const { return state_[x] != no_rule && rules_[state_[x]].a == x; }
  [[nodiscard]] std::span<const TermType> memo_terms(RuleId rule) const {
    return memos_[rule].written ? std::span<const TermType>{memos_[rule].terms} : value(rule);
  }
  void update_memo(RuleId rule);
  void add_rewritten(Symbol x, const Element& coefficient);

  template <class Add, class AddRule>
  void expand(RuleId time, Symbol x, const Element& coefficient, Terms<R>& generators, Add add, AddRule add_rule);
  template <class Begin>
  Trace<R> run_trace(RuleId before, Begin begin);
  Trace<R> trace_of_boundary(Symbol x, RuleId before);

  R ring_;
  const sparse::Matrix<R>& boundary_;
  // Per symbol.
  std::vector<RuleId> state_;  ///< the rule that removed it, or no_rule: it is small
  std::vector<std::uint8_t> degree_;
  std::vector<std::uint32_t> generator_;  ///< of B, or virtual_bit | index in combinations_
  std::vector<RuleId> born_;              ///< the time at which it was made
  std::vector<Neighbours> neighbours_;    ///< small symbols of a degree: a doubly linked list, undone in reverse order
  // Per degree.
  std::vector<Symbol> first_, last_;
  std::vector<std::uint32_t> small_counts_;

  std::vector<Symbol> symbol_of_;  ///< per generator of B
  std::vector<Combination> combinations_;
  std::vector<Rule> rules_;
  std::vector<TermType> values_;
  std::vector<Memo> memos_;
  std::vector<std::pair<RuleId, Memo>> memo_writes_;  ///< memos as they were, for undo: each once per epoch
  std::uint64_t version_ = 1;                         ///< grows with every rule made or undone
  std::uint32_t epoch_ = 1;                           ///< grows with every mark and undo

  std::uint64_t terms_read_ = 0, rule_terms_ = 0;
  std::uint64_t other_effort_ = 0;  ///< terms of traces and of the core, words of large coefficients
  std::uint64_t effort_limit_ = UINT64_MAX;

  TorsionCore<R> core_;
  std::set<Symbol> unsettled_;
  int moves_left_ = 0;                                    ///< changes of basis that this step may still make
  std::vector<std::vector<Perturbation>> perturbations_;  ///< by the degree of the changed generators
  std::vector<PerturbationStep> perturbation_steps_;
  std::unordered_map<RuleId, Change> changes_;
  std::uint64_t last_serial_ = 0;
  sparse::Accumulator<R> sum_;
  /// One for each trace that is running: taking in a change may start another.
  std::deque<sparse::Accumulator<R>> traced_;
  std::size_t traces_running_ = 0;
  Terms<R> column_;
  std::vector<RuleId> pending_;
};

}  // namespace sesame::engine

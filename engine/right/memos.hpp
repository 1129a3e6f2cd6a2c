/// \file
/// Rewriting chains of B to chains of S, with a memoised result for each rule.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/right/effort.hpp"
#include "engine/right/lifts.hpp"
#include "engine/right/perturbations.hpp"
#include "engine/right/rules.hpp"
#include "sparse/accumulator.hpp"
#include "sparse/growing_array.hpp"

namespace sesame::engine {

/// What is kept of a rule that was read. Without anything written, its value stands.
template <Ring R>
struct RewritingMemo {
  struct Written {
    Terms<R, Symbol> terms;
    std::uint32_t epoch = 0;  ///< in which that was
  };
  std::uint64_t checked = 0;    ///< the version at which it was known to be in small symbols only
  std::uint64_t perturbed = 0;  ///< the serial number of the last perturbation that it takes into account
  std::unique_ptr<Written> written;
};

}  // namespace sesame::engine

namespace sesame::sparse {

template <Ring R>
inline constexpr bool is_relocatable<engine::RewritingMemo<R>> = true;

}  // namespace sesame::sparse

namespace sesame::engine {

/// *Rewriting* replaces symbols by the values of their rules until all are small: on chains of B that is f: B -> S. The
/// *memo* of a rule is its value rewritten as far as it was when it was last read; it begins as the value itself, which
/// is not copied, and is brought up to date when it is read again.
///
/// Invariants: a memo that is `checked` at the present version has no symbol that a rule removes; one that is not has
/// the same image as the value of its rule, as long as no perturbation has changed that; one that was `perturbed`
/// before the last perturbation of its degree begins again from the value. Memos are written once per *epoch*, the time
/// between two moments that undo may go back to, with what they were kept for it.
template <Ring R>
class Memos {
 public:
  using Element = typename R::Element;
  using TermType = sparse::Term<R, Symbol>;

  /// All of them must outlive it.
  Memos(R ring, const Rules<R>& rules, const Perturbations<R>& perturbations, Lifts<R>& lifts, Effort& effort)
      : ring_{ring}, rules_{rules}, perturbations_{perturbations}, lifts_{lifts}, effort_{effort}, sum_{ring} {}

  /// The image in S of a sum of symbols, in normal form; `for_each(visit)` calls visit(symbol, coefficient) for each of
  /// its terms, and is called twice. Cost: amortised, the length of the memos that it reads.
  template <class ForEach>
  void rewrite(ForEach for_each, Terms<R, Symbol>& out) {
    // All memos first: bringing one up to date uses the same sum.
    for_each([this](Symbol x, const Element&) {
      if (rules_.is_rewritten(x)) {
        bring_up_to_date(rules_.removed_by(x));
      }
    });
    for_each([this](Symbol x, const Element& coefficient) { add_rewritten(x, coefficient); });
    sum_.finish(out);
  }

  [[nodiscard]] const R& ring() const { return ring_; }
  /// Makes room for symbols, about half of which are removed by rules.
  void reserve(std::size_t symbols) {
    memos_.reserve(symbols / 2);
    sum_.reserve(symbols);
  }
  /// The number of memos kept for undo, of those that are forgotten too.
  [[nodiscard]] std::size_t size() const { return forgotten_ + before_.size(); }
  /// From now on memos that are written are kept as they are at this moment.
  void begin_epoch() { ++epoch_; }
  /// Goes back to the memos of the moment when there were `size` kept. Requires: the rules have been undone to it.
  void undo(std::size_t size);
  /// Undo will not go back to when there were fewer kept.
  void forget_before(std::size_t size);

  /// Forgets what an OverBudget has cut off.
  void drop_work() { sum_.clear(); }

 private:
  using Memo = RewritingMemo<R>;

  /// Two equal ones mean that no memo that was up to date has stopped to be.
  [[nodiscard]] std::uint64_t version() const { return rules_.version() + perturbations_.version(); }
  [[nodiscard]] std::span<const TermType> terms(RuleId rule) const {
    return memos_[rule].written != nullptr ? std::span<const TermType>{memos_[rule].written->terms}
                                           : rules_.value(rule);
  }
  void bring_up_to_date(RuleId rule);
  void refresh(RuleId rule);
  void update(RuleId rule);
  Terms<R, Symbol>& writable(RuleId rule);
  /// Requires: the memo of the rule that removed x, if there is one, is up to date.
  void add_rewritten(Symbol x, const Element& coefficient) {
    const RuleId rule = rules_.removed_by(x);
    effort_.read(1);
    if (rule == no_rule) {
      sum_.add_product(x, coefficient, ring_.one());
    } else if (rules_[rule].a == x) {
      const std::span<const TermType> image = terms(rule);
      effort_.read(image.size());
      for (const auto& [y, factor] : image) {
        sum_.add_product(y, coefficient, factor);
      }
    }
  }

  R ring_;
  const Rules<R>& rules_;
  const Perturbations<R>& perturbations_;
  Lifts<R>& lifts_;
  Effort& effort_;
  sparse::GrowingArray<Memo> memos_;            ///< per rule; of the latest, which nobody has read yet, there are none
  std::deque<std::pair<RuleId, Memo>> before_;  ///< memos as they were, for undo: each once per epoch
  std::size_t forgotten_ = 0;                   ///< that were in front of these
  std::uint32_t epoch_ = 1;
  sparse::Accumulator<R, Symbol> sum_;
  std::vector<RuleId> pending_;  ///< scratch
};

}  // namespace sesame::engine

#include "engine/right/memos.hpp"

#include <algorithm>
#include <utility>

namespace sesame::engine {

/// Rules refer to younger rules, so there are no circles; the stack is explicit because chains of rules can be as long
/// as the history.
template <Ring R>
void Memos<R>::bring_up_to_date(RuleId rule) {
  if (memos_.size() < rules_.size()) {
    memos_.resize(rules_.size());
  }
  const std::uint64_t now = version();
  pending_.assign(1, rule);
  while (!pending_.empty()) {
    effort_.check();
    const RuleId top = pending_.back();
    bool is_current = memos_[top].checked == now;
    bool waits = false;
    if (!is_current) {
      if (memos_[top].perturbed != perturbations_.last(top)) {
        refresh(top);
      }
      is_current = true;
      const std::span<const TermType> image = terms(top);
      effort_.read(image.size());
      for (const TermType& term : image) {
        const RuleId next = rules_.removed_by(term.index);
        if (next == no_rule) {
          continue;
        }
        is_current = false;
        if (rules_[next].a == term.index && memos_[next].checked != now) {
          pending_.push_back(next);
          waits = true;
          break;
        }
      }
    }
    if (waits) {
      continue;
    }
    if (!is_current) {
      update(top);
    }
    memos_[top].checked = now;
    pending_.pop_back();
  }
}

/// The terms of the memo of a rule, to be written: as it was, it is remembered for undo.
template <Ring R>
Terms<R, Symbol>& Memos<R>::writable(RuleId rule) {
  Memo& memo = memos_[rule];
  if (memo.written == nullptr || memo.written->epoch != epoch_) {
    auto fresh = std::make_unique<typename Memo::Written>();
    fresh->epoch = epoch_;
    before_.emplace_back(rule, Memo{0, memo.perturbed, std::exchange(memo.written, std::move(fresh))});
  }
  return memo.written->terms;
}

template <Ring R>
void Memos<R>::update(RuleId rule) {
  for (const auto& [x, coefficient] : terms(rule)) {
    add_rewritten(x, coefficient);
  }
  sum_.finish(writable(rule));
}

/// What a memo says of rules that have been perturbed since is void: it begins again from the value of its own rule.
template <Ring R>
void Memos<R>::refresh(RuleId rule) {
  lifts_.take_in(rule);
  if (memos_[rule].written != nullptr || !perturbations_.gain(rule).empty()) {
    Terms<R, Symbol> value;
    perturbations_.for_each_in_value(rule, [&value](Symbol x, const Element& coefficient) {
      value.push_back({x, coefficient});
    });
    writable(rule) = std::move(value);
  }
  memos_[rule].perturbed = perturbations_.last(rule);
}

template <Ring R>
void Memos<R>::undo(std::size_t size) {
  memos_.resize(std::min<std::size_t>(memos_.size(), rules_.size()));
  while (this->size() > size) {
    auto& [rule, before] = before_.back();
    if (rule < memos_.size()) {
      memos_[rule] = std::move(before);  // checked at a version that is over
    }
    before_.pop_back();
  }
  ++epoch_;
}

template <Ring R>
void Memos<R>::forget_before(std::size_t size) {
  for (; forgotten_ < size && !before_.empty(); ++forgotten_) {
    before_.pop_front();
  }
}

#define SESAME_INSTANTIATE(R) template class Memos<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine

#include "engine/rewriter.hpp"

#include <algorithm>
#include <functional>
#include <queue>

namespace sesame::engine {
namespace {

constexpr std::uint32_t virtual_bit = 0x8000'0000U;

// Over Z: what may be multiplied into other columns. Without these limits random complexes of loops and squares, whose
// cores are dense, soon have coefficients of thousands of digits.
constexpr int largest_of_mild_column = 3;
constexpr int largest_of_combination = 100;
constexpr int moves_per_generator = 200;

bool is_virtual(std::uint32_t generator) { return (generator & virtual_bit) != 0; }

}  // namespace

// ---------------------------------------------------------------------------------------------- symbols and rules

template <Ring R>
Symbol Rewriter<R>::add_symbol(int degree, std::uint32_t generator) {
  const auto x = static_cast<Symbol>(state_.size());
  const auto p = static_cast<std::size_t>(degree);
  if (p >= first_.size()) {
    first_.resize(p + 1, no_symbol);
    last_.resize(p + 1, no_symbol);
    small_counts_.resize(p + 1, 0);
  }
  state_.push_back(no_rule);
  degree_.push_back(static_cast<std::uint8_t>(degree));
  generator_.push_back(generator);
  born_.push_back(rules());
  neighbours_.push_back({last_[p], no_symbol});
  relink(x);
  return x;
}

template <Ring R>
void Rewriter<R>::drop_last_symbol() {
  const auto x = static_cast<Symbol>(state_.size() - 1);
  unlink(x);
  if (is_virtual(generator_[x])) {
    combinations_.pop_back();
  } else {
    symbol_of_.pop_back();
  }
  state_.pop_back();
  degree_.pop_back();
  generator_.pop_back();
  born_.pop_back();
  neighbours_.pop_back();
}

template <Ring R>
void Rewriter<R>::unlink(Symbol x) {
  const auto p = static_cast<std::size_t>(degree_[x]);
  const auto [before, after] = neighbours_[x];
  (before == no_symbol ? first_[p] : neighbours_[before].after) = after;
  (after == no_symbol ? last_[p] : neighbours_[after].before) = before;
  --small_counts_[p];
}

/// Undoes the unlink of x, when everything that was linked or unlinked since has been undone.
template <Ring R>
void Rewriter<R>::relink(Symbol x) {
  const auto p = static_cast<std::size_t>(degree_[x]);
  const auto [before, after] = neighbours_[x];
  (before == no_symbol ? first_[p] : neighbours_[before].after) = x;
  (after == no_symbol ? last_[p] : neighbours_[after].before) = x;
  ++small_counts_[p];
}

template <Ring R>
RuleId Rewriter<R>::push_rule(Symbol a, Symbol b, Element inverse, std::span<const TermType> value) {
  const RuleId id = rules();
  rules_.push_back({a, b, std::move(inverse), values_.size(), static_cast<std::uint32_t>(value.size())});
  values_.insert(values_.end(), value.begin(), value.end());
  memos_.emplace_back();
  state_[a] = id;
  unlink(a);
  if (b != no_symbol) {
    state_[b] = id;
    unlink(b);
  }
  ++version_;
  return id;
}

template <Ring R>
void Rewriter<R>::pop_rule() {
  const Rule& rule = rules_.back();
  if (rule.b != no_symbol) {
    relink(rule.b);
    state_[rule.b] = no_rule;
  }
  relink(rule.a);
  state_[rule.a] = no_rule;
  values_.erase(values_.begin() + static_cast<std::ptrdiff_t>(rule.value_begin), values_.end());
  rules_.pop_back();
  memos_.pop_back();
}

template <Ring R>
std::vector<Symbol> Rewriter<R>::small(int degree) const {
  std::vector<Symbol> symbols;
  if (degree >= 0 && static_cast<std::size_t>(degree) < first_.size()) {
    for (Symbol x = first_[static_cast<std::size_t>(degree)]; x != no_symbol; x = neighbours_[x].after) {
      symbols.push_back(x);
    }
  }
  return symbols;
}

template <Ring R>
typename Rewriter<R>::Mark Rewriter<R>::mark() {
  ++epoch_;
  return {static_cast<Symbol>(state_.size()),
          rules(),
          static_cast<std::uint32_t>(symbol_of_.size()),
          values_.size(),
          memo_writes_.size(),
          core_.journal_size()};
}

template <Ring R>
void Rewriter<R>::undo(const Mark& mark) {
  core_.undo(mark.core_journal);
  while (rules_.size() > mark.rules || state_.size() > mark.symbols) {
    // A symbol was made after the last rule exactly when it was born at the present time.
    if (state_.size() > mark.symbols && born_.back() >= rules()) {
      drop_last_symbol();
    } else {
      pop_rule();
    }
  }
  while (memo_writes_.size() > mark.memo_writes) {
    auto& [rule, before] = memo_writes_.back();
    if (rule < rules()) {
      memos_[rule] = std::move(before);
      memos_[rule].checked = 0;
    }
    memo_writes_.pop_back();
  }
  ++version_;
  ++epoch_;
}

// -------------------------------------------------------------------------------------------------------- rewriting

template <Ring R>
void Rewriter<R>::add_rewritten(Symbol x, const Element& coefficient) {
  const RuleId rule = state_[x];
  ++terms_read_;
  if (rule == no_rule) {
    sum_.add_product(x, coefficient, ring_.one());
  } else if (rules_[rule].a == x) {
    terms_read_ += memo_terms(rule).size();
    for (const auto& [y, factor] : memo_terms(rule)) {
      sum_.add_product(y, coefficient, factor);
    }
  }
}

/// The memo of a rule in small symbols only. Rules refer to younger rules, so there are no circles; the stack is
/// explicit because chains of rules can be as long as the history.
template <Ring R>
std::span<const sparse::Term<R>> Rewriter<R>::memoised(RuleId rule) {
  pending_.assign(1, rule);
  while (!pending_.empty()) {
    const RuleId top = pending_.back();
    bool is_current = memos_[top].checked == version_;
    bool waits = false;
    if (!is_current) {
      is_current = true;
      terms_read_ += memo_terms(top).size();
      for (const TermType& term : memo_terms(top)) {
        const RuleId next = state_[term.index];
        if (next == no_rule) {
          continue;
        }
        is_current = false;
        if (rules_[next].a == term.index && memos_[next].checked != version_) {
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
      update_memo(top);
    }
    memos_[top].checked = version_;
    pending_.pop_back();
  }
  return memo_terms(rule);
}

template <Ring R>
void Rewriter<R>::update_memo(RuleId rule) {
  for (const auto& [x, coefficient] : memo_terms(rule)) {
    add_rewritten(x, coefficient);
  }
  Memo& memo = memos_[rule];
  if (memo.epoch != epoch_) {
    memo_writes_.emplace_back(rule, std::move(memo));
    memo = Memo{};
    memo.epoch = epoch_;
  }
  sum_.finish(memo.terms);
  memo.written = true;
}

template <Ring R>
Terms<R> Rewriter<R>::rewrite(std::span<const TermType> chain_of_b) {
  // All memos first: bringing one up to date uses the same sum.
  for (const TermType& term : chain_of_b) {
    if (const Symbol x = symbol_of_[term.index]; is_eliminated_a(x)) {
      memoised(state_[x]);
    }
  }
  for (const TermType& term : chain_of_b) {
    add_rewritten(symbol_of_[term.index], term.coefficient);
  }
  Terms<R> out;
  sum_.finish(out);
  return out;
}

template <Ring R>
void Rewriter<R>::append(int degree) {
  const auto generator = static_cast<std::uint32_t>(symbol_of_.size());
  const Symbol x = add_symbol(degree, generator);
  symbol_of_.push_back(x);
  boundary_.for_each_in_column(generator, [this](const TermType& term) {
    if (const Symbol y = symbol_of_[term.index]; is_eliminated_a(y)) {
      memoised(state_[y]);
    }
  });
  boundary_.for_each_in_column(
      generator, [this](const TermType& term) { add_rewritten(symbol_of_[term.index], term.coefficient); });
  sum_.finish(column_);
  if (column_.empty()) {
    return;
  }
  if (const TermType* unit = mild_unit(column_)) {
    eliminate(unit->index, x, column_);
  } else {
    core_.set(x, column_);
    unsettled_.insert(x);
  }
  if constexpr (!R::is_field) {
    settle();
  }
}

/// The youngest unit of a column that may be eliminated: over a field any, over Z when the other entries are small or
/// at most one. Others would be multiplied into every column that they meet; the Smith form deals with such a column
/// better.
template <Ring R>
const sparse::Term<R>* Rewriter<R>::mild_unit(const Terms<R>& column) const {
  if constexpr (!R::is_field) {
    if (column.size() > 2 && largest(column) > largest_of_mild_column) {
      return nullptr;
    }
  }
  for (auto term = column.rbegin(); term != column.rend(); ++term) {
    if (ring_.is_unit(term->coefficient)) {
      return &*term;
    }
  }
  return nullptr;
}

/// d b = column has the unit e at a: both go, a -> -e^-1 rest, b -> 0.
template <Ring R>
void Rewriter<R>::eliminate(Symbol a, Symbol b, const Terms<R>& column) {
  Terms<R> value;
  value.reserve(column.size() - 1);
  Element inverse = ring_.zero();
  for (const TermType& term : column) {
    if (term.index == a) {
      inverse = ring_.inverse(term.coefficient);
    }
  }
  const Element minus_inverse = ring_.negate(inverse);
  for (const TermType& term : column) {
    if (term.index != a) {
      value.push_back({term.index, ring_.multiply(minus_inverse, term.coefficient)});
    }
  }
  push_rule(a, b, std::move(inverse), value);
  if constexpr (!R::is_field) {
    core_.set(a, {});
    core_.set(b, {});
    substitute_row(a, value);
    substitute_row(b, {});
  }
}

// -------------------------------------------------------------------------------------- the torsion core, over Z only

/// Writes a row's symbol as `value` in every column of the core; the columns changed are to be settled again.
template <Ring R>
void Rewriter<R>::substitute_row(Symbol row, std::span<const TermType> value) {
  for (const Symbol z : core_.columns_with_row(row)) {
    Terms<R> column = *core_.find(z);
    const auto at = std::find_if(column.begin(), column.end(), [row](const TermType& t) { return t.index == row; });
    const Element coefficient = at->coefficient;
    column.erase(at);
    sparse::add_multiple(ring_, column, coefficient, value);
    core_.set(z, std::move(column));
    unsettled_.insert(z);
  }
}

template <Ring R>
void Rewriter<R>::settle() {
  moves_left_ = moves_per_generator;
  while (!unsettled_.empty()) {
    const Symbol x = *unsettled_.begin();
    unsettled_.erase(unsettled_.begin());
    if (core_.find(x) != nullptr) {
      settle_column(x);
    }
  }
}

/// One move towards Hermite form: a unit is eliminated; a column of coprime entries is made to have one; a shared pivot
/// is reduced by a step of Euclid's algorithm; an entry in another column's pivot row is brought below that pivot. What
/// is changed is queued again. A column stays as it is when the move would make coefficients grow, or when this step
/// has made all the moves that it may: nothing but speed and the size of S depends on them.
template <Ring R>
void Rewriter<R>::settle_column(Symbol x) {
  if (content(*core_.find(x)) == 1) {
    while (mild_unit(*core_.find(x)) == nullptr && reduce_rows(x)) {
    }
    const Terms<R> column = *core_.find(x);
    if (const TermType* unit = mild_unit(column)) {
      eliminate(unit->index, x, column);
    }
    return;
  }
  const Terms<R> column = *core_.find(x);
  const TermType& pivot = column.back();
  if (const Symbol y = core_.pivot_owner(pivot.index); y != no_symbol && y != x) {
    const Element q = ring_.quotient(pivot.coefficient, core_.find(y)->back().coefficient);
    if (!ring_.is_zero(q)) {
      combine(x, q, y);
    } else if (moves_left_-- > 0) {  // x has the smaller pivot: they change places
      core_.release_pivot(y);
      core_.own_pivot(x);
      unsettled_.insert(y);
    }
    return;
  }
  core_.own_pivot(x);
  for (auto term = std::next(column.rbegin()); term != column.rend(); ++term) {
    const Symbol y = core_.pivot_owner(term->index);
    if (y == no_symbol) {
      continue;
    }
    const Element q = ring_.quotient(term->coefficient, core_.find(y)->back().coefficient);
    if (!ring_.is_zero(q) && combine(x, q, y)) {
      return;
    }
  }
  for (const Symbol z : core_.columns_with_row(pivot.index)) {
    const Terms<R>& other = *core_.find(z);
    const auto at = std::find_if(other.begin(), other.end(), [&](const TermType& t) { return t.index == pivot.index; });
    if (z != x && moves_left_ > 0 && !ring_.is_zero(ring_.quotient(at->coefficient, pivot.coefficient))) {
      --moves_left_;
      unsettled_.insert(z);
    }
  }
}

template <Ring R>
Integer Rewriter<R>::largest(const Terms<R>& column) const {
  Integer most = 0;
  for (const TermType& term : column) {
    most = std::max(most, sparse::abs(ring_.to_integer(term.coefficient)));
  }
  return most;
}

template <Ring R>
Integer Rewriter<R>::content(const Terms<R>& column) const {
  Integer divisor = 0;
  for (const TermType& term : column) {
    divisor = sparse::gcd(divisor, ring_.to_integer(term.coefficient));
  }
  return divisor;
}

/// One step of Euclid's algorithm on the entries of a column, by a change of basis of its rows: m r + t s with t = q m
/// + n becomes m r' + n s with r' = r + q s. Repeated on coprime entries it ends with a unit, which no move of columns
/// might show. False when the step is not made.
template <Ring R>
bool Rewriter<R>::reduce_rows(Symbol x) {
  const Terms<R>& column = *core_.find(x);
  const auto size = [this](const TermType& term) { return sparse::abs(ring_.to_integer(term.coefficient)); };
  const TermType& least = *std::min_element(column.begin(), column.end(),
                                            [&](const TermType& a, const TermType& b) { return size(a) < size(b); });
  for (const TermType& term : column) {
    const Element q = ring_.quotient(term.coefficient, least.coefficient);
    if (!(ring_.multiply(q, least.coefficient) == term.coefficient)) {
      return combine(least.index, ring_.negate(q), term.index);
    }
  }
  return false;
}

/// The change of basis x' = x - q y: x -> x' + q y. False, and nothing is done, when a column of the core would get an
/// entry larger than any it has and not small, or when this step has made all its moves.
template <Ring R>
bool Rewriter<R>::combine(Symbol x, const Element& q, Symbol y) {
  if (moves_left_ <= 0) {
    return false;
  }
  const Terms<R>* column_x = core_.find(x);
  const Terms<R>* column_y = core_.find(y);
  Terms<R> column = column_x == nullptr ? Terms<R>{} : *column_x;
  const Integer before = largest(column);
  if (column_y != nullptr) {
    sparse::add_multiple<R>(ring_, column, ring_.negate(q), *column_y);
  }
  const auto grows = [&](const Integer& from, const Integer& to) { return to > from && to > largest_of_combination; };
  if (grows(before, largest(column))) {
    return false;
  }
  const auto combined = static_cast<Symbol>(state_.size());
  const Terms<R> value{{y, q}, {combined, ring_.one()}};  // y is older than the symbol to be made: this is normal form
  for (const Symbol z : core_.columns_with_row(x)) {
    Terms<R> changed = *core_.find(z);
    const auto at = std::find_if(changed.begin(), changed.end(), [x](const TermType& t) { return t.index == x; });
    sparse::add_multiple<R>(ring_, changed, Element{at->coefficient}, value);
    if (grows(largest(*core_.find(z)), largest(changed))) {
      return false;
    }
  }
  --moves_left_;
  const auto index = static_cast<std::uint32_t>(combinations_.size());
  add_symbol(degree_[x], virtual_bit | index);
  const RuleId rule = push_rule(x, no_symbol, ring_.zero(), value);
  combinations_.push_back({x, y, q, rule, column});
  core_.set(x, {});
  core_.set(combined, std::move(column));
  unsettled_.insert(combined);
  substitute_row(x, value);
  return true;
}

// ------------------------------------------------------------------------------------------------- traces and lifts

/// Rewrites with the rules made before a time, each as it was made, the earliest first; `begin(add)` adds what is to be
/// rewritten. Rules refer to later rules only, so each is applied at most once.
template <Ring R>
template <class Begin>
Trace<R> Rewriter<R>::run_trace(RuleId before, Begin begin) {
  std::priority_queue<RuleId, std::vector<RuleId>, std::greater<>> queue;
  const auto add = [&](Symbol x, const Element& factor, const Element& coefficient) {
    const RuleId rule = state_[x];
    if (rule < before && rules_[rule].a == x && traced_.add_product(x, factor, coefficient)) {
      queue.push(rule);
    }
  };
  begin(add);
  Trace<R> trace;
  while (!queue.empty()) {
    const RuleId rule = queue.top();
    queue.pop();
    const Element coefficient = traced_.take(rules_[rule].a);
    if (ring_.is_zero(coefficient)) {
      continue;
    }
    if (rules_[rule].b != no_symbol) {
      trace.emplace_back(rule, ring_.multiply(rules_[rule].inverse, coefficient));
    }
    for (const auto& [y, factor] : value(rule)) {
      add(y, coefficient, factor);
    }
  }
  traced_.finish(column_);  // all taken: this only clears
  return trace;
}

template <Ring R>
Trace<R> Rewriter<R>::trace(std::span<const TermType> chain_of_b) {
  return run_trace(rules(), [&](auto add) {
    for (const TermType& term : chain_of_b) {
      add(symbol_of_[term.index], term.coefficient, ring_.one());
    }
  });
}

/// The trace of the boundary of x by the rules made before a time (after its making, for a combination).
template <Ring R>
Trace<R> Rewriter<R>::trace_of_boundary(Symbol x, RuleId before) {
  return run_trace(before, [&](auto add) {
    if (is_virtual(generator_[x])) {
      for (const TermType& term : combinations_[generator_[x] & ~virtual_bit].column) {
        add(term.index, term.coefficient, ring_.one());
      }
    } else {
      boundary_.for_each_in_column(
          generator_[x], [&](const TermType& term) { add(symbol_of_[term.index], term.coefficient, ring_.one()); });
    }
  });
}

template <Ring R>
Terms<R> Rewriter<R>::lift(std::span<const TermType> chain_of_s, const Trace<R>& trace) {
  // What is still to be expanded: V_t(x) with its coefficient, the latest t first. Expanding one leads to earlier ones
  // only, so equal ones have been added up by the time their turn comes.
  std::map<std::pair<RuleId, Symbol>, Element, std::greater<>> pending;
  const auto add = [&](RuleId time, Symbol x, const Element& factor, const Element& coefficient) {
    ring_.add_product(pending.try_emplace({time, x}, ring_.zero()).first->second, factor, coefficient);
  };
  for (const TermType& term : chain_of_s) {
    add(rules(), term.index, term.coefficient, ring_.one());
  }
  for (const auto& [rule, coefficient] : trace) {
    add(rule, rules_[rule].b, coefficient, ring_.one());
  }
  Terms<R> chain;
  while (!pending.empty()) {
    const auto node = pending.extract(pending.begin());
    const auto [time, x] = node.key();
    const Element& coefficient = node.mapped();
    if (ring_.is_zero(coefficient)) {
      continue;
    }
    if (is_virtual(generator_[x])) {
      const Combination& combination = combinations_[generator_[x] & ~virtual_bit];
      add(combination.rule, combination.x, coefficient, ring_.one());
      add(combination.rule, combination.y, ring_.negate(coefficient), combination.q);
    } else {
      chain.push_back({generator_[x], coefficient});
    }
    const Element minus = ring_.negate(coefficient);
    for (const auto& [rule, factor] : trace_of_boundary(x, time)) {
      add(rule, rules_[rule].b, minus, factor);
    }
  }
  sparse::normalize(ring_, chain);
  return chain;
}

#define SESAME_INSTANTIATE(R) template class Rewriter<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine

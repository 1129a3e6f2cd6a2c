#include "engine/right/rewriter.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <tuple>

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

// ----------------------------------------------------------------------------------------------------------- budget

template <Ring R>
void Rewriter<R>::set_budget(std::uint64_t terms) {
  effort_limit_ = terms < UINT64_MAX - effort() ? effort() + terms : UINT64_MAX;
}

template <Ring R>
void Rewriter<R>::drop_work() {
  Terms<R> nothing;
  sum_.finish(nothing);
  for (sparse::Accumulator<R>& traced : traced_) {
    traced.finish(nothing);
  }
  traces_running_ = 0;
  unsettled_.clear();
}

/// The words that a coefficient is held in: what arithmetic on it costs.
template <Ring R>
std::uint64_t Rewriter<R>::words(const Element& coefficient) {
  if constexpr (requires { coefficient.words(); }) {
    return coefficient.words();
  }
  return 1;
}

template <Ring R>
std::uint64_t Rewriter<R>::words(const Terms<R>& terms) {
  std::uint64_t sum = 0;
  for (const TermType& term : terms) {
    sum += words(term.coefficient);
  }
  return sum;
}

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
  rule_terms_ += value.size();
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
void Rewriter<R>::consume(std::span<const Symbol> symbols) {
  for (const Symbol x : symbols) {
    push_rule(x, no_symbol, ring_.zero(), {});
    state_[x] = no_rule;  // rewriting ends at it
    if constexpr (!R::is_field) {
      core_.set(x, {});
    }
  }
}

template <Ring R>
Index Rewriter<R>::generator_in(Symbol x) const {
  while (is_virtual(generator_[x])) {
    x = combinations_[generator_[x] & ~virtual_bit].x;
  }
  return generator_[x];
}

template <Ring R>
void Rewriter<R>::pop_rule() {
  const Rule& rule = rules_.back();
  if (!changes_.empty()) {
    changes_.erase(rules() - 1);
  }
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
          core_.journal_size(),
          perturbation_steps_.size()};
}

template <Ring R>
void Rewriter<R>::undo(const Mark& mark) {
  while (perturbation_steps_.size() > mark.perturbations) {
    undo_last_perturbation();
  }
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
    check_budget();
    const RuleId top = pending_.back();
    bool is_current = memos_[top].checked == version_;
    bool waits = false;
    if (!is_current) {
      if (memos_[top].perturbed != last_perturbation(top)) {
        refresh_memo(top);
      }
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

/// The memo of a rule, to be written: as it was, it is remembered for undo.
template <Ring R>
typename Rewriter<R>::Memo& Rewriter<R>::writable_memo(RuleId rule) {
  Memo& memo = memos_[rule];
  if (memo.epoch != epoch_) {
    memo_writes_.emplace_back(rule, std::move(memo));
    memo = Memo{};
    memo.perturbed = memo_writes_.back().second.perturbed;
    memo.epoch = epoch_;
  }
  memo.written = true;
  return memo;
}

template <Ring R>
void Rewriter<R>::update_memo(RuleId rule) {
  for (const auto& [x, coefficient] : memo_terms(rule)) {
    add_rewritten(x, coefficient);
  }
  sum_.finish(writable_memo(rule).terms);
}

/// What a memo says of rules that have been perturbed since is void: it starts again from the value of its own rule.
template <Ring R>
void Rewriter<R>::refresh_memo(RuleId rule) {
  take_in(rule);
  const auto change = changes_.find(rule);
  if (memos_[rule].written || (change != changes_.end() && !change->second.terms.empty())) {
    Terms<R> terms;
    for_each_in_value(rule, [&terms](Symbol x, const Element& coefficient) { terms.push_back({x, coefficient}); });
    writable_memo(rule).terms = std::move(terms);
  }
  memos_[rule].perturbed = last_perturbation(rule);
}

template <Ring R>
Terms<R> Rewriter<R>::rewrite(std::span<const TermType> chain_of_b) {
  Terms<R> symbols;
  symbols.reserve(chain_of_b.size());
  for (const TermType& term : chain_of_b) {
    symbols.push_back({symbol_of_[term.index], term.coefficient});
  }
  return rewrite_symbols(symbols);
}

template <Ring R>
Terms<R> Rewriter<R>::rewrite_symbols(std::span<const TermType> chain) {
  // All memos first: bringing one up to date uses the same sum.
  for (const TermType& term : chain) {
    if (is_eliminated_a(term.index)) {
      memoised(state_[term.index]);
    }
  }
  for (const TermType& term : chain) {
    add_rewritten(term.index, term.coefficient);
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
    other_effort_ += words(column);
    core_.set(z, std::move(column));
    unsettled_.insert(z);
  }
}

template <Ring R>
void Rewriter<R>::settle() {
  moves_left_ = moves_per_generator;
  while (!unsettled_.empty()) {
    check_budget();
    const Symbol x = *unsettled_.begin();
    unsettled_.erase(unsettled_.begin());
    if (const Terms<R>* column = core_.find(x)) {
      other_effort_ += words(*column);
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
  if (traces_running_ == traced_.size()) {
    traced_.emplace_back(ring_);
  }
  sparse::Accumulator<R>& traced = traced_[traces_running_++];
  std::priority_queue<RuleId, std::vector<RuleId>, std::greater<>> queue;
  const auto add = [&](Symbol x, const Element& factor, const Element& coefficient) {
    const RuleId rule = state_[x];
    if (rule < before && rules_[rule].a == x && traced.add_product(x, factor, coefficient)) {
      queue.push(rule);
    }
  };
  begin(add);
  Trace<R> trace;
  while (!queue.empty()) {
    const RuleId rule = queue.top();
    queue.pop();
    const Element coefficient = traced.take(rules_[rule].a);
    if (ring_.is_zero(coefficient)) {
      continue;
    }
    if (rules_[rule].b != no_symbol) {
      trace.emplace_back(rule, ring_.multiply(rules_[rule].inverse, coefficient));
    }
    if (perturbations_until(degree_[rules_[rule].a] + 1, before) > taken_in(rule)) {
      take_in(rule);  // else what it is behind with is in symbols that no rule of that time can use
    }
    const std::uint64_t weight = words(coefficient);
    for_each_in_value(rule, [&](Symbol y, const Element& factor) {
      other_effort_ += weight * words(factor);
      add(y, coefficient, factor);
    });
    check_budget();
  }
  Terms<R> nothing;
  traced.finish(nothing);  // all taken: this only clears
  --traces_running_;
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

/// One step of writing a * V_time(x) in generators of B and in lifts of earlier times: `add(time, y, coefficient)` is
/// told of those of a combination, `add_rule(rule, coefficient)` of those of the symbols b of rules.
template <Ring R>
template <class Add, class AddRule>
void Rewriter<R>::expand(RuleId time, Symbol x, const Element& a, Terms<R>& generators, Add add, AddRule add_rule) {
  if (is_virtual(generator_[x])) {
    const Combination& combination = combinations_[generator_[x] & ~virtual_bit];
    add(combination.rule, combination.x, a);
    add(combination.rule, combination.y, ring_.negate(ring_.multiply(a, combination.q)));
  } else {
    generators.push_back({generator_[x], a});
  }
  const Element minus = ring_.negate(a);
  for (const auto& [rule, factor] : trace_of_boundary(x, time)) {
    add_rule(rule, ring_.multiply(minus, factor));
  }
}

template <Ring R>
Terms<R> Rewriter<R>::lift(std::span<const TermType> chain_of_s, const Trace<R>& trace) {
  // What is still to be expanded: V_t(x) with its coefficient, the latest t first. Expanding one leads to earlier ones
  // only, so equal ones have been added up by the time their turn comes.
  std::map<std::pair<RuleId, Symbol>, Element, std::greater<>> pending;
  const auto add = [&](RuleId time, Symbol x, const Element& coefficient) {
    ring_.add_product(pending.try_emplace({time, x}, ring_.zero()).first->second, coefficient, ring_.one());
  };
  const auto add_rule = [&](RuleId rule, const Element& coefficient) { add(rule, rules_[rule].b, coefficient); };
  for (const TermType& term : chain_of_s) {
    add(rules(), term.index, term.coefficient);
  }
  for (const auto& [rule, coefficient] : trace) {
    add_rule(rule, coefficient);
  }
  Terms<R> chain;
  while (!pending.empty()) {
    const auto node = pending.extract(pending.begin());
    if (!ring_.is_zero(node.mapped())) {
      expand(node.key().first, node.key().second, node.mapped(), chain, add, add_rule);
    }
  }
  sparse::normalize(ring_, chain);
  return chain;
}

// ---------------------------------------------------------------------------------------------------- perturbations

/// The value of a rule, with the changes that it has taken in: these are in younger symbols, so this is normal form.
template <Ring R>
template <class Visit>
void Rewriter<R>::for_each_in_value(RuleId rule, Visit visit) const {
  for (const TermType& term : value(rule)) {
    visit(term.index, term.coefficient);
  }
  if (!changes_.empty()) {
    if (const auto change = changes_.find(rule); change != changes_.end()) {
      const Element factor = ring_.negate(rules_[rule].inverse);
      for (const TermType& term : change->second.terms) {
        visit(term.index, ring_.multiply(factor, term.coefficient));
      }
    }
  }
}

/// The serial number of the last perturbation that concerns a rule, of those made before or after it; 0: none.
template <Ring R>
std::uint64_t Rewriter<R>::last_perturbation(RuleId rule) const {
  const auto q = static_cast<std::size_t>(degree_[rules_[rule].a]) + 1;
  return q < perturbations_.size() && !perturbations_[q].empty() ? perturbations_[q].back().serial : 0;
}

/// How many perturbations of generators of a degree there had been at a time.
template <Ring R>
std::size_t Rewriter<R>::perturbations_until(int degree, RuleId time) const {
  const auto q = static_cast<std::size_t>(degree);
  if (q >= perturbations_.size()) {
    return 0;
  }
  const auto& all = perturbations_[q];
  const auto after = std::upper_bound(all.begin(), all.end(), time,
                                      [](RuleId t, const Perturbation& perturbation) { return t < perturbation.time; });
  return static_cast<std::size_t>(after - all.begin());
}

template <Ring R>
std::size_t Rewriter<R>::taken_in(RuleId rule) const {
  const auto change = changes_.find(rule);
  return change != changes_.end() ? change->second.taken_in : perturbations_until(degree_[rules_[rule].a] + 1, rule);
}

template <Ring R>
typename Rewriter<R>::Expansion Rewriter<R>::expansion(Symbol x, RuleId time) {
  Expansion v;
  std::vector<std::tuple<RuleId, Symbol, Element>> pending{{time, x, ring_.one()}};
  while (!pending.empty()) {
    const auto [t, y, coefficient] = pending.back();
    pending.pop_back();
    expand(
        t, y, coefficient, v.generators, [&](RuleId at, Symbol z, const Element& a) { pending.emplace_back(at, z, a); },
        [&](RuleId rule, const Element& a) { v.trace.emplace_back(rule, ring_.negate(a)); });
  }
  return v;
}

/// delta(V), in symbols from `first` on. Requires: the rules of the trace have taken in all changes.
template <Ring R>
Terms<R> Rewriter<R>::change_of(const Expansion& v, Symbol first) {
  Terms<R> change;
  for (const TermType& part : v.generators) {
    boundary_.for_each_in_column(part.index, [&](const TermType& term) {
      if (term.index > part.index && symbol_of_[term.index] >= first) {
        change.push_back({symbol_of_[term.index], ring_.multiply(part.coefficient, term.coefficient)});
      }
    });
  }
  for (const auto& [rule, coefficient] : v.trace) {
    if (const auto of_rule = changes_.find(rule); of_rule != changes_.end()) {
      for (const TermType& term : of_rule->second.terms) {
        if (term.index >= first) {
          change.push_back({term.index, ring_.negate(ring_.multiply(coefficient, term.coefficient))});
        }
      }
    }
  }
  other_effort_ += words(change);
  sparse::normalize(ring_, change);
  return change;
}

/// Whether there has been a perturbation that a rule has not taken in and that may change it.
template <Ring R>
bool Rewriter<R>::is_behind(RuleId rule) const {
  const auto q = static_cast<std::size_t>(degree_[rules_[rule].a]) + 1;
  if (q >= perturbations_.size() || perturbations_[q].empty() || rules_[rule].b == no_symbol) {
    return false;
  }
  const auto& all = perturbations_[q];
  return std::any_of(all.begin() + static_cast<std::ptrdiff_t>(taken_in(rule)), all.end(),
                     [rule](const Perturbation& perturbation) { return perturbation.since <= rule; });
}

/// Brings the value of a rule up to date, and of all rules that it depends on; with a stack of its own, for chains of
/// rules can be as long as the history.
template <Ring R>
void Rewriter<R>::take_in(RuleId rule) {
  if (!is_behind(rule)) {
    return;
  }
  struct Frame {
    RuleId rule;
    Expansion lift;  // of its b
    std::size_t next = 0;
  };
  std::vector<Frame> stack;
  const auto push = [&](RuleId r) {
    Expansion lift = expansion(rules_[r].b, r);
    stack.push_back({r, std::move(lift)});
  };
  push(rule);
  while (!stack.empty()) {
    Frame& top = stack.back();
    while (top.next < top.lift.trace.size() && !is_behind(top.lift.trace[top.next].first)) {
      ++top.next;
    }
    if (top.next < top.lift.trace.size()) {
      push(top.lift.trace[top.next].first);
      continue;
    }
    const RuleId done = top.rule;
    const std::size_t before = taken_in(done);
    const auto& all = perturbations_[static_cast<std::size_t>(degree_[rules_[done].a]) + 1];
    const Terms<R> change = change_of(top.lift, all[before].first);
    Change& sum = changes_[done];
    sum.terms.insert(sum.terms.end(), change.begin(), change.end());
    sum.taken_in = all.size();
    perturbation_steps_.back().rules.push_back(done);
    terms_read_ += change.size() + top.lift.trace.size();
    other_effort_ += words(change);
    stack.pop_back();
  }
}

/// delta(V_time(x)), in symbols from `first` on.
template <Ring R>
Terms<R> Rewriter<R>::change_now(Symbol x, RuleId time, Symbol first) {
  const Expansion v = expansion(x, time);
  for (const auto& [rule, coefficient] : v.trace) {
    take_in(rule);
  }
  return change_of(v, first);
}

template <Ring R>
void Rewriter<R>::perturb(RuleId time, Index first, std::span<const Index> changed) {
  const Symbol first_symbol = symbol_of_[first];
  std::set<int> combined;  // degrees with changes of basis
  for (const Combination& combination : combinations_) {
    combined.insert(degree_[combination.x]);
  }
  std::set<Symbol> concerned;   // small symbols whose boundary may change
  std::map<int, RuleId> since;  // by degree: rules made before do not have a changed generator in their lifts
  for (const Index generator : changed) {
    const Symbol x = symbol_of_[generator];
    const RuleId rule = state_[x];
    if (rule == no_rule) {
      concerned.insert(x);
    }
    // In the lifts of others are only the b of rules, and whatever is part of a combination.
    const bool is_combined = combined.contains(degree_[x]);
    if (is_combined || (rule != no_rule && rules_[rule].b == x)) {
      const RuleId from = is_combined ? born_[x] : rule;
      const auto [at, is_new] = since.try_emplace(degree_[x], from);
      at->second = std::min(at->second, from);
    }
  }
  std::vector<int> degrees;
  for (const auto& [degree, rule] : since) {
    degrees.push_back(degree);
    const auto q = static_cast<std::size_t>(degree);
    perturbations_.resize(std::max(perturbations_.size(), q + 1));
    perturbations_[q].push_back({time, rule, first_symbol, ++last_serial_});
    for (const Symbol x : small(degree)) {
      if (x < first_symbol) {
        concerned.insert(x);
      }
    }
  }
  perturbation_steps_.push_back({first_symbol, degrees, {}, {}});
  ++version_;
  for (std::uint32_t k = 0; k < combinations_.size() && !since.empty(); ++k) {
    const RuleId rule = combinations_[k].rule;
    const auto of_degree = since.find(degree_[combinations_[k].x]);
    if (rule < time && of_degree != since.end() && rule >= of_degree->second) {
      const Terms<R> change = change_now(value(rule).back().index, rule + 1, first_symbol);
      if (!change.empty()) {
        Terms<R>& column = combinations_[k].column;
        column.insert(column.end(), change.begin(), change.end());
        perturbation_steps_.back().combinations.push_back(k);
      }
    }
  }
  for (const Symbol x : concerned) {
    if (state_[x] != no_rule) {
      continue;
    }
    Terms<R> column = rewrite_symbols(change_now(x, rules(), first_symbol));
    if (column.empty()) {
      continue;
    }
    if constexpr (R::is_field) {
      eliminate(mild_unit(column)->index, x, column);
    } else {
      if (const Terms<R>* before = core_.find(x)) {
        sparse::add_multiple<R>(ring_, column, ring_.one(), *before);
      }
      core_.set(x, std::move(column));
      unsettled_.insert(x);
    }
  }
  if constexpr (!R::is_field) {
    settle();
  }
}

template <Ring R>
void Rewriter<R>::undo_last_perturbation() {
  const PerturbationStep step = std::move(perturbation_steps_.back());
  perturbation_steps_.pop_back();
  const auto strip = [&step](Terms<R>& terms) {
    std::erase_if(terms, [&step](const TermType& term) { return term.index >= step.first; });
  };
  for (const int degree : step.degrees) {
    perturbations_[static_cast<std::size_t>(degree)].pop_back();
  }
  for (const std::uint32_t k : step.combinations) {
    strip(combinations_[k].column);
  }
  for (const RuleId rule : step.rules) {
    const auto change = changes_.find(rule);
    if (change == changes_.end()) {
      continue;
    }
    strip(change->second.terms);
    const auto q = static_cast<std::size_t>(degree_[rules_[rule].a]) + 1;
    change->second.taken_in = std::min(change->second.taken_in, perturbations_[q].size());
    if (perturbation_steps_.empty()) {
      changes_.erase(change);
    } else {
      perturbation_steps_.back().rules.push_back(rule);
    }
  }
}

#define SESAME_INSTANTIATE(R) template class Rewriter<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine

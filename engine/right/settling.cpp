#include "engine/right/settling.hpp"

#include <algorithm>
#include <concepts>
#include <iterator>

#include "sparse/integer.hpp"

namespace sesame::engine {

using sparse::Integer;

namespace {

// What may be multiplied into other columns. Without these limits random complexes of loops and squares, whose cores
// are dense, soon have coefficients of thousands of digits.
constexpr int largest_of_mild_column = 3;
constexpr int largest_of_combination = 100;
constexpr int moves_per_step = 200;

template <Ring R>
Integer size_of(const R& ring, const sparse::Term<R, Symbol>& term) {
  Integer value = ring.to_integer(term.coefficient);
  return value.sign() < 0 ? -value : value;  // for machine words no call, unlike abs
}

template <Ring R>
Integer largest(const R& ring, const Terms<R, Symbol>& column) {
  Integer most = 0;
  for (const sparse::Term<R, Symbol>& term : column) {
    most = std::max(most, size_of(ring, term));
  }
  return most;
}

template <Ring R>
bool is_larger_than(int bound, const R& ring, const Terms<R, Symbol>& column) {
  return std::any_of(column.begin(), column.end(), [&](const sparse::Term<R, Symbol>& term) {
    if constexpr (std::same_as<typename R::Element, Integer>) {
      return term.coefficient > bound || term.coefficient < -bound;
    } else {
      return size_of(ring, term) > bound;
    }
  });
}

template <Ring R>
bool has_unit(const R& ring, const Terms<R, Symbol>& column) {
  return std::any_of(column.begin(), column.end(),
                     [&](const sparse::Term<R, Symbol>& term) { return ring.is_unit(term.coefficient); });
}

/// Whether the entries of a column, none of which is a unit, have no common divisor.
template <Ring R>
bool is_coprime(const R& ring, const Terms<R, Symbol>& column) {
  Integer divisor = 0;
  for (auto term = column.begin(); term != column.end() && divisor != 1; ++term) {
    divisor = sparse::gcd(divisor, ring.to_integer(term->coefficient));
  }
  return divisor == 1;
}

/// A column with `value` in the place of one of its rows.
template <Ring R>
Terms<R, Symbol> substituted(const R& ring, const Terms<R, Symbol>& column, Symbol row,
                             std::span<const sparse::Term<R, Symbol>> value) {
  const typename R::Element& factor = sparse::find_term<R>(column, row)->coefficient;
  Terms<R, Symbol> sum;
  sum.reserve(column.size() + value.size());
  auto more = value.begin();
  const auto add_more_before = [&](auto is_before) {
    for (; more != value.end() && is_before(more->index); ++more) {
      sum.push_back({more->index, ring.multiply(factor, more->coefficient)});
    }
  };
  for (const sparse::Term<R, Symbol>& term : column) {
    add_more_before([&](Symbol x) { return x < term.index; });
    const bool is_in_both = more != value.end() && more->index == term.index;
    if (term.index == row) {
      continue;  // where the value has it, too, that comes next
    }
    sum.push_back(term);
    if (is_in_both) {
      ring.add_product(sum.back().coefficient, factor, (more++)->coefficient);
      if (ring.is_zero(sum.back().coefficient)) {
        sum.pop_back();
      }
    }
  }
  add_more_before([](Symbol) { return true; });
  return sum;
}

/// Whether a coefficient has become larger than it was, and larger than small.
bool grows(const Integer& before, const Integer& after) { return after > before && after > largest_of_combination; }

}  // namespace

// ----------------------------------------------------------------------------------------------------- eliminations

template <Ring R>
void Settling<R>::place(Symbol x, const Terms<R, Symbol>& column) {
  if (const TermType* unit = mild_unit(column)) {
    eliminate(unit->index, x, column);
  } else {
    core_.set(x, column);
    unsettled_.insert(x);
  }
}

template <Ring R>
void Settling<R>::extend(Symbol x, Terms<R, Symbol> more) {
  if constexpr (R::is_field) {
    place(x, more);
  } else {
    if (const Terms<R, Symbol>* before = core_.find(x)) {
      sparse::add_multiple<R>(ring_, more, ring_.one(), *before);
    }
    core_.set(x, std::move(more));
    unsettled_.insert(x);
  }
}

template <Ring R>
void Settling<R>::restore(Symbol x, const Terms<R, Symbol>& column, bool owns_pivot) {
  core_.set(x, column);
  if (owns_pivot) {
    sparse::expects(core_.pivot_owner(column.back().index) == no_symbol, "a pivot has one owner");
    core_.own_pivot(x);
  }
}

template <Ring R>
void Settling<R>::consume(Symbol x) {
  rules_.consume(x);
  if constexpr (!R::is_field) {
    core_.set(x, {});
  }
}

/// The youngest unit of a column that may be eliminated: over a field any, over Z when the other entries are small or
/// at most one. Others would be multiplied into every column that they meet; the Smith form deals with such a column
/// better.
template <Ring R>
const sparse::Term<R, Symbol>* Settling<R>::mild_unit(const Terms<R, Symbol>& column) const {
  if constexpr (!R::is_field) {
    if (column.size() > 2 && is_larger_than(largest_of_mild_column, ring_, column)) {
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

/// d b = column has a unit at a: both go.
template <Ring R>
void Settling<R>::eliminate(Symbol a, Symbol b, const Terms<R, Symbol>& column) {
  const RuleId rule = rules_.eliminate(a, b, column);
  if constexpr (!R::is_field) {
    core_.set(a, {});
    core_.set(b, {});
    substitute_row(a, rules_.value(rule));
    substitute_row(b, {});
  }
}

// ------------------------------------------------------------------------------------------------- moves, over Z only

/// Writes a row's symbol as `value` in every column of the core; the columns changed are to be settled again.
template <Ring R>
void Settling<R>::substitute_row(Symbol row, std::span<const TermType> value) {
  for (const Symbol z : core_.columns_with_row(row)) {
    Terms<R, Symbol> column = substituted<R>(ring_, *core_.find(z), row, value);
    effort_.spend(words_of(column));
    core_.set(z, std::move(column));
    unsettled_.insert(z);
  }
}

template <Ring R>
void Settling<R>::settle() {
  if constexpr (!R::is_field) {
    moves_left_ = moves_per_step;
    while (!unsettled_.empty()) {
      effort_.check();
      const Symbol x = *unsettled_.begin();
      unsettled_.erase(unsettled_.begin());
      if (const Terms<R, Symbol>* column = core_.find(x)) {
        effort_.spend(words_of(*column));
        settle_column(x);
      }
    }
  }
}

/// One move towards Hermite form: a unit is eliminated; a column of coprime entries is made to have one; a shared pivot
/// is reduced by a step of Euclid's algorithm; an entry in another column's pivot row is brought below that pivot. What
/// is changed is queued again. A column stays as it is when the move would make coefficients grow, or when this step
/// has made all the moves that it may: nothing but speed and the size of S depends on them.
template <Ring R>
void Settling<R>::settle_column(Symbol x) {
  const Terms<R, Symbol>& column = *core_.find(x);
  if (has_unit(ring_, column) || is_coprime(ring_, column)) {
    settle_coprime(x);
    return;
  }
  const Symbol owner = core_.pivot_owner(core_.find(x)->back().index);
  if (owner != no_symbol && owner != x) {
    settle_pivot(x, owner);
    return;
  }
  core_.own_pivot(x);
  settle_row_of(x);
}

template <Ring R>
void Settling<R>::settle_coprime(Symbol x) {
  do {
    if (const TermType* unit = mild_unit(*core_.find(x))) {
      const Terms<R, Symbol> column = *core_.find(x);
      eliminate(unit->index, x, column);
      return;
    }
  } while (reduce_rows(x));
}

/// The pivot of x is owned by another column.
template <Ring R>
void Settling<R>::settle_pivot(Symbol x, Symbol owner) {
  const Element q = ring_.quotient(core_.find(x)->back().coefficient, core_.find(owner)->back().coefficient);
  if (!ring_.is_zero(q)) {
    combine(x, q, owner);
  } else if (moves_left_-- > 0) {  // x has the smaller pivot: they change places
    core_.release_pivot(owner);
    core_.own_pivot(x);
    unsettled_.insert(owner);
  }
}

/// x owns its pivot: its other entries are brought below the pivots of their rows; else whoever is not below x's is
/// queued.
template <Ring R>
void Settling<R>::settle_row_of(Symbol x) {
  const Terms<R, Symbol> column = *core_.find(x);
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
  const TermType& pivot = column.back();
  for (const Symbol z : core_.columns_with_row(pivot.index)) {
    const Element& other = sparse::find_term<R>(*core_.find(z), pivot.index)->coefficient;
    if (z != x && moves_left_ > 0 && !ring_.is_zero(ring_.quotient(other, pivot.coefficient))) {
      --moves_left_;
      unsettled_.insert(z);
    }
  }
}

/// One step of Euclid's algorithm on the entries of a column, by a change of basis of its rows: m r + t s with t = q m
/// + n becomes m r' + n s with r' = r + q s. Repeated on coprime entries it ends with a unit, which no move of columns
/// might show. False when the step is not made.
template <Ring R>
bool Settling<R>::reduce_rows(Symbol x) {
  const Terms<R, Symbol>& column = *core_.find(x);
  if (has_unit(ring_, column)) {
    return false;  // which divides all other entries
  }
  const TermType& least = *std::min_element(column.begin(), column.end(), [this](const auto& a, const auto& b) {
    return size_of(ring_, a) < size_of(ring_, b);
  });
  for (const TermType& term : column) {
    const Element q = ring_.quotient(term.coefficient, least.coefficient);
    if (!(ring_.multiply(q, least.coefficient) == term.coefficient)) {
      return combine(least.index, ring_.negate(q), term.index);
    }
  }
  return false;
}

/// The change of basis x' = x - q y. False, and nothing is done, when a column of the core would get an entry larger
/// than any it has and not small, or when this step has made all its moves.
template <Ring R>
bool Settling<R>::combine(Symbol x, const Element& q, Symbol y) {
  if (moves_left_ <= 0) {
    return false;
  }
  const Terms<R, Symbol>* column_x = core_.find(x);
  const Terms<R, Symbol>* column_y = core_.find(y);
  Terms<R, Symbol> column = column_x == nullptr ? Terms<R, Symbol>{} : *column_x;
  const Integer before = largest(ring_, column);
  if (column_y != nullptr) {
    sparse::add_multiple<R>(ring_, column, ring_.negate(q), *column_y);
  }
  if (grows(before, largest(ring_, column))) {
    return false;
  }
  const Symbol made = rules_.next_symbol();
  const Terms<R, Symbol> value{{y, q}, {made, ring_.one()}};
  for (const Symbol z : core_.columns_with_row(x)) {
    Terms<R, Symbol> changed = *core_.find(z);
    sparse::add_multiple<R>(ring_, changed, Element{sparse::find_term<R>(changed, x)->coefficient}, value);
    if (grows(largest(ring_, *core_.find(z)), largest(ring_, changed))) {
      return false;
    }
  }
  --moves_left_;
  rules_.change_basis(x, q, y, column);
  core_.set(x, {});
  core_.set(made, std::move(column));
  unsettled_.insert(made);
  substitute_row(x, value);
  return true;
}

#define SESAME_INSTANTIATE(R) template class Settling<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine

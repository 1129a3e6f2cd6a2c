#include "engine/right/torsion_core.hpp"

#include <algorithm>

namespace sesame::engine {

template <Ring R>
const Terms<R, Symbol>* TorsionCore<R>::find(Symbol x) const {
  const auto at = columns_.find(x);
  return at == columns_.end() ? nullptr : &at->second;
}

template <Ring R>
std::vector<Symbol> TorsionCore<R>::columns_with_row(Symbol row) const {
  const auto at = rows_.find(row);
  if (at == rows_.end()) {
    return {};
  }
  std::vector<Symbol> columns = at->second;
  std::sort(columns.begin(), columns.end());
  return columns;
}

template <Ring R>
Symbol TorsionCore<R>::pivot_owner(Symbol row) const {
  const auto at = pivots_.find(row);
  return at == pivots_.end() ? no_symbol : at->second;
}

template <Ring R>
void TorsionCore<R>::set(Symbol x, Column column) {
  const auto at = columns_.find(x);
  if (at == columns_.end() ? column.empty() : at->second == column) {
    return;
  }
  Edit& edit = edit_of(x);
  const bool is_first = !edit.before;
  replace(at, x, column);
  if (is_first) {
    edit.before = std::move(column);  // what it was
  }
}

/// The edit that holds what there was of x at the last mark.
template <Ring R>
typename TorsionCore<R>::Edit& TorsionCore<R>::edit_of(Symbol x) {
  const auto [at, is_new] = last_edit_.try_emplace(x, journal_.size());
  if (!is_new && at->second >= epoch_ && at->second < journal_.size() && journal_[at->second].x == x) {
    return journal_[at->second];
  }
  at->second = journal_.size();
  journal_.push_back({x, std::nullopt, owns_pivot(x)});
  return journal_.back();
}

/// Exchanges the column of x, which is at `at`, with another one.
template <Ring R>
void TorsionCore<R>::replace(Place at, Symbol x, Column& column) {
  ++version_;
  if (at == columns_.end()) {
    at = columns_.try_emplace(x).first;
  } else if (column.empty() || column.back().index != at->second.back().index) {
    set_ownership(x, false);
  }
  move_rows(x, at->second, column);
  at->second.swap(column);
  if (at->second.empty()) {
    columns_.erase(at);
  }
}

/// Tells the rows that only one of two columns has.
template <Ring R>
void TorsionCore<R>::move_rows(Symbol x, const Column& before, const Column& after) {
  auto a = before.begin();
  auto b = after.begin();
  while (a != before.end() || b != after.end()) {
    if (b == after.end() || (a != before.end() && a->index < b->index)) {
      leave_row(x, (a++)->index);
    } else if (a == before.end() || b->index < a->index) {
      rows_[(b++)->index].push_back(x);
    } else {
      ++a, ++b;
    }
  }
}

template <Ring R>
void TorsionCore<R>::leave_row(Symbol x, Symbol row) {
  const auto at = rows_.find(row);
  std::vector<Symbol>& in_row = at->second;
  *std::find(in_row.begin(), in_row.end(), x) = in_row.back();
  in_row.pop_back();
  if (in_row.empty()) {
    rows_.erase(at);
  }
}

template <Ring R>
bool TorsionCore<R>::owns_pivot(Symbol x) const {
  const Column* column = find(x);
  return column != nullptr && pivot_owner(column->back().index) == x;
}

template <Ring R>
void TorsionCore<R>::set_ownership(Symbol x, bool owns) {
  if (owns) {
    pivots_[find(x)->back().index] = x;
  } else if (owns_pivot(x)) {
    pivots_.erase(find(x)->back().index);
  }
}

template <Ring R>
void TorsionCore<R>::own_pivot(Symbol x) {
  if (!owns_pivot(x)) {
    edit_of(x);
    set_ownership(x, true);
  }
}

template <Ring R>
void TorsionCore<R>::release_pivot(Symbol x) {
  if (owns_pivot(x)) {
    edit_of(x);
    set_ownership(x, false);
  }
}

template <Ring R>
void TorsionCore<R>::undo(Mark mark) {
  // Pivots change hands in an epoch: all are released before any goes to whom it belonged.
  std::map<Symbol, bool> owned;
  while (journal_.size() > mark) {
    Edit edit = std::move(journal_.back());
    journal_.pop_back();
    set_ownership(edit.x, false);
    if (edit.before) {
      replace(columns_.find(edit.x), edit.x, *edit.before);
    }
    owned[edit.x] = edit.owned_pivot;
  }
  for (const auto& [x, owns] : owned) {
    if (owns) {
      set_ownership(x, true);
    }
  }
  epoch_ = mark;
}

#define SESAME_INSTANTIATE(R) template class TorsionCore<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine

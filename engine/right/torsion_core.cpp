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
  const Column* before = find(x);
  if (before == nullptr ? column.empty() : *before == column) {
    return;
  }
  journal_.push_back({x, before == nullptr ? Column{} : *before, owns_pivot(x)});
  replace(x, std::move(column));
}

template <Ring R>
void TorsionCore<R>::replace(Symbol x, Column column) {
  ++version_;
  if (const auto at = columns_.find(x); at != columns_.end()) {
    if (column.empty() || column.back().index != at->second.back().index) {
      set_ownership(x, false);
    }
    for (const auto& term : at->second) {
      std::vector<Symbol>& in_row = rows_[term.index];
      in_row.erase(std::find(in_row.begin(), in_row.end(), x));
      if (in_row.empty()) {
        rows_.erase(term.index);
      }
    }
    columns_.erase(at);
  }
  for (const auto& term : column) {
    rows_[term.index].push_back(x);
  }
  if (!column.empty()) {
    columns_.emplace(x, std::move(column));
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
    journal_.push_back({x, std::nullopt, false});
    set_ownership(x, true);
  }
}

template <Ring R>
void TorsionCore<R>::release_pivot(Symbol x) {
  if (owns_pivot(x)) {
    journal_.push_back({x, std::nullopt, true});
    set_ownership(x, false);
  }
}

template <Ring R>
void TorsionCore<R>::undo(std::size_t journal_size) {
  while (journal_.size() > journal_size) {
    Edit edit = std::move(journal_.back());
    journal_.pop_back();
    if (edit.before) {
      replace(edit.x, std::move(*edit.before));
    }
    if (find(edit.x) != nullptr) {
      set_ownership(edit.x, edit.owned_pivot);
    }
  }
}

#define SESAME_INSTANTIATE(R) template class TorsionCore<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine

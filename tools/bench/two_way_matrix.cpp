#include "tools/bench/two_way_matrix.hpp"

#include <algorithm>

namespace sesame::tools {

template <sparse::Ring R>
void TwoWayMatrix<R>::append_column(std::span<const sparse::Term<R>> terms) {
  const auto j = static_cast<Index>(columns_.size());
  columns_.emplace_back(terms.begin(), terms.end());
  for (const auto& term : terms) {
    list(term.index, j);
  }
  touched_ += terms.size();
}

template <sparse::Ring R>
void TwoWayMatrix<R>::add_to_column(Index j, const typename R::Element& factor,
                                    std::span<const sparse::Term<R>> terms) {
  touched_ += columns_[j].size() + terms.size();
  for (const auto& term : terms) {
    if (lists_rows_ && ring_.is_zero(entry(term.index, j))) {
      list(term.index, j);
    }
  }
  sparse::add_multiple(ring_, columns_[j], factor, terms);
}

template <sparse::Ring R>
const std::vector<sparse::Index>& TwoWayMatrix<R>::columns_with(Index row) {
  list_all();
  if (row >= rows_.size()) {
    rows_.resize(row + 1);
  }
  std::vector<Index>& listed = rows_[row];
  touched_ += listed.size();
  std::sort(listed.begin(), listed.end());
  listed.erase(std::unique(listed.begin(), listed.end()), listed.end());
  std::erase_if(listed, [&](Index j) { return ring_.is_zero(entry(row, j)); });
  return listed;
}

template <sparse::Ring R>
typename R::Element TwoWayMatrix<R>::entry(Index row, Index j) const {
  const Terms& column = columns_[j];
  const auto at = std::lower_bound(column.begin(), column.end(), row,
                                   [](const sparse::Term<R>& term, Index index) { return term.index < index; });
  return at != column.end() && at->index == row ? at->coefficient : ring_.zero();
}

template <sparse::Ring R>
void TwoWayMatrix<R>::substitute(Index row, const Terms& by) {
  const std::vector<Index> columns = columns_with(row);  // a copy: listings may move while rows are added
  for (const Index j : columns) {
    const typename R::Element coefficient = entry(row, j);
    std::erase_if(columns_[j], [row](const sparse::Term<R>& term) { return term.index == row; });
    add_to_column(j, coefficient, by);
  }
  rows_[row] = {};
}

template <sparse::Ring R>
std::uint64_t TwoWayMatrix<R>::entries() const {
  std::uint64_t entries = 0;
  for (const Terms& column : columns_) {
    entries += column.size();
  }
  return entries;
}

template <sparse::Ring R>
std::size_t TwoWayMatrix<R>::listed(Index row) {
  list_all();
  return row < rows_.size() ? rows_[row].size() : 0;
}

template <sparse::Ring R>
void TwoWayMatrix<R>::list_all() {
  if (lists_rows_) {
    return;
  }
  lists_rows_ = true;
  for (Index j = 0; j < columns_.size(); ++j) {
    touched_ += columns_[j].size();
    for (const auto& term : columns_[j]) {
      list(term.index, j);
    }
  }
}

template <sparse::Ring R>
void TwoWayMatrix<R>::list(Index row, Index j) {
  if (!lists_rows_) {
    return;
  }
  if (row >= rows_.size()) {
    rows_.resize(row + 1);
  }
  rows_[row].push_back(j);
}

#define SESAME_INSTANTIATE(R) template class TwoWayMatrix<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::tools

/// \file
/// The elimination behind Smith forms, kernels and cokernels. Part of their .cpp files, which alone include it.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "sparse/matrix.hpp"
#include "sparse/transform.hpp"

namespace sesame::sparse {

template <Ring R>
struct Pivot {
  Index row;
  Index column;
  typename R::Element value;
};

/// The part of a matrix that an elimination has left: it has none of the rows and columns of the pivots.
template <Ring R>
struct Residue {
  std::vector<Index> rows, columns;  ///< in the whole matrix; none is zero
  Lines<R> entries;                  ///< by columns, rows counted among its own
};

/// Absolute value as the size of an element, for choosing pivots: all units are equal.
template <Ring R>
Integer size_of(const R& ring, const typename R::Element& a) {
  if (ring.is_unit(a)) {
    return 1;
  }
  Integer value = ring.to_integer(a);
  return value.sign() < 0 ? -value : value;  // for machine words no call, unlike abs
}

/// Diagonalises a sparse matrix by column operations that clear the row of a pivot; once that row is clear, the row
/// operations that clear its column touch nothing else. Entries are kept by columns; rows only know where to look.
template <Ring R, class Left = NoTransform, class Right = NoTransform>
class DiagonalElimination {
 public:
  using Element = typename R::Element;

  /// `left` and `right` are told of the operations, see NoTransform.
  explicit DiagonalElimination(const Matrix<R>& matrix, Left left = {}, Right right = {})
      : ring_{matrix.ring()},
        columns_(matrix.columns()),
        rows_(matrix.rows()),
        row_sizes_(matrix.rows()),
        left_{std::move(left)},
        right_{std::move(right)} {
    for (Index j = 0; j < matrix.columns(); ++j) {
      columns_[j] = matrix.column(j);
      for (const Term<R>& entry : columns_[j]) {
        rows_[entry.index].push_back(j);
        ++row_sizes_[entry.index];
      }
      queue(j);
    }
  }

  /// All pivots that are left, in the order found. The matrix is zero apart from them.
  std::vector<Pivot<R>> run() {
    std::vector<Pivot<R>> pivots;
    while (take_pivot(next_pivot(), pivots)) {
    }
    return pivots;
  }
  /// The same, until coefficients begin to grow: then there is a `rest`.
  std::vector<Pivot<R>> run_while_small() {
    std::vector<Pivot<R>> pivots;
    while (!has_grown_ && take_pivot(next_pivot(), pivots)) {
    }
    return pivots;
  }
  /// The same, until there is no unit any more.
  std::vector<Pivot<R>> run_while_small_units() {
    std::vector<Pivot<R>> pivots;
    while (!has_grown_ && take_pivot(next_unit(), pivots)) {
    }
    return pivots;
  }
  [[nodiscard]] Residue<R> residue() const {
    Residue<R> residue;
    std::vector<Index> number(rows_.size(), 0);  // of its rows: from 1 on
    for (const Terms<R>& column : columns_) {
      for (const Term<R>& entry : column) {
        number[entry.index] = 1;
      }
    }
    for (Index i = 0; i < rows_.size(); ++i) {
      if (number[i] != 0) {
        residue.rows.push_back(i);
        number[i] = static_cast<Index>(residue.rows.size());
      }
    }
    for (Index j = 0; j < columns_.size(); ++j) {
      if (!columns_[j].empty()) {
        residue.columns.push_back(j);
        residue.entries.push_back(columns_[j]);
        for (Term<R>& entry : residue.entries.back()) {
          entry.index = number[entry.index] - 1;
        }
      }
    }
    return residue;
  }

  [[nodiscard]] const R& ring() const { return ring_; }
  Left& left() { return left_; }
  Right& right() { return right_; }

 private:
  using Candidate = std::pair<std::size_t, Index>;  // column size, column

  bool take_pivot(std::optional<Pivot<R>> pivot, std::vector<Pivot<R>>& pivots) {
    if (!pivot) {
      return false;
    }
    isolate(*pivot);
    make_positive(*pivot);
    columns_[pivot->column].clear();
    rows_[pivot->row] = {};
    pivots.push_back(std::move(*pivot));
    return true;
  }

  void queue(Index j) {
    if (!columns_[j].empty()) {
      queue_.push({columns_[j].size(), j});
    }
  }

  /// A unit, or, without units left, an entry of least absolute value.
  std::optional<Pivot<R>> next_pivot() {
    auto unit = next_unit();
    return unit ? unit : least_entry();
  }

  /// A unit with little fill-in: in one of the shortest columns, in its shortest row. A column is looked at again only
  /// after it has changed.
  std::optional<Pivot<R>> next_unit() {
    while (!queue_.empty()) {
      const auto [size, j] = queue_.top();
      queue_.pop();
      if (columns_[j].size() != size) {
        continue;
      }
      const Term<R>* best = nullptr;
      for (const Term<R>& entry : columns_[j]) {
        if (ring_.is_unit(entry.coefficient) &&
            (best == nullptr || row_sizes_[entry.index] < row_sizes_[best->index])) {
          best = &entry;
        }
      }
      if (best != nullptr) {
        return Pivot<R>{best->index, j, best->coefficient};
      }
    }
    return std::nullopt;
  }

  std::optional<Pivot<R>> least_entry() const {
    const Term<R>* best = nullptr;
    Index best_column = 0;
    Integer best_size;
    std::size_t best_fill = 0;
    for (Index j = 0; j < columns_.size(); ++j) {
      for (const Term<R>& entry : columns_[j]) {
        Integer size = size_of(ring_, entry.coefficient);
        if (best != nullptr && best_size < size) {
          continue;
        }
        const std::size_t fill = (columns_[j].size() - 1) * (row_sizes_[entry.index] - 1);
        if (best == nullptr || size < best_size || fill < best_fill) {
          best = &entry;
          best_column = j;
          best_size = std::move(size);
          best_fill = fill;
        }
      }
    }
    return best == nullptr ? std::nullopt : std::optional{Pivot<R>{best->index, best_column, best->coefficient}};
  }

  /// Brings the pivot to stand alone in its row and column. Whenever a remainder is left, it is smaller than the
  /// pivot and takes its place: so this ends.
  void isolate(Pivot<R>& pivot) {
    while (true) {
      if (const auto smaller = clear_row(pivot)) {
        pivot = *smaller;
      } else if (const auto lower = clear_column(pivot)) {
        pivot = *lower;
      } else {
        return;
      }
    }
  }

  [[nodiscard]] const Element* find(Index row, Index column) const {
    const Term<R>* term = find_term<R>(columns_[column], row);
    return term != nullptr ? &term->coefficient : nullptr;
  }

  /// Takes multiples of the pivot's column off the others that meet its row. The least remainder, if there is one.
  std::optional<Pivot<R>> clear_row(const Pivot<R>& pivot) {
    std::vector<Index>& row = rows_[pivot.row];
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    const std::vector<Index> others = std::exchange(row, {});
    std::optional<Pivot<R>> least;
    Terms<R> multiples;
    for (const Index k : others) {
      const Element* entry = find(pivot.row, k);
      if (entry == nullptr) {
        continue;
      }
      rows_[pivot.row].push_back(k);
      if (k == pivot.column) {
        continue;
      }
      const Element factor = ring_.negate(ring_.quotient(*entry, pivot.value));
      if (!ring_.is_zero(factor)) {
        add_column(k, factor, pivot.column);
        multiples.push_back({k, factor});
      }
      if (const Element* rest = find(pivot.row, k)) {
        keep_least(least, {pivot.row, k, *rest});
      }
    }
    right_.add(ring_, pivot.column, multiples, ring_.is_unit(pivot.value));
    return least;
  }

  /// Takes multiples of the pivot's row off the others that meet its column; requires the row to be clear.
  std::optional<Pivot<R>> clear_column(const Pivot<R>& pivot) {
    std::optional<Pivot<R>> least;
    Terms<R> cleared, multiples;
    for (Term<R>& entry : columns_[pivot.column]) {
      if (entry.index == pivot.row) {
        cleared.push_back(std::move(entry));
        continue;
      }
      const Element factor = ring_.negate(ring_.quotient(entry.coefficient, pivot.value));
      if (!ring_.is_zero(factor)) {
        multiples.push_back({entry.index, factor});
        ring_.add_product(entry.coefficient, factor, pivot.value);
      }
      if (ring_.is_zero(entry.coefficient)) {
        --row_sizes_[entry.index];
      } else {
        keep_least(least, {entry.index, pivot.column, entry.coefficient});
        cleared.push_back(std::move(entry));
      }
    }
    columns_[pivot.column] = std::move(cleared);
    left_.add(ring_, pivot.row, multiples, ring_.is_unit(pivot.value));
    return least;
  }

  void keep_least(std::optional<Pivot<R>>& least, Pivot<R> candidate) const {
    if (!least || size_of(ring_, candidate.value) < size_of(ring_, least->value)) {
      least = std::move(candidate);
    }
  }

  /// column[to] += factor column[from], with the rows told of new entries and of entries that went.
  void add_column(Index to, const Element& factor, Index from) {
    Terms<R>& column = columns_[to];
    sum_.clear();
    sum_.reserve(column.size() + columns_[from].size());
    auto a = column.begin();
    for (const Term<R>& b : columns_[from]) {
      while (a != column.end() && a->index < b.index) {
        sum_.push_back(std::move(*a++));
      }
      if (a == column.end() || b.index < a->index) {
        ++row_sizes_[b.index];
        rows_[b.index].push_back(to);
        sum_.push_back({b.index, ring_.multiply(factor, b.coefficient)});
      } else {
        ring_.add_product(a->coefficient, factor, b.coefficient);
        if (ring_.is_zero(a->coefficient)) {
          --row_sizes_[b.index];
        } else {
          has_grown_ = has_grown_ || is_large(a->coefficient);
          sum_.push_back(std::move(*a));
        }
        ++a;
      }
    }
    std::move(a, column.end(), std::back_inserter(sum_));
    column.swap(sum_);
    queue(to);
  }

  /// Of a coefficient that is more than what elimination makes of small entries when it goes well.
  [[nodiscard]] static bool is_large(const Element& a) {
    if constexpr (std::same_as<Element, Integer>) {
      constexpr std::int64_t bound = std::int64_t{1} << 40;
      return a > Integer{bound} || a < Integer{-bound};
    }
    return false;
  }

  /// Multiplies the new basis element of the source by a unit: the pivot becomes positive, over a field 1.
  void make_positive(Pivot<R>& pivot) {
    Element unit = ring_.one();
    if (ring_.is_unit(pivot.value)) {
      unit = ring_.inverse(pivot.value);
    } else if (ring_.to_integer(pivot.value).sign() < 0) {
      unit = ring_.negate(unit);
    }
    if (unit == ring_.one()) {
      return;
    }
    pivot.value = ring_.multiply(pivot.value, unit);
    right_.scale(ring_, pivot.column, unit);
  }

  R ring_;
  bool has_grown_ = false;  ///< some coefficient, at some time
  Lines<R> columns_;
  std::vector<std::vector<Index>> rows_;  ///< columns that meet the row: perhaps repeated, perhaps no longer
  std::vector<std::size_t> row_sizes_;    ///< the exact number of entries of the row
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue_;
  Left left_;
  Right right_;
  Terms<R> sum_;  ///< scratch
};

}  // namespace sesame::sparse

/// \file
/// The elimination behind the Smith form. Part of smith.cpp, which alone includes it.
#pragma once

#include <algorithm>
#include <concepts>
#include <functional>
#include <iterator>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "sparse/matrix.hpp"

namespace sesame::sparse {

template <Ring R>
using Lines = std::vector<Terms<R>>;

template <Ring R>
Lines<R> unit_lines(const R& ring, Index n) {
  Lines<R> lines(n);
  for (Index i = 0; i < n; ++i) {
    lines[i] = {{i, ring.one()}};
  }
  return lines;
}

template <Ring R>
void scale(const R& ring, Terms<R>& terms, const typename R::Element& a) {
  for (Term<R>& term : terms) {
    term.coefficient = ring.multiply(term.coefficient, a);
  }
}

/// A change of basis and its inverse: of one, the lines that an operation adds to; of the other, those it adds from.
template <Ring R>
struct Transform {
  Lines<R> forward;  ///< rows of left, or columns of right
  Lines<R> inverse;  ///< columns of left_inverse, or rows of right_inverse

  /// forward[k] += a forward[pivot] for each k a of `multiples`; and the inverse accordingly.
  void add(const R& ring, Index pivot, const Terms<R>& multiples) {
    RawTerms<R> gathered;  // what inverse[pivot] gains, added up at once
    for (const auto& [k, a] : multiples) {
      add_multiple<R>(ring, forward[k], a, forward[pivot]);
      for (const Term<R>& term : inverse[k]) {
        gathered.push_back({term.index, ring.multiply(ring.negate(a), term.coefficient)});
      }
    }
    add_multiple<R>(ring, inverse[pivot], ring.one(), std::move(gathered).normal(ring));
  }
};

template <Ring R>
struct Pivot {
  Index row;
  Index column;
  typename R::Element value;
};

/// Absolute value as the size of an element, for choosing pivots: all units are equal.
template <Ring R>
Integer size_of(const R& ring, const typename R::Element& a) {
  return ring.is_unit(a) ? Integer{1} : abs(ring.to_integer(a));
}

/// Diagonalises a sparse matrix by column operations that clear the row of a pivot; once that row is clear, the row
/// operations that clear its column touch nothing else. Entries are kept by columns; rows only know where to look.
template <Ring R>
class DiagonalElimination {
 public:
  using Element = typename R::Element;

  DiagonalElimination(const Matrix<R>& matrix, bool with_transforms)
      : ring_{matrix.ring()}, columns_(matrix.columns()), rows_(matrix.rows()), row_sizes_(matrix.rows()) {
    for (Index j = 0; j < matrix.columns(); ++j) {
      columns_[j] = matrix.column(j);
      for (const Term<R>& entry : columns_[j]) {
        rows_[entry.index].push_back(j);
        ++row_sizes_[entry.index];
      }
      queue(j);
    }
    if (with_transforms) {
      left_ = {unit_lines(ring_, matrix.rows()), unit_lines(ring_, matrix.rows())};
      right_ = {unit_lines(ring_, matrix.columns()), unit_lines(ring_, matrix.columns())};
    }
    with_transforms_ = with_transforms;
  }

  /// All pivots, in the order found. The matrix is zero apart from them.
  std::vector<Pivot<R>> run() {
    std::vector<Pivot<R>> pivots;
    while (take_pivot(pivots)) {
    }
    return pivots;
  }
  /// The same, until coefficients begin to grow: then there is a `rest`.
  std::vector<Pivot<R>> run_while_small() {
    std::vector<Pivot<R>> pivots;
    while (!has_grown_ && take_pivot(pivots)) {
    }
    return pivots;
  }
  /// The columns that are not zero yet; they have none of the rows of the pivots.
  [[nodiscard]] Lines<R> rest() const {
    Lines<R> rest;
    std::copy_if(columns_.begin(), columns_.end(), std::back_inserter(rest),
                 [](const Terms<R>& column) { return !column.empty(); });
    return rest;
  }

  Transform<R>& left() { return left_; }
  Transform<R>& right() { return right_; }

 private:
  using Candidate = std::pair<std::size_t, Index>;  // column size, column

  bool take_pivot(std::vector<Pivot<R>>& pivots) {
    auto pivot = next_pivot();
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

  /// A unit with little fill-in: in one of the shortest columns, in its shortest row. Without units left, an entry of
  /// least absolute value. A column is looked at again only after it has changed.
  std::optional<Pivot<R>> next_pivot() {
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
    return least_entry();
  }

  std::optional<Pivot<R>> least_entry() const {
    std::optional<Pivot<R>> best;
    Integer best_size;
    std::size_t best_fill = 0;
    for (Index j = 0; j < columns_.size(); ++j) {
      for (const Term<R>& entry : columns_[j]) {
        const Integer size = size_of(ring_, entry.coefficient);
        const std::size_t fill = (columns_[j].size() - 1) * (row_sizes_[entry.index] - 1);
        if (!best || size < best_size || (size == best_size && fill < best_fill)) {
          best = Pivot<R>{entry.index, j, entry.coefficient};
          best_size = size;
          best_fill = fill;
        }
      }
    }
    return best;
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
    if (with_transforms_) {
      right_.add(ring_, pivot.column, multiples);
    }
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
    if (with_transforms_) {
      left_.add(ring_, pivot.row, multiples);
    }
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
    column.assign(std::move_iterator(sum_.begin()), std::move_iterator(sum_.end()));
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
    if (with_transforms_) {
      scale(ring_, right_.forward[pivot.column], unit);
      scale(ring_, right_.inverse[pivot.column], ring_.inverse(unit));
    }
  }

  R ring_;
  bool with_transforms_ = false;
  bool has_grown_ = false;  ///< some coefficient, at some time
  Lines<R> columns_;
  std::vector<std::vector<Index>> rows_;  ///< columns that meet the row: perhaps repeated, perhaps no longer
  std::vector<std::size_t> row_sizes_;    ///< the exact number of entries of the row
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue_;
  Transform<R> left_;
  Transform<R> right_;
  Terms<R> sum_;  ///< scratch
};

}  // namespace sesame::sparse

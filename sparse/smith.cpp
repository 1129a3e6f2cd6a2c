#include "sparse/smith.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <optional>
#include <queue>
#include <utility>

namespace sesame::sparse {
namespace {

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

/// (x, y) becomes (a x + b y, c x + d y).
template <Ring R>
void combine(const R& ring, Terms<R>& x, Terms<R>& y, const std::array<typename R::Element, 4>& abcd) {
  Terms<R> first, second;
  add_multiple<R>(ring, first, abcd[0], x);
  add_multiple<R>(ring, first, abcd[1], y);
  add_multiple<R>(ring, second, abcd[2], x);
  add_multiple<R>(ring, second, abcd[3], y);
  x = std::move(first);
  y = std::move(second);
}

/// A change of basis and its inverse: of one, the lines that an operation adds to; of the other, those it adds from.
template <Ring R>
struct Transform {
  Lines<R> forward;  ///< rows of left, or columns of right
  Lines<R> inverse;  ///< columns of left_inverse, or rows of right_inverse

  /// forward[k] += a forward[pivot] for each k a of `multiples`; and the inverse accordingly.
  void add(const R& ring, Index pivot, const Terms<R>& multiples) {
    Terms<R> gathered;  // what inverse[pivot] gains, added up at once
    for (const auto& [k, a] : multiples) {
      add_multiple<R>(ring, forward[k], a, forward[pivot]);
      for (const Term<R>& term : inverse[k]) {
        gathered.push_back({term.index, ring.multiply(ring.negate(a), term.coefficient)});
      }
    }
    normalize(ring, gathered);
    add_multiple<R>(ring, inverse[pivot], ring.one(), gathered);
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
class Elimination {
 public:
  using Element = typename R::Element;

  Elimination(const Matrix<R>& matrix, bool with_transforms)
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
    while (auto pivot = next_pivot()) {
      isolate(*pivot);
      make_positive(*pivot);
      columns_[pivot->column].clear();
      rows_[pivot->row] = {};
      pivots.push_back(std::move(*pivot));
    }
    return pivots;
  }

  Transform<R>& left() { return left_; }
  Transform<R>& right() { return right_; }

 private:
  using Candidate = std::pair<std::size_t, Index>;  // column size, column

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
    const Terms<R>& terms = columns_[column];
    const auto at = std::lower_bound(terms.begin(), terms.end(), row,
                                     [](const Term<R>& term, Index index) { return term.index < index; });
    return at != terms.end() && at->index == row ? &at->coefficient : nullptr;
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
    const Terms<R> before = columns_[to];
    add_multiple<R>(ring_, columns_[to], factor, columns_[from]);
    auto a = before.begin();
    auto b = columns_[to].begin();
    while (a != before.end() || b != columns_[to].end()) {
      if (b == columns_[to].end() || (a != before.end() && a->index < b->index)) {
        --row_sizes_[(a++)->index];
      } else if (a == before.end() || b->index < a->index) {
        ++row_sizes_[b->index];
        rows_[(b++)->index].push_back(to);
      } else {
        ++a, ++b;
      }
    }
    queue(to);
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
  Lines<R> columns_;
  std::vector<std::vector<Index>> rows_;  ///< columns that meet the row: perhaps repeated, perhaps no longer
  std::vector<std::size_t> row_sizes_;    ///< the exact number of entries of the row
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue_;
  Transform<R> left_;
  Transform<R> right_;
};

/// Makes two pivots a, b into gcd and lcm. With g = x a + y b:
///   [    1     1   ] [ a 0 ] [ x  -b/g ]   [ g    0   ]
///   [ -y b/g  x a/g ] [ 0 b ] [ y   a/g ] = [ 0  a b/g ]     both outer matrices have determinant 1.
template <Ring R>
void make_divide(const R& ring, Pivot<R>& a, Pivot<R>& b, Elimination<R>* elimination) {
  const Integer first = ring.to_integer(a.value), second = ring.to_integer(b.value);
  const Bezout bezout = extended_gcd(first, second);
  const Integer a_g = divide(first, bezout.g).quotient, b_g = divide(second, bezout.g).quotient;
  if (elimination != nullptr) {
    const auto in = [&](const Integer& n) { return ring.from(n); };
    const Integer u = -(bezout.y * b_g), v = bezout.x * a_g;
    Transform<R>& left = elimination->left();
    Transform<R>& right = elimination->right();
    combine<R>(ring, left.forward[a.row], left.forward[b.row], {ring.one(), ring.one(), in(u), in(v)});
    combine<R>(ring, left.inverse[a.row], left.inverse[b.row], {in(v), in(-u), in(-1), ring.one()});
    combine<R>(ring, right.forward[a.column], right.forward[b.column], {in(bezout.x), in(bezout.y), in(-b_g), in(a_g)});
    combine<R>(ring, right.inverse[a.column], right.inverse[b.column], {in(a_g), in(b_g), in(-bezout.y), in(bezout.x)});
  }
  a.value = ring.from(bezout.g);
  b.value = ring.from(a_g * second);
}

/// Sorts the pivots and makes each divide the next.
template <Ring R>
void chain_divisors(const R& ring, std::vector<Pivot<R>>& pivots, Elimination<R>* elimination) {
  const auto less = [&](const Pivot<R>& a, const Pivot<R>& b) {
    return ring.to_integer(a.value) < ring.to_integer(b.value);
  };
  std::stable_sort(pivots.begin(), pivots.end(), less);
  const auto first_non_unit =
      std::find_if(pivots.begin(), pivots.end(), [&](const Pivot<R>& pivot) { return !ring.is_unit(pivot.value); });
  for (auto a = first_non_unit; a != pivots.end(); ++a) {
    for (auto b = a + 1; b != pivots.end(); ++b) {
      if (!divide(ring.to_integer(b->value), ring.to_integer(a->value)).remainder.is_zero()) {
        make_divide(ring, *a, *b, elimination);
      }
    }
  }
}

template <Ring R>
std::vector<typename R::Element> values(const std::vector<Pivot<R>>& pivots) {
  std::vector<typename R::Element> result;
  result.reserve(pivots.size());
  std::transform(pivots.begin(), pivots.end(), std::back_inserter(result), [](const Pivot<R>& p) { return p.value; });
  return result;
}

/// The pivots' lines first, then the others in their old order.
std::vector<Index> pivots_first(std::vector<Index> order, std::size_t n) {
  std::vector<bool> is_pivot(n);
  for (const Index i : order) {
    is_pivot[i] = true;
  }
  for (Index i = 0; i < n; ++i) {
    if (!is_pivot[i]) {
      order.push_back(i);
    }
  }
  return order;
}

/// The matrix whose columns are the lines, in the given order.
template <Ring R>
Matrix<R> from_columns(const R& ring, const Lines<R>& lines, const std::vector<Index>& order) {
  Matrix<R> result(ring, static_cast<Index>(lines.size()), 0);
  for (const Index i : order) {
    result.append_column(lines[i]);
  }
  return result;
}

/// The matrix whose rows are the lines, in the given order.
template <Ring R>
Matrix<R> from_rows(const R& ring, const Lines<R>& lines, const std::vector<Index>& order) {
  return from_columns(ring, lines, order).transposed();
}

}  // namespace

template <Ring R>
SmithForm<R> smith_form(const Matrix<R>& matrix) {
  const R& ring = matrix.ring();
  Elimination<R> elimination(matrix, true);
  std::vector<Pivot<R>> pivots = elimination.run();
  chain_divisors(ring, pivots, &elimination);
  std::vector<Index> rows, columns;
  for (const Pivot<R>& pivot : pivots) {
    rows.push_back(pivot.row);
    columns.push_back(pivot.column);
  }
  rows = pivots_first(std::move(rows), matrix.rows());
  columns = pivots_first(std::move(columns), matrix.columns());
  return {values(pivots), from_rows(ring, elimination.left().forward, rows),
          from_columns(ring, elimination.left().inverse, rows),
          from_columns(ring, elimination.right().forward, columns),
          from_rows(ring, elimination.right().inverse, columns)};
}

template <Ring R>
std::vector<typename R::Element> invariant_factors(const Matrix<R>& matrix) {
  std::vector<Pivot<R>> pivots = Elimination<R>(matrix, false).run();
  chain_divisors<R>(matrix.ring(), pivots, nullptr);
  return values(pivots);
}

namespace {

template <Ring R>
std::vector<Terms<R>> columns_of(const Matrix<R>& matrix, Index from, Index to) {
  std::vector<Terms<R>> columns;
  for (Index j = from; j < to; ++j) {
    columns.push_back(matrix.column(j));
  }
  return columns;
}

template <Ring R>
Matrix<R> from_columns(const R& ring, Index rows, const std::vector<Terms<R>>& columns) {
  Matrix<R> result(ring, rows, 0);
  for (const Terms<R>& column : columns) {
    result.append_column(column);
  }
  return result;
}

/// The last rows of a matrix, from row `from` on.
template <Ring R>
Matrix<R> lower_rows(const Matrix<R>& matrix, Index from) {
  Matrix<R> result(matrix.ring(), matrix.rows() - from, 0);
  Terms<R> kept;
  for (Index j = 0; j < matrix.columns(); ++j) {
    kept.clear();
    matrix.for_each_in_column(j, [&](const Term<R>& entry) {
      if (entry.index >= from) {
        kept.push_back({entry.index - from, entry.coefficient});
      }
    });
    result.append_column(kept);
  }
  return result;
}

}  // namespace

template <Ring R>
std::vector<AgostonBasis<R>> agoston_bases(const std::vector<Matrix<R>>& boundaries) {
  std::vector<AgostonBasis<R>> bases(boundaries.size());
  if (boundaries.empty()) {
    return bases;
  }
  const R& ring = boundaries.front().ring();
  const Index vertices = boundaries.front().columns();
  expects(boundaries.front().is_zero(), "agoston_bases: d[0] must be zero");
  // A basis of the cycles of degree p as columns, and the coordinates of a cycle in it.
  Matrix<R> cycles = Matrix<R>::identity(ring, vertices);
  Matrix<R> coordinates = cycles;
  for (std::size_t p = 0; p < boundaries.size(); ++p) {
    if (p + 1 == boundaries.size()) {
      bases[p].cycles = columns_of(cycles, 0, cycles.columns());
      break;
    }
    const Matrix<R>& next = boundaries[p + 1];
    expects(next.rows() == boundaries[p].columns(), "agoston_bases: the shapes of the boundaries must chain up");
    // The image of d[p+1] lies in the cycles: one Smith form there serves both degrees.
    SmithForm<R> form = smith_form(coordinates * next);
    const auto rank = static_cast<Index>(form.factors.size());
    const Matrix<R> new_cycles = cycles * form.left_inverse;
    bases[p].cycles = columns_of(new_cycles, 0, new_cycles.columns());
    bases[p].bounded_by = columns_of(form.right, 0, rank);
    bases[p].orders = std::move(form.factors);
    bases[p + 1].moving = bases[p].bounded_by;
    cycles = from_columns(ring, next.columns(), columns_of(form.right, rank, next.columns()));
    coordinates = lower_rows(form.right_inverse, rank);
  }
  return bases;
}

#define SESAME_INSTANTIATE(R)                                              \
  template SmithForm<R> smith_form<R>(const Matrix<R>&);                   \
  template std::vector<R::Element> invariant_factors<R>(const Matrix<R>&); \
  template std::vector<AgostonBasis<R>> agoston_bases<R>(const std::vector<Matrix<R>>&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::sparse

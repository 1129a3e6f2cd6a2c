/// \file
/// The bodies of matrix.hpp, for matrix.cpp and for whoever brings a ring of their own.
#pragma once

#include <algorithm>
#include <utility>

#include "sparse/column_store_bodies.hpp"
#include "sparse/matrix.hpp"

namespace sesame::sparse {

template <Ring R>
std::size_t Matrix<R>::nonzeros() const {
  std::size_t units = rest_ == Rest::identity ? std::min(rows(), columns()) : 0;
  if (units != 0) {
    store_.for_each_stored([&](Index j) { units -= j < rows() ? 1 : 0; });
  }
  return stored_entries() + units;
}

template <Ring R>
bool Matrix<R>::is_zero() const {
  return nonzeros() == 0;
}

template <Ring R>
Terms<R> Matrix<R>::column(Index column) const {
  expects(column < columns(), "Matrix::column: no such column");
  Terms<R> terms;
  for_each_in_column(column, [&](const TermType& entry) { terms.push_back(entry); });
  return terms;
}

template <Ring R>
auto Matrix<R>::entry(Index row, Index column) const -> Element {
  expects(row < rows() && column < columns(), "Matrix::entry: no such place");
  Element found = ring().zero();
  for_each_in_column(column, [&](const TermType& entry) {
    if (entry.index == row) {
      found = entry.coefficient;
    }
  });
  return found;
}

template <Ring R>
void Matrix<R>::add_to_column(Index column, const Element& a, std::span<const TermType> terms) {
  Terms<R> sum = this->column(column);
  add_multiple(ring(), sum, a, terms);
  set_column(column, sum);
}

// ---- merging

template <Ring R>
MergeWork Matrix<R>::merge(const Matrix& b, const Matrix& c, const Matrix& d) {
  expects(this != &b && this != &c && this != &d, "Matrix::merge: a matrix cannot be merged with itself");
  expects(b.rows() == rows() && c.columns() == columns() && d.rows() == c.rows() && d.columns() == b.columns(),
          "Matrix::merge: the shapes of the four blocks must fit");
  expects(b.ring() == ring() && c.ring() == ring() && d.ring() == ring(), "Matrix::merge: the rings must be equal");
  MergeWork work;
  if (rest_ == Rest::identity && c.rows() != 0) {
    for (Index j = rows(); j < columns(); ++j) {  // zero columns that would become unit vectors when rows are added
      if (!is_stored(j)) {
        set_column(j, {});
      }
    }
  }
  const bool implicit_units = rest_ == Rest::identity && d.rest_ == Rest::identity && rows() == columns();
  const Index rows_above = rows();
  append_rows(c.rows());
  merge_below(c, rows_above, work);
  merge_right(b, d, rows_above, implicit_units, work);
  return work;
}

/// Hangs each column of C below the same column of A.
template <Ring R>
void Matrix<R>::merge_below(const Matrix& c, Index rows_above, MergeWork& work) {
  Terms<R> hanging;  // kept from column to column: no allocation per column
  const auto hang_column = [&](Index j) {
    hanging.clear();
    const bool unit = !is_stored(j) && has_implicit_unit(j);
    if (unit) {
      hanging.push_back({j, ring().one()});
    }
    c.for_each_in_column(j, [&](const TermType& entry) {
      hanging.push_back({entry.index + rows_above, entry.coefficient});
    });
    if (hanging.size() == (unit ? 1u : 0u)) {
      return;
    }
    work.entries_of_a += unit ? 1 : 0;
    work.entries_written += hanging.size() - (unit ? 1 : 0);
    store_.extend_column(j, hanging);
  };
  if (c.rest_ == Rest::identity) {
    for (Index j = 0; j < columns(); ++j) {
      hang_column(j);
    }
  } else {
    c.store_.for_each_stored([&](Index j) { hang_column(j); });
  }
}

/// Appends the columns of B, each over the same column of D.
template <Ring R>
void Matrix<R>::merge_right(const Matrix& b, const Matrix& d, Index rows_above, bool implicit_units, MergeWork& work) {
  Terms<R> column;
  for (Index j = 0; j < b.columns(); ++j) {
    column.clear();
    b.for_each_in_column(j, [&](const TermType& entry) { column.push_back(entry); });
    if (implicit_units && column.empty() && j < d.rows() && !d.is_stored(j)) {
      store_.append_columns(1);
      continue;
    }
    d.for_each_in_column(j, [&](const TermType& entry) {
      column.push_back({entry.index + rows_above, entry.coefficient});
    });
    work.entries_written += column.size();
    if (rest_ == Rest::zero && column.empty()) {
      store_.append_columns(1);
    } else {
      append_column(column);
    }
  }
}

// ---- algebra

template <Ring R>
Terms<R> Matrix<R>::apply(std::span<const TermType> terms) const {
  RawTerms<R> image;
  for (const TermType& term : terms) {
    expects(term.index < columns(), "Matrix::apply: a term has no column");
    for_each_in_column(term.index, [&](const TermType& entry) {
      image.push_back({entry.index, ring().multiply(entry.coefficient, term.coefficient)});
    });
  }
  return std::move(image).normal(ring());
}

template <Ring R>
Chain<R> Matrix<R>::apply(const Chain<R>& v, int shift) const {
  expects(v.ring() == ring(), "Matrix::apply: the rings must be equal");
  return Chain<R>(ring(), Degree{v.degree().value + shift}, apply(v.terms()));
}

template <Ring R>
Matrix<R> Matrix<R>::transposed() const {
  struct Entry {
    Index row, column;
    Element value;
  };
  std::vector<Entry> entries;
  entries.reserve(stored_entries());
  Matrix result(ring(), columns(), rows(), rest_);
  for (const Index j : stored()) {
    if (rest_ == Rest::identity && j < rows()) {
      result.set_column(j, {});  // row j has no implicit unit
    }
    for_each_in_column(j, [&](const TermType& e) { entries.push_back({e.index, j, e.coefficient}); });
  }
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.row < b.row; });
  for (auto e = entries.begin(); e != entries.end();) {
    const Index i = e->row;
    RawTerms<R> row;
    for (; e != entries.end() && e->row == i; ++e) {
      row.push_back({e->column, std::move(e->value)});
    }
    if (i < columns() && !is_stored(i) && has_implicit_unit(i)) {
      row.push_back({i, ring().one()});
    }
    result.set_column(i, std::move(row).normal(ring()));
  }
  return result;
}

template <Ring R>
bool Matrix<R>::equals(const Matrix& other) const {
  return ring() == other.ring() && rows() == other.rows() && columns() == other.columns() &&
         !first_difference(*this, other).has_value();
}

/// Makes the implicit units explicit; from then on the rest is zero. Cost O(columns).
template <Ring R>
void Matrix<R>::store_implicit_units() {
  if (rest_ == Rest::identity) {
    for (Index j = 0; j < std::min(rows(), columns()); ++j) {
      if (!is_stored(j)) {
        const TermType unit{j, ring().one()};
        set_column(j, {&unit, 1});
      }
    }
    rest_ = Rest::zero;
  }
}

template <Ring R>
void Matrix<R>::add(const Element& a, const Matrix& other) {
  expects(rows() == other.rows() && columns() == other.columns(), "Matrix::add: the shapes must be equal");
  expects(ring() == other.ring(), "Matrix::add: the rings must be equal");
  if (this == &other) {
    return add(a, Matrix{other});
  }
  Element unit = rest_ == Rest::identity ? ring().one() : ring().zero();
  if (other.rest_ == Rest::identity) {
    unit = ring().add(unit, a);
  }
  if (!ring().is_zero(unit) && unit != ring().one()) {
    store_implicit_units();
    Matrix plain{other};
    plain.store_implicit_units();
    return add(a, plain);
  }
  if (other.rest_ == Rest::identity) {
    for (const Index j : stored()) {
      if (!other.is_stored(j)) {
        add_to_column(j, a, other.column(j));
      }
    }
  }
  for (const Index j : other.stored()) {
    add_to_column(j, a, other.column(j));
  }
  rest_ = ring().is_zero(unit) ? Rest::zero : Rest::identity;
}

template <Ring R>
void Matrix<R>::scale(const Element& a) {
  if (ring().is_zero(a)) {
    *this = Matrix(ring(), rows(), columns());
  } else if (a != ring().one()) {
    store_implicit_units();
    store_.scale(a);
  }
}

template <Ring R>
Matrix<R> operator*(const Matrix<R>& a, const Matrix<R>& b) {
  expects(a.columns() == b.rows(), "Matrix product: the shapes must fit");
  expects(a.ring() == b.ring(), "Matrix product: the rings must be equal");
  const bool unit = a.rest() == Rest::identity && b.rest() == Rest::identity;
  Matrix<R> product(a.ring(), a.rows(), b.columns(), unit ? Rest::identity : Rest::zero);
  if (b.rest() == Rest::identity) {
    for (const Index j : a.stored()) {  // an implicit column e_j of b gives column j of a
      if (j < b.columns() && !b.is_stored(j)) {
        product.set_column(j, a.column(j));
      }
    }
  }
  if (unit) {
    for (Index j = b.rows(); j < std::min(a.rows(), b.columns()); ++j) {  // here b is zero and 1 would not be
      product.set_column(j, {});
    }
  }
  for (const Index j : b.stored()) {
    const Terms<R> image = a.apply(b.column(j));
    if (unit || !image.empty()) {
      product.set_column(j, image);
    }
  }
  return product;
}

template <Ring R>
Matrix<R> operator+(Matrix<R> a, const Matrix<R>& b) {
  a.add(a.ring().one(), b);
  return a;
}

template <Ring R>
Matrix<R> operator-(Matrix<R> a, const Matrix<R>& b) {
  a.add(a.ring().negate(a.ring().one()), b);
  return a;
}

template <Ring R>
Matrix<R> operator-(Matrix<R> a) {
  a.scale(a.ring().negate(a.ring().one()));
  return a;
}

template <Ring R>
Matrix<R> blocks(Matrix<R> a, const Matrix<R>& b, const Matrix<R>& c, const Matrix<R>& d) {
  a.merge(b, c, d);
  return a;
}

template <Ring R>
std::optional<Position> first_difference(const Matrix<R>& a, const Matrix<R>& b) {
  expects(a.rows() == b.rows() && a.columns() == b.columns(), "first_difference: the shapes must be equal");
  const std::vector<Index> in_a = a.stored(), in_b = b.stored();
  std::vector<Index> stored;
  std::set_union(in_a.begin(), in_a.end(), in_b.begin(), in_b.end(), std::back_inserter(stored));
  const Index units = a.rest() == b.rest() ? 0 : std::min(a.rows(), a.columns());
  Index next = 0;  // the first column that has not been compared
  for (const Index j : stored) {
    if (next < j && next < units) {
      return Position{next, next};
    }
    next = j + 1;
    const Terms<R> x = a.column(j), y = b.column(j);
    const auto [at, bt] = std::mismatch(x.begin(), x.end(), y.begin(), y.end());
    if (at == x.end() && bt == y.end()) {
      continue;
    }
    const Index none = a.rows();
    return Position{std::min(at == x.end() ? none : at->index, bt == y.end() ? none : bt->index), j};
  }
  return next < units ? std::optional{Position{next, next}} : std::nullopt;
}

}  // namespace sesame::sparse

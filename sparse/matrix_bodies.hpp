/// \file
/// The bodies of matrix.hpp, for matrix.cpp and for whoever brings a ring of their own.
#pragma once

#include <algorithm>
#include <utility>

#include "sparse/matrix.hpp"

namespace sesame::sparse {

// ---- construction

template <Ring R>
Matrix<R>::Matrix(R ring, Index rows, Index columns, Rest rest)
    : ring_{std::move(ring)}, rows_{rows}, columns_{columns}, rest_{rest} {}

template <Ring R>
Matrix<R>::Matrix(const Matrix& other) : Matrix(other.ring_, other.rows_, other.columns_, other.rest_) {
  dense_.reserve(other.dense_.size());
  for (const Column& column : other.dense_) {
    dense_.push_back(column.is_absent() ? column : store_copy(other, column));
  }
  hashed_.reserve(other.hashed_.size());
  for (const auto& [index, column] : other.hashed_) {
    hashed_.emplace(index, store_copy(other, column));
  }
  stored_columns_ = other.stored_columns_;
}

template <Ring R>
Matrix<R>& Matrix<R>::operator=(const Matrix& other) {
  Matrix copy{other};
  swap(copy);
  return *this;
}

template <Ring R>
void Matrix<R>::swap(Matrix& other) noexcept {
  std::swap(ring_, other.ring_);
  std::swap(rows_, other.rows_);
  std::swap(columns_, other.columns_);
  std::swap(rest_, other.rest_);
  dense_.swap(other.dense_);
  hashed_.swap(other.hashed_);
  links_.swap(other.links_);
  std::swap(free_link_, other.free_link_);
  pool_.swap(other.pool_);
  std::swap(stored_columns_, other.stored_columns_);
  std::swap(stored_entries_, other.stored_entries_);
}

// ---- segments and links

template <Ring R>
auto Matrix<R>::store(std::span<const TermType> terms) -> Column {
  if (terms.empty()) {
    return {0, 0};
  }
  expects(terms.size() < Column::chained, "Matrix: a column holds fewer than 2^31 entries");
  const auto size = static_cast<std::uint32_t>(terms.size());
  const auto position = pool_.allocate(size);
  std::copy(terms.begin(), terms.end(), pool_.at(position));
  stored_entries_ += size;
  return {position, size};
}

template <Ring R>
auto Matrix<R>::store_copy(const Matrix& other, const Column& column) -> Column {
  const std::size_t size = other.size_of(column);
  if (size == 0) {
    return {0, 0};
  }
  expects(size < Column::chained, "Matrix: a column holds fewer than 2^31 entries");
  const auto position = pool_.allocate(static_cast<std::uint32_t>(size));
  TermType* to = pool_.at(position);
  other.for_each_segment(
      column, [&](Segment segment) { to = std::copy_n(other.pool_.at(segment.position), segment.size, to); });
  stored_entries_ += size;
  return {position, static_cast<std::uint32_t>(size)};
}

template <Ring R>
std::size_t Matrix<R>::size_of(const Column& column) const {
  std::size_t size = 0;
  for_each_segment(column, [&](Segment segment) { size += segment.size; });
  return size;
}

template <Ring R>
void Matrix<R>::release(const Column& column) {
  for_each_segment(column, [&](Segment segment) {
    pool_.release(segment.position, segment.size);
    stored_entries_ -= segment.size;
  });
  if (column.is_chained()) {
    free_link_ = std::exchange(links_[column.at].next, free_link_);
  }
}

template <Ring R>
std::uint32_t Matrix<R>::new_link(Link link) {
  if (free_link_ == no_link) {
    links_.push_back(link);
    return static_cast<std::uint32_t>(links_.size() - 1);
  }
  const std::uint32_t at = free_link_;
  free_link_ = links_[at].next;
  links_[at] = link;
  return at;
}

/// Hangs one more segment, not empty, at the end of a stored column. Cost O(1): the record knows the last link.
template <Ring R>
void Matrix<R>::hang(Index column, Column segment) {
  Column& record = at(column);
  if (record.size == 0) {
    record = segment;
    return;
  }
  if (!record.is_chained()) {
    const std::uint32_t only = new_link({{record.at, record.size}, no_link});
    links_[only].next = only;
    record = {only, Column::chained};
  }
  const std::uint32_t last = new_link({{segment.at, segment.size}, links_[record.at].next});
  links_[record.at].next = last;
  record.at = last;
}

/// Copies everything to a new place once more room is wasted than used, so that waste costs O(1) amortised.
template <Ring R>
void Matrix<R>::repack_if_wasteful() {
  constexpr std::size_t not_worth_it = 256;
  if (pool_.wasted() > stored_entries_ + not_worth_it) {
    Matrix packed{*this};
    swap(packed);
  }
}

// ---- the directory of columns

template <Ring R>
auto Matrix<R>::find_hashed(Index column) const -> const Column* {
  if (hashed_.empty()) {
    return nullptr;
  }
  const auto found = hashed_.find(column);
  return found == hashed_.end() ? nullptr : &found->second;
}

template <Ring R>
template <class Visit>
void Matrix<R>::for_each_stored(Visit&& visit) const {
  for (Index j = 0; j < dense_.size(); ++j) {
    if (!dense_[j].is_absent()) {
      visit(j, dense_[j]);
    }
  }
  for (const auto& [j, column] : hashed_) {
    visit(j, column);
  }
}

/// Stores a column that is not stored yet.
template <Ring R>
void Matrix<R>::put(Index column, Column record) {
  ++stored_columns_;
  if (column < dense_.size()) {
    dense_[column] = record;
  } else {
    hashed_.emplace(column, record);
    settle_directory();
  }
}

template <Ring R>
void Matrix<R>::put_last(Column record) {
  if (dense_.size() == columns_) [[likely]] {
    dense_.push_back(record);
    ++columns_;
    ++stored_columns_;
  } else {
    put(columns_++, record);
  }
}

/// Removes a column from the directory and hands out its record, an absent one when it was not stored.
template <Ring R>
auto Matrix<R>::take_out(Index column) -> Column {
  Column taken;
  if (column < dense_.size()) {
    taken = std::exchange(dense_[column], Column{});
  } else if (const auto found = hashed_.find(column); found != hashed_.end()) {
    taken = found->second;
    hashed_.erase(found);
  }
  stored_columns_ -= taken.is_absent() ? 0 : 1;
  return taken;
}

/// Chooses between array and hashing. Between two switches the number of stored columns changes by a fixed part of the
/// length of the array, which is what a switch costs.
template <Ring R>
void Matrix<R>::settle_directory() {
  if (hashed_.size() > (columns_ - dense_.size()) / 4) {
    dense_.resize(columns_);
    for (const auto& [j, column] : std::exchange(hashed_, {})) {
      dense_[j] = column;
    }
  } else if (stored_columns_ < dense_.size() / 16) {
    for (Index j = 0; j < dense_.size(); ++j) {
      if (!dense_[j].is_absent()) {
        hashed_.emplace(j, dense_[j]);
      }
    }
    std::vector<Column>{}.swap(dense_);
  } else if (dense_.capacity() / 4 > dense_.size() + 16) {
    dense_.shrink_to_fit();
  }
}

template <Ring R>
std::vector<Index> Matrix<R>::stored() const {
  std::vector<Index> indices;
  indices.reserve(stored_columns_);
  for_each_stored([&](Index j, const Column&) { indices.push_back(j); });
  std::sort(indices.end() - static_cast<std::ptrdiff_t>(hashed_.size()), indices.end());
  return indices;
}

// ---- reading

template <Ring R>
std::size_t Matrix<R>::nonzeros() const {
  std::size_t units = rest_ == Rest::identity ? std::min(rows_, columns_) : 0;
  if (units != 0) {
    for_each_stored([&](Index j, const Column&) { units -= j < rows_ ? 1 : 0; });
  }
  return stored_entries_ + units;
}

template <Ring R>
bool Matrix<R>::is_zero() const {
  return nonzeros() == 0;
}

template <Ring R>
Terms<R> Matrix<R>::column(Index column) const {
  expects(column < columns_, "Matrix::column: no such column");
  Terms<R> terms;
  for_each_in_column(column, [&](const TermType& entry) { terms.push_back(entry); });
  return terms;
}

template <Ring R>
auto Matrix<R>::entry(Index row, Index column) const -> Element {
  expects(row < rows_ && column < columns_, "Matrix::entry: no such place");
  Element found = ring_.zero();
  for_each_in_column(column, [&](const TermType& entry) {
    if (entry.index == row) {
      found = entry.coefficient;
    }
  });
  return found;
}

// ---- changing columns

template <Ring R>
void Matrix<R>::set_column(Index column, std::span<const TermType> terms) {
  expects(column < columns_, "Matrix::set_column: no such column");
  expects(terms.empty() || terms.back().index < rows_, "Matrix::set_column: a row is out of range");
  const Column* found = find(column);
  if (found == nullptr) {
    put(column, store(terms));
    return;
  }
  Column& record = at(column);
  if (!record.is_chained() && !terms.empty() && terms.size() <= record.size) {
    std::copy(terms.begin(), terms.end(), pool_.at(record.at));
    const auto size = static_cast<std::uint32_t>(terms.size());
    if (size < record.size) {
      pool_.release(record.at + size, record.size - size);
      stored_entries_ -= record.size - size;
      record.size = size;
    }
  } else {
    release(record);
    record = {0, 0};
    record = store(terms);
  }
  repack_if_wasteful();
}

template <Ring R>
void Matrix<R>::forget_column(Index column) {
  expects(column < columns_, "Matrix::forget_column: no such column");
  const Column taken = take_out(column);
  if (!taken.is_absent()) {
    release(taken);
    settle_directory();
    repack_if_wasteful();
  }
}

template <Ring R>
void Matrix<R>::add_to_column(Index column, const Element& a, std::span<const TermType> terms) {
  Terms<R> sum = this->column(column);
  add_multiple(ring_, sum, a, terms);
  set_column(column, sum);
}

template <Ring R>
void Matrix<R>::append_column(std::span<const TermType> terms) {
  expects(terms.empty() || terms.back().index < rows_, "Matrix::append_column: a row is out of range");
  put_last(store(terms));
}

template <Ring R>
void Matrix<R>::truncate(Index rows, Index columns) {
  expects(rows <= rows_ && columns <= columns_, "Matrix::truncate: cannot grow");
  const auto from = std::max<std::size_t>(columns, dense_.size());
  if (!hashed_.empty() && from < columns_) {
    std::vector<Index> going;
    if (columns_ - from < hashed_.size()) {
      for (auto j = static_cast<Index>(from); j < columns_; ++j) {
        going.push_back(j);
      }
    } else {
      const std::vector<Index> all = stored();
      going.assign(std::lower_bound(all.begin(), all.end(), static_cast<Index>(from)), all.end());
    }
    // From right to left, the reverse of the order of appending: then the pool gets back what it gave last.
    std::for_each(going.rbegin(), going.rend(), [&](Index j) {
      if (const Column taken = take_out(j); !taken.is_absent()) {
        release(taken);
      }
    });
  }
  while (dense_.size() > columns) {
    if (const Column last = dense_.back(); !last.is_absent()) {
      --stored_columns_;
      release(last);
    }
    dense_.pop_back();
  }
  rows_ = rows;
  columns_ = columns;
  settle_directory();
  repack_if_wasteful();
}

// ---- merging

template <Ring R>
MergeWork Matrix<R>::merge(const Matrix& b, const Matrix& c, const Matrix& d) {
  expects(this != &b && this != &c && this != &d, "Matrix::merge: a matrix cannot be merged with itself");
  expects(b.rows_ == rows_ && c.columns_ == columns_ && d.rows_ == c.rows_ && d.columns_ == b.columns_,
          "Matrix::merge: the shapes of the four blocks must fit");
  expects(b.ring_ == ring_ && c.ring_ == ring_ && d.ring_ == ring_, "Matrix::merge: the rings must be equal");
  MergeWork work;
  if (rest_ == Rest::identity && c.rows_ != 0) {
    for (Index j = rows_; j < columns_; ++j) {  // zero columns that would become unit vectors when rows are added
      if (!is_stored(j)) {
        put(j, {0, 0});
      }
    }
  }
  merge_below(c, work);
  merge_right(b, d, work);
  rows_ += c.rows_;
  return work;
}

/// Hangs each column of C below the same column of A.
template <Ring R>
void Matrix<R>::merge_below(const Matrix& c, MergeWork& work) {
  Terms<R> hanging;  // kept from column to column: no allocation per column
  const auto hang_column = [&](Index j) {
    hanging.clear();
    const bool unit = !is_stored(j) && has_implicit_unit(j);
    if (unit) {
      hanging.push_back({j, ring_.one()});
    }
    c.for_each_in_column(j, [&](const TermType& entry) {
      hanging.push_back({entry.index + rows_, entry.coefficient});
    });
    if (hanging.size() == (unit ? 1u : 0u)) {
      return;
    }
    work.entries_of_a += unit ? 1 : 0;
    work.entries_written += hanging.size() - (unit ? 1 : 0);
    if (is_stored(j)) {
      hang(j, store(hanging));
    } else {
      put(j, store(hanging));
    }
  };
  if (c.rest_ == Rest::identity) {
    for (Index j = 0; j < columns_; ++j) {
      hang_column(j);
    }
  } else {
    c.for_each_stored([&](Index j, const Column&) { hang_column(j); });
  }
}

/// Appends the columns of B, each over the same column of D.
template <Ring R>
void Matrix<R>::merge_right(const Matrix& b, const Matrix& d, MergeWork& work) {
  const bool implicit_units = rest_ == Rest::identity && d.rest_ == Rest::identity && rows_ == columns_;
  Terms<R> column;
  for (Index j = 0; j < b.columns_; ++j) {
    column.clear();
    b.for_each_in_column(j, [&](const TermType& entry) { column.push_back(entry); });
    if (implicit_units && column.empty() && j < d.rows_ && !d.is_stored(j)) {
      ++columns_;
      continue;
    }
    d.for_each_in_column(j, [&](const TermType& entry) { column.push_back({entry.index + rows_, entry.coefficient}); });
    work.entries_written += column.size();
    if (rest_ == Rest::zero && column.empty()) {
      ++columns_;
    } else {
      put_last(store(column));
    }
  }
}

// ---- algebra

template <Ring R>
Terms<R> Matrix<R>::apply(std::span<const TermType> terms) const {
  Terms<R> image;
  for (const TermType& term : terms) {
    expects(term.index < columns_, "Matrix::apply: a term has no column");
    for_each_in_column(term.index, [&](const TermType& entry) {
      image.push_back({entry.index, ring_.multiply(entry.coefficient, term.coefficient)});
    });
  }
  normalize(ring_, image);
  return image;
}

template <Ring R>
Chain<R> Matrix<R>::apply(const Chain<R>& v, int shift) const {
  expects(v.ring() == ring_, "Matrix::apply: the rings must be equal");
  return Chain<R>(ring_, Degree{v.degree().value + shift}, apply(v.terms()));
}

template <Ring R>
Matrix<R> Matrix<R>::transposed() const {
  struct Entry {
    Index row, column;
    Element value;
  };
  std::vector<Entry> entries;
  entries.reserve(stored_entries_);
  Matrix result(ring_, columns_, rows_, rest_);
  for (const Index j : stored()) {
    if (rest_ == Rest::identity && j < rows_) {
      result.set_column(j, {});  // row j has no implicit unit
    }
    for_each_in_column(j, [&](const TermType& e) { entries.push_back({e.index, j, e.coefficient}); });
  }
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.row < b.row; });
  Terms<R> row;
  for (auto e = entries.begin(); e != entries.end();) {
    const Index i = e->row;
    row.clear();
    for (; e != entries.end() && e->row == i; ++e) {
      row.push_back({e->column, std::move(e->value)});
    }
    if (i < columns_ && !is_stored(i) && has_implicit_unit(i)) {
      row.push_back({i, ring_.one()});
      normalize(ring_, row);
    }
    result.set_column(i, row);
  }
  return result;
}

template <Ring R>
bool Matrix<R>::equals(const Matrix& other) const {
  return ring_ == other.ring_ && rows_ == other.rows_ && columns_ == other.columns_ &&
         !first_difference(*this, other).has_value();
}

/// Makes the implicit units explicit; from then on the rest is zero. Cost O(columns).
template <Ring R>
void Matrix<R>::store_implicit_units() {
  if (rest_ == Rest::identity) {
    for (Index j = 0; j < std::min(rows_, columns_); ++j) {
      if (!is_stored(j)) {
        const TermType unit{j, ring_.one()};
        put(j, store({&unit, 1}));
      }
    }
    rest_ = Rest::zero;
  }
}

template <Ring R>
void Matrix<R>::add(const Element& a, const Matrix& other) {
  expects(rows_ == other.rows_ && columns_ == other.columns_, "Matrix::add: the shapes must be equal");
  expects(ring_ == other.ring_, "Matrix::add: the rings must be equal");
  if (this == &other) {
    return add(a, Matrix{other});
  }
  Element unit = rest_ == Rest::identity ? ring_.one() : ring_.zero();
  if (other.rest_ == Rest::identity) {
    unit = ring_.add(unit, a);
  }
  if (!ring_.is_zero(unit) && unit != ring_.one()) {
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
  rest_ = ring_.is_zero(unit) ? Rest::zero : Rest::identity;
}

template <Ring R>
void Matrix<R>::scale(const Element& a) {
  if (ring_.is_zero(a)) {
    *this = Matrix(ring_, rows_, columns_);
    return;
  }
  if (a == ring_.one()) {
    return;
  }
  store_implicit_units();
  for_each_stored([&](Index, const Column& column) {
    for_each_segment(column, [&](Segment segment) {
      TermType* entry = pool_.at(segment.position);
      for (const TermType* end = entry + segment.size; entry != end; ++entry) {
        entry->coefficient = ring_.multiply(entry->coefficient, a);
      }
    });
  });
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

// ---- printing

template <Ring R>
std::string Matrix<R>::to_string() const {
  constexpr Index largest_table = 16;
  if (rows_ == 0 || columns_ == 0) {
    return std::to_string(rows_) + " x " + std::to_string(columns_) + " over " + ring_.name() + "\n";
  }
  return rows_ <= largest_table && columns_ <= largest_table ? to_table() : to_list();
}

template <Ring R>
std::string Matrix<R>::to_table() const {
  std::vector<std::string> cells(std::size_t{rows_} * columns_, "0");
  std::vector<std::size_t> width(columns_, 1);
  for (Index j = 0; j < columns_; ++j) {
    for_each_in_column(j, [&](const TermType& entry) {
      std::string& cell = cells[std::size_t{entry.index} * columns_ + j];
      cell = to_rational(ring_, entry.coefficient).to_string();
      width[j] = std::max(width[j], cell.size());
    });
  }
  std::string text;
  for (Index i = 0; i < rows_; ++i) {
    text += "[";
    for (Index j = 0; j < columns_; ++j) {
      const std::string& cell = cells[std::size_t{i} * columns_ + j];
      text += std::string(1 + width[j] - cell.size(), ' ') + cell;
    }
    text += " ]\n";
  }
  return text;
}

template <Ring R>
std::string Matrix<R>::to_list() const {
  std::string text = std::to_string(rows_) + " x " + std::to_string(columns_) + " over " + ring_.name();
  text += rest_ == Rest::identity ? ", the identity but for:\n" : ", zero but for:\n";
  for (const Index j : stored()) {
    text += std::to_string(j) + ": " + sparse::to_string<R>(ring_, column(j), "e") + "\n";
  }
  return text;
}

}  // namespace sesame::sparse

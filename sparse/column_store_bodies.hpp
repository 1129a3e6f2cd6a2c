/// \file
/// The bodies of column_store.hpp, for column_store.cpp and for whoever brings a ring or ids of their own.
#pragma once

#include <algorithm>
#include <utility>

#include "sparse/column_store.hpp"

namespace sesame::sparse {

// ---- construction

template <Ring R, class Id>
ColumnStore<R, Id>::ColumnStore(R ring, Index rows, Index columns)
    : ring_{std::move(ring)}, rows_{rows}, columns_{columns} {}

template <Ring R, class Id>
ColumnStore<R, Id>::ColumnStore(const ColumnStore& other) : ColumnStore(other.ring_, other.rows_, other.columns_) {
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

template <Ring R, class Id>
ColumnStore<R, Id>& ColumnStore<R, Id>::operator=(const ColumnStore& other) {
  ColumnStore copy{other};
  swap(copy);
  return *this;
}

template <Ring R, class Id>
void ColumnStore<R, Id>::swap(ColumnStore& other) noexcept {
  std::swap(ring_, other.ring_);
  std::swap(rows_, other.rows_);
  std::swap(columns_, other.columns_);
  dense_.swap(other.dense_);
  hashed_.swap(other.hashed_);
  links_.swap(other.links_);
  std::swap(free_link_, other.free_link_);
  pool_.swap(other.pool_);
  std::swap(stored_columns_, other.stored_columns_);
  std::swap(stored_entries_, other.stored_entries_);
}

// ---- segments and links

template <Ring R, class Id>
auto ColumnStore<R, Id>::store(std::span<const TermType> terms) -> Column {
  if (terms.empty()) {
    return {0, 0};
  }
  expects(terms.size() < Column::chained, "ColumnStore: a column holds fewer than 2^31 entries");
  const auto size = static_cast<std::uint32_t>(terms.size());
  const auto position = pool_.allocate(size);
  std::copy(terms.begin(), terms.end(), pool_.at(position));
  stored_entries_ += size;
  return {position, size};
}

template <Ring R, class Id>
auto ColumnStore<R, Id>::store_copy(const ColumnStore& other, const Column& column) -> Column {
  const std::size_t size = other.size_of(column);
  if (size == 0) {
    return {0, 0};
  }
  expects(size < Column::chained, "ColumnStore: a column holds fewer than 2^31 entries");
  const auto position = pool_.allocate(static_cast<std::uint32_t>(size));
  TermType* to = pool_.at(position);
  other.for_each_segment(
      column, [&](Segment segment) { to = std::copy_n(other.pool_.at(segment.position), segment.size, to); });
  stored_entries_ += size;
  return {position, static_cast<std::uint32_t>(size)};
}

template <Ring R, class Id>
std::size_t ColumnStore<R, Id>::size_of(const Column& column) const {
  std::size_t size = 0;
  for_each_segment(column, [&](Segment segment) { size += segment.size; });
  return size;
}

template <Ring R, class Id>
void ColumnStore<R, Id>::release(const Column& column) {
  for_each_segment(column, [&](Segment segment) {
    pool_.release(segment.position, segment.size);
    stored_entries_ -= segment.size;
  });
  if (column.is_chained()) {
    free_link_ = std::exchange(links_[column.at].next, free_link_);
  }
}

template <Ring R, class Id>
std::uint32_t ColumnStore<R, Id>::new_link(Link link) {
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
template <Ring R, class Id>
void ColumnStore<R, Id>::hang(Id column, Column segment) {
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
template <Ring R, class Id>
void ColumnStore<R, Id>::repack_if_wasteful() {
  constexpr std::size_t not_worth_it = 256;
  if (pool_.wasted() > stored_entries_ + not_worth_it) {
    ColumnStore packed{*this};
    swap(packed);
  }
}

// ---- the directory of columns

template <Ring R, class Id>
auto ColumnStore<R, Id>::find_hashed(Id column) const -> const Column* {
  if (hashed_.empty()) {
    return nullptr;
  }
  const auto found = hashed_.find(column);
  return found == hashed_.end() ? nullptr : &found->second;
}

/// Stores a column that is not stored yet.
template <Ring R, class Id>
void ColumnStore<R, Id>::put(Id column, Column record) {
  ++stored_columns_;
  if (column < dense_.size()) {
    dense_[column] = record;
  } else {
    hashed_.emplace(column, record);
    settle_directory();
  }
}

template <Ring R, class Id>
void ColumnStore<R, Id>::put_last(Column record) {
  if (dense_.size() == columns_) [[likely]] {
    dense_.push_back(record);
    ++columns_;
    ++stored_columns_;
  } else {
    put(Id{columns_++}, record);
  }
}

/// Removes a column from the directory and hands out its record, an absent one when it was not stored.
template <Ring R, class Id>
auto ColumnStore<R, Id>::take_out(Id column) -> Column {
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
template <Ring R, class Id>
void ColumnStore<R, Id>::settle_directory() {
  if (hashed_.size() > (columns_ - dense_.size()) / 4) {
    dense_.resize(columns_);
    for (const auto& [j, column] : std::exchange(hashed_, {})) {
      dense_[j] = column;
    }
  } else if (stored_columns_ < dense_.size() / 16) {
    for (Index j = 0; j < dense_.size(); ++j) {
      if (!dense_[j].is_absent()) {
        hashed_.emplace(Id{j}, dense_[j]);
      }
    }
    GrowingArray<Column>{}.swap(dense_);
  } else if (dense_.capacity() / 4 > dense_.size() + 16) {
    dense_.shrink_to_fit();
  }
}

template <Ring R, class Id>
std::vector<Id> ColumnStore<R, Id>::stored() const {
  std::vector<Id> indices;
  indices.reserve(stored_columns_);
  for_each_stored([&](Id j) { indices.push_back(j); });
  std::sort(indices.end() - static_cast<std::ptrdiff_t>(hashed_.size()), indices.end());
  return indices;
}

// ---- reading

template <Ring R, class Id>
Terms<R, Id> ColumnStore<R, Id>::column(Id column) const {
  expects(column < columns_, "ColumnStore::column: no such column");
  Terms<R, Id> terms;
  for_each_in_column(column, [&](const TermType& entry) { terms.push_back(entry); });
  return terms;
}

template <Ring R, class Id>
auto ColumnStore<R, Id>::entry(Id row, Id column) const -> Element {
  expects(row < rows_ && column < columns_, "ColumnStore::entry: no such place");
  Element found = ring_.zero();
  for_each_in_column(column, [&](const TermType& entry) {
    if (entry.index == row) {
      found = entry.coefficient;
    }
  });
  return found;
}

// ---- changing columns

template <Ring R, class Id>
void ColumnStore<R, Id>::set_column(Id column, std::span<const TermType> terms) {
  expects(column < columns_, "ColumnStore::set_column: no such column");
  expects(terms.empty() || terms.back().index < rows_, "ColumnStore::set_column: a row is out of range");
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

template <Ring R, class Id>
void ColumnStore<R, Id>::forget_column(Id column) {
  expects(column < columns_, "ColumnStore::forget_column: no such column");
  const Column taken = take_out(column);
  if (!taken.is_absent()) {
    release(taken);
    settle_directory();
    repack_if_wasteful();
  }
}

template <Ring R, class Id>
void ColumnStore<R, Id>::add_to_column(Id column, const Element& a, std::span<const TermType> terms) {
  Terms<R, Id> sum = this->column(column);
  add_multiple(ring_, sum, a, terms);
  set_column(column, sum);
}

template <Ring R, class Id>
void ColumnStore<R, Id>::extend_column(Id column, std::span<const TermType> terms) {
  expects(column < columns_, "ColumnStore::extend_column: no such column");
  expects(!terms.empty() && terms.back().index < rows_, "ColumnStore::extend_column: no terms, or a row out of range");
  if (is_stored(column)) {
    hang(column, store(terms));
  } else {
    put(column, store(terms));
  }
}

template <Ring R, class Id>
void ColumnStore<R, Id>::scale(const Element& a) {
  for_each_stored([&](Id j) {
    for_each_segment(at(j), [&](Segment segment) {
      TermType* entry = pool_.at(segment.position);
      for (const TermType* end = entry + segment.size; entry != end; ++entry) {
        entry->coefficient = ring_.multiply(entry->coefficient, a);
      }
    });
  });
}

template <Ring R, class Id>
void ColumnStore<R, Id>::append_column(std::span<const TermType> terms) {
  expects(terms.empty() || terms.back().index < rows_, "ColumnStore::append_column: a row is out of range");
  put_last(store(terms));
}

template <Ring R, class Id>
void ColumnStore<R, Id>::truncate(Index rows, Index columns) {
  expects(rows <= rows_ && columns <= columns_, "ColumnStore::truncate: cannot grow");
  const auto from = std::max<std::size_t>(columns, dense_.size());
  if (!hashed_.empty() && from < columns_) {
    std::vector<Id> going;
    if (columns_ - from < hashed_.size()) {
      for (auto j = static_cast<Index>(from); j < columns_; ++j) {
        going.push_back(Id{j});
      }
    } else {
      const std::vector<Id> all = stored();
      going.assign(std::lower_bound(all.begin(), all.end(), static_cast<Index>(from)), all.end());
    }
    // From right to left, the reverse of the order of appending: then the pool gets back what it gave last.
    std::for_each(going.rbegin(), going.rend(), [&](Id j) {
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

}  // namespace sesame::sparse

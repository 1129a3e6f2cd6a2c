/// \file
/// `ColumnStore`: the columns of a sparse matrix, in blocks that never move.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sparse/chain.hpp"
#include "sparse/entry_pool.hpp"
#include "sparse/growing_array.hpp"

namespace sesame::sparse {

/// Columns of entries in rows, each stored or not; what one that is not stored means is for others to say. (`Matrix` is
/// a map on top of it. A boundary that only grows and shrinks needs no more than this; its rows and columns have ids of
/// one kind.)
///
/// Storage   The entries of a column lie in one or more segments, sorted by row across segments, never zero, never
///           repeated. Segments live in blocks that never move: growing neither copies nor reads what is there. Only
///           replacing or forgetting columns may one day repack them, when most of the room is wasted. A column costs 8
///           bytes besides its entries; where few columns are stored they are found by hashing, and the others cost no
///           memory.
/// Cost      Unless a member says otherwise, O(size of the columns that it names).
template <Ring R, class Id = Index>
class ColumnStore {
 public:
  using Element = typename R::Element;
  using TermType = Term<R, Id>;

  /// No column is stored.
  ColumnStore(R ring, Index rows, Index columns);
  ColumnStore(const ColumnStore& other);
  ColumnStore& operator=(const ColumnStore& other);
  /// What is moved from has no rows and no columns.
  ColumnStore(ColumnStore&& other) noexcept : ColumnStore(other.ring_, 0, 0) { swap(other); }
  ColumnStore& operator=(ColumnStore&& other) noexcept {
    ColumnStore moved{std::move(other)};
    swap(moved);
    return *this;
  }
  ~ColumnStore() = default;
  void swap(ColumnStore& other) noexcept;

  [[nodiscard]] const R& ring() const { return ring_; }
  [[nodiscard]] Index rows() const { return rows_; }
  [[nodiscard]] Index columns() const { return columns_; }
  /// The number of columns that are stored, whether or not they are zero.
  [[nodiscard]] std::size_t stored_columns() const { return stored_columns_; }
  [[nodiscard]] std::size_t stored_entries() const { return stored_entries_; }

  [[nodiscard]] bool is_stored(Id column) const { return find(column) != nullptr; }
  /// Calls visit(const TermType&) for each entry of the column, by increasing row. False when it is not stored.
  template <class Visit>
  bool for_each_in_column(Id column, Visit&& visit) const;
  /// The column in normal form (a copy); zero when it is not stored.
  [[nodiscard]] Terms<R, Id> column(Id column) const;
  /// Zero where nothing is stored.
  [[nodiscard]] Element entry(Id row, Id column) const;
  /// The indices of the stored columns, increasing. Cost O(k log k) for k of them.
  [[nodiscard]] std::vector<Id> stored() const;
  /// Calls visit(Id) for each stored column, in any order.
  template <class Visit>
  void for_each_stored(Visit&& visit) const;

  /// Replaces a column; from then on it is stored. Requires: normal form, rows in range, terms not inside this store.
  void set_column(Id column, std::span<const TermType> terms);
  void forget_column(Id column);
  /// column += a * terms (normal form); one that is not stored counts as zero.
  void add_to_column(Id column, const Element& a, std::span<const TermType> terms);
  /// Hangs entries below all those of a column, which are neither copied nor read. Requires: terms, in normal form.
  /// Cost O(|terms|).
  void extend_column(Id column, std::span<const TermType> terms);
  /// Multiplies all entries. Requires: not by zero.
  void scale(const Element& a);

  /// Makes room for columns and entries that are to be appended to an empty store. Says nothing but how fast that is.
  void reserve(std::size_t columns, std::size_t entries) {
    dense_.reserve(columns);
    pool_.reserve(entries);
  }
  /// Appends a stored column on the right. Cost O(|terms|), amortised over the directory of columns.
  void append_column(std::span<const TermType> terms);
  /// Appends columns that are not stored on the right. Cost O(1).
  void append_columns(Index count) { columns_ += count; }
  /// Cost O(1).
  void append_rows(Index count) { rows_ += count; }
  /// Cuts back to the first `rows` rows and `columns` columns: undo of growth.
  /// Requires: the columns kept have no entry in the rows cut off. Cost O(size of the columns that go).
  void truncate(Index rows, Index columns);

 private:
  using Pool = EntryPool<TermType>;

  /// A run of entries.
  struct Segment {
    std::uint32_t position;
    std::uint32_t size;
  };
  /// Where the entries of a column are: in one segment; or in a ring of links whose last one is number `at`.
  struct Column {
    static constexpr std::uint32_t chained = 0x8000'0000u;
    static constexpr std::uint32_t absent = 0xffff'ffffu;
    std::uint32_t at = 0;
    std::uint32_t size = absent;  ///< of the one segment, or one of the marks above
    [[nodiscard]] bool is_absent() const { return size == absent; }
    [[nodiscard]] bool is_chained() const { return size == chained; }
  };
  /// A segment of a column that has several; the last one links to the first.
  struct Link {
    Segment segment;
    std::uint32_t next;
  };
  static constexpr std::uint32_t no_link = 0xffff'ffffu;

  [[nodiscard]] const Column* find(Id column) const {
    if (column < dense_.size()) {
      const Column& found = dense_[column];
      return found.is_absent() ? nullptr : &found;
    }
    return find_hashed(column);
  }
  [[nodiscard]] const Column* find_hashed(Id column) const;
  template <class Visit>
  void for_each_segment(const Column& column, Visit&& visit) const;

  [[nodiscard]] Column store(std::span<const TermType> terms);
  [[nodiscard]] Column store_copy(const ColumnStore& other, const Column& column);
  [[nodiscard]] std::size_t size_of(const Column& column) const;
  void release(const Column& column);
  Column& at(Id column) { return column < dense_.size() ? dense_[column] : hashed_.at(column); }
  void put(Id column, Column record);
  void put_last(Column record);
  Column take_out(Id column);
  void hang(Id column, Column segment);
  std::uint32_t new_link(Link link);
  void settle_directory();
  void repack_if_wasteful();

  R ring_;
  Index rows_;
  Index columns_;
  // The directory: columns below dense_.size() are in dense_, those from there on in hashed_ when they are stored.
  GrowingArray<Column> dense_;
  std::unordered_map<Id, Column> hashed_;
  std::vector<Link> links_;
  std::uint32_t free_link_ = no_link;  ///< links out of use form a list
  Pool pool_;
  std::size_t stored_columns_ = 0;
  std::size_t stored_entries_ = 0;
};

template <Ring R, class Id>
template <class Visit>
void ColumnStore<R, Id>::for_each_segment(const Column& column, Visit&& visit) const {
  if (!column.is_chained()) [[likely]] {
    if (column.size != 0) {
      visit(Segment{column.at, column.size});
    }
    return;
  }
  std::uint32_t link = column.at;
  do {
    link = links_[link].next;
    visit(links_[link].segment);
  } while (link != column.at);
}

template <Ring R, class Id>
template <class Visit>
bool ColumnStore<R, Id>::for_each_in_column(Id column, Visit&& visit) const {
  const Column* found = find(column);
  if (found == nullptr) [[unlikely]] {
    return false;
  }
  for_each_segment(*found, [&](Segment segment) {
    const TermType* entry = pool_.at(segment.position);
    for (const TermType* end = entry + segment.size; entry != end; ++entry) {
      visit(*entry);
    }
  });
  return true;
}

template <Ring R, class Id>
template <class Visit>
void ColumnStore<R, Id>::for_each_stored(Visit&& visit) const {
  for (Index j = 0; j < dense_.size(); ++j) {
    if (!dense_[j].is_absent()) {
      visit(Id{j});
    }
  }
  for (const auto& [j, column] : hashed_) {
    visit(j);
  }
}

}  // namespace sesame::sparse

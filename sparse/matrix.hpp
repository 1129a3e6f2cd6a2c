/// \file
/// Sparse matrices by columns, with an implicit identity and an in-place four-block merge.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "sparse/chain.hpp"
#include "sparse/entry_pool.hpp"

namespace sesame::sparse {

/// What the columns that a matrix does not store are: zero, or (column j) the unit vector e_j.
enum class Rest : std::uint8_t { zero, identity };

/// Counts of the work that merges did, for tests and statistics.
struct MergeWork {
  std::size_t entries_written = 0;  ///< entries copied in from B, C and D
  std::size_t entries_of_a = 0;     ///< entries of A that had to be read or moved: only those of unit columns that
                                    ///< were implicit and get a part of C (one each)
};

/// A sparse matrix over a ring, stored by columns.
///
/// Shape     rows x columns; entry (i, j) maps generator j of the source to generator i of the target.
/// Columns   A column is *stored* or not. A column that is not stored is zero, or, in a matrix with Rest::identity, the
///           unit vector e_j (zero for j >= rows). So a map that differs from the identity in k columns stores k
///           columns.
/// Storage   The entries of a column lie in one or more segments, sorted by row across segments, never zero, never
///           repeated. Segments live in blocks that never move: growing a matrix neither copies nor reads what is
///           there. Only replacing or forgetting columns may one day repack them, when most of the room is wasted. A
///           column costs 8 bytes besides its entries; a matrix that stores few of its columns finds them by hashing,
///           and costs no memory for the others.
/// Cost      Unless a member says otherwise, O(size of the columns that it names).
template <Ring R>
class Matrix {
 public:
  using Element = typename R::Element;
  using TermType = Term<R>;

  Matrix(R ring, Index rows, Index columns, Rest rest = Rest::zero);
  static Matrix identity(R ring, Index n) { return Matrix(ring, n, n, Rest::identity); }
  Matrix(const Matrix& other);
  Matrix& operator=(const Matrix& other);
  /// What is moved from is a 0 x 0 matrix.
  Matrix(Matrix&& other) noexcept : Matrix(other.ring_, 0, 0) { swap(other); }
  Matrix& operator=(Matrix&& other) noexcept {
    Matrix moved{std::move(other)};
    swap(moved);
    return *this;
  }
  ~Matrix() = default;
  void swap(Matrix& other) noexcept;

  [[nodiscard]] const R& ring() const { return ring_; }
  [[nodiscard]] Index rows() const { return rows_; }
  [[nodiscard]] Index columns() const { return columns_; }
  [[nodiscard]] Rest rest() const { return rest_; }
  /// The number of columns that are stored, whether or not they are zero.
  [[nodiscard]] std::size_t stored_columns() const { return stored_columns_; }
  /// The number of entries that are stored (implicit ones do not count).
  [[nodiscard]] std::size_t stored_entries() const { return stored_entries_; }
  /// The number of nonzero entries of the matrix, implicit ones included. Cost O(stored columns).
  [[nodiscard]] std::size_t nonzeros() const;

  [[nodiscard]] bool is_stored(Index column) const { return find(column) != nullptr; }
  /// Calls visit(const Term<R>&) for each entry of the column, by increasing row; the implicit entry included.
  template <class Visit>
  void for_each_in_column(Index column, Visit&& visit) const;
  /// The column in normal form (a copy).
  [[nodiscard]] Terms<R> column(Index column) const;
  [[nodiscard]] Element entry(Index row, Index column) const;
  /// The indices of the stored columns, increasing. Cost O(k log k) for k of them.
  [[nodiscard]] std::vector<Index> stored() const;

  /// Replaces a column; from then on it is stored. Requires: normal form, rows in range, terms not inside this matrix.
  void set_column(Index column, std::span<const TermType> terms);
  /// Makes a column implicit again.
  void forget_column(Index column);
  /// column += a * terms (normal form).
  void add_to_column(Index column, const Element& a, std::span<const TermType> terms);

  /// Appends a stored column on the right. Cost O(|terms|), amortised over the directory of columns.
  void append_column(std::span<const TermType> terms);
  /// Appends rows at the bottom, zero in the stored columns. A matrix with Rest::identity keeps its implicit columns,
  /// and columns j >= the old number of rows become unit vectors. Cost O(1).
  void append_rows(Index count) { rows_ += count; }
  /// Cuts the matrix back to its first `rows` rows and `columns` columns: undo of growth.
  /// Requires: the columns kept have no entry in the rows cut off. Cost O(size of the columns that go).
  void truncate(Index rows, Index columns);

  /// Turns A (this) into [[A, B], [C, D]] in place: B and D are appended as columns, C is hung below A's columns.
  ///
  /// Shapes    A m x n, B m x q, C p x n, D p x q; none of B, C, D is this matrix. The result has the rest of A.
  ///           Where A and D have Rest::identity and m = n, unit columns of D over which B is zero stay implicit;
  ///           the implicit entries of B, C and D are otherwise
  ///           written like stored ones.
  /// Cost      O(nnz B + nnz C + nnz D + q), and the stored columns of C: A's entries are neither copied nor traversed.
  ///           An implicit unit column of A under which C has entries becomes stored: one entry of A. Where A has
  ///           Rest::identity and n > m, its implicit columns from m on, which are zero, become stored: O(n - m).
  /// Source    W. Rharbaoui's thesis (2022), the in-place merge of four matrices.
  MergeWork merge(const Matrix& b, const Matrix& c, const Matrix& d);

  /// this * chain terms. Requires: indices < columns(). The result is in normal form.
  [[nodiscard]] Terms<R> apply(std::span<const TermType> terms) const;
  /// this * v, as a chain of degree v.degree() + shift.
  [[nodiscard]] Chain<R> apply(const Chain<R>& v, int shift) const;

  /// The transpose. An implicit identity stays implicit where its row meets no stored column.
  [[nodiscard]] Matrix transposed() const;
  [[nodiscard]] bool is_zero() const;
  /// True when the two are the same map, whatever each stores.
  friend bool operator==(const Matrix& a, const Matrix& b) { return a.equals(b); }

  /// this += a * other. Same shape. Cost O(stored entries of other + those of the columns touched). Where implicit
  /// columns add up to zero or to unit vectors they stay implicit (1 - M costs O(stored M)); otherwise every column
  /// gets stored.
  void add(const Element& a, const Matrix& other);
  void scale(const Element& a);

  /// For people: a table with aligned columns for small matrices; larger ones as a list of columns `j: 2 e0 - e3`.
  [[nodiscard]] std::string to_string() const;

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

  [[nodiscard]] const Column* find(Index column) const {
    if (column < dense_.size()) {
      const Column& found = dense_[column];
      return found.is_absent() ? nullptr : &found;
    }
    return find_hashed(column);
  }
  [[nodiscard]] const Column* find_hashed(Index column) const;
  [[nodiscard]] bool has_implicit_unit(Index column) const { return rest_ == Rest::identity && column < rows_; }
  template <class Visit>
  void for_each_segment(const Column& column, Visit&& visit) const;
  template <class Visit>
  void for_each_stored(Visit&& visit) const;

  [[nodiscard]] Column store(std::span<const TermType> terms);
  [[nodiscard]] Column store_copy(const Matrix& other, const Column& column);
  [[nodiscard]] std::size_t size_of(const Column& column) const;
  void release(const Column& column);
  Column& at(Index column) { return column < dense_.size() ? dense_[column] : hashed_.at(column); }
  void put(Index column, Column record);
  void put_last(Column record);
  Column take_out(Index column);
  void hang(Index column, Column segment);
  std::uint32_t new_link(Link link);
  void settle_directory();
  void repack_if_wasteful();
  void store_implicit_units();
  void merge_below(const Matrix& c, MergeWork& work);
  void merge_right(const Matrix& b, const Matrix& d, MergeWork& work);
  [[nodiscard]] bool equals(const Matrix& other) const;
  [[nodiscard]] std::string to_table() const;
  [[nodiscard]] std::string to_list() const;

  R ring_;
  Index rows_;
  Index columns_;
  Rest rest_;
  // The directory: columns below dense_.size() are in dense_, those from there on in hashed_ when they are stored.
  std::vector<Column> dense_;
  std::unordered_map<Index, Column> hashed_;
  std::vector<Link> links_;
  std::uint32_t free_link_ = no_link;  ///< links out of use form a list
  Pool pool_;
  std::size_t stored_columns_ = 0;
  std::size_t stored_entries_ = 0;
};

/// a * b. Requires: a.columns() == b.rows(), same ring. Implicit identities multiply at no cost: identity * M costs
/// O(stored M).
template <Ring R>
[[nodiscard]] Matrix<R> operator*(const Matrix<R>& a, const Matrix<R>& b);
template <Ring R>
[[nodiscard]] Matrix<R> operator+(Matrix<R> a, const Matrix<R>& b);
template <Ring R>
[[nodiscard]] Matrix<R> operator-(Matrix<R> a, const Matrix<R>& b);
template <Ring R>
[[nodiscard]] Matrix<R> operator-(Matrix<R> a);
/// The matrix [[a, b], [c, d]] as a new one; shapes as in merge.
template <Ring R>
[[nodiscard]] Matrix<R> blocks(Matrix<R> a, const Matrix<R>& b, const Matrix<R>& c, const Matrix<R>& d);
/// The first place where two matrices of one shape differ (columns first), or nothing.
struct Position {
  Index row;
  Index column;
};
template <Ring R>
[[nodiscard]] std::optional<Position> first_difference(const Matrix<R>& a, const Matrix<R>& b);

template <Ring R>
template <class Visit>
void Matrix<R>::for_each_segment(const Column& column, Visit&& visit) const {
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

template <Ring R>
template <class Visit>
void Matrix<R>::for_each_in_column(Index column, Visit&& visit) const {
  if (const Column* found = find(column)) [[likely]] {
    for_each_segment(*found, [&](Segment segment) {
      const TermType* entry = pool_.at(segment.position);
      for (const TermType* end = entry + segment.size; entry != end; ++entry) {
        visit(*entry);
      }
    });
  } else if (has_implicit_unit(column)) {
    const TermType unit{column, ring_.one()};
    visit(unit);
  }
}

}  // namespace sesame::sparse

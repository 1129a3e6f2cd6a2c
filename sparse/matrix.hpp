/// \file
/// Sparse matrices by columns, with an implicit identity and an in-place four-block merge.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sparse/column_store.hpp"

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
/// Storage   See ColumnStore.
/// Cost      Unless a member says otherwise, O(size of the columns that it names).
template <Ring R>
class Matrix {
 public:
  using Element = typename R::Element;
  using TermType = Term<R>;

  Matrix(R ring, Index rows, Index columns, Rest rest = Rest::zero)
      : store_{std::move(ring), rows, columns}, rest_{rest} {}
  static Matrix identity(R ring, Index n) { return Matrix(ring, n, n, Rest::identity); }

  [[nodiscard]] const R& ring() const { return store_.ring(); }
  [[nodiscard]] Index rows() const { return store_.rows(); }
  [[nodiscard]] Index columns() const { return store_.columns(); }
  [[nodiscard]] Rest rest() const { return rest_; }
  /// The number of columns that are stored, whether or not they are zero.
  [[nodiscard]] std::size_t stored_columns() const { return store_.stored_columns(); }
  /// The number of entries that are stored (implicit ones do not count).
  [[nodiscard]] std::size_t stored_entries() const { return store_.stored_entries(); }
  /// The number of nonzero entries of the matrix, implicit ones included. Cost O(stored columns).
  [[nodiscard]] std::size_t nonzeros() const;

  [[nodiscard]] bool is_stored(Index column) const { return store_.is_stored(column); }
  /// Calls visit(const Term<R>&) for each entry of the column, by increasing row; the implicit entry included.
  template <class Visit>
  void for_each_in_column(Index column, Visit&& visit) const;
  /// The column in normal form (a copy).
  [[nodiscard]] Terms<R> column(Index column) const;
  [[nodiscard]] Element entry(Index row, Index column) const;
  /// The indices of the stored columns, increasing. Cost O(k log k) for k of them.
  [[nodiscard]] std::vector<Index> stored() const { return store_.stored(); }

  /// Replaces a column; from then on it is stored. Requires: normal form, rows in range, terms not inside this matrix.
  void set_column(Index column, std::span<const TermType> terms) { store_.set_column(column, terms); }
  /// Makes a column implicit again.
  void forget_column(Index column) { store_.forget_column(column); }
  /// column += a * terms (normal form).
  void add_to_column(Index column, const Element& a, std::span<const TermType> terms);

  /// Appends a stored column on the right. Cost O(|terms|), amortised over the directory of columns.
  void append_column(std::span<const TermType> terms) { store_.append_column(terms); }
  /// Appends rows at the bottom, zero in the stored columns. A matrix with Rest::identity keeps its implicit columns,
  /// and columns j >= the old number of rows become unit vectors. Cost O(1).
  void append_rows(Index count) { store_.append_rows(count); }
  /// Cuts the matrix back to its first `rows` rows and `columns` columns: undo of growth.
  /// Requires: the columns kept have no entry in the rows cut off. Cost O(size of the columns that go).
  void truncate(Index rows, Index columns) { store_.truncate(rows, columns); }

  /// Turns A (this) into [[A, B], [C, D]] in place: B and D are appended as columns, C is hung below A's columns.
  ///
  /// Shapes    A m x n, B m x q, C p x n, D p x q; none of B, C, D is this matrix. The result has the rest of A.
  ///           Where A and D have Rest::identity and m = n, unit columns of D over which B is zero stay implicit;
  ///           the implicit entries of B, C and D are otherwise written like stored ones.
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

 private:
  [[nodiscard]] bool has_implicit_unit(Index column) const { return rest_ == Rest::identity && column < rows(); }
  void store_implicit_units();
  void merge_below(const Matrix& c, Index rows_above, MergeWork& work);
  void merge_right(const Matrix& b, const Matrix& d, Index rows_above, bool implicit_units, MergeWork& work);
  [[nodiscard]] bool equals(const Matrix& other) const;

  ColumnStore<R> store_;
  Rest rest_;
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
void Matrix<R>::for_each_in_column(Index column, Visit&& visit) const {
  if (!store_.for_each_in_column(column, visit) && has_implicit_unit(column)) {
    const TermType unit{column, ring().one()};
    visit(unit);
  }
}

}  // namespace sesame::sparse

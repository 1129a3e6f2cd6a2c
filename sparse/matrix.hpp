/// \file
/// Sparse matrices by columns, with an implicit identity and an in-place four-block merge.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "sparse/chain.hpp"

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
///           unit vector e_j (zero for j >= rows). So a map that differs from the identity in k columns stores k columns.
/// Storage   The entries of a column lie in one or more segments, sorted by row across segments, never zero, never
///           repeated. Segments live in blocks that never move: growing a matrix neither copies nor reads what is there.
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
  Matrix(Matrix&&) noexcept = default;
  Matrix& operator=(Matrix&&) noexcept = default;
  ~Matrix() = default;

  [[nodiscard]] const R& ring() const { return ring_; }
  [[nodiscard]] Index rows() const { return rows_; }
  [[nodiscard]] Index columns() const { return columns_; }
  [[nodiscard]] Rest rest() const { return rest_; }
  /// The number of columns that are stored, whether or not they are zero.
  [[nodiscard]] std::size_t stored_columns() const;
  /// The number of entries that are stored (implicit ones do not count).
  [[nodiscard]] std::size_t stored_entries() const { return stored_entries_; }
  /// The number of nonzero entries of the matrix, implicit ones included. Cost O(stored columns).
  [[nodiscard]] std::size_t nonzeros() const;

  [[nodiscard]] bool is_stored(Index column) const;
  /// Calls visit(const Term<R>&) for each entry of the column, by increasing row; the implicit entry included.
  template <class Visit>
  void for_each_in_column(Index column, Visit&& visit) const;
  /// The column in normal form (a copy).
  [[nodiscard]] Terms<R> column(Index column) const;
  [[nodiscard]] Element entry(Index row, Index column) const;
  /// The indices of the stored columns, increasing. Cost O(k log k) for k of them.
  [[nodiscard]] std::vector<Index> stored() const;

  /// Replaces a column; from then on it is stored. Requires: normal form, rows in range.
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
  /// Shapes    A m x n, B m x q, C p x n, D p x q. B, C, D have Rest::zero, or D is square with Rest::identity and A has
  ///           Rest::identity (the result keeps it), in which case p = q and m = n.
  /// Cost      O(nnz B + nnz C + nnz D + q): A's entries are neither copied nor traversed. An implicit unit column of A
  ///           under which C has entries becomes stored: one entry of A.
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

  /// this += a * other. Same shape. Cost O(stored entries of other + those of the columns touched), except that adding
  /// an implicit identity to a Rest::zero matrix stores every column.
  void add(const Element& a, const Matrix& other);
  void scale(const Element& a);

  /// For people: a table with aligned columns for small matrices; larger ones as a list of columns `j: 2*e0 - e3`.
  [[nodiscard]] std::string to_string() const;

 private:
  // (The implementer chooses: block pool of entries, segments, directory of columns.)
};

/// a * b. Requires: a.columns() == b.rows(), same ring. Implicit identities multiply at no cost: identity * M costs O(stored M).
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

}  // namespace sesame::sparse

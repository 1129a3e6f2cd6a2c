/// \file
/// Finite chain complexes, by their boundary matrices.
///
/// Letters, used throughout this folder and in the papers: C a complex, d its differential, (f, g, h) a reduction,
/// i, j, r, s an exact sequence, chi the part of a differential that mixes the two ends of a sequence.
/// Maps act on the left: `g f x` is first f, then g.
#pragma once

#include <cstddef>
#include <vector>

#include "sparse/matrix.hpp"

namespace sesame::reductions {

using sparse::Chain;
using sparse::Degree;
using sparse::Index;
using sparse::Integer;
using sparse::Matrix;
using sparse::RawTerms;
using sparse::Rest;
using sparse::Ring;
using sparse::Term;
using sparse::Terms;

/// A graded module with a finite basis: the number of generators of each degree 0, 1, 2, ...
/// Two that differ by zeros at the end are the same module; the classes of this folder keep them without such zeros.
using Sizes = std::vector<Index>;

/// The number of generators of degree p; 0 for every p that `sizes` does not list.
[[nodiscard]] inline Index size_at(const Sizes& sizes, int p) {
  return p >= 0 && static_cast<std::size_t>(p) < sizes.size() ? sizes[static_cast<std::size_t>(p)] : 0;
}
/// The same module without zeros at the end.
[[nodiscard]] Sizes trimmed(Sizes sizes);

/// A free chain complex with a finite basis: modules C_0, C_1, ... and boundaries d_p: C_p -> C_{p-1}.
///
/// The constructor checks shapes; that d d = 0 is for `first_defect` (defect.hpp) to say.
template <Ring R>
class ChainComplex {
 public:
  /// \param sizes       generators per degree 0..n
  /// \param boundaries  one matrix per degree; boundaries[p] has size(p-1) rows and size(p) columns
  /// Zero degrees at the top are dropped.
  ChainComplex(R ring, Sizes sizes, std::vector<Matrix<R>> boundaries);
  /// The complex of these sizes in which every boundary is zero.
  static ChainComplex with_zero_boundary(R ring, Sizes sizes);

  [[nodiscard]] const R& ring() const { return ring_; }
  /// The largest degree that has a generator; -1 for the zero complex.
  [[nodiscard]] int top() const { return static_cast<int>(sizes_.size()) - 1; }
  [[nodiscard]] Index size(int p) const { return size_at(sizes_, p); }
  [[nodiscard]] const Sizes& sizes() const { return sizes_; }
  /// d_p, for every p: a zero matrix of size(p-1) rows and size(p) columns where one of the two is empty.
  [[nodiscard]] const Matrix<R>& boundary(int p) const;
  /// d_0, ..., d_top, as `sparse::agoston_bases` takes them.
  [[nodiscard]] std::vector<Matrix<R>> boundaries() const;
  /// The boundary of a chain of any degree.
  [[nodiscard]] Chain<R> boundary_of(const Chain<R>& chain) const;
  /// The number of generators, all degrees together.
  [[nodiscard]] std::size_t total_size() const;

  friend bool operator==(const ChainComplex& a, const ChainComplex& b) { return a.equals(b); }

 private:
  [[nodiscard]] bool equals(const ChainComplex& other) const;

  R ring_;
  Sizes sizes_;
  std::vector<Matrix<R>> boundaries_;  // d_0, ..., d_{top+1}, then the empty matrix
};

}  // namespace sesame::reductions

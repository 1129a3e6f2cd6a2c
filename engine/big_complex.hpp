/// \file
/// The big complex B of a history of steps, append-only, and the left reduction (f, g, h): B => C onto the object.
#pragma once

#include <cstdint>
#include <vector>

#include "ops/structure.hpp"
#include "sparse/matrix.hpp"

namespace sesame::engine {

using ops::CellId;
using ops::LinkId;
using ops::Structure;
using sparse::Index;
using sparse::Ring;
using sparse::Terms;

/// The big complex. It has one generator per cell ever created and one per removal of a cell, so |B| <= 2 |cells|.
///
///   a cell c created with faces c_k     generator [c] of degree dim c,      boundary g(d c)
///   a cell x removed in favour of y     generator <x> of degree dim x + 1,  boundary g(y) - g(x)
///
/// This is the cone of iB: B0 -> B1 of the exact sequence of each step, [[dB1, iB], [0, -dB0]], grown in place: the new
/// columns are appended, the old block is neither copied nor read. The left reduction is never stored as a matrix:
///
///   f [c] = the cell that c is now, f <x> = 0                       (the union-find forest of the structure)
///   g c   = [c] + sum over faces k of sign_k P(c_k)                 (the identity, plus corrections)
///   h [c] = -P(c), h <x> = 0
///
/// where P(x) is the sum of the generators <y> on the path of the forest from x to the cell that x is now.
///
/// Source: S. Peltier's habilitation (2023), section 3.3.3; see engine/LIVE_FORM.md.
template <Ring R>
class BigComplex {
 public:
  explicit BigComplex(R ring, const Structure& structure);

  [[nodiscard]] const R& ring() const { return ring_; }
  [[nodiscard]] Index size() const { return static_cast<Index>(origin_.size()); }
  [[nodiscard]] int degree(Index generator) const { return degree_[generator]; }
  /// The boundary of B as one square matrix over all degrees.
  [[nodiscard]] const sparse::Matrix<R>& boundary() const { return boundary_; }
  /// The number of generators of each degree, up to the largest that has one.
  [[nodiscard]] const std::vector<std::uint32_t>& counts() const { return counts_; }

  /// The entries ever appended to the boundary, undone ones included.
  [[nodiscard]] std::uint64_t entries_appended() const { return entries_appended_; }

  /// Appends the generator of the next cell, of the next removal. Cost O(faces of faces * log cells).
  Index append_cell(CellId cell);
  Index append_removal(LinkId link);
  void truncate(Index size, CellId cells, LinkId links);

  /// g of a current cell times a factor, added to `out` (not in normal form).
  void add_g(CellId cell, const typename R::Element& factor, Terms<R>& out) const;
  /// P(x) times a factor, added to `out` (not in normal form).
  void add_path(CellId x, const typename R::Element& factor, Terms<R>& out) const;
  /// f of a generator: a current cell, or ops::none.
  [[nodiscard]] CellId f(Index generator) const;
  /// f of a chain of B, as a chain of current cells (indices are cell ids), in normal form.
  [[nodiscard]] Terms<R> f(std::span<const sparse::Term<R>> chain) const;
  /// h of a generator, in normal form.
  [[nodiscard]] Terms<R> h(Index generator) const;

 private:
  static constexpr std::uint32_t removal = 0x8000'0000U;  ///< mark of <x> in origin_

  Index append(std::uint32_t origin, int degree);

  R ring_;
  const Structure& structure_;
  sparse::Matrix<R> boundary_;
  std::vector<std::uint32_t> origin_;  ///< per generator: a cell, or removal | link
  std::vector<std::uint8_t> degree_;
  std::vector<Index> of_cell_, of_link_;
  std::vector<std::uint32_t> counts_;
  std::uint64_t entries_appended_ = 0;
  Terms<R> column_;  ///< scratch
};

}  // namespace sesame::engine

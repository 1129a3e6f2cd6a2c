/// \file
/// A cell complex that is given column by column, as a boundary matrix over Z/2.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "sparse/growing_array.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// Cells are numbered in the order of their columns, from 0. Only what the checks need is kept: one word a cell.
class ColumnComplex {
 public:
  static constexpr int largest_dimension = 63;

  /// Adds the next cell and returns its number. Its rows are numbers of earlier cells, no two the same.
  /// Errors: bad_input when a row is not of one dimension less, or when the boundary of the boundary is not 0. That is
  /// seen by the sum of random words for the cells of it: a wrong matrix passes with probability 2^-58.
  /// Nothing has changed then. Cost: the number of rows.
  Result<std::uint32_t> include(int dimension, std::span<const std::uint64_t> rows);
  /// The dimension of a cell.
  [[nodiscard]] int dimension(std::uint64_t cell) const { return static_cast<int>(cells_[cell] & dimension_mask); }
  [[nodiscard]] std::uint64_t cells() const { return cells_.size(); }
  /// Begins to load what `include` will read of a row, if there is such a cell.
  void prefetch(std::uint64_t cell) const { __builtin_prefetch(cells_.data() + std::min(cell, cells())); }
  /// The rows of the cell included last.
  [[nodiscard]] std::span<const std::uint32_t> facets() const { return facets_; }
  /// The number of cells of each dimension, up to the largest that has one.
  [[nodiscard]] std::span<const std::uint64_t> counts() const { return counts_; }

 private:
  [[nodiscard]] Error wrong_dimension(int dimension, std::span<const std::uint64_t> rows) const;

  static constexpr std::uint64_t dimension_mask = largest_dimension;

  /// The dimension in the low bits, above them the sum of the words of the rows.
  sparse::GrowingArray<std::uint64_t> cells_;
  std::vector<std::uint64_t> counts_;
  std::vector<std::uint32_t> facets_;
};

}  // namespace sesame::ops

#include "ops/simplicial/column_complex.hpp"

#include <string>

#include "sparse/contract.hpp"
#include "sparse/hash_index.hpp"

namespace sesame::ops {

namespace {

Error bad(std::string what) { return {Errc::bad_input, std::move(what)}; }

}  // namespace

Result<std::uint32_t> ColumnComplex::include(int dimension, std::span<const std::uint64_t> rows) {
  if (dimension < 0 || dimension > largest_dimension) {
    return bad("dimension " + std::to_string(dimension) + " should be from 0 to " + std::to_string(largest_dimension));
  }
  if (dimension == 0 && !rows.empty()) {
    return bad("a cell of dimension 0 has no boundary");
  }
  facets_.resize(rows.size());
  const auto dimension_below = static_cast<std::uint64_t>(dimension - 1);
  std::uint64_t word = 0;
  std::uint64_t of_boundary = 0;
  std::uint64_t other_dimensions = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::uint64_t row = rows[k];
    if (row >= cells_.size()) {
      return bad("row " + std::to_string(row) + " is no earlier cell");
    }
    facets_[k] = static_cast<std::uint32_t>(row);
    word ^= sparse::spread_bits(row);
    of_boundary ^= cells_[row];
    other_dimensions |= (cells_[row] ^ dimension_below) & dimension_mask;
  }
  if (other_dimensions != 0) {
    return wrong_dimension(dimension, rows);
  }
  if ((of_boundary & ~dimension_mask) != 0) {
    return bad("the boundary of its boundary is not 0");
  }
  const auto d = static_cast<std::size_t>(dimension);
  if (counts_.size() <= d) {
    counts_.resize(d + 1, 0);
  }
  ++counts_[d];
  sparse::expects(cells_.size() < UINT32_MAX, "fewer than 2^32 cells");
  cells_.push_back((word & ~dimension_mask) | d);
  return static_cast<std::uint32_t>(cells_.size() - 1);
}

Error ColumnComplex::wrong_dimension(int dimension, std::span<const std::uint64_t> rows) const {
  std::size_t k = 0;
  while ((cells_[rows[k]] & dimension_mask) + 1 == static_cast<std::uint64_t>(dimension)) {
    ++k;
  }
  return bad("row " + std::to_string(rows[k]) + " is of dimension " + std::to_string(cells_[rows[k]] & dimension_mask) +
             "; the boundary of a cell of dimension " + std::to_string(dimension) + " has cells of dimension " +
             std::to_string(dimension - 1));
}

}  // namespace sesame::ops

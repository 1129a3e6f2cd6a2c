/// \file
/// Ranks modulo p by plain elimination, invariant factors, and homology of plain simplicial complexes by them.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "sparse/matrix.hpp"
#include "sparse/smith.hpp"
#include "tests/support/random_towers.hpp"

namespace sesame::tests {

using DenseRow = std::vector<std::int64_t>;

/// The invariant factors of a matrix over Z that are not 0, by its Smith form: as many as its rank over Q.
inline std::vector<sparse::Integer> invariant_factors(const std::vector<DenseRow>& rows) {
  sparse::Matrix<sparse::Integers> matrix(sparse::Integers{},
                                          rows.empty() ? 0 : static_cast<sparse::Index>(rows[0].size()), 0);
  for (const DenseRow& row : rows) {
    sparse::Terms<sparse::Integers> column;
    for (sparse::Index k = 0; k < row.size(); ++k) {
      if (row[k] != 0) {
        column.push_back({k, row[k]});
      }
    }
    matrix.append_column(column);
  }
  return sparse::invariant_factors(matrix);
}

/// The rank modulo a small prime of a list of rows of one length.
inline std::size_t rank_modulo(std::vector<DenseRow> rows, std::int64_t p) {
  const auto reduced = [p](std::int64_t x) { return (x % p + p) % p; };
  std::size_t rank = 0;
  const std::size_t columns = rows.empty() ? 0 : rows[0].size();
  for (std::size_t c = 0; c < columns && rank < rows.size(); ++c) {
    std::size_t pivot = rank;
    while (pivot < rows.size() && reduced(rows[pivot][c]) == 0) {
      ++pivot;
    }
    if (pivot == rows.size()) {
      continue;
    }
    std::swap(rows[pivot], rows[rank]);
    std::int64_t inverse = 1;
    while (reduced(inverse * rows[rank][c]) != 1) {
      ++inverse;
    }
    for (std::size_t r = rank + 1; r < rows.size(); ++r) {
      const std::int64_t factor = reduced(rows[r][c] * inverse);
      for (std::size_t k = c; factor != 0 && k < columns; ++k) {
        rows[r][k] = reduced(rows[r][k] - factor * rows[rank][k]);
      }
    }
    ++rank;
  }
  return rank;
}

/// The simplices of one dimension of a plain complex, numbered.
inline std::map<PlainComplex::Simplex, std::size_t> numbered(const PlainComplex& complex, std::size_t dimension) {
  std::map<PlainComplex::Simplex, std::size_t> number;
  for (const PlainComplex::Simplex& s : complex.simplices()) {
    if (s.size() == dimension + 1) {
      number.emplace(s, number.size());
    }
  }
  return number;
}

/// The boundaries of the simplices of a dimension, a row each, in the simplices of one dimension less.
inline std::vector<DenseRow> boundary_rows(const PlainComplex& complex, std::size_t dimension) {
  const auto below = numbered(complex, dimension - 1);
  std::vector<DenseRow> rows;
  for (const auto& [simplex, index] : numbered(complex, dimension)) {
    DenseRow row(below.size(), 0);
    std::int64_t sign = 1;
    for (const ops::Label v : simplex) {
      PlainComplex::Simplex facet = simplex;
      facet.erase(v);
      row[below.at(facet)] = sign;
      sign = -sign;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Betti numbers over Z/p, zeros at the end left out.
inline std::vector<std::uint64_t> betti_modulo(const PlainComplex& complex, std::int64_t p) {
  std::vector<std::uint64_t> betti;
  std::size_t rank_below = 0;
  for (std::size_t d = 0; !numbered(complex, d).empty(); ++d) {
    const std::size_t rank_above = rank_modulo(boundary_rows(complex, d + 1), p);
    betti.push_back(numbered(complex, d).size() - rank_below - rank_above);
    rank_below = rank_above;
  }
  while (!betti.empty() && betti.back() == 0) {
    betti.pop_back();
  }
  return betti;
}

}  // namespace sesame::tests

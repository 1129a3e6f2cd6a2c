/// \file
/// The slow and plain twin of the sparse matrices: rows of machine words, and random matrices to compare on.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "sparse/matrix.hpp"

namespace sesame::sparse {

/// The ring that stands for its type in the tests.
template <Ring R>
R sample_ring() {
  if constexpr (std::is_same_v<R, Zp>) {
    return *Zp::make(7);
  } else {
    return R{};
  }
}

/// A dense matrix of small integers, to be read modulo the characteristic.
struct Dense {
  Dense(Index rows_of, Index columns_of) : rows{rows_of}, columns{columns_of}, entries(std::size_t{rows} * columns) {}
  std::int64_t& operator()(Index i, Index j) { return entries[std::size_t{i} * columns + j]; }
  std::int64_t operator()(Index i, Index j) const { return entries[std::size_t{i} * columns + j]; }

  Index rows, columns;
  std::vector<std::int64_t> entries;
};

inline Dense product(const Dense& a, const Dense& b) {
  Dense c(a.rows, b.columns);
  for (Index i = 0; i < a.rows; ++i) {
    for (Index j = 0; j < b.columns; ++j) {
      for (Index k = 0; k < a.columns; ++k) {
        c(i, j) += a(i, k) * b(k, j);
      }
    }
  }
  return c;
}

template <Ring R>
Matrix<R> to_sparse(const R& ring, const Dense& a) {
  Matrix<R> result(ring, a.rows, 0);
  for (Index j = 0; j < a.columns; ++j) {
    RawTerms<R> column;
    for (Index i = 0; i < a.rows; ++i) {
      column.push_back({i, ring.from(a(i, j))});
    }
    result.append_column(std::move(column).normal(ring));
  }
  return result;
}

/// Reads every entry on its own; values must fit a machine word.
template <Ring R>
Dense to_dense(const Matrix<R>& a) {
  Dense result(a.rows(), a.columns());
  for (Index i = 0; i < a.rows(); ++i) {
    for (Index j = 0; j < a.columns(); ++j) {
      result(i, j) = a.ring().to_integer(a.entry(i, j)).to_int64().value();
    }
  }
  return result;
}

/// Where a matrix differs from its twin, or breaks the promises of its storage; empty when all is well.
template <Ring R>
std::string difference(const Matrix<R>& a, const Dense& twin) {
  if (a.rows() != twin.rows || a.columns() != twin.columns) {
    return "shape";
  }
  std::size_t nonzeros = 0;
  for (Index j = 0; j < twin.columns; ++j) {
    Index next = 0;
    bool normal = true;
    a.for_each_in_column(j, [&](const Term<R>& entry) {
      normal = normal && entry.index >= next && entry.index < a.rows() && !a.ring().is_zero(entry.coefficient);
      next = entry.index + 1;
      ++nonzeros;
    });
    if (!normal) {
      return "column " + std::to_string(j) + " is not in normal form";
    }
    for (Index i = 0; i < twin.rows; ++i) {
      if (a.entry(i, j) != a.ring().from(twin(i, j))) {
        return "entry " + std::to_string(i) + ", " + std::to_string(j);
      }
    }
  }
  return nonzeros == a.nonzeros() ? "" : "nonzeros";
}

using Random = std::mt19937;

inline Index below(Random& random, Index n) { return static_cast<Index>(random() % n); }

/// A dense matrix in which about one entry of `sparsity` is not zero.
inline Dense random_dense(Random& random, Index rows, Index columns, Index sparsity = 3) {
  Dense a(rows, columns);
  for (auto& entry : a.entries) {
    entry = below(random, sparsity) == 0 ? std::int64_t{below(random, 9)} - 4 : 0;
  }
  return a;
}

/// A matrix and its twin. Columns are stored in random order, some not at all.
template <Ring R>
struct Pair {
  Matrix<R> sparse;
  Dense dense;
};

template <Ring R>
Pair<R> random_pair(const R& ring, Random& random, Index rows, Index columns, Rest rest, Index one_stored_of = 2) {
  Pair<R> pair{Matrix<R>(ring, rows, columns, rest), Dense(rows, columns)};
  if (rest == Rest::identity) {
    for (Index j = 0; j < std::min(rows, columns); ++j) {
      pair.dense(j, j) = 1;
    }
  }
  for (Index round = 0; columns > 0 && round < columns / one_stored_of + 1; ++round) {
    const Index j = below(random, columns);
    const Dense column = random_dense(random, rows, 1);
    RawTerms<R> terms;
    for (Index i = 0; i < rows; ++i) {
      pair.dense(i, j) = column(i, 0);
      terms.push_back({i, ring.from(column(i, 0))});
    }
    pair.sparse.set_column(j, std::move(terms).normal(ring));
  }
  return pair;
}

}  // namespace sesame::sparse

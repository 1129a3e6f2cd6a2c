/// \file
/// Complexes with known homology, and short ways to write matrices, for the tests of every folder.
#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <map>
#include <utility>
#include <vector>

#include "reductions/chain_complex.hpp"
#include "reductions/group.hpp"

namespace sesame::tests {

using reductions::AbelianGroup;
using reductions::ChainComplex;
using reductions::Sizes;
using sparse::Index;
using sparse::Integer;
using sparse::Integers;
using sparse::Matrix;
using sparse::Ring;
using sparse::Terms;
using sparse::Z2;
using sparse::Zp;

/// The value of a ring type that tests use: Z/5 for Zp.
template <Ring R>
R test_ring() {
  if constexpr (std::same_as<R, Zp>) {
    return Zp::make(5).value();
  } else {
    return R{};
  }
}

/// Row and coefficient.
using Entry = std::pair<Index, int>;

template <class Id = Index, Ring R>
Terms<R, Id> terms_of(const R& ring, const std::vector<Entry>& entries) {
  sparse::RawTerms<R, Id> terms;
  for (const auto& [row, coefficient] : entries) {
    terms.push_back({Id{row}, ring.from(std::int64_t{coefficient})});
  }
  return std::move(terms).normal(ring);
}

/// A matrix from its columns, each a list of {row, coefficient}.
template <Ring R>
Matrix<R> matrix_of(const R& ring, Index rows, const std::vector<std::vector<Entry>>& columns) {
  Matrix<R> matrix(ring, rows, static_cast<Index>(columns.size()));
  for (std::size_t j = 0; j < columns.size(); ++j) {
    matrix.set_column(static_cast<Index>(j), terms_of(ring, columns[j]));
  }
  return matrix;
}

/// The complex with these generators and one matrix per degree from 1 on.
template <Ring R>
ChainComplex<R> complex_of(const R& ring, const Sizes& sizes, const std::vector<std::vector<std::vector<Entry>>>& d) {
  std::vector<Matrix<R>> boundaries;
  boundaries.emplace_back(ring, Index{0}, sizes.at(0));
  for (std::size_t p = 1; p < sizes.size(); ++p) {
    boundaries.push_back(matrix_of(ring, sizes[p - 1], d.at(p - 1)));
  }
  return ChainComplex<R>(ring, sizes, std::move(boundaries));
}

/// The simplicial complex with these facets, given by their vertices; generators in lexicographic order.
template <Ring R>
ChainComplex<R> simplicial_complex(const R& ring, const std::vector<std::vector<int>>& facets) {
  std::vector<std::map<std::vector<int>, Index>> simplices;  // per dimension, with their numbers
  for (std::vector<int> facet : facets) {
    std::sort(facet.begin(), facet.end());
    simplices.resize(std::max(simplices.size(), facet.size()));
    for (unsigned subset = 1; subset < (1U << facet.size()); ++subset) {
      std::vector<int> face;
      for (std::size_t k = 0; k < facet.size(); ++k) {
        if ((subset >> k & 1U) != 0) {
          face.push_back(facet[k]);
        }
      }
      simplices[face.size() - 1].emplace(std::move(face), Index{0});
    }
  }
  for (auto& dimension : simplices) {
    Index number = 0;
    for (auto& simplex : dimension) {
      simplex.second = number++;
    }
  }
  Sizes sizes;
  std::vector<std::vector<std::vector<Entry>>> boundaries;
  for (std::size_t p = 0; p < simplices.size(); ++p) {
    sizes.push_back(static_cast<Index>(simplices[p].size()));
    if (p == 0) {
      continue;
    }
    auto& columns = boundaries.emplace_back();
    for (const auto& [simplex, number] : simplices[p]) {
      auto& column = columns.emplace_back();
      for (std::size_t k = 0; k <= p; ++k) {
        std::vector<int> face = simplex;
        face.erase(face.begin() + static_cast<std::ptrdiff_t>(k));
        column.emplace_back(simplices[p - 1].at(face), k % 2 == 0 ? 1 : -1);
      }
    }
  }
  return complex_of(ring, sizes, boundaries);
}

/// The boundary of an (n+1)-simplex.
template <Ring R>
ChainComplex<R> sphere(const R& ring, int n) {
  std::vector<std::vector<int>> facets;
  for (int left_out = 0; left_out <= n + 1; ++left_out) {
    auto& facet = facets.emplace_back();
    for (int v = 0; v <= n + 1; ++v) {
      if (v != left_out) {
        facet.push_back(v);
      }
    }
  }
  return simplicial_complex(ring, facets);
}

/// Möbius's torus on 7 vertices.
template <Ring R>
ChainComplex<R> torus(const R& ring) {
  std::vector<std::vector<int>> facets;
  for (int v = 0; v < 7; ++v) {
    facets.push_back({v, (v + 1) % 7, (v + 3) % 7});
    facets.push_back({v, (v + 2) % 7, (v + 3) % 7});
  }
  return simplicial_complex(ring, facets);
}

/// The projective plane on 6 vertices: half an icosahedron.
template <Ring R>
ChainComplex<R> projective_plane(const R& ring) {
  return simplicial_complex(
      ring,
      {{0, 1, 4}, {0, 1, 5}, {0, 2, 3}, {0, 2, 4}, {0, 3, 5}, {1, 2, 3}, {1, 2, 5}, {1, 3, 4}, {2, 4, 5}, {3, 4, 5}});
}

/// The Klein bottle as a square of two triangles with sides glued: 1 vertex, 3 edges, 2 triangles.
template <Ring R>
ChainComplex<R> klein_bottle(const R& ring) {
  return complex_of(ring, {1, 3, 2}, {{{}, {}, {}}, {{{0, 1}, {1, 1}, {2, -1}}, {{0, 1}, {2, 1}, {1, -1}}}});
}

/// The dunce hat: one triangle, its three edges glued as a a a^-1.
template <Ring R>
ChainComplex<R> dunce_hat(const R& ring) {
  return complex_of(ring, {1, 1, 1}, {{{}}, {{{0, 1}}}});
}

/// A sphere of dimension n with a ball of dimension n + 1 attached t times: H_n = Z/t. Requires n >= 1.
template <Ring R>
ChainComplex<R> moore_space(const R& ring, int n, int t) {
  Sizes sizes(static_cast<std::size_t>(n) + 2, 0);
  sizes[0] = 1;
  sizes[static_cast<std::size_t>(n)] = 1;
  sizes[static_cast<std::size_t>(n) + 1] = 1;
  std::vector<std::vector<std::vector<Entry>>> d;
  for (int p = 1; p <= n + 1; ++p) {
    const Index columns = reductions::size_at(sizes, p);
    d.emplace_back(columns);
    if (p == n + 1) {
      d.back()[0] = {{0, t}};
    }
  }
  return complex_of(ring, sizes, d);
}

/// The lens space L(t, q) with one cell in each dimension 0..3: H_1 = Z/t, H_3 = Z.
template <Ring R>
ChainComplex<R> lens_space(const R& ring, int t) {
  return complex_of(ring, {1, 1, 1, 1}, {{{}}, {{{0, t}}}, {{}}});
}

/// Real projective space of dimension n, one cell per dimension.
template <Ring R>
ChainComplex<R> projective_space(const R& ring, int n) {
  std::vector<std::vector<std::vector<Entry>>> d;
  for (int p = 1; p <= n; ++p) {
    d.push_back({p % 2 == 0 ? std::vector<Entry>{{0, 2}} : std::vector<Entry>{}});
  }
  return complex_of(ring, Sizes(static_cast<std::size_t>(n) + 1, 1), d);
}

/// Z^rank + the cyclic groups of these orders.
inline AbelianGroup group(Index rank, const std::vector<Integer>& orders = {}) {
  AbelianGroup result = reductions::group_of(orders);
  result.rank += rank;
  return result;
}

}  // namespace sesame::tests

#include "sparse/contract.hpp"
#include "tools/bench/constructions.hpp"
#include "tools/bench/tilings.hpp"

namespace sesame::tools {
namespace {

using Facets = std::vector<std::vector<std::uint32_t>>;

/// Both triangles of the square at (i, j), but for the lower one when that is left out.
template <class Vertex>
void add_square(Facets& facets, std::uint32_t i, std::uint32_t j, bool without_lower, const Vertex& vertex) {
  if (!without_lower) {
    facets.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
  }
  facets.push_back({vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1)});
}

}  // namespace

Operations torus(std::uint32_t n, Assembly assembly) {
  sparse::expects(n >= 1, "a torus has a square at least");
  const auto side = [n](std::uint32_t direction, std::uint32_t i, std::uint32_t j) {
    return (std::uint64_t{direction} * n + i % n) * n + j % n;
  };
  Tiling tiling{{1, 1}, {}};
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      tiling.sides.push_back({side(0, i + 1, j), side(0, i, j), side(1, i, j + 1), side(1, i, j)});
    }
  }
  return assembled(tiling, assembly);
}

Operations klein_bottle(std::uint32_t n, Assembly assembly) {
  sparse::expects(n >= 3, "a Klein bottle of triangles has at least three squares either way");
  const auto vertex = [n](std::uint32_t i, std::uint32_t j) {
    return j < n ? i % n * n + j : (n - i % n) % n * n;  // the last row is the first one, the other way around
  };
  Facets facets;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      add_square(facets, i, j, false, vertex);
    }
  }
  return assembled(tiling_of_facets(std::move(facets)), assembly);
}

Operations separate_klein_bottles(std::uint32_t count) {
  Operations operations;
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::string q = "q" + std::to_string(k);
    operations.emplace_back(ops::MakeSimploid{q, {1, 1}, {}});
    operations.emplace_back(ops::Identify{{{q + ".1x0-1", q + ".0-1x0"}, {q + ".0x0-1", q + ".0-1x1"}}});
  }
  return operations;
}

Operations surface_of_genus(std::uint32_t genus, std::uint32_t n, Assembly assembly) {
  sparse::expects(genus >= 1 && n >= 4, "a surface has a torus of four squares either way at least");
  // Each torus but the last lacks the lower triangle at (m, m); each but the first lacks the one at (0, 0), whose
  // vertices are those of the triangle that the torus before it lacks.
  const std::uint32_t m = n / 2;
  Facets facets;
  for (std::uint32_t torus = 0; torus < genus; ++torus) {
    const auto own = [n](std::uint32_t t, std::uint32_t i, std::uint32_t j) { return (t * n + i % n) * n + j % n; };
    const auto vertex = [&](std::uint32_t i, std::uint32_t j) {
      const bool is_shared = torus > 0 && i % n <= 1 && j % n <= i % n;
      return is_shared ? own(torus - 1, m + i % n, m + j % n) : own(torus, i, j);
    };
    for (std::uint32_t i = 0; i < n; ++i) {
      for (std::uint32_t j = 0; j < n; ++j) {
        const bool is_joined = i == j && ((i == 0 && torus > 0) || (i == m && torus + 1 < genus));
        add_square(facets, i, j, is_joined, vertex);
      }
    }
  }
  return assembled(tiling_of_facets(std::move(facets)), assembly);
}

}  // namespace sesame::tools

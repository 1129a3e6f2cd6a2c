#include "ops/maps/incidence_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "ops/maps/cell_boundary.hpp"
#include "ops/maps/rooted_map.hpp"
#include "sparse/matrix.hpp"
#include "sparse/ring.hpp"
#include "sparse/smith.hpp"

namespace sesame::ops {
namespace {

/// The cells of one dimension as they are oriented.
struct OrientedCells {
  std::vector<std::int8_t> sign;  ///< per dart of the map: what it counts in its cell
  std::vector<CellBoundary> boundaries;
};

Result<OrientedCells> orient(const GMap& map, int i, const Orbits& cells) {
  OrientedCells oriented{std::vector<std::int8_t>(map.size(), 0), {}};
  CellBoundaries boundaries(map);
  for (const Dart first : cells.first) {
    CellBoundary cell = boundaries.of(i, first);
    const DartSigns signs = dart_signs(cell.map);
    if (signs.fault != DartSigns::Fault::nothing) {
      return Error{Errc::refused,
                   fmt::format("the {}-cell of dart {} {} at dart {}, so it has no incidence numbers", i, first,
                               signs.fault == DartSigns::Fault::fold ? "is folded" : "is not orientable, as is seen",
                               cell.representatives[signs.where])};
    }
    for (std::size_t k = 0; k < cell.darts.size(); ++k) {
      oriented.sign[cell.darts[k]] = signs.of[cell.boundary_darts[k]];
    }
    oriented.boundaries.push_back(std::move(cell));
  }
  return oriented;
}

std::vector<std::pair<std::uint32_t, int>> boundary_of(int i, const CellBoundary& cell,
                                                       const std::vector<std::int8_t>& sign,
                                                       const std::vector<std::int8_t>& sign_below,
                                                       const Orbits& below) {
  std::map<std::uint32_t, int> sum;
  const Orbits faces = orbits(cell.map, cell.map.indices() & ~(IndexSet{1} << (i - 1)));
  for (const Dart face : faces.first) {
    const Dart dart = cell.representatives[face];
    sum[below.of[dart]] += sign[dart] * sign_below[dart];
  }
  std::vector<std::pair<std::uint32_t, int>> boundary;
  for (const auto& term : sum) {
    if (term.second != 0) {
      boundary.push_back(term);
    }
  }
  return boundary;
}

std::vector<sparse::Integer> factors_of(const IncidenceComplex& complex, std::size_t p) {
  const sparse::Integers ring;
  sparse::Matrix<sparse::Integers> matrix(ring, complex.cells[p - 1].count(), 0);
  for (const auto& boundary : complex.boundaries[p]) {
    sparse::Terms<sparse::Integers> terms;
    for (const auto& [cell, coefficient] : boundary) {
      terms.push_back({cell, sparse::Integer{coefficient}});
    }
    matrix.append_column(terms);
  }
  return sparse::invariant_factors(matrix);
}

/// Homology Z in the degrees 0 and n, twice in degree 0 when these are one, and else none.
bool has_homology_of_sphere(const IncidenceComplex& complex) {
  const std::size_t n = complex.cells.size() - 1;
  std::size_t rank_into = 0;  // of the boundary that comes into degree p + 1
  for (std::size_t p = n + 1; p-- > 0;) {
    std::size_t rank = 0;
    if (p > 0) {
      const std::vector<sparse::Integer> factors = factors_of(complex, p);
      rank = factors.size();
      if (std::ranges::any_of(factors, [](const sparse::Integer& factor) { return factor != 1; })) {
        return false;
      }
    }
    const std::size_t betti = complex.cells[p].count() - rank - rank_into;
    const std::size_t wanted = (p == 0 ? 1U : 0U) + (p == n ? 1U : 0U);
    if (betti != wanted) {
      return false;
    }
    rank_into = rank;
  }
  return true;
}

}  // namespace

DartSigns dart_signs(const GMap& connected) {
  DartSigns signs;
  if (connected.size() == 0) {
    return signs;
  }
  std::vector<std::int8_t> of(connected.size(), 0);
  of[0] = 1;
  for (const Dart d : darts_from(connected, 0)) {
    for (int i = 0; i <= connected.dimension(); ++i) {
      const Dart next = connected.alpha(i, d);
      if (next == d || of[next] == of[d]) {
        signs.fault = next == d ? DartSigns::Fault::fold : DartSigns::Fault::one_sided;
        signs.where = d;
        return signs;
      }
      of[next] = static_cast<std::int8_t>(-of[d]);
    }
  }
  signs.of = std::move(of);
  return signs;
}

Result<IncidenceComplex> incidence_complex(const GMap& map) {
  IncidenceComplex complex;
  OrientedCells below;
  for (int i = 0; i <= map.dimension(); ++i) {
    complex.cells.push_back(cells(map, i));
    complex.boundaries.emplace_back();
    Result<OrientedCells> oriented = orient(map, i, complex.cells.back());
    if (!oriented) {
      return oriented.error();
    }
    for (const CellBoundary& cell : oriented->boundaries) {
      complex.boundaries.back().push_back(
          i == 0 ? std::vector<std::pair<std::uint32_t, int>>{}
                 : boundary_of(i, cell, oriented->sign, below.sign, complex.cells[static_cast<std::size_t>(i) - 1]));
    }
    below = std::move(*oriented);
  }
  return complex;
}

bool is_homology_sphere(const GMap& map) {
  const int n = map.dimension();
  if (n < 2) {
    return map.size() > 0 && dart_signs(map).fault == DartSigns::Fault::nothing;  // two points, or a circle
  }
  if (dart_signs(map).fault != DartSigns::Fault::nothing) {
    return false;
  }
  if (n == 2) {  // a closed orientable surface
    return cells(map, 0).count() + cells(map, 2).count() == cells(map, 1).count() + 2;
  }
  CellBoundaries boundaries(map);
  for (int i = 1; i <= n; ++i) {
    for (const Dart first : cells(map, i).first) {
      const CellBoundary cell = boundaries.of(i, first);
      if (!is_homology_sphere(cell.map)) {
        return false;
      }
    }
  }
  const Result<IncidenceComplex> complex = incidence_complex(map);
  return complex.has_value() && has_homology_of_sphere(*complex);
}

}  // namespace sesame::ops

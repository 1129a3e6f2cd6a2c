#include "ops/cells/cone_shape.hpp"

#include <map>
#include <utility>

#include "ops/maps/incidence_numbers.hpp"
#include "reductions/elimination.hpp"
#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

using sparse::Index;
using sparse::Integer;
using sparse::Integers;
using sparse::Matrix;

/// The chains of the cells with the augmentation, one degree up: degree 0 has one generator.
reductions::ChainComplex<Integers> augmented(const IncidenceComplex& cells) {
  const Integers ring;
  reductions::Sizes sizes{1};
  std::vector<Matrix<Integers>> boundaries{Matrix<Integers>(ring, 0, 1)};
  for (std::size_t p = 0; p < cells.cells.size(); ++p) {
    Matrix<Integers> boundary(ring, sizes.back(), 0);
    for (const auto& of_cell : cells.boundaries[p]) {
      sparse::Terms<Integers> terms;
      for (const auto& [face, coefficient] : of_cell) {
        terms.push_back({face, Integer{coefficient}});
      }
      if (p == 0) {
        terms.push_back({0, Integer{1}});
      }
      boundary.append_column(terms);
    }
    sizes.push_back(cells.cells[p].count());
    boundaries.push_back(std::move(boundary));
  }
  return {ring, std::move(sizes), std::move(boundaries)};
}

int small(const Integer& n) {
  const auto value = n.to_int64();
  sparse::expects(value && *value <= INT32_MAX && *value >= -INT32_MAX, "coefficients of small models are small");
  return static_cast<int>(*value);
}

/// A generator over the sum of all largest cells of the boundary, which are faces of the cell even if no cycle has
/// them, and a part that closes this up.
void add_cancelling_pair(const IncidenceComplex& cells, int n, ConeShape& shape) {
  const auto p = static_cast<std::size_t>(n) - 1;
  ConeShape::Generator whole{n, {}, {{static_cast<std::uint32_t>(shape.generators.size()), 1}}};
  std::map<std::uint32_t, int> boundary;
  for (std::uint32_t cell = 0; cell < cells.cells[p].count(); ++cell) {
    whole.terms.push_back({n - 1, cells.cells[p].first[cell], 1});
    for (const auto& [face, coefficient] : cells.boundaries[p][cell]) {
      boundary[face] += coefficient;
    }
  }
  ConeShape::Generator part{n - 1, {}, {}};
  for (const auto& [face, coefficient] : boundary) {
    if (coefficient != 0) {
      part.terms.push_back({n - 2, cells.cells[p - 1].first[face], -coefficient});
    }
  }
  shape.generators.push_back(std::move(part));
  shape.generators.push_back(std::move(whole));
}

}  // namespace

ConeShape cone_shape_of(const GMap& boundary) {
  const Result<IncidenceComplex> cells = incidence_complex(boundary);
  sparse::expects(cells.has_value(), "the cells of the boundary are balls");
  const auto [model, g] = reductions::small_model(augmented(*cells));
  const int n = boundary.dimension() + 1;
  ConeShape shape;
  std::uint32_t first_below = 0;
  std::uint32_t first = 0;
  for (int degree = 0; degree <= n; ++degree) {
    first_below = std::exchange(first, static_cast<std::uint32_t>(shape.generators.size()));
    for (Index s = 0; s < model.size(degree); ++s) {
      ConeShape::Generator generator{degree, {}, {}};
      if (degree > 0) {
        const auto p = static_cast<std::size_t>(degree) - 1;
        for (const auto& [cell, coefficient] : g.at(degree).column(s)) {
          generator.terms.push_back({degree - 1, cells->cells[p].first[cell], small(coefficient)});
        }
      }
      for (const auto& [below, coefficient] : model.boundary(degree).column(s)) {
        generator.of_this.emplace_back(first_below + below, -small(coefficient));
      }
      shape.generators.push_back(std::move(generator));
    }
  }
  if (model.size(n) == 0) {
    add_cancelling_pair(*cells, n, shape);
  }
  return shape;
}

}  // namespace sesame::ops

/// \file
/// Random complexes of cells that are known by their boundaries, for tests.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ops/vocabulary/operation.hpp"

namespace sesame::tests {

using TermsOfCell = std::vector<std::pair<int, std::string>>;

inline ops::ListedCell known_by_boundary(std::string id, int dimension, const TermsOfCell& boundary) {
  ops::ListedCell cell{std::move(id), {}, {}, {}, ops::ListedBoundary{dimension, {}}};
  for (const auto& [coefficient, face] : boundary) {
    cell.faces.push_back(face);
    cell.boundary->coefficients.push_back(coefficient);
  }
  return cell;
}

/// Cells of dimensions 0 to `top`, a few of each. Those of a dimension come in pairs with equal boundaries, so that
/// random sums of differences of them are cycles, along which the next ones are attached; others are spheres.
template <class Draw>
ops::MakeComplex random_boundary_complex(const std::string& name, int top, Draw& random) {
  std::vector<ops::ListedCell> cells;
  const int vertices = random.in(1, 3);
  for (int v = 0; v < vertices; ++v) {
    cells.push_back(known_by_boundary("v" + std::to_string(v), 0, {}));
  }
  std::vector<std::pair<std::string, std::string>> pairs;
  const auto add_pair = [&](int p, const TermsOfCell& boundary) {
    const std::string first = "c" + std::to_string(p) + "." + std::to_string(cells.size());
    const std::string second = first + "'";
    cells.push_back(known_by_boundary(first, p, boundary));
    cells.push_back(known_by_boundary(second, p, boundary));
    pairs.emplace_back(first, second);
  };
  for (int k = random.in(1, 2); k > 0; --k) {
    const auto any = [&] { return "v" + std::to_string(random.in(0, vertices - 1)); };
    add_pair(1, {{1, any()}, {-1, any()}});
  }
  for (int p = 2; p <= top; ++p) {
    const std::vector<std::pair<std::string, std::string>> below = std::exchange(pairs, {});
    for (int k = random.in(1, 2); k > 0; --k) {
      TermsOfCell boundary;
      for (const auto& [one, other] : below) {
        if (const int times = random.in(-2, 2); times != 0) {
          boundary.emplace_back(times, one);
          boundary.emplace_back(-times, other);
        }
      }
      add_pair(p, boundary);
    }
  }
  return {name, ops::CellList(cells)};
}

}  // namespace sesame::tests

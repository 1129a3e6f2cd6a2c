/// \file
/// What tests ask of the homology of a mesh and of its generators.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "sparse/smith.hpp"
#include "tests/support/catch.hpp"
#include "tools/mesh/mesh_homology.hpp"

namespace sesame::tools {

inline MeshHomology homology_of(const Mesh& mesh, const sparse::AnyRing& ring = sparse::Integers{}) {
  auto found = mesh_homology(mesh, {"shape.off", ring, true});
  REQUIRE(found);
  return std::move(*found);
}

inline std::vector<const MeshGenerator*> of_degree(const MeshHomology& found, int degree) {
  std::vector<const MeshGenerator*> generators;
  for (const auto& generator : found.generators) {
    if (generator.degree == degree) {
      generators.push_back(&generator);
    }
  }
  return generators;
}

inline std::set<std::pair<std::uint32_t, std::uint32_t>> sides_of(const Mesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    for (std::size_t i = 0; i < face.size(); ++i) {
      sides.insert(std::minmax(face[i], face[(i + 1) % face.size()]));
    }
  }
  for (const auto& [a, b] : mesh.lines) {
    sides.insert(std::minmax(a, b));
  }
  return sides;
}

/// Closed, simple, along edges of the file, and as long as it says.
inline void check_loop(const Mesh& mesh, const MeshGenerator& generator) {
  const auto& loop = generator.vertices;
  REQUIRE(loop.size() >= 3);
  CHECK(std::set<std::uint32_t>(loop.begin(), loop.end()).size() == loop.size());
  CHECK(generator.chain.terms.size() == loop.size());
  const auto sides = sides_of(mesh);
  double length = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto a = loop[i];
    const auto b = loop[(i + 1) % loop.size()];
    CHECK(sides.contains(std::minmax(a, b)));
    const Point& p = mesh.points[a];
    const Point& q = mesh.points[b];
    length += std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  }
  CHECK(generator.length.to_double() == Approx(length));
}

/// The engine agrees that the generators of a degree generate: their classes are a basis, with the orders that they
/// claim.
inline void check_basis(MeshHomology& found, int degree) {
  const auto generators = of_degree(found, degree);
  const auto p = static_cast<std::size_t>(degree);
  const auto& torsion = found.homology.torsion.at(p);
  REQUIRE(generators.size() == torsion.size() + static_cast<std::size_t>(found.homology.betti.at(p)));
  const auto rows = static_cast<sparse::Index>(generators.size());
  sparse::Matrix<sparse::Integers> classes{sparse::Integers{}, rows, 0};
  for (const auto* generator : generators) {
    const auto answer = found.engine->classify(generator->chain);
    REQUIRE(answer.is_cycle);
    sparse::Terms<sparse::Integers> column;
    for (sparse::Index i = 0; i < rows; ++i) {
      if (!answer.coefficients[i].is_zero()) {
        column.push_back({i, answer.coefficients[i].numerator()});
      }
    }
    classes.append_column(column);
    if (!generator->order.is_zero()) {
      REQUIRE(generator->bounding);
      auto multiple = generator->chain;
      for (auto& term : multiple.terms) {
        term.coefficient *= generator->order;
      }
      CHECK(found.engine->maps().boundary(*generator->bounding).terms == multiple.terms);
    }
  }
  // Relations of the group, then the classes: together they generate everything.
  for (sparse::Index i = 0; i < torsion.size(); ++i) {
    classes.append_column(sparse::Terms<sparse::Integers>{{i, torsion[i]}});
  }
  const auto factors = sparse::invariant_factors(classes);
  CHECK(factors.size() == rows);
  CHECK(std::all_of(factors.begin(), factors.end(), [](const sparse::Integer& factor) { return factor == 1; }));
}

inline void check_all(const Mesh& mesh, MeshHomology& found) {
  for (int degree = 0; degree < static_cast<int>(found.homology.betti.size()); ++degree) {
    check_basis(found, degree);
  }
  for (const auto* loop : of_degree(found, 1)) {
    CHECK(loop->is_short);
    check_loop(mesh, *loop);
  }
}

/// How often a loop on grid_torus(n, m) runs along and around: no engine is asked.
inline std::array<int, 2> windings(const std::vector<std::uint32_t>& loop, std::uint32_t n, std::uint32_t m) {
  const auto step = [](std::uint32_t from, std::uint32_t to, std::uint32_t size) {
    const std::uint32_t forward = (to + size - from) % size;
    return forward <= 1 ? static_cast<int>(forward) : -1;
  };
  std::array<int, 2> turns{};
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto a = loop[i];
    const auto b = loop[(i + 1) % loop.size()];
    turns[0] += step(a / m, b / m, n);
    turns[1] += step(a % m, b % m, m);
  }
  return {turns[0] / static_cast<int>(n), turns[1] / static_cast<int>(m)};
}

}  // namespace sesame::tools

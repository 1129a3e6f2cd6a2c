#include <fmt/format.h>

#include <string>
#include <utility>

#include "sparse/contract.hpp"
#include "tools/bench/constructions.hpp"
#include "tools/bench/filtrations.hpp"

namespace sesame::tools {
namespace {

using Names = std::vector<std::string>;

std::string numbered(const char* letter, std::uint32_t number) { return letter + std::to_string(number); }

/// A cone over everything and one over the cells that cover what was there before. The cells that cover it all now.
Names suspend(Operations& operations, const Names& cover, const std::string& north, const std::string& south) {
  operations.emplace_back(ops::MakeCone{north, {}, {}});
  operations.emplace_back(ops::MakeCone{south, cover, {}});
  Names cones;
  for (const std::string& apex : {north, south}) {
    for (const std::string& cell : cover) {
      cones.push_back(fmt::format("{}*{}", apex, cell));
    }
  }
  return cones;
}

ops::Operation circle(const std::string& name, std::uint32_t edges) {
  ops::MakeComplex complex{name, {}};
  for (std::uint32_t k = 0; k < edges; ++k) {
    complex.cells.push_back({numbered("v", k), {}, {}, {}});
  }
  for (std::uint32_t k = 0; k < edges; ++k) {
    complex.cells.push_back({numbered("e", k), {}, {numbered("v", (k + 1) % edges), numbered("v", k)}, {}});
  }
  return complex;
}

/// The vertex of a product of circles whose place is k in the first and 0 in the others.
std::string vertex_of_product(std::uint32_t factors, std::uint32_t k) {
  std::string name = fmt::format("c0.v{}", k);
  for (std::uint32_t factor = 1; factor < factors; ++factor) {
    name = fmt::format("p{}.({}|c{}.v0)", factor, name, factor);
  }
  return name;
}

}  // namespace

Operations random_triangles(std::uint32_t vertices, std::size_t triangles, std::uint64_t seed) {
  const Filtration filtration = random_two_complex(vertices, triangles, seed);
  Operations operations;
  for (std::size_t k = 0; k < filtration.size(); ++k) {
    Names simplex;
    for (const std::uint32_t vertex : filtration.vertices[k]) {
      simplex.push_back(std::to_string(vertex));
    }
    operations.emplace_back(ops::Insert{{std::move(simplex)}});
  }
  return operations;
}

Operations iterated_cones(std::uint32_t points, std::uint32_t cones) {
  ops::MakeComplex complex{"K", {}};
  for (std::uint32_t k = 0; k < points; ++k) {
    complex.cells.push_back({std::to_string(k), {}, {}, {}});
  }
  Operations operations{complex};
  for (std::uint32_t k = 0; k < cones; ++k) {
    operations.emplace_back(ops::MakeCone{numbered("a", k), {}, {}});
  }
  return operations;
}

Operations suspended_points(std::uint32_t dimension) {
  Operations operations{ops::MakeComplex{"K", {{"0", {}, {}, {}}, {"1", {}, {}, {}}}}};
  Names cover{"K.0", "K.1"};
  for (std::uint32_t k = 1; k <= dimension; ++k) {
    cover = suspend(operations, cover, numbered("n", k), numbered("s", k));
  }
  return operations;
}

Operations suspended_klein_bottle(std::uint32_t n, Assembly assembly) {
  Operations operations = klein_bottle(n, assembly);
  Names cover;
  for (std::uint32_t tile = 0; tile < 2 * n * n; ++tile) {
    cover.push_back(numbered("t", tile));
  }
  suspend(operations, cover, "n", "s");
  return operations;
}

Operations product_of_circles(std::uint32_t edges, std::uint32_t factors) {
  return glued_product_of_circles(edges, factors, 0);
}

Operations glued_product_of_circles(std::uint32_t edges, std::uint32_t factors, std::uint32_t gluings) {
  sparse::expects(factors >= 1 && gluings < edges, "a product has a factor at least, and vertices to glue");
  Operations operations{circle("c0", edges)};
  std::string product = "c0";
  for (std::uint32_t factor = 1; factor < factors; ++factor) {
    const std::string next = numbered("c", factor);
    operations.push_back(circle(next, edges));
    operations.emplace_back(ops::MakeProduct{numbered("p", factor), product, next, false});
    product = numbered("p", factor);
  }
  for (std::uint32_t k = 1; k <= gluings; ++k) {
    operations.emplace_back(ops::Identify{{{vertex_of_product(factors, 0), vertex_of_product(factors, k)}}});
  }
  return operations;
}

}  // namespace sesame::tools

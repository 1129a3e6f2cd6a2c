// Polygons and cubes by their darts, sewn to one another.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "sparse/contract.hpp"
#include "tools/bench/constructions.hpp"

namespace sesame::tools {
namespace {

/// The orders of three axes. A dart of a cube is a vertex, an edge there and a square at that edge: the vertex, as bits
/// by axis, and the axes of the edge, of the other edges of the square, and across it.
constexpr std::array<std::array<std::uint32_t, 3>, 6> orders_of_axes{
    {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};

ops::Dart dart_of_cube(std::uint32_t vertex, const std::array<std::uint32_t, 3>& axes) {
  const auto at = std::ranges::find(orders_of_axes, axes);
  return static_cast<ops::Dart>(vertex * orders_of_axes.size()) + static_cast<ops::Dart>(at - orders_of_axes.begin());
}

std::vector<std::vector<ops::Dart>> involutions_of_cube() {
  std::vector<std::vector<ops::Dart>> alpha(4);
  for (std::uint32_t vertex = 0; vertex < 8; ++vertex) {
    for (const auto& axes : orders_of_axes) {
      const auto [edge, other, across] = axes;
      alpha[0].push_back(dart_of_cube(vertex ^ 1U << edge, axes));
      alpha[1].push_back(dart_of_cube(vertex, {other, edge, across}));
      alpha[2].push_back(dart_of_cube(vertex, {edge, across, other}));
      alpha[3].push_back(dart_of_cube(vertex, axes));
    }
  }
  return alpha;
}

/// The dart of a square of a cube, "t3.0-1x1x0-1", at the vertex of it that is lowest, along the first axis it has.
std::string dart_of_square(std::string_view square) {
  const std::size_t dot = square.find('.');
  std::uint32_t across = 0, side = 0, axis = 0;
  for (std::size_t k = dot + 1; k < square.size(); ++axis) {
    const std::size_t end = std::min(square.find('x', k), square.size());
    if (end - k == 1) {  // one vertex of the edge along this axis, not both
      across = axis;
      side = square[k] == '1' ? 1 : 0;
    }
    k = end + 1;
  }
  const std::uint32_t first = across == 0 ? 1 : 0, second = across == 2 ? 1 : 2;
  return fmt::format("{}:{}", square.substr(0, dot), dart_of_cube(side << across, {first, second, across}));
}

}  // namespace

Operations torus_of_polygons(std::uint32_t n) {
  sparse::expects(n >= 1, "a torus has a square at least");
  const auto name = [n](std::uint32_t i, std::uint32_t j) { return fmt::format("t{}", i % n * n + j % n); };
  Operations operations;
  for (std::uint32_t k = 0; k < n * n; ++k) {
    operations.emplace_back(ops::MakePolygon{name(k / n, k % n), 4});
  }
  for (std::uint32_t i = 0; i < n; ++i) {  // the sides go round: below, on the right, above, on the left
    for (std::uint32_t j = 0; j < n; ++j) {
      operations.emplace_back(ops::Sew{2, {{name(i, j) + ":2", name(i, j + 1) + ":7"}}});
      operations.emplace_back(ops::Sew{2, {{name(i, j) + ":4", name(i + 1, j) + ":1"}}});
    }
  }
  return operations;
}

Operations menger_sponge_of_maps(int level, Assembly assembly) {
  Operations operations = menger_sponge(level, assembly);
  for (ops::Operation& operation : operations) {
    if (const auto* cube = std::get_if<ops::MakeSimploid>(&operation)) {
      operation = ops::MakeGMap{cube->name, involutions_of_cube()};
    } else {
      ops::Sew sew{3, {}};
      for (const auto& [one, other] : std::get<ops::Identify>(operation).pairs) {
        sew.pairs.emplace_back(dart_of_square(one), dart_of_square(other));
      }
      operation = std::move(sew);
    }
  }
  return operations;
}

}  // namespace sesame::tools

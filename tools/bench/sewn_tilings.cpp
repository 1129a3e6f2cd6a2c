// Polygons and cubes by their darts, sewn to one another.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "ops/maps/rooted_map.hpp"
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

/// A cube, its darts in the order in which a search from one of them finds them, as those of a standard cell are: then
/// all cubes share what is known of one.
class Cube {
 public:
  Cube() : found_(48), alpha_(4, std::vector<ops::Dart>(48)) {
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
    const std::vector<ops::Dart> order = ops::darts_from(*ops::GMap::make(alpha), 0);
    for (ops::Dart k = 0; k < order.size(); ++k) {
      found_[order[k]] = k;
    }
    for (std::size_t i = 0; i < alpha.size(); ++i) {
      for (ops::Dart d = 0; d < order.size(); ++d) {
        alpha_[i][found_[d]] = found_[alpha[i][d]];
      }
    }
  }

  [[nodiscard]] const std::vector<std::vector<ops::Dart>>& involutions() const { return alpha_; }
  [[nodiscard]] ops::Dart dart(std::uint32_t vertex, const std::array<std::uint32_t, 3>& axes) const {
    return found_[dart_of_cube(vertex, axes)];
  }

 private:
  std::vector<ops::Dart> found_;
  std::vector<std::vector<ops::Dart>> alpha_;
};

/// The dart of a square of a cube, "t3.0-1x1x0-1", at the vertex of it that is lowest, along the first axis it has.
std::string dart_of_square(const Cube& cube, std::string_view square) {
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
  return fmt::format("{}:{}", square.substr(0, dot), cube.dart(side << across, {first, second, across}));
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
  const Cube cube;
  Operations operations = menger_sponge(level, assembly);
  for (ops::Operation& operation : operations) {
    if (const auto* simploid = std::get_if<ops::MakeSimploid>(&operation)) {
      operation = ops::MakeGMap{simploid->name, cube.involutions()};
    } else {
      ops::Sew sew{3, {}};
      for (const auto& [one, other] : std::get<ops::Identify>(operation).pairs) {
        sew.pairs.emplace_back(dart_of_square(cube, one), dart_of_square(cube, other));
      }
      operation = std::move(sew);
    }
  }
  return operations;
}

}  // namespace sesame::tools

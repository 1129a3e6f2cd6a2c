#include "ops/maps/polygon_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

/// A side by its corners, the lesser one first, and the darts at these.
struct Side {
  std::array<std::uint32_t, 2> corners;
  std::array<Dart, 2> darts;
  std::size_t polygon;
};

}  // namespace

Result<GMap> map_of_polygons(std::span<const std::vector<std::uint32_t>> polygons) {
  std::vector<std::vector<Dart>> alpha(3);
  std::vector<Side> sides;
  Dart first = 0;
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    const auto size = static_cast<Dart>(polygons[p].size());
    if (size == 0) {
      return Error{Errc::bad_input, fmt::format("polygon {} has no corners: it should have one at least", p)};
    }
    for (Dart s = 0; s < size; ++s) {
      const Dart at = first + 2 * s, next = at + 1;
      alpha[0].insert(alpha[0].end(), {next, at});
      alpha[1].insert(alpha[1].end(), {first + (2 * s + 2 * size - 1) % (2 * size), first + (2 * s + 2) % (2 * size)});
      Side side{{polygons[p][s], polygons[p][(s + 1) % size]}, {at, next}, p};
      if (side.corners[0] > side.corners[1]) {
        std::swap(side.corners[0], side.corners[1]);
        std::swap(side.darts[0], side.darts[1]);
      }
      sides.push_back(side);
    }
    first += 2 * size;
  }
  for (Dart d = 0; d < first; ++d) {
    alpha[2].push_back(d);
  }
  std::ranges::stable_sort(sides, {}, &Side::corners);
  for (std::size_t k = 0; k + 1 < sides.size(); ++k) {
    const Side &one = sides[k], &other = sides[k + 1];
    if (one.corners != other.corners) {
      continue;
    }
    if (k + 2 < sides.size() && sides[k + 2].corners == one.corners) {
      return Error{
          Errc::bad_input,
          fmt::format("the polygons {}, {} and {} have the side from corner {} to {} in common: a map has at most "
                      "two there",
                      one.polygon, other.polygon, sides[k + 2].polygon, one.corners[0], one.corners[1])};
    }
    for (const std::size_t end : {0U, 1U}) {
      alpha[2][one.darts[end]] = other.darts[end];
      alpha[2][other.darts[end]] = one.darts[end];
    }
    ++k;
  }
  Result<GMap> map = GMap::make(std::move(alpha));
  sparse::expects(map.has_value(), "polygons make a map");
  return map;
}

}  // namespace sesame::ops

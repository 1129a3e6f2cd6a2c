#include "ops/maps/boundary_map.hpp"

#include <utility>

#include "ops/maps/incidence.hpp"
#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

/// The n-free dart on the other side of the (n-2)-cell of one. The walk ends: both are involutions, so it cannot come
/// back into itself, and where alpha_{n-1} fixes a dart it turns and leads back to where it began.
Dart across(const GMap& map, Dart d) {
  const int n = map.dimension();
  Dart at = map.alpha(n - 1, d);
  while (!map.is_free(n, at)) {
    at = map.alpha(n - 1, map.alpha(n, at));
  }
  return at;
}

}  // namespace

BoundaryMap boundary_of(const GMap& map) {
  const int n = map.dimension();
  sparse::expects(n >= 0, "points have no boundary");
  BoundaryMap boundary{.map = {}, .dart = free_darts(map, n)};
  if (n == 0) {
    boundary.map = GMap::points(static_cast<Dart>(boundary.dart.size()));
    return boundary;
  }
  std::vector<Dart> number(map.size(), no_dart);
  for (Dart b = 0; b < boundary.dart.size(); ++b) {
    number[boundary.dart[b]] = b;
  }
  std::vector<std::vector<Dart>> alpha(static_cast<std::size_t>(n));
  for (const Dart d : boundary.dart) {
    for (int i = 0; i < n - 1; ++i) {
      alpha[static_cast<std::size_t>(i)].push_back(number[map.alpha(i, d)]);
    }
    alpha.back().push_back(number[across(map, d)]);
  }
  boundary.map = std::move(*GMap::make(std::move(alpha)));
  return boundary;
}

}  // namespace sesame::ops

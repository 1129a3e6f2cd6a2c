#include "ops/maps/cell_boundary.hpp"

#include <algorithm>
#include <utility>

#include "sparse/contract.hpp"

namespace sesame::ops {

CellBoundary CellBoundaries::of(int i, Dart d) {
  const IndexSet above = map_.indices() & ~((IndexSet{2} << i) - 1);
  CellBoundary cell;
  cell.darts = walk_.from(d, map_.indices() & ~(IndexSet{1} << i));
  std::ranges::sort(cell.darts);
  for (const Dart dart : cell.darts) {
    if (boundary_dart_[dart] != no_dart) {
      continue;
    }
    const auto number = static_cast<Dart>(cell.representatives.size());
    cell.representatives.push_back(dart);
    for (const Dart same : walk_.from(dart, above)) {
      boundary_dart_[same] = number;
    }
  }
  for (const Dart dart : cell.darts) {
    cell.boundary_darts.push_back(boundary_dart_[dart]);
  }
  if (i == 0) {
    cell.map = GMap::points(static_cast<Dart>(cell.representatives.size()));
  } else {
    std::vector<std::vector<Dart>> alpha(static_cast<std::size_t>(i));
    for (int j = 0; j < i; ++j) {
      for (const Dart dart : cell.representatives) {
        alpha[static_cast<std::size_t>(j)].push_back(boundary_dart_[map_.alpha(j, dart)]);
      }
    }
    Result<GMap> boundary = GMap::make(std::move(alpha));
    sparse::expects(boundary.has_value(), "the canonical boundary of a cell is a map");
    cell.map = std::move(*boundary);
  }
  for (const Dart dart : cell.darts) {
    boundary_dart_[dart] = no_dart;
  }
  return cell;
}

}  // namespace sesame::ops

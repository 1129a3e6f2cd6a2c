#include "ops/maps/surface.hpp"

#include <fmt/format.h>

#include <vector>

#include "ops/maps/euler.hpp"
#include "ops/maps/orbits.hpp"
#include "ops/maps/orientation.hpp"

namespace sesame::ops {
namespace {

/// The other end of the boundary around a vertex of the simplicial analogue, the one numbered `vertex` of a triangle,
/// from the side of that triangle that is opposite to `side.index`, where the dart is free.
IndexedDart across(const GMap& map, IndexedDart side, int vertex) {
  int index = 3 - vertex - side.index;
  Dart d = side.dart;
  while (!map.is_free(index, d)) {
    d = map.alpha(index, d);
    index = 3 - vertex - index;
  }
  return {index, d};
}

/// All sides of triangles on the boundary form circles: those numbered `index` where a dart is `index`-free.
std::int64_t count_circles(const GMap& map) {
  std::vector<bool> met(std::size_t{map.size()} * 3, false);
  const auto place = [](IndexedDart side) { return std::size_t{side.dart} * 3 + static_cast<std::size_t>(side.index); };
  std::int64_t circles = 0;
  for (int i = 0; i <= 2; ++i) {
    for (const Dart d : free_darts(map, i)) {
      IndexedDart side{i, d};
      if (met[place(side)]) {
        continue;
      }
      ++circles;
      for (int vertex = (i + 1) % 3; !met[place(side)];) {
        met[place(side)] = true;
        side = across(map, side, vertex);
        vertex = 3 - vertex - side.index;
      }
    }
  }
  return circles;
}

std::string name_without_boundary(const Surface& surface) {
  if (surface.summands == 0) {
    return "a sphere";
  }
  if (surface.orientable) {
    return surface.summands == 1 ? "a torus" : fmt::format("a sum of {} tori", surface.summands);
  }
  return surface.summands == 1   ? "a projective plane"
         : surface.summands == 2 ? "a Klein bottle"
                                 : fmt::format("a sum of {} projective planes", surface.summands);
}

}  // namespace

Result<Surface> surface_of(const GMap& map) {
  if (map.dimension() != 2) {
    return Error{Errc::refused,
                 fmt::format("a map of dimension {} is no surface: only those of dimension 2 are", map.dimension())};
  }
  const Orbits parts = components(map);
  if (parts.count() != 1) {
    return Error{Errc::refused, parts.count() == 0
                                    ? std::string{"a map without darts is no surface"}
                                    : fmt::format("dart {} cannot be reached from dart 0, but a surface is connected: "
                                                  "its {} components are asked one by one",
                                                  parts.first[1], parts.count())};
  }
  Surface surface;
  surface.orientable = !signs(map, map.indices()).conflict;
  surface.boundary_circles = count_circles(map);
  surface.summands = (2 - simplicial_euler(map) - surface.boundary_circles) / (surface.orientable ? 2 : 1);
  return surface;
}

std::string describe(const Surface& surface) {
  if (surface.boundary_circles == 0) {
    return name_without_boundary(surface);
  }
  if (surface.summands == 0 && surface.boundary_circles <= 2) {
    return surface.boundary_circles == 1 ? "a disc" : "an annulus";
  }
  if (!surface.orientable && surface.summands == 1 && surface.boundary_circles == 1) {
    return "a Möbius strip";
  }
  return fmt::format("{} with {} boundary {}", name_without_boundary(surface), surface.boundary_circles,
                     surface.boundary_circles == 1 ? "circle" : "circles");
}

}  // namespace sesame::ops

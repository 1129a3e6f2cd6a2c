#include "ops/cells/cell_shape.hpp"

#include <utility>

#include "ops/maps/incidence_numbers.hpp"
#include "ops/maps/rooted_map.hpp"

namespace sesame::ops {

CellShape shape_of(GMap boundary) {
  CellShape shape;
  shape.signs = dart_signs(boundary).of;
  shape.places.assign(boundary.size(), {UINT32_MAX, no_dart});
  const IndexSet within_face = boundary.indices() >> 1U;
  for (Dart d = 0; d < boundary.size(); ++d) {
    if (shape.places[d].dart != no_dart) {
      continue;
    }
    const auto face = static_cast<std::uint32_t>(shape.face_roots.size());
    shape.face_roots.push_back(d);
    Dart place = 0;
    for (const Dart of_face : darts_from(boundary, d, within_face)) {
      shape.places[of_face] = {face, place++};
    }
  }
  shape.boundary = std::move(boundary);
  return shape;
}

}  // namespace sesame::ops

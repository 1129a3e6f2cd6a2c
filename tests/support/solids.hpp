/// \file
/// Solids and squares as maps, and the operations that make and sew them.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "ops/maps/gmap.hpp"
#include "ops/maps/polygon_map.hpp"
#include "ops/vocabulary/operation.hpp"

namespace sesame::tests {

using ops::Dart;
using ops::GMap;

using Polygons = std::vector<std::vector<std::uint32_t>>;

inline Polygons tetrahedron_faces() { return {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}; }
inline Polygons cube_faces() {
  return {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
}
/// The prism over a polygon, and the pyramid.
inline Polygons prism_faces(std::uint32_t sides) {
  Polygons faces(2);
  for (std::uint32_t k = 0; k < sides; ++k) {
    const std::uint32_t next = (k + 1) % sides;
    faces[0].insert(faces[0].begin(), k);
    faces[1].push_back(sides + k);
    faces.push_back({k, next, sides + next, sides + k});
  }
  return faces;
}
inline Polygons pyramid_faces(std::uint32_t sides) {
  Polygons faces(1);
  for (std::uint32_t k = 0; k < sides; ++k) {
    faces[0].insert(faces[0].begin(), k);
    faces.push_back({k, (k + 1) % sides, sides});
  }
  return faces;
}

inline GMap map_of_faces(const Polygons& polygons) { return *ops::map_of_polygons(polygons); }
/// The solid with these faces, as a 3-G-map.
inline GMap solid_of(const Polygons& polygons) { return map_of_faces(polygons).extended(); }

inline ops::MakeGMap make_map(const std::string& name, const GMap& map, bool as_simplices = false) {
  return {name, map.involutions(), as_simplices};
}
inline ops::Sew sew_darts(int dimension, const std::string& one, const std::string& other) {
  return {dimension, {{one, other}}};
}
inline std::string dart_name(const std::string& map, Dart d) { return map + ":" + std::to_string(d); }

/// One square with its sides sewn: "torus", "Klein bottle", "projective plane".
inline GMap square_with(std::vector<Dart> alpha_2) {
  return *GMap::make({{1, 0, 3, 2, 5, 4, 7, 6}, {7, 2, 1, 4, 3, 6, 5, 0}, std::move(alpha_2)});
}
inline GMap torus_of_a_square() { return square_with({5, 4, 7, 6, 1, 0, 3, 2}); }
inline GMap klein_bottle_of_a_square() { return square_with({4, 5, 7, 6, 0, 1, 3, 2}); }
inline GMap projective_plane_of_a_square() { return square_with({4, 5, 6, 7, 0, 1, 2, 3}); }

}  // namespace sesame::tests

/// \file
/// Maps by name, and ways to write maps down. Darts are written from 1 here, as figures have them, and 0 is nowhere.
#pragma once

#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "ops/maps/nmap_cells.hpp"
#include "tests/support/catch.hpp"

namespace sesame::tests {

using ops::Dart;
using ops::GMap;
using ops::NMap;
using ops::no_dart;

using Images = std::vector<Dart>;
using Lists = std::vector<std::vector<Dart>>;

/// The value, or a failure with what the error says.
template <class T>
T made(Result<T> result) {
  if (!result) {
    FAIL(result.error().what);
  }
  return std::move(*result);
}

/// What an error says, or nothing at all.
template <class T>
std::string refusal(const Result<T>& result) {
  return result ? std::string{} : result.error().what;
}

/// From cycles of darts; all others are fixed.
inline Images cycles(Dart count, const Lists& all) {
  Images images(count);
  std::iota(images.begin(), images.end(), 0U);
  for (const Images& cycle : all) {
    for (std::size_t at = 0; at < cycle.size(); ++at) {
      images[cycle[at] - 1] = cycle[(at + 1) % cycle.size()] - 1;
    }
  }
  return images;
}

/// The same, and all others nowhere.
inline Images partial_cycles(Dart count, const Lists& all) {
  Images images(count, no_dart);
  const Images whole = cycles(count, all);
  for (const Images& cycle : all) {
    for (const Dart d : cycle) {
      images[d - 1] = whole[d - 1];
    }
  }
  return images;
}

/// From the images of darts 1, 2, ...
inline Images images(const Images& from_one) {
  Images images;
  for (const Dart d : from_one) {
    images.push_back(d == 0 ? no_dart : d - 1);
  }
  return images;
}

/// Darts as figures have them, in increasing order, of those that a predicate chooses.
template <class Chosen>
Images darts_where(Dart count, Chosen chosen) {
  Images darts;
  for (Dart d = 0; d < count; ++d) {
    if (chosen(d)) {
      darts.push_back(d + 1);
    }
  }
  return darts;
}

/// Orbits as figures have them.
inline Lists lists(const ops::Orbits& orbits) {
  Lists lists(orbits.count());
  for (Dart d = 0; d < orbits.of.size(); ++d) {
    lists[orbits.of[d]].push_back(d + 1);
  }
  return lists;
}

/// The orbit of a dart from 1, as figures have it.
inline Images orbit_of(const ops::Orbits& orbits, Dart from_one) { return lists(orbits)[orbits.of[from_one - 1]]; }

/// An object of faces by the vertices around them; where an edge of one runs back along an edge of another, they meet.
inline NMap of_faces(const std::vector<std::vector<int>>& faces) {
  Lists beta(2);
  std::map<std::pair<int, int>, Dart> half_edges;
  for (const std::vector<int>& face : faces) {
    const Dart first = static_cast<Dart>(beta[0].size());
    const Dart sides = static_cast<Dart>(face.size());
    for (Dart side = 0; side < sides; ++side) {
      beta[0].push_back(first + (side + 1) % sides);
      half_edges[{face[side], face[(side + 1) % sides]}] = first + side;
    }
  }
  beta[1].assign(beta[0].size(), no_dart);
  for (const auto& [ends, d] : half_edges) {
    if (const auto other = half_edges.find({ends.second, ends.first}); other != half_edges.end()) {
      beta[1][d] = other->second;
    }
  }
  return made(NMap::make(std::move(beta)));
}

inline NMap cube_surface() {
  return of_faces({{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

inline NMap tetrahedron_surface() { return of_faces({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}); }

/// Squares on a torus; at least three each way.
inline NMap torus_grid(int width, int height) {
  std::vector<std::vector<int>> faces;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int right = (x + 1) % width;
      const int up = (y + 1) % height;
      faces.push_back({y * width + x, y * width + right, up * width + right, up * width + x});
    }
  }
  return of_faces(faces);
}

/// The map with one dimension more, in which it lies alone.
inline NMap raised(const NMap& map) {
  Lists beta = map.images();
  beta.emplace_back(map.size(), no_dart);
  return made(NMap::make(std::move(beta)));
}
inline GMap raised(const GMap& map) {
  Lists alpha = map.involutions();
  alpha.emplace_back(map.size());
  std::iota(alpha.back().begin(), alpha.back().end(), 0U);
  return made(GMap::make(std::move(alpha)));
}

/// A map whose darts are all free of the last beta, sewn to its mirror image all over.
inline NMap doubled(const NMap& map) {
  Lists beta = ops::disjoint_union(map, map.inverse()).images();
  for (Dart d = 0; d < 2 * map.size(); ++d) {
    beta.back()[d] = d < map.size() ? d + map.size() : d - map.size();
  }
  return made(NMap::make(std::move(beta)));
}

/// A planar graph of 9 edges with its outer face, which is drawn two ways: around the faces, and back.
inline NMap eighteen_darts() {
  return made(
      NMap::make({cycles(18, {{2, 7, 6, 4}, {1, 3, 18, 16, 14, 12, 10}, {8, 9, 11, 13}, {5, 15, 17}}),
                  cycles(18, {{1, 2}, {3, 4}, {5, 6}, {7, 8}, {9, 10}, {11, 12}, {13, 14}, {15, 16}, {17, 18}})}));
}
inline NMap eighteen_darts_back() { return eighteen_darts().inverse(); }

/// A disc of triangles, squares and what is left of some, with darts that are free in each way.
inline NMap fourteen_darts() {
  return made(NMap::make({images({4, 3, 0, 6, 0, 1, 12, 9, 10, 11, 8, 13, 14, 7}),
                          images({0, 14, 4, 3, 10, 13, 0, 0, 0, 5, 12, 11, 6, 2})}));
}

/// A small 2-G-map, and what is known of it.
struct KnownSurface {
  const char* name;
  GMap map;
  std::vector<std::uint64_t> cells;
  std::vector<std::uint64_t> simplices;
  std::int64_t simplicial_euler;
  std::int64_t cellular_euler;
  int classes;  ///< of darts under turning; 0 where that is undefined
  int circles;  ///< of the boundary
};

/// One square, its sides sewn to each other, and smaller things.
inline std::vector<KnownSurface> known_surfaces() {
  const auto square = [](const Lists& alpha_2) {
    return made(GMap::make({cycles(8, {{1, 2}, {3, 4}, {5, 6}, {7, 8}}), cycles(8, {{2, 3}, {4, 5}, {6, 7}, {8, 1}}),
                            cycles(8, alpha_2)}));
  };
  const auto digon = [](const Lists& alpha_2) {
    return made(GMap::make({cycles(4, {{1, 2}, {3, 4}}), cycles(4, {{2, 3}, {4, 1}}), cycles(4, alpha_2)}));
  };
  const Images swap = cycles(2, {{1, 2}});
  return {
      {"a torus", square({{1, 6}, {2, 5}, {3, 8}, {4, 7}}), {1, 2, 1}, {4, 12, 8}, 0, 0, 2, 0},
      {"a Klein bottle", square({{1, 5}, {2, 6}, {3, 8}, {4, 7}}), {1, 2, 1}, {4, 12, 8}, 0, 0, 1, 0},
      {"a projective plane", square({{1, 5}, {2, 6}, {3, 7}, {4, 8}}), {2, 2, 1}, {5, 12, 8}, 1, 1, 1, 0},
      {"a Möbius strip", square({{1, 5}, {2, 6}}), {2, 3, 1}, {6, 14, 8}, 0, 0, 1, 1},
      {"an annulus", square({{1, 6}, {2, 5}}), {2, 3, 1}, {6, 14, 8}, 0, 0, 2, 2},
      {"a disc", square({}), {4, 4, 1}, {9, 16, 8}, 1, 1, 2, 1},
      {"a projective plane", digon({{1, 3}, {2, 4}}), {1, 1, 1}, {3, 6, 4}, 1, 1, 1, 0},
      {"a sphere", digon({{1, 4}, {2, 3}}), {2, 1, 1}, {4, 6, 4}, 2, 2, 2, 0},
      {"a sphere", made(GMap::make({swap, swap, swap})), {1, 1, 1}, {3, 3, 2}, 2, 1, 0, 0},
      {"a sphere", digon({{1, 2}, {3, 4}}), {1, 2, 1}, {4, 6, 4}, 2, 0, 0, 0},
  };
}

}  // namespace sesame::tests

/// \file
/// Small objects of cells as G-maps, random ones, and the homology of what models stand for.
#pragma once

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "ops/maps/numbered_set.hpp"
#include "reductions/homology.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_complexes.hpp"

namespace sesame::tests {

using DartPairs = std::vector<std::pair<ops::Dart, ops::Dart>>;

/// H_0, H_1, ... over the integers, without trivial groups at the top.
inline std::vector<std::string> homology_of(const ops::NumberedSet& set) {
  std::vector<std::string> groups;
  const auto complex = ops::chain_complex(set);
  for (int p = 2; p <= complex.top(); ++p) {
    REQUIRE((complex.boundary(p - 1) * complex.boundary(p)).is_zero());
  }
  for (const auto& group : reductions::homology_groups(complex)) {
    groups.push_back(group.to_string());
  }
  while (!groups.empty() && groups.back() == "0") {
    groups.pop_back();
  }
  return groups;
}

/// An involution of some darts, which fixes all that are in no pair.
inline std::vector<ops::Dart> involution(ops::Dart darts, const DartPairs& pairs) {
  std::vector<ops::Dart> images(darts);
  std::iota(images.begin(), images.end(), ops::Dart{0});
  for (const auto& [d, e] : pairs) {
    images[d] = e;
    images[e] = d;
  }
  return images;
}

/// A square with the sides (12), (34), (56), (78), whose corners are (23), (45), (67), (81), sewn by pairs; darts are
/// counted from 1, as in tables of such maps.
inline ops::GMap sewn_square(const DartPairs& pairs) {
  DartPairs from_0;
  for (const auto& [d, e] : pairs) {
    from_0.emplace_back(d - 1, e - 1);
  }
  return std::move(*ops::GMap::make({involution(8, {{0, 1}, {2, 3}, {4, 5}, {6, 7}}),
                                     involution(8, {{1, 2}, {3, 4}, {5, 6}, {7, 0}}), involution(8, from_0)}));
}
inline const DartPairs torus_pairs{{1, 6}, {2, 5}, {3, 8}, {4, 7}};
inline const DartPairs klein_bottle_pairs{{1, 5}, {2, 6}, {3, 8}, {4, 7}};
inline const DartPairs projective_plane_pairs{{1, 5}, {2, 6}, {3, 7}, {4, 8}};
inline const DartPairs moebius_strip_pairs{{1, 5}, {2, 6}};
inline const DartPairs annulus_pairs{{1, 6}, {2, 5}};

/// The 2-G-map of faces by their corners, of which no two faces have more than one edge with the same ends in common:
/// faces are sewn along such edges.
inline ops::GMap gmap_of_faces(const std::vector<std::vector<int>>& faces) {
  DartPairs edges;
  DartPairs corners;
  DartPairs sewn;
  std::map<std::pair<int, int>, ops::Dart> waiting;  // by the vertex of a dart, and the other end of its edge
  ops::Dart next = 0;
  for (const std::vector<int>& face : faces) {
    const auto size = static_cast<ops::Dart>(face.size());
    for (ops::Dart k = 0; k < size; ++k) {
      const ops::Dart d = next + 2 * k;
      edges.emplace_back(d, d + 1);
      corners.emplace_back(d + 1, next + (2 * k + 2) % (2 * size));
      const int from = face[k];
      const int to = face[(k + 1) % size];
      for (const auto& [key, dart] : {std::pair(std::pair(from, to), d), std::pair(std::pair(to, from), d + 1)}) {
        if (const auto [place, is_new] = waiting.emplace(key, dart); !is_new) {
          sewn.emplace_back(place->second, dart);
        }
      }
    }
    next += 2 * size;
  }
  return std::move(*ops::GMap::make({involution(next, edges), involution(next, corners), involution(next, sewn)}));
}

inline ops::GMap surface_of_a_cube() {
  return gmap_of_faces({{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}});
}

/// side x side squares.
inline ops::GMap quad_torus(int side) {
  std::vector<std::vector<int>> faces;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const int i1 = (i + 1) % side;
      const int j1 = (j + 1) % side;
      faces.push_back({i * side + j, i1 * side + j, i1 * side + j1, i * side + j1});
    }
  }
  return gmap_of_faces(faces);
}

/// One dimension more, in which nothing is sewn: a cone over each component.
inline ops::GMap extended(const ops::GMap& map) {
  std::vector<std::vector<ops::Dart>> alpha = map.involutions();
  alpha.push_back(involution(map.size(), {}));
  return std::move(*ops::GMap::make(std::move(alpha)));
}

/// Two cones over each component, sewn all over: its suspension.
inline ops::GMap suspension_of(const ops::GMap& map) {
  std::vector<std::vector<ops::Dart>> alpha = ops::disjoint_union(map, map).involutions();
  DartPairs pairs;
  for (ops::Dart d = 0; d < map.size(); ++d) {
    pairs.emplace_back(d, map.size() + d);
  }
  alpha.push_back(involution(2 * map.size(), pairs));
  return std::move(*ops::GMap::make(std::move(alpha)));
}

/// The polygon as a closed map of dimension 1.
inline ops::GMap closed_polygon(ops::Dart sides) { return ops::polygon(sides).restricted(1); }

/// The component of dart 0.
inline ops::GMap component_of_first(const ops::GMap& map) {
  const ops::Orbits parts = ops::components(map);
  std::vector<ops::Dart> place(map.size(), ops::no_dart);
  ops::Dart count = 0;
  for (ops::Dart d = 0; d < map.size(); ++d) {
    if (parts.join(0, d)) {
      place[d] = count++;
    }
  }
  std::vector<std::vector<ops::Dart>> alpha(map.involutions().size());
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    for (ops::Dart d = 0; d < map.size(); ++d) {
      if (place[d] != ops::no_dart) {
        alpha[i].push_back(place[map.involutions()[i][d]]);
      }
    }
  }
  return std::move(*ops::GMap::make(std::move(alpha)));
}

/// 0, ..., count - 1 in any order.
inline std::vector<ops::Dart> shuffled_darts(Random& random, ops::Dart count) {
  std::vector<ops::Dart> order(count);
  std::iota(order.begin(), order.end(), ops::Dart{0});
  for (ops::Dart k = 1; k < count; ++k) {
    std::swap(order[k], order[static_cast<std::size_t>(random.in(0, static_cast<int>(k)))]);
  }
  return order;
}

/// A connected 2-G-map of at most `edges` edges. When it is not closed, edges may have any form: folded, with a free
/// side or a free end.
inline ops::GMap random_surface_map(Random& random, int edges, bool closed) {
  DartPairs along;
  DartPairs across;
  ops::Dart darts = 0;
  for (int e = 0; e < edges; ++e) {
    const ops::Dart d = darts;
    const auto form = closed ? 0 : random.in(0, 4);
    if (form == 0) {  // both sides
      along.insert(along.end(), {{d, d + 1}, {d + 2, d + 3}});
      across.insert(across.end(), {{d, d + 2}, {d + 1, d + 3}});
    }
    if (form == 1 || form == 2) {  // one side, and the same one folded
      along.emplace_back(d, d + 1);
    }
    if (form == 2 || form == 3) {  // folded, and both sides of one end
      across.emplace_back(d, d + 1);
    }
    darts += form == 0 ? 4 : form == 4 ? 1 : 2;
  }
  const std::vector<ops::Dart> order = shuffled_darts(random, darts);
  DartPairs around;
  for (std::size_t k = 0; k + 1 < order.size(); k += 2) {
    if (closed || !random.one_in(4)) {
      around.emplace_back(order[k], order[k + 1]);
    }
  }
  return component_of_first(
      std::move(*ops::GMap::make({involution(darts, along), involution(darts, around), involution(darts, across)})));
}

/// A connected closed 3-G-map of at most `cubes` cubes, whose faces are sewn in pairs at random.
inline ops::GMap random_cubes(Random& random, int cubes) {
  ops::GMap all = surface_of_a_cube();
  for (int k = 1; k < cubes; ++k) {
    all = ops::disjoint_union(all, surface_of_a_cube());
  }
  const ops::Dart faces = all.size() / 8;  // a face has 8 darts in a row, in the order of its boundary
  const std::vector<ops::Dart> order = shuffled_darts(random, faces);
  DartPairs sewn;
  for (std::size_t k = 0; k + 1 < order.size(); k += 2) {
    ops::Dart d = 8 * order[k];
    ops::Dart e = 8 * order[k + 1] + static_cast<ops::Dart>(random.in(0, 7));
    for (int side = 0; side < 4; ++side) {
      sewn.emplace_back(d, e);
      sewn.emplace_back(all.alpha(0, d), all.alpha(0, e));
      d = all.alpha(1, all.alpha(0, d));
      e = all.alpha(1, all.alpha(0, e));
    }
  }
  std::vector<std::vector<ops::Dart>> alpha = all.involutions();
  alpha.push_back(involution(all.size(), sewn));
  return component_of_first(std::move(*ops::GMap::make(std::move(alpha))));
}

/// The kind and the sentence of an error, or that there is none.
template <class T>
std::string refusal_of(const Result<T>& result) {
  if (result) {
    return "none";
  }
  return (result.error().code == Errc::refused ? "refused: " : "bad input: ") + result.error().what;
}

/// The vertices of all simplices of a dimension, sorted.
inline std::vector<std::vector<ops::SimplexNumber>> vertex_lists(const ops::NumberedSet& set, int p) {
  std::vector<std::vector<ops::SimplexNumber>> lists;
  for (ops::SimplexNumber s = 0; s < set.count(p); ++s) {
    lists.push_back(set.vertices(p, s));
  }
  std::sort(lists.begin(), lists.end());
  return lists;
}

using FVector = std::vector<std::uint32_t>;
using GroupNames = std::vector<std::string>;

}  // namespace sesame::tests

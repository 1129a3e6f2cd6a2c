// The classification of surfaces.
#include "ops/maps/surface.hpp"

#include <set>

#include "ops/maps/boundary_map.hpp"
#include "ops/maps/euler.hpp"
#include "ops/maps/map_conversions.hpp"
#include "ops/maps/orientation.hpp"
#include "tests/support/random_maps.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;
using Catch::Contains;

namespace {

/// Faces without an orientation, by the vertices around them; each edge is of two faces at most, and of each once.
GMap unoriented_faces(const std::vector<std::vector<int>>& faces) {
  GMap map = polygon(static_cast<Dart>(faces[0].size()));
  for (std::size_t f = 1; f < faces.size(); ++f) {
    map = disjoint_union(map, polygon(static_cast<Dart>(faces[f].size())));
  }
  Lists alpha = map.involutions();
  // Of each edge, by its ends, the dart at the first of them.
  std::map<std::pair<int, int>, Dart> met;
  Dart d = 0;
  for (const std::vector<int>& face : faces) {
    for (std::size_t side = 0; side < face.size(); ++side) {
      for (const bool begins : {true, false}) {
        const int from = face[(side + (begins ? 0 : 1)) % face.size()];
        const int to = face[(side + (begins ? 1 : 0)) % face.size()];
        if (const auto [other, is_new] = met.try_emplace({from, to}, d); !is_new) {
          alpha[2][d] = other->second;
          alpha[2][other->second] = d;
        }
        ++d;
      }
    }
  }
  return made(GMap::make(std::move(alpha)));
}

/// Half of a cube, whose opposite points are one: the three ways around four vertices.
GMap half_cube() { return unoriented_faces({{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 1, 3}}); }

/// Takes the face of dart 0 of a and that of the last dart of b away, which have equally many sides, and sews what was
/// around them. No face is sewn to itself.
GMap connected_sum(const GMap& a, const GMap& b) {
  const GMap both = disjoint_union(a, b);
  const Dart size = both.size();
  const auto step = [&](int i, Dart d) { return both.alpha(i, d); };
  const DartPairs faces = sewing(size, 0, size - 1, 2, step, step).value();
  Lists alpha = both.involutions();
  std::vector<bool> gone(size, false);
  for (const auto& [x, y] : faces) {
    const Dart left = both.alpha(2, x);
    const Dart right = both.alpha(2, y);
    alpha[2][left] = right;
    alpha[2][right] = left;
    gone[x] = true;
    gone[y] = true;
  }
  Images number(size, no_dart);
  Dart next = 0;
  for (Dart d = 0; d < size; ++d) {
    number[d] = gone[d] ? no_dart : next++;
  }
  Lists rest(3);
  for (std::size_t i = 0; i < 3; ++i) {
    for (Dart d = 0; d < size; ++d) {
      if (!gone[d]) {
        rest[i].push_back(number[alpha[i][d]]);
      }
    }
  }
  return made(GMap::make(std::move(rest)));
}

/// Components of the graph of all sides and corners of triangles that are on the boundary.
std::int64_t plain_circles(const GMap& map) {
  std::map<std::pair<int, Dart>, std::set<std::pair<int, Dart>>> neighbours;
  for (int i = 0; i <= 2; ++i) {
    for (Dart d = 0; d < map.size(); ++d) {
      if (map.is_free(i, d)) {
        const auto vertex = [&](int j) {
          const Orbits all = cells(map, j);
          return std::pair{j, all.first[all.of[d]]};
        };
        neighbours[vertex((i + 1) % 3)].insert(vertex((i + 2) % 3));
        neighbours[vertex((i + 2) % 3)].insert(vertex((i + 1) % 3));
      }
    }
  }
  std::int64_t circles = 0;
  while (!neighbours.empty()) {
    ++circles;
    std::vector<std::pair<int, Dart>> open{neighbours.begin()->first};
    while (!open.empty()) {
      const auto at = neighbours.find(open.back());
      open.pop_back();
      if (at != neighbours.end()) {
        open.insert(open.end(), at->second.begin(), at->second.end());
        neighbours.erase(at);
      }
    }
  }
  return circles;
}

std::string name_of(const GMap& map) { return describe(made(surface_of(map))); }

}  // namespace

TEST_CASE("small surfaces are called by their names", "[maps]") {
  for (const KnownSurface& known : known_surfaces()) {
    CHECK(name_of(known.map) == known.name);
    CHECK(made(surface_of(known.map)).boundary_circles == known.circles);
    CHECK(made(surface_of(known.map)).euler() == known.simplicial_euler);
  }
  CHECK(name_of(to_gmap(eighteen_darts())) == "a sphere");
  CHECK(name_of(to_gmap(fourteen_darts())) == "a disc");
  CHECK(name_of(to_gmap(cube_surface())) == "a sphere");
  CHECK(name_of(to_gmap(torus_grid(3, 3))) == "a torus");
  CHECK(name_of(to_gmap(torus_grid(4, 4))) == "a torus");
  CHECK(name_of(to_gmap(torus_grid(4, 8))) == "a torus");
  CHECK(name_of(polygon(1)) == "a disc");
  CHECK(name_of(made(GMap::make({{0}, {0}, {0}}))) == "a disc");  // one triangle of the simplicial analogue
}

TEST_CASE("a connected sum has the characteristics of both, less two", "[maps]") {
  const GMap sphere = to_gmap(cube_surface());
  const GMap torus = to_gmap(torus_grid(3, 3));
  const GMap plane = half_cube();
  CHECK(name_of(plane) == "a projective plane");
  CHECK(name_of(connected_sum(sphere, sphere)) == "a sphere");
  CHECK(name_of(connected_sum(sphere, torus)) == "a torus");
  CHECK(name_of(connected_sum(plane, sphere)) == "a projective plane");
  CHECK(name_of(connected_sum(torus, torus)) == "a sum of 2 tori");
  CHECK(name_of(connected_sum(torus, connected_sum(torus, torus))) == "a sum of 3 tori");
  CHECK(name_of(connected_sum(plane, plane)) == "a Klein bottle");
  // A torus beside one that is not orientable counts as two projective planes.
  CHECK(name_of(connected_sum(plane, torus)) == "a sum of 3 projective planes");
  CHECK(name_of(connected_sum(connected_sum(plane, plane), plane)) == "a sum of 3 projective planes");
  for (const GMap& a : {sphere, torus, plane}) {
    for (const GMap& b : {sphere, torus, plane}) {
      const GMap sum = connected_sum(a, b);
      CHECK(simplicial_euler(sum) == simplicial_euler(a) + simplicial_euler(b) - 2);
      CHECK(made(surface_of(sum)).euler() == simplicial_euler(sum));
      CHECK(cellular_euler(sum) == simplicial_euler(sum));
    }
  }
}

TEST_CASE("names of surfaces with boundary", "[maps]") {
  CHECK(describe({.orientable = true, .summands = 1, .boundary_circles = 1}) == "a torus with 1 boundary circle");
  CHECK(describe({.orientable = true, .summands = 0, .boundary_circles = 3}) == "a sphere with 3 boundary circles");
  CHECK(describe({.orientable = false, .summands = 2, .boundary_circles = 2}) ==
        "a Klein bottle with 2 boundary circles");
  CHECK(describe({.orientable = false, .summands = 1, .boundary_circles = 2}) ==
        "a projective plane with 2 boundary circles");
  // A grid on a torus without two of its squares that do not meet.
  const GMap torus = to_gmap(torus_grid(4, 4));
  Images kept;
  Images number(torus.size(), no_dart);
  for (Dart d = 0; d < torus.size(); ++d) {
    const Dart face = d % 64 / 4;
    if (face != 0 && face != 10) {
      number[d] = static_cast<Dart>(kept.size());
      kept.push_back(d);
    }
  }
  Lists rest(3);
  for (int i = 0; i <= 2; ++i) {
    for (const Dart d : kept) {
      const Dart image = number[torus.alpha(i, d)];
      rest[static_cast<std::size_t>(i)].push_back(image == no_dart ? number[d] : image);
    }
  }
  CHECK(name_of(made(GMap::make(std::move(rest)))) == "a torus with 2 boundary circles");
}

TEST_CASE("what is no connected surface is refused", "[maps]") {
  CHECK_THAT(refusal(surface_of(polygon(3).restricted(1))), Contains("dimension 1 is no surface"));
  CHECK_THAT(refusal(surface_of(to_gmap(raised(cube_surface())))), Contains("dimension 3"));
  CHECK_THAT(refusal(surface_of(polygon(3).restricted(-1))), Contains("dimension -1"));
  CHECK_THAT(refusal(surface_of(made(GMap::make(Lists(3))))), Contains("without darts"));
  CHECK_THAT(refusal(surface_of(disjoint_union(polygon(3), polygon(3)))), Contains("dart 6 cannot be reached"));
}

TEST_CASE("a surface has the characteristic and the boundary that its triangles have", "[maps]") {
  Random random{71};
  std::set<std::string> names;
  for (int round = 0; round < 300; ++round) {
    const GMap whole = random_gmap(random, {.dimension = 2, .closed = random.one_in(2), .folds = true});
    const GMap map = component_of(whole, 0);
    const Surface surface = made(surface_of(map));
    REQUIRE(surface.euler() == simplicial_euler(map));
    REQUIRE(surface.boundary_circles == plain_circles(map));
    CHECK(surface.summands >= 0);
    CHECK(surface == made(surface_of(map.dual())));
    if (is_closed(map, 0) && is_closed(map, 1)) {
      CHECK(surface.boundary_circles == components(boundary_of(map).map).count());
    }
    if (const Result<bool> orientable = is_orientable(map)) {
      CHECK(surface.orientable == *orientable);
    }
    names.insert(describe(surface));
  }
  CHECK(names.size() > 12);
}

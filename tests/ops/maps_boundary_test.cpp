// Boundaries of maps.
#include "ops/maps/boundary_map.hpp"

#include "ops/maps/euler.hpp"
#include "ops/maps/map_conversions.hpp"
#include "ops/maps/surface.hpp"
#include "tests/support/random_maps.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;

namespace {

/// A cube and its mirror image, sewn along some pairs of faces that are images of each other.
GMap two_cubes(const std::vector<Dart>& faces) {
  const NMap cube = raised(cube_surface());
  Lists beta = disjoint_union(cube, cube.inverse()).images();
  for (const Dart face : faces) {
    for (Dart d = 4 * face; d < 4 * face + 4; ++d) {
      beta[2][d] = d + 24;
      beta[2][d + 24] = d;
    }
  }
  return to_gmap(made(NMap::make(std::move(beta))));
}

std::uint32_t boundary_components(const GMap& map) { return components(boundary_of(map).map).count(); }

}  // namespace

TEST_CASE("a polygon is bounded by its sides, a cube by its surface", "[maps]") {
  for (Dart sides = 1; sides < 5; ++sides) {
    const BoundaryMap boundary = boundary_of(polygon(sides));
    CHECK(boundary.map == polygon(sides).restricted(1));
    CHECK(boundary.dart == cycles(2 * sides, {}));
  }
  CHECK(boundary_of(to_gmap(raised(cube_surface()))).map == to_gmap(cube_surface()));
  CHECK(boundary_of(to_gmap(raised(torus_grid(3, 4)))).map == to_gmap(torus_grid(3, 4)));
  CHECK(boundary_of(to_gmap(cube_surface())).map.size() == 0);
}

TEST_CASE("the boundary walks over what is sewn inside", "[maps]") {
  const GMap two = two_cubes({0});
  const BoundaryMap brick = boundary_of(two);
  CHECK(cell_counts(brick.map) == std::vector<std::uint64_t>{12, 20, 10});
  CHECK(describe(made(surface_of(brick.map))) == "a sphere");
  for (Dart b = 0; b < brick.dart.size(); ++b) {
    CHECK(two.is_free(3, brick.dart[b]));
    CHECK(brick.dart[brick.map.alpha(0, b)] == two.alpha(0, brick.dart[b]));
  }
  // Sewn along opposite faces they are a ring, along three they close it more.
  CHECK(describe(made(surface_of(boundary_of(two_cubes({0, 1})).map))) == "a torus");
  CHECK(describe(made(surface_of(boundary_of(two_cubes({0, 2})).map))) == "a sphere");
  CHECK(boundary_components(two_cubes({2, 3, 4, 5})) == 2);
  CHECK(boundary_components(two_cubes({0, 1, 2, 3, 4, 5})) == 0);
}

TEST_CASE("a strip has one boundary circle or two", "[maps]") {
  for (const KnownSurface& known : known_surfaces()) {
    CAPTURE(known.name);
    CHECK(boundary_components(known.map) == static_cast<std::uint32_t>(known.circles));
  }
}

TEST_CASE("a line is bounded by its two ends, and points by some of them", "[maps]") {
  const GMap line = made(GMap::make({cycles(6, {{1, 2}, {3, 4}, {5, 6}}), cycles(6, {{2, 3}, {4, 5}})}));
  CHECK(boundary_of(line).dart == Images{0, 5});
  CHECK(boundary_of(line).map == made(GMap::make({cycles(2, {{1, 2}})})));  // through the line they are joined
  const GMap ends = made(GMap::make({cycles(6, {{1, 2}, {3, 4}, {5, 6}}), cycles(6, {{1, 6}, {3, 4}})}));
  CHECK(boundary_of(ends).map == made(GMap::make({cycles(2, {{1, 2}})})));
  const GMap points = made(GMap::make({cycles(5, {{2, 3}})}));
  CHECK(boundary_of(points).dart == Images{0, 3, 4});
  CHECK(boundary_of(points).map == GMap::points(3));
}

TEST_CASE("a boundary is a map without boundary, and its last involution joins the ends of each walk", "[maps]") {
  Random random{81};
  std::size_t darts = 0;
  for (int round = 0; round < 200; ++round) {
    const int n = random.in(1, 4);
    const GMap map = random_gmap(random, {.dimension = n, .closed = random.one_in(5), .folds = true});
    const BoundaryMap boundary = boundary_of(map);
    REQUIRE(boundary.map.dimension() == n - 1);
    REQUIRE(boundary.dart == free_darts(map, n));
    REQUIRE(GMap::make(boundary.map.involutions()));
    const Orbits walks = orbits(map, IndexSet{3} << (n - 1));
    for (Dart b = 0; b < boundary.dart.size(); ++b) {
      const Dart d = boundary.dart[b];
      for (int i = 0; i + 1 < n; ++i) {
        CHECK(boundary.dart[boundary.map.alpha(i, b)] == map.alpha(i, d));
      }
      // An orbit of two involutions has at most two darts that the one or the other fixes.
      Dart end = d;
      for (const Dart other : boundary.dart) {
        end = other != d && walks.join(other, d) ? other : end;
      }
      REQUIRE(boundary.dart[boundary.map.alpha(n - 1, b)] == end);
    }
    darts += boundary.dart.size();
    bool inside = true;
    for (int i = 0; i < n; ++i) {
      inside = inside && is_closed(map, i);
    }
    if (inside) {
      CHECK(is_closed(boundary.map));
    }
  }
  CHECK(darts > 1000);
}

TEST_CASE("an object of odd dimension has half the characteristic of its boundary", "[maps]") {
  // Where it is a manifold: a ball, a solid torus, what lies between two spheres.
  for (const std::vector<Dart>& faces :
       std::vector<std::vector<Dart>>{{}, {0}, {0, 1}, {2, 3, 4, 5}, {0, 1, 2, 3, 4}}) {
    const GMap map = two_cubes(faces);
    CHECK(2 * simplicial_euler(map) == simplicial_euler(boundary_of(map).map));
  }
}

// Euler characteristics of maps, and when counting cells gives them.
#include "ops/maps/euler.hpp"

#include "ops/maps/map_conversions.hpp"
#include "tests/support/random_maps.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;

namespace {

using Numbers = std::vector<std::uint64_t>;

/// Alternating counts of what a closed map of dimension 2 has, by its own cells.
Numbers counts_of_closed(const NMap& map) {
  Numbers counts;
  for (int i = 0; i <= 2; ++i) {
    counts.push_back(cells(map, i).count());
  }
  return counts;
}

}  // namespace

TEST_CASE("cells and simplices of small surfaces are as counted by hand", "[maps]") {
  for (const KnownSurface& known : known_surfaces()) {
    CAPTURE(known.name);
    CHECK(cell_counts(known.map) == known.cells);
    CHECK(simplex_counts(known.map) == known.simplices);
    CHECK(simplicial_euler(known.map) == known.simplicial_euler);
    CHECK(cellular_euler(known.map) == known.cellular_euler);
    CHECK(euler_conditions(known.map).free.has_value() == (known.circles > 0));
  }
}

TEST_CASE("a planar graph with its outer face is a sphere", "[maps]") {
  const GMap map = to_gmap(eighteen_darts());
  CHECK(map.size() == 36);
  CHECK(cell_counts(map) == Numbers{7, 9, 4});
  CHECK(simplex_counts(map) == Numbers{20, 54, 36});
  CHECK(simplicial_euler(map) == 2);
  CHECK(cellular_euler(map) == 2);
  CHECK(euler_conditions(map).hold());
  // As darts of a G-map: a corner of two edges, a square, any edge, and the sides of its simplices.
  CHECK(orbit_of(cells(map, 0), 2).size() == 4);
  CHECK(orbit_of(cells(map, 2), 8).size() == 8);
  for (const Images& edge : lists(cells(map, 1))) {
    CHECK(edge.size() == 4);
  }
  for (int i = 0; i <= 2; ++i) {
    CHECK(orbits(map, IndexSet{1} << i).count() == 18);
  }
}

TEST_CASE("a disc with open faces has the characteristic of a disc, but not by its cells", "[maps]") {
  const GMap map = to_gmap(fourteen_darts());
  CHECK(map.size() == 28);
  CHECK(cell_counts(map) == Numbers{7, 9, 5});
  CHECK(simplex_counts(map) == Numbers{21, 48, 28});
  CHECK(orbits(map, 0b001).count() == 14);
  CHECK(orbits(map, 0b010).count() == 16);
  CHECK(orbits(map, 0b100).count() == 18);
  CHECK(simplicial_euler(map) == 1);
  CHECK(cellular_euler(map) == 3);
  const EulerConditions conditions = euler_conditions(map);
  CHECK(conditions.free == IndexedDart{1, 1});  // dart 2 follows nothing
  CHECK(conditions.folded == IndexedDart{1, 1});
  CHECK(conditions.hollow);
  CHECK_FALSE(conditions.hold());
}

TEST_CASE("squares on a torus", "[maps]") {
  for (const auto& [width, height] : {std::pair{3, 3}, {4, 4}, {4, 8}}) {
    const NMap map = torus_grid(width, height);
    const auto faces = static_cast<std::uint64_t>(width * height);
    CHECK(map.size() == 4 * faces);
    const GMap gmap = to_gmap(map);
    CHECK(cell_counts(gmap) == Numbers{faces, 2 * faces, faces});
    CHECK(simplex_counts(gmap) == Numbers{4 * faces, 12 * faces, 8 * faces});
    CHECK(simplicial_euler(gmap) == 0);
    CHECK(cellular_euler(gmap) == 0);
    CHECK(euler_conditions(gmap).hold());
  }
}

TEST_CASE("cubes, and what two of them bound", "[maps]") {
  const GMap surface = to_gmap(cube_surface());
  CHECK(surface.size() == 48);
  CHECK(simplex_counts(surface) == Numbers{26, 72, 48});
  CHECK(simplicial_euler(surface) == 2);
  const GMap solid = to_gmap(raised(cube_surface()));
  CHECK(cell_counts(solid) == Numbers{8, 12, 6, 1});
  CHECK(simplex_counts(solid) == Numbers{27, 98, 120, 48});
  CHECK(simplicial_euler(solid) == 1);
  CHECK(cellular_euler(solid) == 1);  // though the conditions are broken: they are not necessary
  CHECK(euler_conditions(solid).free == IndexedDart{3, 0});
  CHECK(euler_conditions(solid).folded == IndexedDart{3, 0});
  CHECK_FALSE(euler_conditions(solid).hollow);
  const GMap sphere = to_gmap(doubled(raised(cube_surface())));
  CHECK(sphere.size() == 96);
  CHECK(cell_counts(sphere) == Numbers{8, 12, 6, 2});
  CHECK(cell_counts(to_gmap(made(dual(doubled(raised(cube_surface())))))) == Numbers{2, 6, 12, 8});
  CHECK(simplex_counts(sphere) == Numbers{28, 124, 192, 96});
  CHECK(simplicial_euler(sphere) == 0);
  CHECK(cellular_euler(sphere) == 0);
  CHECK(euler_conditions(sphere).hold());
}

TEST_CASE("a cell whose boundary is a torus is no ball, and counting it is wrong", "[maps]") {
  const NMap two_volumes = doubled(raised(torus_grid(3, 3)));
  CHECK(two_volumes.size() == 72);
  const GMap map = to_gmap(two_volumes);
  CHECK(cell_counts(map) == Numbers{9, 18, 9, 2});
  CHECK(simplicial_euler(map) == 2);
  CHECK(cellular_euler(map) == -2);
  const EulerConditions conditions = euler_conditions(map);
  CHECK_FALSE(conditions.free);
  CHECK_FALSE(conditions.folded);
  CHECK(conditions.hollow == IndexedDart{2, 0});
  CHECK_FALSE(conditions.hold());
}

TEST_CASE("what is folded onto itself is told", "[maps]") {
  const Images swap = cycles(2, {{1, 2}});
  const EulerConditions conditions = euler_conditions(made(GMap::make({swap, swap, swap})));
  CHECK_FALSE(conditions.free);
  CHECK(conditions.folded == IndexedDart{0, 0});
  CHECK_FALSE(conditions.hollow);
  // alpha_1 may do what alpha_0 does, or alpha_2 does: a sphere with two loops.
  const GMap loops = to_gmap(made(NMap::make({images({1, 2}), images({2, 1})})));
  CHECK(cell_counts(loops) == Numbers{1, 1, 2});
  CHECK(simplicial_euler(loops) == 2);
  CHECK(cellular_euler(loops) == 2);
  CHECK(euler_conditions(loops).hold());
  // Beside something sound, the dart is that of the folded part.
  const GMap both = disjoint_union(to_gmap(cube_surface()), made(GMap::make({swap, swap, swap})));
  CHECK(euler_conditions(both).folded == IndexedDart{0, 48});
}

TEST_CASE("a dart that is alone has the two ends of its edge", "[maps]") {
  const GMap map = to_gmap(made(NMap::make({images({0}), images({0})})));
  CHECK(cell_counts(map) == Numbers{2, 1, 1});
  CHECK(simplex_counts(map) == Numbers{4, 5, 2});
  CHECK(simplicial_euler(map) == 1);
  CHECK(cellular_euler(map) == 2);
}

TEST_CASE("pairs of points are spheres, and so are polygons", "[maps]") {
  CHECK(simplicial_euler(made(GMap::make({cycles(2, {{1, 2}})}))) == 2);
  CHECK(simplicial_euler(made(GMap::make({cycles(1, {})}))) == 1);
  CHECK(simplicial_euler(GMap::points(3)) == 0);
  CHECK(simplex_counts(GMap::points(3)).empty());
  for (Dart sides = 1; sides < 5; ++sides) {
    CHECK(simplicial_euler(polygon(sides).restricted(1)) == 0);
    CHECK(simplicial_euler(polygon(sides)) == 1);
  }
}

TEST_CASE("the characteristic adds up over components", "[maps]") {
  Random random{51};
  for (int round = 0; round < 40; ++round) {
    const GMap map = random_gmap(random, {.dimension = random.in(0, 3), .closed = random.one_in(2), .folds = true});
    std::int64_t simplicial = 0;
    std::int64_t cellular = 0;
    for (const Dart d : components(map).first) {
      simplicial += simplicial_euler(component_of(map, d));
      cellular += cellular_euler(component_of(map, d));
    }
    CHECK(simplicial_euler(map) == simplicial);
    CHECK(cellular_euler(map) == cellular);
  }
}

TEST_CASE("where the conditions hold, cells have the characteristic of the object", "[maps]") {
  Random random{52};
  int holding = 0;
  int differing = 0;
  for (int round = 0; round < 300; ++round) {
    const GMap map =
        random_gmap(random, {.dimension = random.in(0, 4), .closed = !random.one_in(4), .folds = random.one_in(3)});
    const EulerConditions conditions = euler_conditions(map);
    CHECK(conditions.free.has_value() != is_closed(map));
    if (conditions.free) {
      CHECK(map.is_free(conditions.free->index, conditions.free->dart));
      CHECK(conditions.folded);
    }
    if (!conditions.folded) {
      for (Dart d = 0; d < map.size(); ++d) {
        for (int i = 2; i <= map.dimension(); ++i) {
          CHECK(map.alpha(i, d) != map.alpha(0, d));
        }
      }
    }
    if (conditions.hold()) {
      ++holding;
      REQUIRE(simplicial_euler(map) == cellular_euler(map));
    } else {
      differing += simplicial_euler(map) == cellular_euler(map) ? 0 : 1;
    }
    if (conditions.hollow) {
      const auto [i, d] = *conditions.hollow;
      CHECK(simplicial_euler(component_of(map.restricted(i), d)) != (i % 2 == 0 ? 2 : 0));
    }
  }
  CHECK(holding > 50);
  CHECK(differing > 50);
}

TEST_CASE("a closed map of dimension two has simplices by its edges", "[maps]") {
  Random random{53};
  for (int round = 0; round < 40; ++round) {
    const NMap map = random_nmap(random, {.dimension = 2, .closed = true});
    const Numbers cells = counts_of_closed(map);
    const GMap gmap = to_gmap(map);
    CHECK(cell_counts(gmap) == cells);
    CHECK(simplex_counts(gmap) == Numbers{cells[0] + cells[1] + cells[2], 6 * cells[1], 4 * cells[1]});
    CHECK(euler_conditions(gmap).hold());
    CHECK(simplicial_euler(gmap) % 2 == 0);
  }
}

TEST_CASE("an object has as many points as cells, and as many top simplices as darts", "[maps]") {
  Random random{54};
  for (int round = 0; round < 40; ++round) {
    const GMap map = random_gmap(random, {.dimension = random.in(0, 4), .closed = random.one_in(2), .folds = true});
    const Numbers counts = simplex_counts(map);
    std::uint64_t cells = 0;
    for (const std::uint64_t count : cell_counts(map)) {
      cells += count;
    }
    CHECK(counts.front() == (map.dimension() == 0 ? map.size() : cells));
    CHECK(counts.back() == map.size());
    CHECK(simplicial_euler(map) == simplicial_euler(map.dual()));
  }
}

// G-maps, their laws and their orbits.
//
// What the sources on maps tell and no test of maps asks for: points, edges and faces in space, and what is computed
// from their coordinates (objects here have no shape: a surface is told by its darts); simplicial and abstract
// complexes as sets of simplices (simplicial/ has those, and semi-simplicial sets are asked where maps become such);
// homology and its torsion (the engine's); what is only drawn in a figure, without the images of its darts; isomorphism
// of maps.
#include "ops/maps/incidence.hpp"
#include "tests/support/random_maps.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;
using Catch::Contains;

namespace {

/// Orbits by merging classes until nothing changes.
Images plain_orbits(const GMap& map, IndexSet generators) {
  Images of = cycles(map.size(), {});
  for (bool changed = true; changed;) {
    changed = false;
    for (Dart d = 0; d < map.size(); ++d) {
      for (int i = 0; i <= map.dimension(); ++i) {
        Dart& other = of[map.alpha(i, d)];
        if ((generators >> i & 1U) != 0 && of[d] < other) {
          other = of[d];
          changed = true;
        }
      }
    }
  }
  return of;
}

}  // namespace

TEST_CASE("a G-map is refused by the law that it breaks, with a dart", "[maps]") {
  CHECK_THAT(refusal(GMap::make({})), Contains("alpha_0, at least"));
  CHECK_THAT(refusal(GMap::make({{0, 1}, {0}})), Contains("alpha_1 has 1 images, but alpha_0 has 2"));
  CHECK_THAT(refusal(GMap::make({{0, 2}})), Contains("alpha_0 sends dart 1 to 2"));
  CHECK_THAT(refusal(GMap::make({{0, no_dart}})), Contains("alpha_0 sends dart 1"));
  CHECK_THAT(refusal(GMap::make({{0, 1, 2}, {1, 2, 0}})), Contains("alpha_1 is no involution: it sends dart 0 to 1"));
  CHECK_THAT(refusal(GMap::make(Lists(32, {0}))), Contains("dimension 31"));
  CHECK(GMap::make(Lists(31, {0})));
  // alpha_0 alpha_2 is of order 3; alpha_1 alpha_2 and alpha_0 alpha_1 may be.
  const Images left = cycles(6, {{1, 2}, {3, 4}, {5, 6}});
  const Images right = cycles(6, {{2, 3}, {4, 5}, {6, 1}});
  CHECK_THAT(refusal(GMap::make({left, cycles(6, {}), right})),
             Contains("alpha_0 alpha_2 is no involution: from dart 0"));
  CHECK(GMap::make({left, right, cycles(6, {})}));
  CHECK(GMap::make({cycles(6, {}), left, right}));
  CHECK_THAT(refusal(GMap::make({cycles(6, {}), left, cycles(6, {}), right})), Contains("alpha_1 alpha_3"));
  CHECK_THAT(refusal(GMap::make({left, cycles(6, {}), cycles(6, {}), right})), Contains("alpha_0 alpha_3"));
  CHECK(GMap::make({left, left, left}));  // alpha_0 alpha_2 may be the identity
}

TEST_CASE("a G-map without involutions is points", "[maps]") {
  const GMap points = GMap::points(3);
  CHECK(points.dimension() == -1);
  CHECK(points.indices() == 0);
  CHECK(components(points).count() == 3);
  CHECK(is_closed(points));
  CHECK(GMap{}.size() == 0);
  const GMap pairs = made(GMap::make({cycles(4, {{1, 2}})}));
  CHECK(pairs.dimension() == 0);
  CHECK(lists(components(pairs)) == Lists{{1, 2}, {3}, {4}});
  CHECK(cells(pairs, 0).count() == 4);
  CHECK(pairs.restricted(-1) == GMap::points(4));
}

TEST_CASE("orbits are a partition, each what its generators reach", "[maps]") {
  Random random{11};
  for (int round = 0; round < 60; ++round) {
    const GMap map = random_gmap(random, {.dimension = random.in(0, 4), .closed = random.one_in(2), .folds = true});
    const auto generators = static_cast<IndexSet>(random.in(0, (1 << (map.dimension() + 1)) - 1));
    const Orbits all = orbits(map, generators);
    const Images plain = plain_orbits(map, generators);
    OrbitWalk walk{map};
    for (Dart d = 0; d < map.size(); ++d) {
      REQUIRE(all.first[all.of[d]] == plain[d]);
      Images reached = walk.from(d, generators);
      CHECK(reached.front() == d);
      std::ranges::sort(reached);
      REQUIRE(reached == [&] {
        Images same;
        for (Dart e = 0; e < map.size(); ++e) {
          if (plain[e] == plain[d]) {
            same.push_back(e);
          }
        }
        return same;
      }());
    }
    CHECK(std::ranges::is_sorted(all.first));
    if (generators == 0) {
      CHECK(all.count() == map.size());
    }
    CHECK(orbits(map, 0).count() == map.size());
  }
}

TEST_CASE("darts that are free of an index are those that it fixes", "[maps]") {
  // A face of five and a half sides, some of it sewn: free in all three ways.
  const GMap map =
      made(GMap::make({cycles(11, {{1, 2}, {3, 4}, {5, 6}, {7, 8}, {9, 10}}),
                       cycles(11, {{2, 3}, {4, 5}, {6, 7}, {8, 9}, {10, 11}}), cycles(11, {{3, 8}, {4, 7}})}));
  CHECK(free_darts(map, 0) == Images{10});
  CHECK(free_darts(map, 1) == Images{0});
  CHECK(free_darts(map, 2) == Images{0, 1, 4, 5, 8, 9, 10});
  CHECK_FALSE(is_closed(map, 0));
  CHECK_FALSE(is_closed(map));
  const GMap lines = map.restricted(1);
  CHECK(is_closed(polygon(5), 1));
  CHECK_FALSE(is_closed(polygon(5), 2));
  CHECK_FALSE(is_closed(polygon(5)));
  CHECK(is_closed(polygon(5).restricted(1)));
  CHECK(cells(lines, 0).count() == 6);
  CHECK(cells(lines, 1).count() == 6);
}

TEST_CASE("a polygon has as many corners as sides", "[maps]") {
  for (Dart sides = 1; sides <= 6; ++sides) {
    const GMap map = polygon(sides);
    CHECK(map.size() == 2 * sides);
    CHECK(cells(map, 0).count() == sides);
    CHECK(cells(map, 1).count() == sides);
    CHECK(cells(map, 2).count() == 1);
    CHECK(is_connected(map));
    for (Dart side = 1; side < sides; ++side) {
      CHECK(map.alpha(1, 2 * side) == 2 * side - 1);
    }
  }
}

TEST_CASE("the dual of a G-map has its cells in reverse order, without a condition", "[maps]") {
  Random random{12};
  for (int round = 0; round < 60; ++round) {
    const int n = random.in(0, 4);
    const GMap map = random_gmap(random, {.dimension = n, .closed = random.one_in(2), .folds = true});
    const GMap dual = made(GMap::make(map.dual().involutions()));
    CHECK(dual.dual() == map);
    for (int i = 0; i <= n; ++i) {
      CHECK(lists(cells(map, i)) == lists(cells(dual, n - i)));
    }
  }
}

TEST_CASE("maps beside each other keep their darts apart", "[maps]") {
  const GMap both = disjoint_union(polygon(3), polygon(4));
  CHECK(both.size() == 14);
  CHECK(components(both).first == Images{0, 6});
  CHECK(component_of(both, 8).size() == 8);
  CHECK(cells(both, 1).count() == 7);
  CHECK(disjoint_union(GMap::points(2), GMap::points(3)) == GMap::points(5));
}

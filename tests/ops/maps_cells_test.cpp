// Cells of n-maps, and their duals.
#include "ops/maps/incidence.hpp"
#include "tests/support/random_maps.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;
using Catch::Contains;

namespace {

/// The dual by its formula alone, without asking whether it makes sense.
Lists dual_by_formula(const NMap& map) {
  const int n = map.dimension();
  Lists beta;
  for (int k = 1; k <= n; ++k) {
    beta.emplace_back();
    for (Dart d = 0; d < map.size(); ++d) {
      beta.back().push_back(k == n ? map.beta(n, d) : map.beta({n, n - k}, d));
    }
  }
  return beta;
}

std::vector<std::uint32_t> counts(const NMap& map) {
  std::vector<std::uint32_t> counts;
  for (int i = 0; i <= map.dimension(); ++i) {
    counts.push_back(cells(map, i).count());
  }
  return counts;
}

using OrbitCounts = std::vector<std::uint32_t>;

}  // namespace

TEST_CASE("the cells of a planar graph are its vertices, its edges and its faces with the outer one", "[maps]") {
  const NMap map = eighteen_darts_back();
  CHECK(counts(map) == OrbitCounts{7, 9, 4});
  CHECK(counts(eighteen_darts()) == OrbitCounts{7, 9, 4});
  CHECK(orbit_of(cells(map, 0), 7) == Images{5, 7, 13, 16});
  CHECK(orbit_of(cells(map, 0), 8) == Images{2, 8, 10});
  CHECK(orbit_of(cells(map, 0), 10) == Images{2, 8, 10});
  CHECK(orbit_of(cells(map, 1), 7) == Images{7, 8});
  CHECK(orbit_of(cells(map, 1), 10) == Images{9, 10});
  CHECK(orbit_of(cells(map, 2), 7) == Images{2, 4, 6, 7});
  CHECK(orbit_of(cells(map, 2), 8) == Images{8, 9, 11, 13});
  CHECK(orbit_of(cells(map, 2), 1) == Images{1, 3, 10, 12, 14, 16, 18});
  CHECK(orbit_of(cells(eighteen_darts(), 0), 6) == Images{6, 8, 14, 15});
  CHECK(eighteen_darts().beta(1, 0) == 2);
  CHECK(eighteen_darts().beta(2, 0) == 1);
  CHECK(is_connected(map));
}

TEST_CASE("cells of a map with boundary are where darts lead, and end where they lead nowhere", "[maps]") {
  const NMap map = fourteen_darts();
  CHECK(lists(cells(map, 0)) == Lists{{1, 5, 11, 13}, {2, 7}, {3, 6, 14}, {4}, {8, 12}, {9}, {10}});
  CHECK(lists(cells(map, 1)) == Lists{{1}, {2, 14}, {3, 4}, {5, 10}, {6, 13}, {7}, {8}, {9}, {11, 12}});
  CHECK(lists(cells(map, 2)) == Lists{{1, 4, 6}, {2, 3}, {5}, {7, 12, 13, 14}, {8, 9, 10, 11}});
  CHECK(is_connected(map));
}

TEST_CASE("a vertex is found across free darts", "[maps]") {
  // Darts 1 and 3 leave one vertex, but the dart between them leaves another.
  const NMap map = made(NMap::make({Images(3, no_dart), images({2, 1, 0}), images({0, 3, 2})}));
  CHECK(lists(cells(map, 0)) == Lists{{1, 3}, {2}});
  CHECK(lists(cells(map, 1)) == Lists{{1, 2, 3}});
  CHECK(lists(cells(map, 2)) == Lists{{1}, {2, 3}});
  CHECK(lists(cells(map, 3)) == Lists{{1, 2}, {3}});
}

TEST_CASE("a vertex takes its composed steps as one, never half of them", "[maps]") {
  // With the plain orbit of beta_2 and beta_3 the two ends of an edge would be one vertex.
  const NMap cubes = doubled(raised(cube_surface()));
  CHECK(counts(cubes) == OrbitCounts{8, 12, 6, 2});
  // Where beta_2 alone is left, the vertices of a square's darts are single.
  const NMap square = of_faces({{0, 1, 2, 3}});
  CHECK(counts(square) == OrbitCounts{4, 4, 1});
}

TEST_CASE("cells of small maps", "[maps]") {
  CHECK(lists(cells(NMap::points(2), 0)) == Lists{{1}, {2}});
  CHECK(components(NMap::points(2)).count() == 2);
  const NMap line = made(NMap::make({images({2, 3, 0})}));
  CHECK(lists(cells(line, 0)) == Lists{{1}, {2}, {3}});
  CHECK(lists(cells(line, 1)) == Lists{{1}, {2}, {3}});
  CHECK(is_connected(line));
  CHECK(counts(made(NMap::make({images({1, 2}), images({2, 1})}))) == OrbitCounts{1, 1, 2});  // two loops back to back
  CHECK(counts(made(NMap::make({images({0}), images({0})}))) == OrbitCounts{1, 1, 1});
  CHECK(counts(cube_surface()) == OrbitCounts{8, 12, 6});
  CHECK(counts(raised(cube_surface())) == OrbitCounts{8, 12, 6, 1});
  CHECK(counts(tetrahedron_surface()) == OrbitCounts{4, 6, 4});
  CHECK(counts(torus_grid(3, 3)) == OrbitCounts{9, 18, 9});
  CHECK(counts(doubled(raised(torus_grid(3, 3)))) == OrbitCounts{9, 18, 9, 2});
}

TEST_CASE("in a closed map of dimension two each edge has two darts", "[maps]") {
  Random random{31};
  for (int round = 0; round < 30; ++round) {
    const NMap map = random_nmap(random, {.dimension = 2, .closed = true});
    CHECK(2 * cells(map, 1).count() == map.size());
    for (const Images& edge : lists(cells(map, 1))) {
      CHECK(edge.size() == 2);
    }
  }
}

TEST_CASE("the dual of a planar graph has its faces as vertices", "[maps]") {
  const NMap map = eighteen_darts_back();
  const NMap other = made(dual(map));
  CHECK(counts(other) == OrbitCounts{4, 9, 7});
  for (int i = 0; i <= 2; ++i) {
    CHECK(lists(cells(map, i)) == lists(cells(other, 2 - i)));
  }
  CHECK(made(dual(other)) == map);
  CHECK(other.beta(1, 5) == 16);                         // from 6 to 5 and 17
  CHECK(made(dual(eighteen_darts())).beta(1, 5) == 14);  // with the other orientation to 15
  // As rotations: sigma of the dual is phi, and its phi is sigma.
  const NMap drawn = eighteen_darts();
  const NMap dual_drawn = made(dual(drawn));
  for (Dart d = 0; d < 18; ++d) {
    CHECK(dual_drawn.beta(1, d) == drawn.beta({2, 1}, d));
    CHECK(dual_drawn.beta({2, 1}, d) == drawn.beta(1, d));
  }
}

TEST_CASE("the graph of the dual has an edge for each time that two faces meet", "[maps]") {
  using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  const NMap map = eighteen_darts();
  CHECK(graph_of(map) == Edges{{0, 1}, {1, 2}, {2, 3}, {0, 3}, {0, 4}, {4, 5}, {5, 3}, {3, 6}, {6, 2}});
  // Faces by their smallest darts: 0 that of 1, 1 that of 2, 2 that of 5, 3 that of 8.
  CHECK(graph_of(made(dual(map))) == Edges{{0, 1}, {0, 1}, {2, 1}, {1, 3}, {3, 0}, {3, 0}, {3, 0}, {2, 0}, {2, 0}});
  CHECK(graph_of(made(NMap::make({images({1, 2}), images({2, 1})}))) == Edges{{0, 0}});
}

TEST_CASE("a map with free darts of its own dimension has no dual", "[maps]") {
  const NMap map = fourteen_darts();
  CHECK_THAT(refusal(dual(map)), Contains("dart 0 is 2-free"));
  // What the formula would give is a map, but not with the cells that it should have.
  const NMap wrong = made(NMap::make(dual_by_formula(map)));
  CHECK(wrong.images()[0] == images({0, 7, 6, 0, 11, 14, 0, 0, 0, 0, 13, 8, 1, 3}));
  CHECK(orbit_of(cells(wrong, 0), 8) == Images{8, 10, 11});
  CHECK(orbit_of(cells(wrong, 0), 9) == Images{9});
  CHECK(counts(wrong) == OrbitCounts{6, 9, 7});
  CHECK(lists(cells(wrong, 1)) == lists(cells(map, 1)));
  CHECK(lists(cells(wrong, 2)) == lists(cells(map, 0)));
  CHECK(dual_by_formula(wrong) != map.images());
  // In dimension three it may be none at all.
  const NMap solid = made(NMap::make({Images(3, no_dart), images({2, 1, 0}), images({3, 0, 1})}));
  CHECK_THAT(refusal(dual(solid)), Contains("dart 1 is 3-free"));
  CHECK_THAT(refusal(NMap::make(dual_by_formula(solid))), Contains("after beta_3 is no involution"));
  CHECK_THAT(refusal(dual(made(NMap::make({images({2, 0})})))), Contains("dart 1 is 1-free"));
}

TEST_CASE("a map without such darts has one, though it has boundary elsewhere", "[maps]") {
  const NMap solid = made(NMap::make({Images(4, no_dart), images({2, 1, 0, 0}), images({3, 4, 1, 2})}));
  const NMap other = made(dual(solid));
  CHECK(other.images() == Lists{images({0, 0, 2, 1}), Images(4, no_dart), images({3, 4, 1, 2})});
  for (int i = 0; i <= 3; ++i) {
    CHECK(lists(cells(solid, i)) == lists(cells(other, 3 - i)));
  }
  CHECK(made(dual(other)) == solid);
}

TEST_CASE("a map on which the last beta agrees with an earlier one has no dual", "[maps]") {
  const Images swap = images({2, 1});
  const NMap map = made(NMap::make({swap, swap, swap}));
  CHECK_THAT(refusal(dual(map)), Contains("beta_3 and beta_1 both send dart 0 to dart 1, so beta_2 of the dual"));
  CHECK_THAT(refusal(NMap::make(dual_by_formula(map))), Contains("beta_2 fixes dart 0"));
  // beta_2 and beta_1 may agree in dimension 2, and beta_3 and beta_2 in dimension 3.
  CHECK(dual(made(NMap::make({swap, swap}))));
}

TEST_CASE("the dual of a map of dimension one runs backwards", "[maps]") {
  const NMap map = made(NMap::make({images({2, 3, 1, 4})}));
  CHECK(made(dual(map)).images() == Lists{images({3, 1, 2, 4})});
  CHECK(made(dual(NMap::points(3))) == NMap::points(3));
}

TEST_CASE("cells of a map are the dual's, dart by dart, open where they were", "[maps]") {
  Random random{32};
  int refused = 0;
  int open = 0;
  for (int round = 0; round < 300; ++round) {
    const int n = random.in(1, 4);
    NMap map = random_nmap(random, {.dimension = n, .closed = random.one_in(3)});
    if (n > 1 && random.one_in(2)) {
      map = closed_by_twin(map);
    }
    const Result<NMap> other = dual(map);
    if (!other) {
      ++refused;
      continue;
    }
    REQUIRE(NMap::make(other->images()));
    CHECK(made(dual(*other)) == map);
    for (int i = 0; i <= n && n > 1; ++i) {
      CHECK(lists(cells(map, i)) == lists(cells(*other, n - i)));
      for (const Dart d : cells(map, i).first) {
        CHECK((opening(map, i, d) == no_dart) == (opening(*other, n - i, d) == no_dart));
        open += opening(map, i, d) == no_dart ? 0 : 1;
      }
    }
  }
  CHECK(refused > 20);
  CHECK(refused < 250);
  CHECK(open > 100);
}

TEST_CASE("a cell is open where a step around it leads nowhere", "[maps]") {
  const NMap map = fourteen_darts();
  CHECK(opening(map, 2, 0) == no_dart);  // the triangle of 1, 4, 6
  CHECK(opening(map, 2, 1) == 1);        // 2 follows nothing
  CHECK(opening(map, 1, 0) == 0);        // 1 is 2-free
  CHECK(opening(map, 1, 10) == no_dart);
  CHECK(opening(map, 0, 8) == 8);
  for (int i = 0; i <= 3; ++i) {
    CHECK(opening(doubled(raised(cube_surface())), i, 0) == no_dart);
    CHECK((opening(raised(cube_surface()), i, 0) == no_dart) == (i == 3));
  }
}

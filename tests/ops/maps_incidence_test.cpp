// Incidence, adjacency, free darts and paths, of maps of both kinds.
#include "ops/maps/incidence.hpp"

#include <type_traits>

#include "ops/maps/map_conversions.hpp"
#include "tests/support/random_maps.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;

namespace {

/// Calls check(map) for random maps of both kinds.
template <class Check>
void for_random_maps(unsigned seed, int rounds, Check check) {
  Random random{seed};
  for (int round = 0; round < rounds; ++round) {
    check(random_gmap(random, {.dimension = random.in(0, 3), .closed = random.one_in(2), .folds = true}));
    check(random_nmap(random, {.dimension = random.in(1, 4), .closed = random.one_in(2)}));
  }
}

bool share_a_dart(const Orbits& a, std::uint32_t cell, const Orbits& b, std::uint32_t other) {
  for (Dart d = 0; d < a.of.size(); ++d) {
    if (a.of[d] == cell && b.of[d] == other) {
      return true;
    }
  }
  return false;
}

}  // namespace

TEST_CASE("cells of different dimensions are incident where they share a dart", "[maps]") {
  const MapIncidence all{eighteen_darts_back()};
  CHECK(all.dimension() == 2);
  CHECK(all.are_incident({1, 7 - 1}, {2, 2 - 1}));
  CHECK(all.are_incident({2, 2 - 1}, {1, 8 - 1}));
  CHECK_FALSE(all.are_incident({1, 7 - 1}, {1, 8 - 1}));  // one edge
  CHECK(all.are_incident({0, 8 - 1}, {2, 7 - 1}));
  CHECK_FALSE(all.are_incident({0, 8 - 1}, {2, 5 - 1}));
  CHECK(all.darts({2, 7 - 1}) == Images{1, 3, 5, 6});
  CHECK(all.incident({2, 7 - 1}, 1) == Images{0, 2, 4, 6});  // edges by their smaller darts
  CHECK(all.incident({0, 7 - 1}, 2) == Images{0, 1, 4, 7});  // all four faces
  CHECK(all.incident({1, 1 - 1}, 2) == Images{0, 1});
  CHECK(all.incident({1, 1 - 1}, 1).empty());
}

TEST_CASE("cells of one dimension are adjacent along one of the dimension below", "[maps]") {
  const MapIncidence all{eighteen_darts_back()};
  CHECK(all.are_adjacent({2, 9 - 1}, {2, 2 - 1}));
  CHECK(all.adjacent({2, 5 - 1}) == Images{0, 1});
  CHECK_FALSE(all.are_adjacent({2, 5 - 1}, {2, 8 - 1}));  // a vertex in common, which is not enough
  CHECK_FALSE(all.are_adjacent({2, 5 - 1}, {1, 5 - 1}));
  CHECK(all.are_adjacent({1, 1 - 1}, {1, 7 - 1}));
  CHECK(all.are_adjacent({1, 1 - 1}, {1, 2 - 1}));  // itself
  CHECK_FALSE(all.are_adjacent({0, 1 - 1}, {0, 2 - 1}));
  CHECK_FALSE(all.are_adjacent({0, 1 - 1}, {0, 1 - 1}));
  CHECK(all.adjacent({0, 1 - 1}).empty());
  // A volume alone has a face on each side, and no neighbour.
  const MapIncidence cube{to_gmap(raised(cube_surface()))};
  CHECK(cube.adjacent({3, 0}).empty());
  CHECK(cube.adjacent({2, 0}).size() == 4);
  CHECK(cube.incident({3, 0}, 0).size() == 8);
  const MapIncidence cubes{doubled(raised(cube_surface()))};
  CHECK(cubes.adjacent({3, 0}) == Images{24});
}

TEST_CASE("beta_i leads across an i minus first cell, to an adjacent cell or to the same one", "[maps]") {
  for_random_maps(41, 40, [](const auto& map) {
    constexpr bool is_gmap = std::is_same_v<std::decay_t<decltype(map)>, GMap>;
    const MapIncidence all{map};
    for (Dart d = 0; d < map.size(); ++d) {
      // Of an n-map, beta_1 leads to another vertex: that one is left by the next dart.
      for (int i = is_gmap ? 1 : 2; i <= map.dimension(); ++i) {
        Dart to = no_dart;
        if constexpr (is_gmap) {
          to = map.alpha(i, d);
        } else {
          to = map.beta(i, d);
        }
        if (to != no_dart) {
          CHECK(all.are_incident({i - 1, d}, {i, to}));
          CHECK(all.are_adjacent({i, d}, {i, to}));
        }
      }
    }
  });
}

TEST_CASE("lists of cells are what asking for each of them tells", "[maps]") {
  for_random_maps(42, 25, [](const auto& map) {
    const MapIncidence all{map};
    for (int i = 0; i <= map.dimension(); ++i) {
      for (std::uint32_t cell = 0; cell < all.cells(i).count(); ++cell) {
        const MapCell c{i, all.cells(i).first[cell]};
        Images wanted_adjacent;
        for (int j = 0; j <= map.dimension(); ++j) {
          Images wanted;
          for (std::uint32_t other = 0; other < all.cells(j).count(); ++other) {
            const MapCell o{j, all.cells(j).first[other]};
            const bool incident = i != j && share_a_dart(all.cells(i), cell, all.cells(j), other);
            REQUIRE(all.are_incident(c, o) == incident);
            if (incident) {
              wanted.push_back(o.dart);
            }
            bool adjacent = false;
            for (std::uint32_t below = 0; i == j && i > 0 && below < all.cells(i - 1).count(); ++below) {
              adjacent = adjacent || (share_a_dart(all.cells(i), cell, all.cells(i - 1), below) &&
                                      share_a_dart(all.cells(i), other, all.cells(i - 1), below));
            }
            REQUIRE(all.are_adjacent(c, o) == adjacent);
            if (adjacent && other != cell) {
              wanted_adjacent.push_back(o.dart);
            }
          }
          REQUIRE(all.incident(c, j) == wanted);
        }
        REQUIRE(all.adjacent(c) == wanted_adjacent);
      }
    }
  });
}

TEST_CASE("in the dual the same cells are incident and adjacent", "[maps]") {
  Random random{43};
  for (int round = 0; round < 40; ++round) {
    const GMap map = random_gmap(random, {.dimension = 2, .closed = random.one_in(2)});
    const MapIncidence all{map};
    const MapIncidence dual{map.dual()};
    for (int i = 0; i <= 2; ++i) {
      for (const Dart d : all.cells(i).first) {
        for (int j = 0; j <= 2; ++j) {
          CHECK(all.incident({i, d}, j) == dual.incident({2 - i, d}, 2 - j));
        }
      }
    }
    // Edges that share a vertex are, in the dual, edges that share a face.
    for (const Dart d : all.cells(1).first) {
      for (const Dart vertex : all.incident({1, d}, 0)) {
        CHECK(dual.are_incident({2, vertex}, {1, d}));
      }
    }
  }
}

TEST_CASE("free darts are listed for each index", "[maps]") {
  const NMap map = fourteen_darts();
  CHECK(free_darts(map, 0) == images({2, 5}));
  CHECK(free_darts(map, 1) == images({3, 5}));
  CHECK(free_darts(map, 2) == images({1, 7, 8, 9}));
  CHECK_FALSE(is_closed(map));
  CHECK_FALSE(is_closed(map, 0));
  const NMap cube = raised(cube_surface());
  CHECK(is_closed(cube, 2));
  CHECK_FALSE(is_closed(cube, 3));
  CHECK_FALSE(is_closed(cube));
  CHECK(is_closed(doubled(cube)));
  for_random_maps(44, 40, [](const auto& each) {
    bool closed = true;
    for (int i = 0; i <= each.dimension(); ++i) {
      CHECK(is_closed(each, i) == free_darts(each, i).empty());
      closed = closed && is_closed(each, i);
    }
    CHECK(is_closed(each) == closed);
  });
}

TEST_CASE("a path is a sequence of darts with a step between each two", "[maps]") {
  const NMap map = eighteen_darts_back();
  CHECK(steps_of_path(map, images({1, 2, 4, 6, 5, 15})) == std::vector<int>{2, 1, 1, 2, 0});
  CHECK_FALSE(steps_of_path(map, images({1, 4})));
  CHECK(steps_of_path(map, {3}) == std::vector<int>{});
  CHECK(steps_of_path(map, {}) == std::vector<int>{});
  const GMap square = polygon(4);
  CHECK(steps_of_path(square, {0, 1, 2, 3}) == std::vector<int>{0, 1, 0});
  CHECK(steps_of_path(square, {0, 0}) == std::vector<int>{2});  // where it is free, and itself
  CHECK_FALSE(steps_of_path(square, {0, 2}));
  CHECK(path(square, 0, 4) == Images{0, 7, 6, 5, 4});
  CHECK_FALSE(steps_of_path(NMap::points(2), {0, 1}));
}

TEST_CASE("there is a path between two darts when one orbit has them all", "[maps]") {
  for_random_maps(45, 40, [](const auto& map) {
    const Orbits parts = components(map);
    bool reaches_all = true;
    for (Dart d = 0; d < map.size(); ++d) {
      const Images found = path(map, 0, d);
      reaches_all = reaches_all && !found.empty();
      REQUIRE(!found.empty() == parts.join(0, d));
      if (!found.empty()) {
        CHECK(found.front() == 0);
        CHECK(found.back() == d);
        REQUIRE(steps_of_path(map, found));
        Images twice = found;
        std::ranges::sort(twice);
        CHECK(std::ranges::adjacent_find(twice) == twice.end());
      }
    }
    CHECK(is_connected(map) == reaches_all);
  });
}

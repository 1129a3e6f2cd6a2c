// From n-maps to G-maps and back.
#include "ops/maps/map_conversions.hpp"

#include "ops/maps/incidence.hpp"
#include "ops/maps/orientation.hpp"
#include "tests/support/random_maps.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;
using Catch::Contains;

namespace {

NMap random_open_or_closed(Random& random) {
  return random_nmap(random, {.dimension = random.in(1, 4), .closed = random.one_in(2)});
}

/// The first `count` darts of each orbit, where there are some.
Lists trace(const Orbits& orbits, Dart count) {
  Lists traced;
  for (const Images& orbit : lists(orbits)) {
    Images kept;
    for (const Dart d : orbit) {
      if (d <= count) {
        kept.push_back(d);
      }
    }
    if (!kept.empty()) {
      traced.push_back(kept);
    }
  }
  return traced;
}

}  // namespace

TEST_CASE("a disc with free darts becomes a G-map in which the same darts are free", "[maps]") {
  const NMap map = fourteen_darts();
  const GMap gmap = to_gmap(map);
  const Dart size = 14;
  CHECK(gmap.size() == 28);
  CHECK(free_darts(gmap, 0).empty());
  CHECK(free_darts(gmap, 1) == Images{1, 4, 2 + size, 4 + size});  // 2, 5 begin nowhere; 3, 5 lead nowhere
  CHECK(free_darts(gmap, 2) == Images{0, 6, 7, 8, 0 + size, 6 + size, 7 + size, 8 + size});
  CHECK(gmap.alpha(1, 0) == 5 + size);   // 6 comes before 1
  CHECK(gmap.alpha(1, 0 + size) == 3);   // and 4 after it
  CHECK(gmap.alpha(2, 1) == 13 + size);  // 14 lies the other way
  CHECK(gmap.alpha(2, 1 + size) == 13);
  CHECK(lists(components(made(turning_map(gmap)))).size() == 2);
  for (Dart d = 0; d < size; ++d) {
    CHECK(made(to_nmap(gmap, d)).map == map);
    CHECK(made(to_nmap(gmap, d + size)).map == map.inverse());
  }
}

TEST_CASE("any n-map has a G-map, with twice its darts and its cells", "[maps]") {
  Random random{91};
  int hidden_vertices = 0;
  for (int round = 0; round < 500; ++round) {
    const NMap map = random_open_or_closed(random);
    const int n = map.dimension();
    const GMap gmap = to_gmap(map);
    REQUIRE(GMap::make(gmap.involutions()));
    REQUIRE(gmap.size() == 2 * map.size());
    REQUIRE(gmap.dimension() == n);
    CHECK(is_closed(gmap, 0));
    for (int i = 1; i <= n; ++i) {
      CHECK(is_closed(gmap, i) == is_closed(map, i));
    }
    for (int i = 0; i <= n && n > 1; ++i) {
      const Orbits of_gmap = cells(gmap, i);
      REQUIRE(trace(of_gmap, map.size()) == lists(cells(map, i)));
      if (i > 0 || is_closed(map)) {
        CHECK(of_gmap.count() == cells(map, i).count());
      } else {
        hidden_vertices += of_gmap.count() > cells(map, i).count() ? 1 : 0;
      }
    }
    CHECK(is_connected(gmap) == is_connected(map));
    for (const ComponentOrientability& each : orientability(gmap)) {
      CHECK(each.is == Orientability::orientable);
    }
  }
  CHECK(hidden_vertices > 15);  // why vertices of open maps are counted here
}

TEST_CASE("there and back from a dart is the map, from the other end of its edge the inverse", "[maps]") {
  Random random{92};
  for (int round = 0; round < 200; ++round) {
    const NMap map = component_of(random_open_or_closed(random), 0);
    const GMap gmap = to_gmap(map);
    const Dart start = static_cast<Dart>(random.in(0, static_cast<int>(map.size()) - 1));
    const HalfOfMap same = made(to_nmap(gmap, start));
    CHECK(same.map == map);
    CHECK(same.dart == cycles(map.size(), {}));
    const HalfOfMap turned = made(to_nmap(gmap, start + map.size()));
    CHECK(turned.map == map.inverse());
    CHECK(turned.dart.front() == map.size());
  }
}

TEST_CASE("a G-map is that of either half of it", "[maps]") {
  Random random{93};
  int converted = 0;
  int refused = 0;
  for (int round = 0; round < 400; ++round) {
    const GMap whole =
        random_gmap(random, {.dimension = random.in(0, 4), .closed = random.one_in(2), .folds = random.one_in(4)});
    const GMap map = component_of(whole, 0);
    const Dart start = static_cast<Dart>(random.in(0, static_cast<int>(map.size()) - 1));
    const Result<HalfOfMap> half = to_nmap(map, start);
    REQUIRE(half.has_value() == (orientability(map).at(0).is == Orientability::orientable));
    if (!half) {
      ++refused;
      continue;
    }
    ++converted;
    REQUIRE(2 * half->map.size() == map.size());
    CHECK(std::ranges::binary_search(half->dart, start));
    const GMap back = to_gmap(half->map);
    const auto dart = [&](Dart d) {
      return d < half->map.size() ? half->dart[d] : map.alpha(0, half->dart[d - half->map.size()]);
    };
    for (int i = 0; i <= map.dimension(); ++i) {
      for (Dart d = 0; d < back.size(); ++d) {
        REQUIRE(dart(back.alpha(i, d)) == map.alpha(i, dart(d)));
      }
    }
    if (map.dimension() > 0) {
      REQUIRE(NMap::make(half->map.images()));
    }
  }
  CHECK(converted > 100);
  CHECK(refused > 100);
}

TEST_CASE("both orientations of a G-map are a map", "[maps]") {
  Random random{94};
  for (int round = 0; round < 100; ++round) {
    const GMap map = random_gmap(random, {.dimension = random.in(1, 4), .closed = random.one_in(2)});
    const Result<NMap> both = turning_map(map);
    REQUIRE(both.has_value() == is_closed(map, 0));
    if (!both) {
      continue;
    }
    REQUIRE(NMap::make(both->images()));
    std::uint32_t classes = 0;
    for (const ComponentOrientability& each : orientability(map)) {
      classes += each.is == Orientability::orientable ? 2 : 1;
    }
    CHECK(components(*both).count() == classes);
    for (int i = 1; i <= map.dimension(); ++i) {
      CHECK(is_closed(map, i) == is_closed(*both, i));
    }
  }
}

TEST_CASE("what has no orientation, or not one, is refused with a dart", "[maps]") {
  const std::vector<KnownSurface> known = known_surfaces();
  CHECK(to_nmap(known[0].map, 0));
  CHECK_THAT(refusal(to_nmap(known[0].map, 8)), Contains("there is no dart 8: the map has 8"));
  CHECK_THAT(refusal(to_nmap(known[1].map, 3)), Contains("not orientable: dart 3 can be turned into dart 2"));
  CHECK_THAT(refusal(to_nmap(known[8].map, 0)), Contains("alpha_2 and alpha_0 agree on dart 0"));
  CHECK_THAT(refusal(to_nmap(disjoint_union(known[0].map, known[0].map), 9)),
             Contains("dart 0 cannot be reached from dart 9"));
  const GMap open = made(GMap::make({cycles(3, {{1, 2}}), cycles(3, {{2, 3}})}));
  CHECK_THAT(refusal(to_nmap(open, 0)), Contains("dart 2 is 0-free"));
  CHECK_THAT(refusal(turning_map(open)), Contains("dart 2 is 0-free"));
}

TEST_CASE("small maps convert", "[maps]") {
  // Points: each is a pair of darts.
  const GMap pairs = to_gmap(NMap::points(2));
  CHECK(pairs.involutions() == Lists{{2, 3, 0, 1}});
  CHECK(made(to_nmap(to_gmap(NMap::points(1)), 1)).dart == Images{1});
  CHECK(made(turning_map(pairs)) == NMap::points(4));
  // Two loops back to back: alpha_0 and alpha_1 are the same.
  const GMap loops = to_gmap(made(NMap::make({images({1, 2}), images({2, 1})})));
  CHECK(loops.involutions()[0] == loops.involutions()[1]);
  // A loop is no free dart, and the other way.
  const NMap loop = made(NMap::make({images({1})}));
  const NMap free = made(NMap::make({images({0})}));
  CHECK(to_gmap(loop).involutions()[1] == Images{1, 0});
  CHECK(to_gmap(free).involutions()[1] == Images{0, 1});
  CHECK(made(to_nmap(to_gmap(loop), 0)).map == loop);
  CHECK(made(to_nmap(to_gmap(free), 0)).map == free);
}

// Orientability of G-maps, and signs of darts.
#include "ops/maps/orientation.hpp"

#include "ops/maps/map_conversions.hpp"
#include "tests/support/random_maps.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;
using Catch::Contains;

namespace {

/// Classes of darts by merging.
class Classes {
 public:
  explicit Classes(Dart size) : of_(cycles(size, {})) {}
  void merge(Dart a, Dart b) {
    const Dart from = of_[a];
    std::ranges::replace(of_, from, of_[b]);
  }
  bool join(Dart a, Dart b) const { return of_[a] == of_[b]; }
  std::size_t count() const {
    Images all = of_;
    std::ranges::sort(all);
    return static_cast<std::size_t>(std::unique(all.begin(), all.end()) - all.begin());
  }

 private:
  Images of_;
};

/// How many classes of darts are left by alpha_0 and then another one; where that other one is free, a step is none,
/// or, as for closed maps, it is alpha_0 alone.
std::size_t classes_of_turning(const GMap& map, bool also_where_free) {
  Classes classes{map.size()};
  for (int i = 1; i <= map.dimension(); ++i) {
    for (Dart d = 0; d < map.size(); ++d) {
      const Dart opposite = map.alpha(0, d);
      if (also_where_free || !map.is_free(i, opposite)) {
        classes.merge(d, map.alpha(i, opposite));
      }
    }
  }
  return classes.count();
}

Orientability of_one(const GMap& map) { return orientability(map).at(0).is; }

}  // namespace

TEST_CASE("small surfaces are orientable, or not, or neither", "[maps]") {
  for (const KnownSurface& known : known_surfaces()) {
    CAPTURE(known.name);
    const ComponentOrientability found = orientability(known.map).at(0);
    CHECK(found.first == 0);
    if (known.classes == 0) {
      CHECK(found.is == Orientability::undefined);
      CHECK(found.obstacle == IndexedDart{2, 0});
      CHECK_THAT(refusal(is_orientable(known.map)), Contains("alpha_2 and alpha_0 agree on dart 0"));
      CHECK_FALSE(check_turning(known.map));
      CHECK_FALSE(signs(known.map, known.map.indices()).of.empty());  // which asks less
    } else {
      CHECK(found.is == (known.classes == 2 ? Orientability::orientable : Orientability::not_orientable));
      CHECK(classes_of_turning(known.map, false) == static_cast<std::size_t>(known.classes));
      CHECK(is_orientable(known.map).value() == (known.classes == 2));
      CHECK(signs(known.map, known.map.indices()).of.empty() == (known.classes == 1));
      CHECK_FALSE(found.obstacle);
    }
  }
}

TEST_CASE("a free dart does not join the two orientations", "[maps]") {
  for (const GMap& map : {polygon(4), to_gmap(fourteen_darts()), to_gmap(raised(cube_surface()))}) {
    CHECK(of_one(map) == Orientability::orientable);
    CHECK(classes_of_turning(map, false) == 2);
    CHECK(classes_of_turning(map, true) == 1);  // what the definition for closed maps would find
  }
}

TEST_CASE("without ends of edges there is no telling", "[maps]") {
  const GMap map = made(GMap::make({cycles(3, {}), cycles(3, {{2, 3}}), cycles(3, {{1, 2}})}));
  CHECK(is_connected(map));
  // Turned over where alpha_0 fixes a dart, all are one class, though the three triangles lie in the plane; not turned
  // over there, each is one for itself.
  CHECK(classes_of_turning(map, false) == 1);
  const ComponentOrientability found = orientability(map).at(0);
  CHECK(found.is == Orientability::undefined);
  CHECK(found.obstacle == IndexedDart{0, 0});
  CHECK_THAT(refusal(is_orientable(map)), Contains("dart 0 is 0-free"));
  CHECK_FALSE(signs(map, map.indices()).of.empty());
}

TEST_CASE("each component is orientable for itself", "[maps]") {
  const std::vector<KnownSurface> known = known_surfaces();
  GMap all = known[0].map;  // a torus, a Klein bottle, one that is folded, a disc
  for (const std::size_t next : {1U, 8U, 5U}) {
    all = disjoint_union(all, known[next].map);
  }
  const std::vector<ComponentOrientability> found = orientability(all);
  REQUIRE(found.size() == 4);
  CHECK(found[0].is == Orientability::orientable);
  CHECK(found[1].is == Orientability::not_orientable);
  CHECK(found[1].first == 8);
  CHECK(found[2].is == Orientability::undefined);
  CHECK(found[2].obstacle == IndexedDart{2, 16});
  CHECK(found[3].is == Orientability::orientable);
  CHECK_THAT(refusal(is_orientable(all)), Contains("dart 16"));
  CHECK_FALSE(is_orientable(disjoint_union(known[0].map, known[1].map)).value());
  CHECK_FALSE(is_orientable(disjoint_union(known[1].map, known[0].map)).value());
  CHECK(is_orientable(disjoint_union(known[0].map, known[5].map)).value());
}

TEST_CASE("points, lines and polygons are orientable", "[maps]") {
  CHECK(of_one(made(GMap::make({cycles(2, {{1, 2}})}))) == Orientability::orientable);
  CHECK(of_one(made(GMap::make({cycles(1, {})}))) == Orientability::undefined);
  for (Dart sides = 1; sides < 5; ++sides) {
    CHECK(of_one(polygon(sides).restricted(1)) == Orientability::orientable);
  }
  CHECK(orientability(polygon(3).restricted(0)).size() == 3);
}

TEST_CASE("two classes of turning are two signs, and in closed maps what the older definition counts", "[maps]") {
  Random random{61};
  int orientable = 0;
  int not_orientable = 0;
  for (int round = 0; round < 300; ++round) {
    const GMap whole = random_gmap(random, {.dimension = random.in(1, 4), .closed = random.one_in(2)});
    const GMap map = component_of(whole, 0);
    const ComponentOrientability found = orientability(map).at(0);
    CHECK(check_turning(map).has_value() == (found.is != Orientability::undefined));
    if (found.is == Orientability::undefined) {
      CHECK(found.obstacle->index == 0);  // nothing is folded here
      CHECK(map.is_free(0, found.obstacle->dart));
      continue;
    }
    const bool is = found.is == Orientability::orientable;
    (is ? orientable : not_orientable) += 1;
    REQUIRE(classes_of_turning(map, false) == (is ? 2 : 1));
    if (is_closed(map)) {
      REQUIRE(classes_of_turning(map, true) == (is ? 2 : 1));
    }
    CHECK(signs(map, map.indices()).of.empty() == !is);
  }
  CHECK(orientable > 50);
  CHECK(not_orientable > 50);
}

TEST_CASE("signs are opposite across each chosen involution, or somewhere a dart would have both", "[maps]") {
  Random random{62};
  int with = 0;
  int without = 0;
  for (int round = 0; round < 400; ++round) {
    const GMap map = random_gmap(random, {.dimension = random.in(0, 4), .closed = random.one_in(2), .folds = true});
    const auto chosen = static_cast<IndexSet>(random.in(0, (1 << (map.dimension() + 1)) - 1));
    const Signs found = signs(map, chosen);
    // Each dart with either sign, and each step to the other sign.
    Classes signed_darts{2 * map.size()};
    for (int i = 0; i <= map.dimension(); ++i) {
      for (Dart d = 0; d < map.size(); ++d) {
        if ((chosen >> i & 1U) != 0 && !map.is_free(i, d)) {
          signed_darts.merge(d, map.alpha(i, d) + map.size());
          signed_darts.merge(d + map.size(), map.alpha(i, d));
        }
      }
    }
    bool possible = true;
    for (Dart d = 0; d < map.size(); ++d) {
      possible = possible && !signed_darts.join(d, d + map.size());
    }
    REQUIRE(found.of.empty() == !possible);
    REQUIRE(found.conflict.has_value() == !possible);
    if (!possible) {
      ++without;
      CHECK((chosen >> found.conflict->index & 1U) == 1);
      CHECK_FALSE(map.is_free(found.conflict->index, found.conflict->dart));
      CHECK(signed_darts.join(found.conflict->dart, found.conflict->dart + map.size()));
      continue;
    }
    ++with;
    for (Dart d = 0; d < map.size(); ++d) {
      CHECK(found.of[d] * found.of[d] == 1);
      for (int i = 0; i <= map.dimension(); ++i) {
        if ((chosen >> i & 1U) != 0 && !map.is_free(i, d)) {
          CHECK(found.of[map.alpha(i, d)] == -found.of[d]);
        }
      }
    }
    for (const Dart first : orbits(map, chosen).first) {
      CHECK(found.of[first] == 1);
    }
  }
  CHECK(with > 50);
  CHECK(without > 15);
}

TEST_CASE("faces of a Klein bottle have signs, and the whole has none", "[maps]") {
  const GMap map = known_surfaces()[1].map;
  CHECK(signs(map, 0b011).of == std::vector<std::int8_t>{1, -1, 1, -1, 1, -1, 1, -1});
  CHECK(signs(map, 0).of == std::vector<std::int8_t>(8, 1));
  CHECK(signs(map, 0b111).of.empty());
  CHECK(signs(map, 0b111).conflict);
  CHECK(signs(map, 0b110).of.size() == 8);  // any two involutions go round by an even number of steps
  CHECK(signs(GMap::points(2), 0).of == std::vector<std::int8_t>{1, 1});
}

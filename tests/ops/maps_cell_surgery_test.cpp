// Removal, contraction, insertion and splitting of cells, on maps alone.
#include "ops/maps/cell_surgery.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "ops/maps/euler.hpp"
#include "ops/maps/incidence_numbers.hpp"
#include "ops/maps/map_conversions.hpp"
#include "ops/maps/rooted_map.hpp"
#include "tests/support/cell_models.hpp"
#include "tests/support/random_maps.hpp"
#include "tests/support/solids.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;

namespace {

std::set<Dart> cell_of(const GMap& map, int i, Dart d) {
  const std::vector<Dart> darts = OrbitWalk{map}.from(d, map.indices() & ~(IndexSet{1} << i));
  return {darts.begin(), darts.end()};
}

/// The definition, word by word: b' alpha_i becomes b' (alpha_i alpha_{i+1})^k alpha_i for the least k that leads out.
GMap removed_plainly(const GMap& map, int i, Dart d) {
  const std::set<Dart> cell = cell_of(map, i, d);
  Lists alpha = map.involutions();
  Images number(map.size(), no_dart);
  Dart kept = 0;
  for (Dart b = 0; b < map.size(); ++b) {
    number[b] = cell.contains(b) ? no_dart : kept++;
  }
  Lists result(alpha.size());
  for (int k = 0; k <= map.dimension(); ++k) {
    for (Dart b = 0; b < map.size(); ++b) {
      if (cell.contains(b)) {
        continue;
      }
      Dart image = map.alpha(k, b);
      for (int times = 1; k == i && cell.contains(image); ++times) {
        image = b;
        for (int t = 0; t < times; ++t) {
          image = map.alpha(i + 1, map.alpha(i, image));
        }
        image = map.alpha(i, image);
      }
      result[static_cast<std::size_t>(k)].push_back(number[image]);
    }
  }
  return made(GMap::make(std::move(result)));
}

std::vector<std::string> homology(const GMap& map) { return homology_of(simplicial_analogue(map)); }

/// Whether all canonical boundaries are homology spheres.
bool has_balls_only(const GMap& map) {
  for (int i = 1; i <= map.dimension(); ++i) {
    const GMap below = map.restricted(i - 1);
    for (const Dart d : cells(map, i).first) {
      std::vector<Dart> darts;
      const Orbits above = orbits(map, map.indices() & ~((IndexSet{2} << i) - 1));
      for (const Dart dart : cell_of(map, i, d)) {
        if (above.first[above.of[dart]] == dart) {
          darts.push_back(dart);
        }
      }
      Images number(map.size(), no_dart);
      for (Dart k = 0; k < darts.size(); ++k) {
        number[darts[k]] = k;
      }
      Lists alpha(static_cast<std::size_t>(i));
      for (int k = 0; k < i; ++k) {
        for (const Dart dart : darts) {
          alpha[static_cast<std::size_t>(k)].push_back(number[above.first[above.of[map.alpha(k, dart)]]]);
        }
      }
      if (!is_homology_sphere(made(GMap::make(std::move(alpha))))) {
        return false;
      }
    }
  }
  return true;
}

GMap random_of_dimension(Random& random, int lowest, int highest) {
  return random_gmap(random, {.dimension = random.in(lowest, highest), .closed = random.one_in(2), .folds = true});
}

Dart any_dart(Random& random, const GMap& map) {
  return static_cast<Dart>(random.in(0, static_cast<int>(map.size()) - 1));
}

}  // namespace

TEST_CASE("a removal is what the definition says, and contraction its dual", "[maps]") {
  Random random{71};
  int done = 0;
  for (int round = 0; round < 600; ++round) {
    const GMap map = random_of_dimension(random, 1, 4);
    const int i = random.in(0, map.dimension() - 1);
    const Dart d = any_dart(random, map);
    const Result<GMap> without = removed(map, i, d);
    const Result<GMap> shrunk = contracted(map.dual(), map.dimension() - i, d);
    REQUIRE(without.has_value() == shrunk.has_value());
    if (without) {
      REQUIRE(*without == removed_plainly(map, i, d));
      REQUIRE(shrunk->dual() == *without);
      ++done;
    } else {
      const std::set<Dart> cell = cell_of(map, i, d);
      const bool commute = i + 2 > map.dimension() || std::ranges::all_of(cell, [&](Dart b) {
                             return map.alpha(i + 1, map.alpha(i + 2, b)) == map.alpha(i + 2, map.alpha(i + 1, b));
                           });
      const bool is_all = std::ranges::all_of(cell, [&](Dart b) { return cell.contains(map.alpha(i, b)); });
      REQUIRE((!commute || is_all));
    }
  }
  CHECK(done > 200);
}

TEST_CASE("the removal of what was inserted leads back, and so does the contraction of what was split", "[maps]") {
  Random random{72};
  std::vector<int> done(5, 0);
  for (int round = 0; round < 1500; ++round) {
    const GMap map = random_of_dimension(random, 1, 4);
    const int n = map.dimension();
    const int i = random.in(0, std::min(2, n - 1));
    std::vector<Dart> darts{any_dart(random, map)};
    if (i == 1 && random.one_in(2)) {
      darts.push_back(any_dart(random, map));
    }
    while (i == 2 && darts.size() < 6 && !random.one_in(4)) {  // on around a face, or into another one
      const Dart next = map.alpha(1, map.alpha(0, darts.back()));
      darts.push_back(random.one_in(2) ? next : map.alpha(1, map.alpha(2, next)));
    }
    const Result<GMap> with = inserted(map, i, darts);
    const Result<GMap> apart = split(map.dual(), n - i, darts);
    REQUIRE(with.has_value() == apart.has_value());
    if (!with) {
      continue;
    }
    REQUIRE(apart->dual() == *with);
    REQUIRE(made(removed(*with, i, map.size())) == map);
    REQUIRE(made(contracted(*apart, n - i, map.size())) == map.dual());
    ++done[static_cast<std::size_t>(i == 1 && darts.size() == 1 ? 3 : i)];
  }
  CAPTURE(done);
  CHECK(std::ranges::min_element(done.begin(), done.begin() + 4)[0] > 20);
}

TEST_CASE("what is inserted into a map of balls makes one of balls with the same homology", "[maps]") {
  Random random{73};
  int done = 0;
  for (int round = 0; round < 400; ++round) {
    const GMap map = random_gmap(random, {.dimension = random.in(2, 3), .closed = true, .folds = false});
    if (map.size() > 100 || !has_balls_only(map)) {
      continue;
    }
    const int i = random.in(0, 1);
    std::vector<Dart> darts{any_dart(random, map)};
    if (i == 1 && random.one_in(2)) {
      darts.push_back(any_dart(random, map));
    }
    if (const Result<GMap> with = inserted(map, i, darts)) {
      REQUIRE(has_balls_only(*with));
      REQUIRE(homology(*with) == homology(map));
      ++done;
    }
  }
  CHECK(done > 60);
}

TEST_CASE("the removal of an edge between two faces keeps the surface, one with a face on both sides cuts it",
          "[maps]") {
  Random random{74};
  int between = 0, loose = 0, two_sided = 0, one_sided = 0;
  for (int round = 0; round < 500; ++round) {
    const GMap map = random_gmap(random, {.dimension = 2, .closed = true, .folds = false});
    const Dart d = any_dart(random, map);
    const Result<GMap> without = removed(map, 1, d);
    if (!without) {
      continue;
    }
    const Orbits faces = cells(map, 2);
    const std::set<Dart> edge = cell_of(map, 1, d);
    const auto change = simplicial_euler(*without) - simplicial_euler(map);
    const bool is_loose = std::ranges::any_of(edge, [&](Dart b) { return map.alpha(1, b) == map.alpha(2, b); });
    if (!faces.join(d, map.alpha(2, d)) || is_loose) {
      REQUIRE(homology(*without) == homology(map));
      ++(is_loose ? loose : between);
      continue;
    }
    // Around the face the other side of the edge is met the same way, or the other way.
    bool same_way = false;
    Dart at = d;
    do {
      same_way = same_way || at == map.alpha(2, d);
      at = map.alpha(1, map.alpha(0, at));
    } while (at != d);
    REQUIRE(change == (same_way ? 1 : 2));
    REQUIRE(homology(*without) != homology(map));
    ++(same_way ? one_sided : two_sided);
  }
  CAPTURE(between, loose, two_sided, one_sided);
  CHECK((between > 20 && loose > 5 && two_sided > 5 && one_sided > 5));
}

TEST_CASE("removals between different balls and contractions of edges that are no loops keep the homology", "[maps]") {
  Random random{75};
  int removals = 0, contractions = 0;
  for (int round = 0; round < 1500 && (removals < 40 || contractions < 40); ++round) {
    const GMap map = random_gmap(random, {.dimension = random.in(2, 3), .closed = random.one_in(2), .folds = false});
    if (map.size() > 150 || !has_balls_only(map)) {
      continue;
    }
    const int n = map.dimension();
    const Dart d = any_dart(random, map);
    if (!map.is_free(n, d) && !cells(map, n).join(d, map.alpha(n, d))) {
      if (const Result<GMap> without = removed(map, n - 1, d)) {
        REQUIRE(has_balls_only(*without));
        REQUIRE(homology(*without) == homology(map));
        ++removals;
      }
    }
    if (!cells(map, 0).join(d, map.alpha(0, d))) {
      const Result<GMap> shrunk = contracted(map, 1, d);
      std::vector<std::uint64_t> counts = cell_counts(map);
      --counts[0];
      --counts[1];
      if (shrunk && cell_counts(*shrunk) == counts && has_balls_only(*shrunk)) {  // a face of this edge alone would go
        REQUIRE(homology(*shrunk) == homology(map));
        ++contractions;
      }
    }
  }
  CHECK((removals >= 40 && contractions >= 40));
}

TEST_CASE("an edge that was removed from between two faces is inserted again", "[maps]") {
  Random random{76};
  int done = 0;
  for (int round = 0; round < 400; ++round) {
    const GMap map = random_gmap(random, {.dimension = 2, .closed = true, .folds = false});
    const Dart d = any_dart(random, map);
    const std::set<Dart> edge = cell_of(map, 1, d);
    const Dart one = map.alpha(1, d), other = map.alpha(1, map.alpha(0, d));
    if (cells(map, 2).join(d, map.alpha(2, d)) || edge.contains(one) || edge.contains(other) ||
        edge.contains(map.alpha(1, map.alpha(2, d))) || edge.contains(map.alpha(1, map.alpha(0, map.alpha(2, d))))) {
      continue;
    }
    const auto number = [&](Dart b) { return b - static_cast<Dart>(std::distance(edge.begin(), edge.lower_bound(b))); };
    const std::vector<Dart> darts{number(one), number(other)};
    const GMap again = made(inserted(made(removed(map, 1, d)), 1, darts));
    REQUIRE(cell_counts(again) == cell_counts(map));
    REQUIRE(isomorphism(component_of(again, darts[0]), component_of(map, one)).has_value());
    ++done;
  }
  CHECK(done > 50);
}

TEST_CASE("cells of a cube are removed as far as they can be", "[maps]") {
  const GMap cube = solid_of(cube_faces());
  CHECK(cell_counts(made(removed(cube, 1, 0))) == std::vector<std::uint64_t>{8, 11, 5, 1});
  CHECK(cell_counts(made(contracted(cube, 1, 0))) == std::vector<std::uint64_t>{7, 11, 6, 1});
  CHECK(refusal(removed(cube, 0, 0))
            .find("the 0-cell of dart 0 cannot be removed: at dart 0 alpha_1 and alpha_2 do "
                  "not commute, so it lies between more than two 1-cells") == 0);
  CHECK(refusal(removed(cube, 3, 0)) == "cells of the dimensions 0 to 2 can be removed, not of 3");
  CHECK(refusal(contracted(cube, 0, 0)) == "cells of the dimensions 1 to 3 can be contracted, not of 0");
  CHECK(refusal(contracted(cube, 2, 0)).find("alpha_1 and alpha_0 do not commute") != std::string::npos);
  CHECK(refusal(removed(polygon(4), 0, 0)).empty());
  CHECK(refusal(removed(polygon(1), 0, 0)).find("nothing would be left") != std::string::npos);
  // A side of the boundary: what it lay between is one face, and the other side of it is nothing.
  const GMap open = made(removed(polygon(4), 1, 0));
  CHECK(open.size() == 6);
  CHECK((open.is_free(1, 0) && open.is_free(1, 5)));
}

TEST_CASE("what cannot be inserted is refused with the dart", "[maps]") {
  const GMap cube = solid_of(cube_faces());
  const auto why = [&](int i, std::vector<Dart> darts) { return refusal(inserted(cube, i, darts)); };
  CHECK(why(3, {0}) == "cells of the dimensions 0 to 2 can be inserted, not of 3");
  CHECK(why(0, {0, 1}) == "no 0-cell can be inserted there: 2 darts are given, and it takes one");
  CHECK(why(1, {}) == "no 1-cell can be inserted there: 0 darts are given, and it takes two, or one");
  CHECK(why(1, {0, 8}) == "no 1-cell can be inserted there: alpha_0 and alpha_1 do not lead from dart 0 to dart 8");
  CHECK(why(2, {0, 4}).find(
            "alpha_1 and alpha_2 do not lead from dart 1, the image of dart 0 under alpha_0, to dart 4") !=
        std::string::npos);
  CHECK(why(2, {0, 1}) == "no 2-cell can be inserted there: dart 1 would be met twice");
  CHECK(refusal(split(cube, 0, std::vector<Dart>{0})) ==
        "cells of the dimensions 1 to 3 can be made by splitting, not of 0");
  CHECK(why(2, {0, 2, 4, 6}).empty());  // around a face, which is pushed off
  CHECK(cell_counts(made(inserted(cube, 2, std::vector<Dart>{0, 2, 4, 6}))) == std::vector<std::uint64_t>{8, 12, 7, 2});
  CHECK(cell_counts(made(inserted(cube, 1, std::vector<Dart>{0, 4}))) == std::vector<std::uint64_t>{8, 13, 7, 1});
  CHECK(cell_counts(made(inserted(cube, 1, std::vector<Dart>{0}))) == std::vector<std::uint64_t>{9, 13, 6, 1});
  CHECK(cell_counts(made(inserted(cube, 1, std::vector<Dart>{0, 0}))) == std::vector<std::uint64_t>{8, 13, 7, 1});
}

// n-maps: their laws.
#include "ops/maps/incidence.hpp"
#include "tests/support/random_maps.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;
using Catch::Contains;

namespace {

Dart at(const Images& f, Dart d) { return d == no_dart ? no_dart : f[d]; }

Images composed(const Images& after, const Images& first) {
  Images both;
  for (const Dart image : first) {
    both.push_back(at(after, image));
  }
  return both;
}

bool is_partial_permutation(const Images& f) {
  for (Dart a = 0; a < f.size(); ++a) {
    for (Dart b = 0; b < a; ++b) {
      if (f[a] == f[b] && f[a] != no_dart) {
        return false;
      }
    }
  }
  return true;
}

Images inverse_of(const Images& f) {
  Images inverse(f.size(), no_dart);
  for (Dart d = 0; d < f.size(); ++d) {
    if (f[d] != no_dart) {
      inverse[f[d]] = d;
    }
  }
  return inverse;
}

bool is_partial_involution(const Images& f) {
  for (Dart d = 0; d < f.size(); ++d) {
    if (f[d] != no_dart && at(f, f[d]) != d) {
      return false;
    }
  }
  return is_partial_permutation(f);
}

/// The definition, word by word.
bool is_map(const Lists& beta) {
  if (!is_partial_permutation(beta[0])) {
    return false;
  }
  const int n = static_cast<int>(beta.size());
  Lists all = beta;
  all.insert(all.begin(), inverse_of(beta[0]));
  for (std::size_t i = 2; i < all.size(); ++i) {
    for (Dart d = 0; d < all[i].size(); ++d) {
      if (all[i][d] == d) {
        return false;
      }
    }
    if (!is_partial_involution(all[i])) {
      return false;
    }
  }
  for (int j = 3; j <= n; ++j) {
    for (int i = 0; i + 2 <= j; ++i) {
      if (!is_partial_involution(composed(all[static_cast<std::size_t>(i)], all[static_cast<std::size_t>(j)]))) {
        return false;
      }
    }
  }
  return true;
}

/// beta_i of all darts.
Images whole(const NMap& map, int i) {
  Images images;
  for (Dart d = 0; d < map.size(); ++d) {
    images.push_back(map.beta(i, d));
  }
  return images;
}

}  // namespace

TEST_CASE("an n-map is refused by the law that it breaks, with a dart", "[maps]") {
  CHECK_THAT(refusal(NMap::make({})), Contains("beta_1, at least"));
  CHECK_THAT(refusal(NMap::make(Lists(31, Images{}))), Contains("dimension 31"));
  CHECK(NMap::make(Lists(30, Images{})));
  CHECK_THAT(refusal(NMap::make({{0, 1}, {1}})), Contains("beta_2 has 1 images, but beta_1 has 2"));
  CHECK_THAT(refusal(NMap::make({{0, 5}})), Contains("beta_1 sends dart 1 to 5"));
  CHECK_THAT(refusal(NMap::make({images({3, 0, 3})})), Contains("beta_1 sends darts 0 and 2 both to dart 2"));
  CHECK_THAT(refusal(NMap::make({images({1, 2}), images({0, 2})})), Contains("beta_2 fixes dart 1"));
  CHECK_THAT(refusal(NMap::make({images({0, 0, 0}), images({2, 3, 1})})),
             Contains("beta_2 is no involution: it sends dart 0 to dart 1, and that one to dart 2"));
  CHECK_THAT(refusal(NMap::make({images({0, 0}), images({2, 0})})),
             Contains("beta_2 is no involution: it sends dart 0 to dart 1, and that one nowhere"));
}

TEST_CASE("beta_0 is asked as well as beta_1 what it does with a third involution", "[maps]") {
  // beta_1 after beta_3 is nowhere at all; beta_0 after it leads from dart 3 to dart 2, and from there nowhere.
  CHECK_THAT(refusal(NMap::make({images({0, 1, 0}), images({0, 0, 0}), images({3, 0, 1})})),
             Contains("beta_0 after beta_3 is no involution: they send dart 2 to dart 1, and that one nowhere"));
  // The other way, beta_0 after beta_3 is nowhere.
  CHECK_THAT(refusal(NMap::make({images({2, 0, 0}), images({0, 0, 0}), images({3, 0, 1})})),
             Contains("beta_1 after beta_3 is no involution: they send dart 2 to dart 1, and that one nowhere"));
  // With two involutions there is nothing to ask: beta_0 after beta_2 may be anything.
  CHECK(NMap::make({images({0, 1, 0}), images({3, 0, 1})}));
  CHECK_THAT(
      refusal(NMap::make({images({0, 0, 0, 0}), images({3, 0, 1, 0}), images({0, 0, 0, 0}), images({2, 1, 0, 0})})),
      Contains("beta_2 after beta_4"));
}

TEST_CASE("what is a 3-map of three darts is as the definition has it, of all that could be", "[maps]") {
  // Each list of images with values 0 to 3, 3 being nowhere, for beta_1; those of involutions for the others and some
  // more.
  Lists lists_of_three;
  for (Dart code = 0; code < 64; ++code) {
    lists_of_three.push_back(images({code % 4, code / 4 % 4, code / 16}));
  }
  int maps = 0;
  for (const Images& beta_1 : lists_of_three) {
    for (const Images& beta_2 : lists_of_three) {
      for (const Images& beta_3 : lists_of_three) {
        const bool wanted = is_map({beta_1, beta_2, beta_3});
        maps += wanted ? 1 : 0;
        if (static_cast<bool>(NMap::make({beta_1, beta_2, beta_3})) != wanted) {
          CAPTURE(beta_1, beta_2, beta_3, wanted);
          FAIL("the definition says otherwise");
        }
      }
    }
  }
  CHECK(maps > 34 * 4);  // with beta_3 nowhere, all of them are
}

TEST_CASE("free is not fixed: a loop is its own next dart", "[maps]") {
  const NMap loops = made(NMap::make({images({1, 2}), images({2, 1})}));
  CHECK(loops.beta(1, 0) == 0);
  CHECK_FALSE(loops.is_free(1, 0));
  CHECK_FALSE(loops.is_free(0, 0));
  CHECK(is_closed(loops));
  const NMap alone = made(NMap::make({images({0}), images({0})}));
  CHECK(alone.is_free(0, 0));
  CHECK(alone.is_free(1, 0));
  CHECK(alone.is_free(2, 0));
  // All three the same: legal, though beta_3 after beta_1 is the identity.
  CHECK(NMap::make({images({2, 1}), images({2, 1}), images({2, 1})}));
}

TEST_CASE("maps without any beta are darts", "[maps]") {
  const NMap points = NMap::points(2);
  CHECK(points.dimension() == 0);
  CHECK(points.is_free(0, 1));
  CHECK(points.images().empty());
  CHECK(points.inverse() == points);
  CHECK(is_closed(points));
  CHECK(disjoint_union(points, points) == NMap::points(4));
  CHECK(NMap{} == NMap::points(0));
}

TEST_CASE("several betas are taken in the order in which they are written", "[maps]") {
  const NMap map = fourteen_darts();
  CHECK(map.beta({2, 1}, 1) == 6);        // from 2 to 14 and to 7
  CHECK(map.beta({1, 2}, 1) == 3);        // from 2 to 3 and to 4
  CHECK(map.beta({0, 2}, 3) == no_dart);  // from 4 to 1, where nothing is beyond
  CHECK(map.beta({2, 1, 1}, 4) == 7);     // from 5 to 10, 11 and 8
  CHECK(map.beta({}, 4) == 4);
  CHECK(map.beta(1, no_dart) == no_dart);
  for (Dart d = 0; d < map.size(); ++d) {
    if (!map.is_free(1, d)) {
      CHECK(map.beta(0, map.beta(1, d)) == d);
    }
    if (!map.is_free(0, d)) {
      CHECK(map.beta(1, map.beta(0, d)) == d);
    }
  }
}

TEST_CASE("the inverse of a map is a map, and its inverse the map", "[maps]") {
  Random random{21};
  for (int round = 0; round < 200; ++round) {
    const NMap map = random_nmap(random, {.dimension = random.in(1, 4), .closed = random.one_in(2)});
    REQUIRE(is_map(map.images()));
    const NMap inverse = map.inverse();
    CHECK(made(NMap::make(inverse.images())) == inverse);
    CHECK(inverse.inverse() == map);
    for (Dart d = 0; d < map.size(); ++d) {
      CHECK(inverse.beta(1, d) == map.beta(0, d));
      CHECK(inverse.beta(0, d) == map.beta(1, d));
    }
    CHECK(whole(map, 0) == inverse_of(whole(map, 1)));
  }
}

TEST_CASE("composed with a third involution the others commute, and turn beta_1 round", "[maps]") {
  Random random{22};
  int products = 0;
  for (int round = 0; round < 150; ++round) {
    const NMap map = random_nmap(random, {.dimension = random.in(3, 4), .closed = random.one_in(3)});
    for (int j = 3; j <= map.dimension(); ++j) {
      for (int i = 0; i + 2 <= j; ++i) {
        const int turned = i <= 1 ? 1 - i : i;
        const Images beta_i = whole(map, i);
        const Images beta_j = whole(map, j);
        CHECK(composed(beta_i, beta_j) == composed(beta_j, whole(map, turned)));
        CHECK(is_partial_involution(composed(beta_j, beta_i)));
        CHECK(inverse_of(composed(beta_i, beta_j)) == composed(inverse_of(beta_j), inverse_of(beta_i)));
        for (Dart d = 0; d < map.size(); ++d) {
          if (!map.is_free(i, d)) {
            ++products;
            CHECK(map.is_free(j, d) == map.is_free(j, map.beta(i, d)));
          }
          if (!map.is_free(j, d)) {
            CHECK(map.is_free(i, d) == map.is_free(turned, map.beta(j, d)));
          }
        }
      }
    }
  }
  CHECK(products > 1000);
}

TEST_CASE("faces are sewn as wholes, to faces of as many sides that run backwards", "[maps]") {
  const NMap triangles = of_faces({{0, 1, 2}, {3, 4, 5}});
  const auto sewn = [](const NMap& map, const Lists& pairs) {
    Lists beta = map.images();
    beta.emplace_back(partial_cycles(map.size(), pairs));
    return NMap::make(std::move(beta));
  };
  CHECK(sewn(triangles, {{1, 4}, {2, 6}, {3, 5}}));
  CHECK_THAT(refusal(sewn(triangles, {{1, 4}})), Contains("beta_0 after beta_3 is no involution"));
  CHECK_THAT(refusal(sewn(triangles, {{1, 4}, {2, 6}})), Contains("after beta_3 is no involution"));
  CHECK_THAT(refusal(sewn(triangles, {{1, 4}, {2, 5}, {3, 6}})), Contains("after beta_3 is no involution"));
  // Not so beta_2, which sews a side to a side.
  CHECK(sewn(made(NMap::make({triangles.images()[0]})), {{1, 4}}));
  const NMap two = of_faces({{0, 1, 2}, {3, 4, 5, 6}});
  CHECK_FALSE(sewn(two, {{1, 4}, {2, 7}, {3, 6}}));
  const NMap open = made(NMap::make({images({2, 3, 1, 5, 6, 0}), Images(6, no_dart)}));
  CHECK_FALSE(sewn(open, {{1, 4}, {2, 6}, {3, 5}}));
}

TEST_CASE("any permutation and any involution without fixed points are a 2-map", "[maps]") {
  Random random{23};
  for (int round = 0; round < 50; ++round) {
    const Dart size = 2 * static_cast<Dart>(random.in(1, 8));
    const NMap map =
        made(NMap::make({random_permutation(random, size, random.one_in(2)), random_involution(random, size, false)}));
    CHECK(is_map(map.images()));
  }
}

TEST_CASE("a graph on a surface is the map of its rotations", "[maps]") {
  const Images alpha = cycles(18, {{1, 2}, {3, 4}, {5, 6}, {7, 8}, {9, 10}, {11, 12}, {13, 14}, {15, 16}, {17, 18}});
  const NMap drawn = eighteen_darts();
  // sigma turns around a vertex: it is phi after alpha.
  const Images sigma = composed(whole(drawn, 1), alpha);
  CHECK(sigma[0] == 6);  // from 1 to 7
  CHECK(map_of_rotations(alpha, sigma).value() == drawn);
  const Lists vertices{{1, 7, 9}, {2, 3}, {4, 5, 18}, {6, 8, 14, 15}, {10, 11}, {12, 13}, {16, 17}};
  Lists orbits_of_sigma;
  std::vector<bool> met(18, false);
  for (Dart d = 0; d < 18; ++d) {
    Images orbit;
    for (Dart e = d; !met[e]; e = sigma[e]) {
      met[e] = true;
      orbit.push_back(e + 1);
    }
    std::ranges::sort(orbit);
    if (!orbit.empty()) {
      orbits_of_sigma.push_back(orbit);
    }
  }
  CHECK(orbits_of_sigma == vertices);
  CHECK(lists(cells(drawn, 0)) == vertices);
}

TEST_CASE("rotations that are none are refused", "[maps]") {
  CHECK_THAT(refusal(map_of_rotations({1, 0}, {0})), Contains("sigma has 1 images"));
  CHECK_THAT(refusal(map_of_rotations({1, no_dart}, {0, 1})), Contains("alpha sends half-edge 1"));
  CHECK_THAT(refusal(map_of_rotations({1, 0}, {0, 0})), Contains("half-edge 1"));
  CHECK_THAT(refusal(map_of_rotations({1, 0}, {0, no_dart})), Contains("half-edge 1"));
  CHECK_THAT(refusal(map_of_rotations({0, 1}, {1, 0})), Contains("alpha fixes half-edge 0"));
  CHECK_THAT(refusal(map_of_rotations({1, 2, 0}, {0, 1, 2})),
             Contains("alpha is no involution: it sends half-edge 0 to 1, and that one to 2"));
  CHECK(map_of_rotations({}, {}));
}

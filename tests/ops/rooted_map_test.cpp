// Connected maps as a dart sees them: isomorphism, canonical forms, and which boundaries are spheres.
#include <algorithm>
#include <numeric>
#include <vector>

#include "ops/maps/cell_boundary.hpp"
#include "ops/maps/incidence_numbers.hpp"
#include "ops/maps/orbits.hpp"
#include "ops/maps/rooted_map.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_complexes.hpp"
#include "tests/support/random_maps.hpp"
#include "tests/support/solids.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

/// The same map with its darts in another order.
GMap relabelled(const GMap& map, Random& random, std::vector<Dart>& place) {
  place.resize(map.size());
  std::iota(place.begin(), place.end(), Dart{0});
  for (std::size_t k = place.size(); k > 1; --k) {
    std::swap(place[k - 1], place[static_cast<std::size_t>(random.in(0, static_cast<int>(k) - 1))]);
  }
  std::vector<std::vector<Dart>> alpha(map.involutions().size(), std::vector<Dart>(map.size()));
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    for (Dart d = 0; d < map.size(); ++d) {
      alpha[i][place[d]] = place[map.involutions()[i][d]];
    }
  }
  return *GMap::make(alpha);
}

bool is_isomorphism(const GMap& from, const GMap& to, const std::vector<Dart>& images) {
  for (Dart d = 0; d < from.size(); ++d) {
    for (int i = 0; i <= from.dimension(); ++i) {
      if (images[from.alpha(i, d)] != to.alpha(i, images[d])) {
        return false;
      }
    }
  }
  return true;
}

const std::vector<Polygons> polyhedra{tetrahedron_faces(), cube_faces(), prism_faces(3), prism_faces(5),
                                      pyramid_faces(4)};

}  // namespace

TEST_CASE("the darts of a polygon are met in their order", "[maps]") {
  const std::vector<Dart> order = ops::darts_from(ops::polygon(7), 0);
  CHECK(std::ranges::is_sorted(order));
  CHECK(order.size() == 14);
  CHECK(ops::rooted_at(ops::polygon(7), 0) == ops::polygon(7));
  CHECK(ops::rooted_at(ops::polygon(7), 9) == ops::polygon(7));
}

TEST_CASE("a map looks the same from its canonical root however its darts are numbered", "[maps]") {
  const auto seed = GENERATE(range(0U, 60U));
  CAPTURE(seed);
  Random random(seed);
  GMap map = component_of(random_gmap(random, {2 + static_cast<int>(seed % 2), false}), 0);
  std::vector<Dart> place;
  const GMap other = relabelled(map, random, place);
  CHECK(ops::rooted_at(map, ops::canonical_root(map)) == ops::rooted_at(other, ops::canonical_root(other)));
  const auto found = ops::isomorphism(map, other);
  REQUIRE(found.has_value());
  CHECK(is_isomorphism(map, other, *found));
  const auto known = ops::isomorphism(map, 0, other, place[0]);
  REQUIRE(known.has_value());
  CHECK(*known == place);
  const std::vector<Dart> automorphic = ops::automorphisms(map);
  for (Dart d = 0; d < map.size(); ++d) {
    const auto images = ops::isomorphism(map, 0, map, d);
    REQUIRE(images.has_value() == (std::ranges::find(automorphic, d) != automorphic.end()));
    REQUIRE((!images || is_isomorphism(map, map, *images)));
  }
}

TEST_CASE("polyhedra have their symmetries, and none of them is another one", "[maps]") {
  const std::vector<std::size_t> symmetries{24, 48, 12, 20, 8};
  for (std::size_t k = 0; k < polyhedra.size(); ++k) {
    const GMap map = map_of_faces(polyhedra[k]);
    CHECK(ops::automorphisms(map).size() == symmetries[k]);
    for (std::size_t other = 0; other < k; ++other) {
      CHECK_FALSE(ops::isomorphism(map, map_of_faces(polyhedra[other])).has_value());
    }
  }
}

TEST_CASE("canonical boundaries are maps of one dimension less", "[maps]") {
  const GMap map = solid_of(cube_faces());
  ops::CellBoundaries boundaries(map);
  CHECK(boundaries.of(3, 0).map == map_of_faces(cube_faces()));
  for (Dart d = 0; d < map.size(); ++d) {
    CHECK(ops::isomorphism(boundaries.of(2, d).map, ops::polygon(4).restricted(1)).has_value());
    CHECK(boundaries.of(1, d).map.size() == 2);
    CHECK(boundaries.of(0, d).map == GMap::points(1));
  }
}

TEST_CASE("of the boundaries of cells those are spheres that should be", "[maps]") {
  for (const Polygons& faces : polyhedra) {
    CHECK(ops::is_homology_sphere(map_of_faces(faces)));
  }
  for (Dart sides = 1; sides < 5; ++sides) {
    CHECK(ops::is_homology_sphere(ops::polygon(sides).restricted(1)));
  }
  CHECK(ops::is_homology_sphere(GMap::points(1)));
  CHECK_FALSE(ops::is_homology_sphere(*GMap::make({{0}})));
  CHECK(ops::is_homology_sphere(*GMap::make({{1, 0}})));
  CHECK_FALSE(ops::is_homology_sphere(torus_of_a_square()));
  CHECK_FALSE(ops::is_homology_sphere(klein_bottle_of_a_square()));
  CHECK_FALSE(ops::is_homology_sphere(projective_plane_of_a_square()));
  CHECK_FALSE(ops::is_homology_sphere(ops::polygon(4)));                        // open
  CHECK_FALSE(ops::is_homology_sphere(*GMap::make({{1, 0}, {1, 0}, {1, 0}})));  // folded
  const auto closed_by_itself = [](const GMap& surface) {                       // two cells over one surface
    const GMap twice = ops::disjoint_union(surface, surface);
    std::vector<std::vector<Dart>> alpha = twice.involutions();
    alpha.emplace_back();
    for (Dart d = 0; d < twice.size(); ++d) {
      alpha.back().push_back((d + surface.size()) % twice.size());
    }
    return *GMap::make(alpha);
  };
  CHECK(ops::is_homology_sphere(closed_by_itself(map_of_faces(cube_faces()))));
  CHECK_FALSE(ops::is_homology_sphere(closed_by_itself(torus_of_a_square())));
}

TEST_CASE("incidence numbers are a complex", "[maps]") {
  const auto seed = GENERATE(range(0U, 80U));
  CAPTURE(seed);
  Random random(seed);
  const auto complex = ops::incidence_complex(random_gmap(random, {3, false}));
  if (!complex) {
    CHECK(complex.error().code == Errc::refused);
    return;
  }
  for (std::size_t i = 2; i < complex->boundaries.size(); ++i) {
    for (const auto& boundary : complex->boundaries[i]) {
      std::vector<int> twice(complex->cells[i - 2].count(), 0);
      for (const auto& [cell, coefficient] : boundary) {
        for (const auto& [below, number] : complex->boundaries[i - 1][cell]) {
          twice[below] += coefficient * number;
        }
      }
      CHECK(std::ranges::all_of(twice, [](int sum) { return sum == 0; }));
    }
  }
}

#include "ops/maps/map_product.hpp"

#include <algorithm>
#include <numeric>

#include "ops/maps/cell_boundary.hpp"
#include "ops/maps/chain_operations.hpp"
#include "ops/maps/euler.hpp"
#include "ops/maps/incidence_numbers.hpp"
#include "ops/maps/map_conversions.hpp"
#include "ops/maps/orientation.hpp"
#include "ops/maps/rooted_map.hpp"
#include "ops/maps/surface.hpp"
#include "tests/support/random_maps.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;

namespace {

/// A circle of some edges, as a 1-G-map; a segment.
GMap circle(Dart edges) {
  Lists alpha(2);
  for (Dart d = 0; d < 2 * edges; ++d) {
    alpha[0].push_back(d ^ 1U);
    alpha[1].push_back(d % 2 == 0 ? (d + 2 * edges - 1) % (2 * edges) : (d + 1) % (2 * edges));
  }
  return made(GMap::make(std::move(alpha)));
}
GMap segment() { return made(GMap::make({{1, 0}, {0, 1}})); }
GMap surface(const char* name) {
  for (const KnownSurface& known : known_surfaces()) {
    if (std::string{known.name} == name) {
      return known.map;
    }
  }
  FAIL(name);
  return {};
}

std::vector<std::uint64_t> convolution(const std::vector<std::uint64_t>& one, const std::vector<std::uint64_t>& other) {
  std::vector<std::uint64_t> product(one.size() + other.size() - 1, 0);
  for (std::size_t a = 0; a < one.size(); ++a) {
    for (std::size_t b = 0; b < other.size(); ++b) {
      product[a + b] += one[a] * other[b];
    }
  }
  return product;
}

ProductDarts darts_of(const GMap& left, const GMap& right) {
  return {left.size(), left.dimension(), right.size(), right.dimension()};
}

/// The same map with its darts in another order.
bool is_image(const GMap& from, const Images& image, const GMap& to) {
  for (int i = 0; i <= from.dimension(); ++i) {
    for (Dart d = 0; d < from.size(); ++d) {
      if (image[from.alpha(i, d)] != to.alpha(i, image[d])) {
        return false;
      }
    }
  }
  return true;
}

std::uint32_t backwards(const ProductDarts& darts, std::uint32_t word) {
  for (std::uint32_t other = 0; other < darts.words(); ++other) {
    bool is = true;
    for (int i = 0; i < darts.dimension(); ++i) {
      is = is && darts.is_left(word, i) == darts.is_left(other, darts.dimension() - 1 - i);
    }
    if (is) {
      return other;
    }
  }
  return UINT32_MAX;
}

GMap small_random_map(Random& random, int dimension) {
  while (true) {
    GMap map = random_gmap(random, {dimension, random.one_in(3), random.one_in(2)});
    if (map.size() <= (dimension == 3 ? 48U : 24U)) {
      return map;
    }
  }
}

}  // namespace

TEST_CASE("words are numbered in their order, and a beginning of one is a word", "[ops][maps][product]") {
  const ProductDarts darts(3, 2, 5, 3);
  CHECK(darts.words() == 10);
  CHECK(darts.size() == 150);
  CHECK(count_of_darts(3, 2, 5, 3) == 150);
  std::vector<std::string> texts;
  for (std::uint32_t word = 0; word < darts.words(); ++word) {
    std::string text;
    for (int i = 0; i < 5; ++i) {
      text += darts.is_left(word, i) ? 'l' : 'a';  // which sorts before it
    }
    CHECK(darts.left_steps(word, 5) == 2);
    for (int i = 0; i <= 5; ++i) {
      const int left = darts.left_steps(word, i);
      const ProductDarts shorter(1, left, 1, i - left);
      const std::uint32_t number = darts.beginning(word, i);
      REQUIRE(number < shorter.words());
      for (int step = 0; step < i; ++step) {
        CHECK(shorter.is_left(number, step) == darts.is_left(word, step));
      }
    }
    texts.push_back(text);
  }
  CHECK(texts.front() == "aaall");
  CHECK(std::ranges::is_sorted(texts));
  for (Dart d = 0; d < darts.size(); ++d) {
    REQUIRE(darts.dart(darts.place(d)) == d);
  }
  CHECK(count_of_darts(no_dart, 15, no_dart, 15) == UINT64_MAX);
}

TEST_CASE("a product of maps has the pairs of their cells", "[ops][maps][product][law]") {
  const unsigned seed = GENERATE(range(0u, 60u));
  CAPTURE(seed);
  Random random(seed);
  const int k = random.in(0, 3);
  const GMap left = small_random_map(random, k), right = small_random_map(random, random.in(0, k == 3 ? 1 : 2));
  const GMap map = product(left, right);  // lawful, or GMap::make would have refused it
  const ProductDarts darts = darts_of(left, right);
  REQUIRE(map.dimension() == left.dimension() + right.dimension());
  REQUIRE(map.size() == darts.size());
  CHECK(cell_counts(map) == convolution(cell_counts(left), cell_counts(right)));
  if (left.dimension() > 0 && right.dimension() > 0) {
    CHECK(simplicial_euler(map) == simplicial_euler(left) * simplicial_euler(right));
  }
  for (int i = 0; i <= map.dimension(); ++i) {
    const Orbits pairs = cells(map, i);
    for (Dart d = 0; d < map.size(); ++d) {
      const auto [e, f, word] = darts.place(d);
      const auto [least_e, least_f, least_word] = darts.place(pairs.first[pairs.of[d]]);
      const int a = darts.left_steps(word, i);
      REQUIRE(a == darts.left_steps(least_word, i));
      REQUIRE(cells(left, a).join(e, least_e));
      REQUIRE(cells(right, i - a).join(f, least_f));
    }
  }
}

TEST_CASE("what is free in a factor is free in the product", "[ops][maps][product][law]") {
  const unsigned seed = GENERATE(range(0u, 20u));
  CAPTURE(seed);
  Random random(seed);
  const GMap left = small_random_map(random, 2), right = small_random_map(random, 1);
  const GMap map = product(left, right);
  const ProductDarts darts = darts_of(left, right);
  const int n = map.dimension();
  for (Dart d = 0; d < map.size(); ++d) {
    const auto [e, f, word] = darts.place(d);
    REQUIRE(map.is_free(n, d) == (darts.is_left(word, n - 1) ? left.is_free(2, e) : right.is_free(1, f)));
    REQUIRE(map.is_free(0, d) == (darts.is_left(word, 0) ? left.is_free(0, e) : right.is_free(0, f)));
  }
}

TEST_CASE("the dual of a product is the product of the duals", "[ops][maps][product][law]") {
  const unsigned seed = GENERATE(range(0u, 20u));
  CAPTURE(seed);
  Random random(seed);
  const GMap left = small_random_map(random, random.in(1, 2)), right = small_random_map(random, random.in(1, 2));
  const ProductDarts darts = darts_of(left, right);
  Images image(darts.size());
  for (Dart d = 0; d < darts.size(); ++d) {
    const auto [e, f, word] = darts.place(d);
    image[d] = darts.dart({e, f, backwards(darts, word)});
  }
  CHECK(is_image(product(left.dual(), right.dual()), image, product(left, right).dual()));
}

TEST_CASE("factors may change places, and be multiplied in any order", "[ops][maps][product][law]") {
  const unsigned seed = GENERATE(range(0u, 12u));
  CAPTURE(seed);
  Random random(seed);
  const GMap a = component_of(small_random_map(random, random.in(1, 2)), 0);
  const GMap b = component_of(small_random_map(random, 1), 0);
  CHECK(isomorphism(product(a, b), product(b, a)));
  if (a.size() * b.size() <= 60) {
    CHECK(isomorphism(product(product(a, b), segment()), product(a, product(b, segment()))));
  }
}

TEST_CASE("a point changes nothing", "[ops][maps][product]") {
  const GMap point = made(GMap::make({{0}})), two = made(GMap::make({{1, 0}}));
  for (const KnownSurface& known : known_surfaces()) {
    CHECK(product(point, known.map) == known.map);
    CHECK(product(known.map, point) == known.map);
    CHECK(cell_counts(product(two, known.map)) == convolution({2}, known.cells));
  }
  CHECK(product(two, two) == made(GMap::make({{0, 1, 2, 3}})));
}

TEST_CASE("products are the spaces that they should be", "[ops][maps][product]") {
  SECTION("two circles make a torus of squares") {
    for (const auto& [width, height] : {std::pair{3, 3}, std::pair{3, 5}, std::pair{4, 4}}) {
      const GMap map = product(circle(static_cast<Dart>(width)), circle(static_cast<Dart>(height)));
      CHECK(isomorphism(map, to_gmap(torus_grid(width, height))));
    }
    const GMap smallest = product(circle(1), circle(1));
    CHECK(isomorphism(smallest, surface("a torus")));
    CHECK(made(surface_of(smallest)) == Surface{true, 1, 0});
  }
  SECTION("two segments make a square, three a cube") {
    const GMap square = product(segment(), segment());
    CHECK(isomorphism(square, polygon(4)));
    CHECK(isomorphism(product(square, segment()), to_gmap(cube_surface()).extended()));
  }
  SECTION("a polygon and a segment make a prism") {
    const GMap prism = product(polygon(5), segment());
    CHECK(cell_counts(prism) == std::vector<std::uint64_t>{10, 15, 7, 1});
    const GMap sides = to_gmap(of_faces(
        {{0, 4, 3, 2, 1}, {5, 6, 7, 8, 9}, {0, 1, 6, 5}, {1, 2, 7, 6}, {2, 3, 8, 7}, {3, 4, 9, 8}, {4, 0, 5, 9}}));
    CHECK(isomorphism(prism, sides.extended()));
  }
  SECTION("an annulus and a Klein bottle") {
    CHECK(made(surface_of(product(circle(3), segment()))) == Surface{true, 0, 2});
    const GMap tube = product(circle(4), segment());
    CHECK(cell_counts(tube) == std::vector<std::uint64_t>{8, 12, 4});
  }
  SECTION("a torus times a circle") {
    const GMap map = product(product(circle(1), circle(1)), circle(1));
    CHECK(cell_counts(map) == std::vector<std::uint64_t>{1, 3, 3, 1});
    CHECK(euler_conditions(product(product(circle(2), circle(2)), circle(2))).hold());
    CHECK(made(is_orientable(map)));
  }
  SECTION("a projective plane times a circle has two sides nowhere") {
    const GMap map = product(surface("a projective plane"), circle(2));
    CHECK(cell_counts(map) == std::vector<std::uint64_t>{4, 8, 6, 2});
    CHECK_FALSE(made(is_orientable(map)));
    CHECK(simplicial_euler(map) == 0);
  }
}

TEST_CASE("the canonical boundary of a product cell is known from those of its factors", "[ops][maps][product][law]") {
  const unsigned seed = GENERATE(range(0u, 12u));
  CAPTURE(seed);
  Random random(seed);
  const GMap left = small_random_map(random, 2), right = small_random_map(random, random.in(1, 2));
  const GMap map = product(left, right);
  const ProductDarts darts = darts_of(left, right);
  CellBoundaries of_map(map), of_left(left), of_right(right);
  const auto place = [](const CellBoundary& cell, Dart d) {
    return cell.boundary_darts[static_cast<std::size_t>(std::ranges::find(cell.darts, d) - cell.darts.begin())];
  };
  for (int i = 1; i <= map.dimension(); ++i) {
    for (const Dart d : cells(map, i).first) {
      const auto [e, f, word] = darts.place(d);
      const int a = darts.left_steps(word, i);
      const CellBoundary cell = of_map.of(i, d), one = of_left.of(a, e), other = of_right.of(i - a, f);
      const GMap expected = boundary_of_product(one.map, other.map);
      const ProductDarts of_cell(one.map.size(), a, other.map.size(), i - a);
      const Dart root = of_cell.dart({place(one, e), place(other, f), darts.beginning(word, i)});
      REQUIRE(expected.dimension() == i - 1);
      CHECK(rooted_at(cell.map, place(cell, d)) == rooted_at(expected, root));
    }
  }
}

TEST_CASE("darts see products of cells as tensor products have them", "[ops][maps][product][law]") {
  const GMap left = polygon(3).restricted(1), right = to_gmap(cube_surface()).restricted(2);
  const GMap boundary = boundary_of_product(left, right);
  const ProductDarts darts(left.size(), 2, right.size(), 3);
  const DartSigns of_left = dart_signs(left), of_right = dart_signs(right), of_product = dart_signs(boundary);
  REQUIRE(of_product.of.size() == boundary.size());
  CHECK(sign_of_word(darts, 0) == 1);
  for (Dart d = 0; d < boundary.size(); ++d) {
    const auto [e, f, word] = darts.place(d);
    REQUIRE(of_product.of[d] == of_left.of[e] * of_right.of[f] * sign_of_word(darts, word));
  }
}

TEST_CASE("a product of chains of maps has the pairs of their cells", "[ops][maps][product][law]") {
  const unsigned seed = GENERATE(range(0u, 20u));
  CAPTURE(seed);
  Random random(seed);
  const auto chain_or_none = [&](int dimension) {
    while (true) {
      if (auto chain = chain_of_gmap(small_random_map(random, dimension))) {
        return std::move(*chain);
      }
    }
  };
  const ChainOfMaps left = chain_or_none(random.in(0, 2)), right = chain_or_none(random.in(0, 2));
  const ChainOfMaps chain = product(left, right);  // lawful, or ChainOfMaps::make would have refused it
  const auto counts = [](const ChainOfMaps& of) {
    const auto found = of.cell_counts();
    return std::vector<std::uint64_t>(found.begin(), found.end());
  };
  CHECK(counts(chain) == convolution(counts(left), counts(right)));
}

TEST_CASE("the chain of a product is the product of the chains", "[ops][maps][product]") {
  const ChainOfMaps of_product = made(chain_of_gmap(product(polygon(3), circle(2))));
  const ChainOfMaps chains = product(made(chain_of_gmap(polygon(3))), made(chain_of_gmap(circle(2))));
  REQUIRE(of_product.cell_counts() == chains.cell_counts());
  for (int i = 1; i <= 3; ++i) {
    REQUIRE(of_product.level(i).size() == chains.level(i).size());
    for (const Dart d : chains.cells(i).first) {
      CHECK(std::ranges::any_of(of_product.cells(i).first, [&](Dart e) {
        return isomorphism(of_product.canonical_boundary(i, e), chains.canonical_boundary(i, d)).has_value();
      }));
    }
  }
}

// Closed manifolds as maps: their groups are those of duality, and their duals are other cells of the same object.
#include <algorithm>
#include <string>
#include <vector>

#include "ops/maps/euler.hpp"
#include "tests/support/cell_models.hpp"
#include "tests/support/engines.hpp"
#include "tests/support/random_maps.hpp"
#include "tests/support/solids.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

/// The map without one of its involutions.
GMap without(const GMap& map, int left_out) {
  Lists alpha = map.involutions();
  alpha.erase(alpha.begin() + left_out);
  return made(GMap::make(std::move(alpha)));
}

/// Whether no dart is free, and what lies around each cell of each dimension is a sphere. Requires: dimension 2 or 3.
bool is_closed_manifold(const GMap& map) {
  for (int i = 0; i <= map.dimension(); ++i) {
    for (Dart d = 0; d < map.size(); ++d) {
      if (map.is_free(i, d)) {
        return false;
      }
    }
    const GMap around = without(map, i);
    for (const Dart first : ops::components(around).first) {
      if (ops::simplicial_euler(component_of(around, first)) != (map.dimension() == 2 ? 0 : 2)) {
        return false;
      }
    }
  }
  return true;
}

std::vector<std::int64_t> betti_modulo_2(const GMap& map) {
  Engine engine(ring_named("Z/2"));
  carry_out(engine, make_map("m", map, true));
  return engine.homology().betti;
}

bool is_symmetric(std::vector<std::int64_t> betti) {
  const std::vector<std::int64_t> forwards = betti;
  std::ranges::reverse(betti);
  return forwards == betti;
}

GMap random_closed_map(Random& random, int dimension) {
  if (dimension == 2) {
    return random.one_in(2) ? random_surface_map(random, random.in(1, 8), true)
                            : random_gmap(random, {.dimension = 2, .closed = true});
  }
  switch (random.in(0, 2)) {
    case 0:
      return random_cubes(random, random.in(1, 2));
    case 1:
      return random_gmap(random, {.dimension = 3, .closed = true});
    default: {
      const std::vector<Polygons> kinds{tetrahedron_faces(), cube_faces(), prism_faces(3), pyramid_faces(4)};
      const GMap solid = solid_of(kinds[static_cast<std::size_t>(random.in(0, 3))]);
      return closed_by_twin(
          sewn_at_random(random, random.one_in(2) ? ops::disjoint_union(solid, solid) : solid, false));
    }
  }
}

}  // namespace

TEST_CASE("modulo 2 closed manifolds have as many classes of each dimension as of the other one") {
  const int dimension = GENERATE(2, 3);
  Random random(static_cast<unsigned>(dimension));
  int manifolds = 0, others = 0, lopsided = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const GMap map = random_closed_map(random, dimension);
    const auto betti = betti_modulo_2(map);
    if (is_closed_manifold(map)) {
      ++manifolds;
      CAPTURE(trial, dimension);
      REQUIRE(is_symmetric(betti));
    } else {
      ++others;
      lopsided += is_symmetric(betti) ? 0 : 1;
    }
  }
  CHECK(manifolds > 20);
  if (dimension == 3) {
    CHECK(others > 5);
    CHECK(lopsided > 0);
  }
}

TEST_CASE("the suspension of a torus is closed, no manifold, and has no such groups") {
  const GMap map = suspension_of(torus_of_a_square());
  CHECK_FALSE(is_closed_manifold(map));
  CHECK(betti_modulo_2(map) == std::vector<std::int64_t>{1, 0, 2, 1});
}

TEST_CASE("by cells, a map and its dual are the same object of other cells") {
  const int dimension = GENERATE(2, 3);
  const std::string ring = GENERATE("Z", "Z/3");
  Random random(static_cast<unsigned>(dimension) + 10);
  int checked = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const GMap map = random_closed_map(random, dimension);
    Engine engine(ring_named(ring)), dual(ring_named(ring));
    if (!engine.apply(make_map("m", map)) || !dual.apply(make_map("m", map.dual()))) {
      continue;
    }
    ++checked;
    std::vector<std::uint64_t> cells(engine.cells().begin(), engine.cells().end());
    std::ranges::reverse(cells);
    REQUIRE(cells == std::vector<std::uint64_t>(dual.cells().begin(), dual.cells().end()));
    REQUIRE(live_groups(engine) == live_groups(dual));
    REQUIRE(engine.first_defect().value_or("") == "");
    REQUIRE(dual.first_defect().value_or("") == "");
  }
  CHECK(checked > 10);
}

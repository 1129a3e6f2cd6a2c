// What of the conditions under which a cell counts once can be asked over a field: incidence numbers modulo 2, which
// need no signs, beside the simplicial analogue.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "ops/maps/cell_boundary.hpp"
#include "ops/maps/incidence_numbers.hpp"
#include "tests/support/cell_models.hpp"
#include "tests/support/random_maps.hpp"
#include "tests/support/ranks.hpp"
#include "tests/support/solids.hpp"

using namespace sesame;
using namespace sesame::tests;
using ops::IndexSet;

namespace {

using Ranks = std::vector<std::size_t>;

/// The ranks of the groups modulo p, by those over Z.
Ranks ranks_of_analogue(const GMap& map, std::int64_t p) {
  const auto groups = reductions::homology_groups(ops::chain_complex(ops::simplicial_analogue(map)));
  Ranks ranks;
  std::size_t torsion_below = 0;
  for (const auto& group : groups) {
    const auto torsion = static_cast<std::size_t>(std::ranges::count_if(
        group.torsion, [&](const sparse::Integer& t) { return t.modulo(static_cast<std::uint32_t>(p)) == 0; }));
    ranks.push_back(group.rank + torsion + torsion_below);
    torsion_below = torsion;
  }
  return ranks;
}

bool is_sphere_modulo(const GMap& map, std::int64_t p) {
  Ranks sphere(static_cast<std::size_t>(map.dimension()) + 1, 0);
  ++sphere.front();
  ++sphere.back();
  return ranks_of_analogue(map, p) == sphere;
}

/// How many times the (i-1)-cells are in the boundaries of the i-cells, i >= 1, a row for each i-cell: how many of its
/// darts are a certain dart of the (i-1)-cell.
std::vector<DenseRow> incidences(const GMap& map, int i) {
  const IndexSet from_i = map.indices() & ~((IndexSet{1} << i) - 1);
  const ops::Orbits above = ops::cells(map, i), below = ops::cells(map, i - 1);
  const ops::Orbits darts_above = ops::orbits(map, from_i & ~(IndexSet{1} << i)),
                    darts_below = ops::orbits(map, from_i);
  std::vector<DenseRow> rows(above.count(), DenseRow(below.count(), 0));
  for (const Dart d : darts_above.first) {
    if (darts_below.join(d, below.first[below.of[d]])) {
      ++rows[above.of[d]][below.of[d]];
    }
  }
  return rows;
}

/// The ranks of the groups of the complex of these numbers modulo 2.
Ranks ranks_of_cells(const GMap& map) {
  std::vector<std::size_t> rank_of_boundary(static_cast<std::size_t>(map.dimension()) + 2, 0);
  for (int i = 1; i <= map.dimension(); ++i) {
    rank_of_boundary[static_cast<std::size_t>(i)] = rank_modulo(incidences(map, i), 2);
  }
  Ranks ranks;
  for (int i = 0; i <= map.dimension(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    ranks.push_back(ops::cells(map, i).count() - rank_of_boundary[at] - rank_of_boundary[at + 1]);
  }
  return ranks;
}

bool boundary_of_boundary_is_zero(const GMap& map) {
  for (int i = 2; i <= map.dimension(); ++i) {
    const std::vector<DenseRow> above = incidences(map, i), below = incidences(map, i - 1);
    for (const DenseRow& row : above) {
      for (std::size_t k = 0; k < below.front().size(); ++k) {
        std::int64_t sum = 0;
        for (std::size_t j = 0; j < row.size(); ++j) {
          sum += row[j] * below[j][k];
        }
        if (sum % 2 != 0) {
          return false;
        }
      }
    }
  }
  return true;
}

/// The canonical boundaries of the cells of dimension 1 and more.
std::vector<GMap> boundaries_of(const GMap& map) {
  std::vector<GMap> boundaries;
  ops::CellBoundaries all(map);
  for (int i = 1; i <= map.dimension(); ++i) {
    for (const Dart d : ops::cells(map, i).first) {
      boundaries.push_back(all.of(i, d).map);
    }
  }
  return boundaries;
}

bool is_free_somewhere(const GMap& map) {
  for (int i = 0; i <= map.dimension(); ++i) {
    for (Dart d = 0; d < map.size(); ++d) {
      if (map.is_free(i, d)) {
        return true;
      }
    }
  }
  return false;
}

/// A lens whose lower face is glued to the upper one after a third of a turn: the lens space L(3,1).
GMap map_of_lens_space() {
  Lists alpha = suspension_of(closed_polygon(3)).involutions();
  alpha.emplace_back(12);
  for (Dart d = 0; d < 6; ++d) {
    alpha.back()[6 + d] = (d + 2) % 6;
    alpha.back()[(d + 2) % 6] = 6 + d;
  }
  return made(GMap::make(std::move(alpha)));
}

GMap random_object(Random& random) {
  const int kind = random.in(0, 5);
  if (kind == 0) {
    return random_surface_map(random, random.in(1, 5), random.one_in(2)).extended();
  }
  if (kind == 1) {
    return random_cubes(random, 1);
  }
  if (kind == 2) {
    return random.one_in(2) ? suspension_of(random_surface_map(random, random.in(1, 4), true)).extended()
                            : map_of_lens_space().extended();
  }
  return random_gmap(random, {.dimension = random.in(1, 3), .closed = random.one_in(2), .folds = random.one_in(3)});
}

}  // namespace

TEST_CASE("a cell over a sphere modulo a prime is closed and orientable, and up to dimension three over a sphere",
          "[maps]") {
  const std::int64_t p = GENERATE(2, 3, 5);
  Random random(static_cast<unsigned>(p));
  int spheres = 0, others = 0, only_modulo = 0;
  for (int trial = 0; trial < 250; ++trial) {
    for (const GMap& boundary : boundaries_of(random_object(random))) {
      // What the cells of the boundary are over is asked first, as of those of the object.
      const auto is_sphere = [&](const GMap& map) { return is_sphere_modulo(map, p); };
      if (!is_sphere(boundary) || !std::ranges::all_of(boundaries_of(boundary), is_sphere)) {
        ++others;
        continue;
      }
      ++spheres;
      REQUIRE_FALSE(is_free_somewhere(boundary));
      if (boundary.dimension() > 0) {
        REQUIRE(ops::dart_signs(boundary).fault == ops::DartSigns::Fault::nothing);
      }
      REQUIRE((ops::is_homology_sphere(boundary) || boundary.dimension() >= 3));
      only_modulo += ops::is_homology_sphere(boundary) ? 0 : 1;
    }
  }
  CHECK(spheres > 500);
  CHECK(others > 100);
  CHECK((only_modulo > 0) == (p != 3));
}

TEST_CASE("incidence numbers modulo 2 have the groups modulo 2 where all cells are over spheres modulo 2", "[maps]") {
  Random random(4);
  int checked = 0, wrong = 0;
  for (int trial = 0; trial < 250; ++trial) {
    const GMap map = random_object(random);
    const std::vector<GMap> boundaries = boundaries_of(map);
    if (std::ranges::none_of(boundaries, is_free_somewhere)) {
      REQUIRE(boundary_of_boundary_is_zero(map));
    }
    if (!std::ranges::all_of(boundaries, [](const GMap& boundary) { return is_sphere_modulo(boundary, 2); })) {
      wrong += ranks_of_cells(map) != ranks_of_analogue(map, 2) ? 1 : 0;
      continue;
    }
    ++checked;
    REQUIRE(ranks_of_cells(map) == ranks_of_analogue(map, 2));
    const auto complex = ops::incidence_complex(map);
    REQUIRE(complex);  // so all cells are orientable
    for (int i = 1; i <= map.dimension(); ++i) {
      const std::vector<DenseRow> rows = incidences(map, i);
      for (std::size_t cell = 0; cell < rows.size(); ++cell) {
        DenseRow with_sign(rows[cell].size(), 0);
        for (const auto& [face, coefficient] : complex->boundaries[static_cast<std::size_t>(i)][cell]) {
          with_sign[face] = coefficient;
        }
        for (std::size_t face = 0; face < with_sign.size(); ++face) {
          REQUIRE((with_sign[face] - rows[cell][face]) % 2 == 0);
        }
      }
    }
  }
  CHECK(checked > 60);
  CHECK(wrong > 20);
}

TEST_CASE("a cell over a projective plane is counted wrongly modulo 2, though numbers modulo 2 need no orientation",
          "[maps]") {
  const GMap cone = projective_plane_of_a_square().extended();
  CHECK(boundary_of_boundary_is_zero(cone));
  CHECK(ranks_of_cells(cone) == Ranks{1, 1, 0, 0});
  CHECK(ranks_of_analogue(cone, 2) == Ranks{1, 0, 0, 0});
}

TEST_CASE("a cell over a lens space is a ball modulo 2 and 5, and not modulo 3 nor over the integers", "[maps]") {
  const GMap lens = map_of_lens_space();
  CHECK(homology_of(ops::simplicial_analogue(lens)) == std::vector<std::string>{"Z", "Z/3", "0", "Z"});
  CHECK(is_sphere_modulo(lens, 2));
  CHECK_FALSE(is_sphere_modulo(lens, 3));
  CHECK(is_sphere_modulo(lens, 5));
  CHECK_FALSE(ops::is_homology_sphere(lens));
  const GMap cone = lens.extended();
  CHECK(ranks_of_cells(cone) == Ranks{1, 0, 0, 0, 0});
  CHECK(ranks_of_analogue(cone, 2) == Ranks{1, 0, 0, 0, 0});
}

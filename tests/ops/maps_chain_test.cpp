#include "ops/maps/chain_operations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/cell_models.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;

namespace {

ChainOfMaps chain_of(const GMap& map) { return std::move(*chain_of_gmap(map)); }

/// Some chains beside each other, each of one polygon.
ChainOfMaps polygons(const std::vector<Dart>& sides) {
  ChainOfMaps all;
  for (const Dart count : sides) {
    all = disjoint_union(all, chain_of(polygon(count)));
  }
  return all;
}

ChainOfMaps glued(const ChainOfMaps& chain, int i, Dart one, Dart other) {
  Result<GluedChain> result = glue_cells(chain, i, one, other);
  INFO(refusal_of(result));
  REQUIRE(result);
  return std::move(result->chain);
}

/// The square with its sides glued by pairs of darts, counted from 1; a pair of darts that are one already says
/// nothing.
ChainOfMaps glued_square(const DartPairs& pairs) {
  ChainOfMaps chain = chain_of(polygon(4));
  std::vector<Dart> place(8);  // of the darts of sides
  std::iota(place.begin(), place.end(), Dart{0});
  for (const auto& [d, e] : pairs) {
    if (place[d - 1] == place[e - 1]) {
      continue;
    }
    Result<GluedChain> result = glue_cells(chain, 1, place[d - 1], place[e - 1]);
    REQUIRE(result);
    chain = std::move(result->chain);
    for (Dart& each : place) {
      each = result->image[1][each];
    }
  }
  return chain;
}

/// Level and faces of a chain, to spoil them.
struct LevelsAndFaces {
  std::vector<GMap> levels;
  std::vector<std::vector<Dart>> sigma;
};
LevelsAndFaces parts_of(const ChainOfMaps& chain) {
  LevelsAndFaces parts{{}, chain.faces()};
  for (int i = 0; i <= chain.dimension(); ++i) {
    parts.levels.push_back(chain.level(i));
  }
  return parts;
}

/// Whether the chain of a G-map exists, by orbits of the map alone: sigma_i is injective on each orbit of alpha_0, ...,
/// alpha_{i-2} when two darts in an orbit of these and of those from alpha_{i+1} on, and in one of those from alpha_i
/// on, are in one of the latter without alpha_i.
bool is_unfolded(const GMap& map) {
  for (int i = 2; i <= map.dimension(); ++i) {
    const IndexSet above = map.indices() & ~((IndexSet{2} << i) - 1);
    const IndexSet below = (IndexSet{1} << (i - 1)) - 1;
    const Orbits one = orbits(map, below | above);
    const Orbits other = orbits(map, above | IndexSet{1} << i);
    const Orbits both = orbits(map, above);
    for (Dart d = 0; d < map.size(); ++d) {
      for (Dart e = 0; e < map.size(); ++e) {
        if (one.join(d, e) && other.join(d, e) && !both.join(d, e)) {
          return false;
        }
      }
    }
  }
  return true;
}

/// (a) and (b), word by word.
bool are_conditions_met(const LevelsAndFaces& parts) {
  for (std::size_t i = 2; i < parts.levels.size(); ++i) {
    const GMap& level = parts.levels[i];
    const GMap& below = parts.levels[i - 1];
    const std::vector<Dart>& sigma = parts.sigma[i - 1];
    const IndexSet indices = below.indices();
    for (Dart d = 0; d < level.size(); ++d) {
      const std::vector<Dart> face = OrbitWalk(level).from(d, indices);
      std::vector<Dart> found;
      std::ranges::transform(face, std::back_inserter(found), [&](Dart e) { return sigma[e]; });
      std::vector<Dart> expected = OrbitWalk(below).from(sigma[d], indices);
      std::ranges::sort(found);
      std::ranges::sort(expected);
      bool holds = found == expected;
      for (std::size_t j = 0; j + 2 <= i; ++j) {
        const auto index = static_cast<int>(j);
        holds = holds && sigma[level.alpha(index, d)] == below.alpha(index, sigma[d]);
      }
      const Dart beyond = level.alpha(static_cast<int>(i) - 1, d);
      if (!holds || parts.sigma[i - 2][sigma[beyond]] != parts.sigma[i - 2][sigma[d]]) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

TEST_CASE("the chain of a map has its cells and its analogue, and leads back to it", "[maps]") {
  for (const GMap& map :
       {sewn_square(torus_pairs), sewn_square(klein_bottle_pairs), sewn_square(projective_plane_pairs),
        sewn_square(moebius_strip_pairs), sewn_square(annulus_pairs), sewn_square({}), surface_of_a_cube(),
        extended(surface_of_a_cube()), suspension_of(surface_of_a_cube()), suspension_of(quad_torus(3)),
        extended(sewn_square(projective_plane_pairs)), closed_polygon(1), polygon(1)}) {
    const ChainOfMaps chain = chain_of(map);
    CHECK(chain.cell_counts() == simplicial_analogue(map).cell_counts());
    CHECK(simplicial_analogue(chain) == simplicial_analogue(map));
    const auto back = gmap_of_chain(chain);
    REQUIRE(back);
    CHECK(*back == map);
  }
}

TEST_CASE("random maps have chains exactly where no cell is folded", "[maps]") {
  Random random(11);
  int folded = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const GMap map =
        trial % 20 == 19 ? random_cubes(random, 2) : random_surface_map(random, random.in(1, 6), random.one_in(3));
    const auto chain = chain_of_gmap(map);
    REQUIRE(chain.has_value() == is_unfolded(map));
    if (!chain) {
      CHECK(
          refusal_of(chain).starts_with("refused: the map has a cell that is sewn to itself, which no chain of maps "
                                        "has: condition (a): sigma_2 sends"));
      ++folded;
      continue;
    }
    CHECK(simplicial_analogue(*chain) == simplicial_analogue(map));
    CHECK(*gmap_of_chain(*chain) == map);
    for (int i = 0; i <= map.dimension(); ++i) {
      CHECK(chain->cells(i).count() == cells(map, i).count());
    }
  }
  CHECK(folded > 30);
  CHECK(folded < 250);
}

TEST_CASE("a chain of dimension 0 is points, and forgets how they are sewn", "[maps]") {
  const ChainOfMaps chain = chain_of(*GMap::make({{1, 0, 2}}));
  CHECK(chain.dimension() == 0);
  CHECK(chain.cell_counts() == FVector{3});
  CHECK(*gmap_of_chain(chain) == *GMap::make({{0, 1, 2}}));
  CHECK(refusal_of(chain_of_gmap(GMap::points(2))) ==
        "bad input: a map of dimension -1 has no cells that a chain of maps could have");
  CHECK(refusal_of(gmap_of_chain(ChainOfMaps())) == "bad input: a chain of maps without levels comes from no map");
}

TEST_CASE("a canonical boundary is the map of a cell, not glued where the object is", "[maps]") {
  const ChainOfMaps torus = chain_of(suspension_of(quad_torus(3)));
  CHECK(torus.canonical_boundary(3, 0) == quad_torus(3));
  CHECK(torus.canonical_boundary(3, quad_torus(3).size()) == quad_torus(3));
  CHECK(torus.canonical_boundary(2, 0) == closed_polygon(4));
  CHECK(torus.canonical_boundary(0, 0) == GMap::points(1));
  const ChainOfMaps square = chain_of(sewn_square(torus_pairs));
  CHECK(square.canonical_boundary(2, 3).size() == 8);
  CHECK(square.canonical_boundary(1, 1).size() == 2);
  Random random(12);
  for (int trial = 0; trial < 20; ++trial) {
    const GMap map = random_surface_map(random, random.in(1, 6), false);
    const auto chain = chain_of_gmap(map);
    if (!chain) {
      continue;
    }
    const NumberedSet set = simplicial_analogue(*chain);
    SimplexNumber vertex = 0;
    for (int i = 0; i <= 2; ++i) {
      for (const Dart d : chain->cells(i).first) {
        CHECK(simplicial_analogue(chain->canonical_boundary(i, d)) == set.canonical_boundary(vertex++));
      }
    }
  }
}

TEST_CASE("gluing the sides of a square makes the surfaces that sewing makes", "[maps]") {
  struct Surface {
    DartPairs pairs;
    GroupNames homology;
  };
  for (const Surface& each : {Surface{torus_pairs, {"Z", "Z^2", "Z"}}, Surface{klein_bottle_pairs, {"Z", "Z + Z/2"}},
                              Surface{projective_plane_pairs, {"Z", "Z/2"}}, Surface{moebius_strip_pairs, {"Z", "Z"}},
                              Surface{annulus_pairs, {"Z", "Z"}}}) {
    const ChainOfMaps chain = glued_square(each.pairs);
    CHECK(homology_of(simplicial_analogue(chain)) == each.homology);
    CHECK(chain.cell_counts() == simplicial_analogue(sewn_square(each.pairs)).cell_counts());
    CHECK(gmap_of_chain(chain)->alpha(2, 0) == sewn_square(each.pairs).alpha(2, 0));
    CHECK(gmap_of_chain(chain)->involutions()[2] == sewn_square(each.pairs).involutions()[2]);
  }
}

TEST_CASE("assemblies that are no quasi-manifolds have their homology, and are no G-maps", "[maps]") {
  // Three squares along an edge.
  const ChainOfMaps three = polygons({4, 4, 4});
  CHECK(three.cell_counts() == FVector{12, 12, 3});
  ChainOfMaps book = glued(three, 1, 0, 8);
  book = glued(book, 1, 0, 14);
  CHECK(book.cell_counts() == FVector{8, 10, 3});
  CHECK(homology_of(simplicial_analogue(book)) == GroupNames{"Z"});
  CHECK(refusal_of(gmap_of_chain(book)) ==
        "refused: dart 0 of level 1 is the face of the darts 0, 8 and 16: of two at most, where the cells are "
        "assembled to "
        "a quasi-manifold");
  // Two squares at a vertex.
  const ChainOfMaps pinched = glued(polygons({4, 4}), 0, 0, 4);
  CHECK(pinched.cell_counts() == FVector{7, 8, 2});
  CHECK(
      refusal_of(gmap_of_chain(pinched)) ==
      "refused: dart 0 of level 0 lies below the darts 0 and 8 of level 2, which no gluing along cells of dimension 1 "
      "joins around it: this is no quasi-manifold");
  // A square with an edge at one of its vertices.
  const ChainOfMaps edge = chain_of(*GMap::make({{1, 0}, {0, 1}}));
  const ChainOfMaps flag = glued(disjoint_union(polygons({4}), edge), 0, 0, 4);
  CHECK(flag.cell_counts() == FVector{5, 5, 1});
  CHECK(homology_of(simplicial_analogue(flag)) == GroupNames{"Z"});
  CHECK(refusal_of(gmap_of_chain(flag)) ==
        "refused: dart 8 of level 1 lies below no dart of level 2: in a quasi-manifold all cells are cells of "
        "dimension 2 or "
        "lie in the boundary of one");
  // Its other end at the opposite vertex: a circle.
  CHECK(homology_of(simplicial_analogue(glued(flag, 0, 2, 4))) == GroupNames{"Z", "Z"});
  CHECK(*gmap_of_chain(polygons({4, 4})) == disjoint_union(polygon(4), polygon(4)));
  CHECK(disjoint_union(edge, polygons({4})).cell_counts() == FVector{6, 5, 1});
  CHECK(disjoint_union(ChainOfMaps(), edge) == edge);
}

TEST_CASE("a square glued to another one all along is a sphere, and then the faces may become one", "[maps]") {
  ChainOfMaps chain = polygons({4, 4});
  // Dart 2s of a square begins side s: glued in turn, each time by the darts that are left.
  std::vector<Dart> place(16);
  std::iota(place.begin(), place.end(), Dart{0});
  for (const Dart side : {0U, 2U, 4U, 6U}) {
    const Result<GluedChain> result = glue_cells(chain, 1, place[side], place[8 + side]);
    REQUIRE(result);
    for (Dart& each : place) {
      each = result->image[1][each];
    }
    chain = result->chain;
  }
  CHECK(chain.cell_counts() == FVector{4, 4, 2});
  CHECK(homology_of(simplicial_analogue(chain)) == GroupNames{"Z", "0", "Z"});
  const Result<GluedChain> one = glue_cells(chain, 2, 0, 8);
  REQUIRE(one);
  CHECK(one->chain == polygons({4}));
  CHECK(one->image[2][11] == 3);
  CHECK(one->image[1] == std::vector<Dart>{0, 1, 2, 3, 4, 5, 6, 7});
  // At once, from what lies beside each other.
  CHECK(glued(polygons({4, 4}), 2, 0, 8) == polygons({4}));
  CHECK(glued(polygons({4, 4}), 2, 0, 9) == polygons({4}));
}

TEST_CASE("a cell above those that are glued is glued along", "[maps]") {
  // Two cubes along a face, then along another one.
  const ChainOfMaps cubes =
      disjoint_union(chain_of(extended(surface_of_a_cube())), chain_of(extended(surface_of_a_cube())));
  REQUIRE(cubes.cell_counts() == FVector{16, 24, 12, 2});
  const Result<GluedChain> once = glue_cells(cubes, 2, 0, 48);
  REQUIRE(once);
  CHECK(once->chain.cell_counts() == FVector{12, 20, 11, 2});
  CHECK(homology_of(simplicial_analogue(once->chain)) == GroupNames{"Z"});
  CHECK(gmap_of_chain(once->chain)->alpha(3, 0) == 48);
  const Result<GluedChain> opposite = glue_cells(once->chain, 2, once->image[2][8], once->image[2][56]);
  REQUIRE(opposite);
  CHECK(opposite->chain.cell_counts() == FVector{8, 16, 10, 2});
  CHECK(homology_of(simplicial_analogue(opposite->chain)) == GroupNames{"Z", "Z"});
}

TEST_CASE("cells that cannot be glued are refused, naming darts", "[maps]") {
  const ChainOfMaps chain = polygons({4, 3, 3});
  CHECK(refusal_of(glue_cells(chain, 2, 0, 8)) ==
        "refused: 2-cells cannot be glued: dart 5 corresponds to dart 11, but by alpha_0 they lead to darts 4 and 10, "
        "and "
        "dart 4 corresponds to 12");
  CHECK(refusal_of(glue_cells(polygons({6, 3}), 2, 0, 12)) ==
        "refused: 2-cells cannot be glued: the cells of darts 0 and 12 have 12 and 6 darts");
  CHECK(refusal_of(glue_cells(chain, 2, 0, 3)) ==
        "refused: 2-cells cannot be glued: darts 0 and 3 are of one cell: a cell is glued to another one");
  CHECK(refusal_of(glue_cells(chain, 0, 0, 10)) == "bad input: there are no darts 0 and 10 of level 0");
  CHECK(refusal_of(glue_cells(chain, 3, 0, 1)) == "bad input: there are no darts 0 and 1 of level 3");
  // Two triangles along an edge; now one on the other such that the edge would be turned round.
  const Result<GluedChain> two = glue_cells(chain, 1, 8, 14);
  REQUIRE(two);
  CHECK(refusal_of(glue_cells(two->chain, 2, 8, 15))
            .starts_with("refused: 2-cells cannot be glued: in the result, condition (a): sigma_2 sends both dart 8 "
                         "and dart 9 of level "
                         "2 to 8, though one face has both"));
  CHECK(glue_cells(two->chain, 2, 8, 14));
}

TEST_CASE("what is no chain of maps is refused, naming the condition, the level and a dart", "[maps]") {
  const ChainOfMaps square = polygons({4});
  const auto with = [&](auto change) {
    LevelsAndFaces parts = parts_of(square);
    change(parts);
    return refusal_of(ChainOfMaps::make(std::move(parts.levels), std::move(parts.sigma)));
  };
  REQUIRE(with([](LevelsAndFaces&) {}) == "none");
  CHECK(with([](LevelsAndFaces& p) { p.sigma.pop_back(); }) ==
        "bad input: 3 levels have 1 lists of faces: each but level 0 has one");
  CHECK(with([](LevelsAndFaces& p) { p.levels[1] = GMap::points(8); }) ==
        "bad input: level 1 has 0 involutions: alpha_0 to alpha_0 would be right, 1 of them");
  CHECK(with([](LevelsAndFaces& p) { p.sigma[1].pop_back(); }) ==
        "bad input: sigma_2 has 7 images, but level 2 has 8 darts: each has one");
  CHECK(with([](LevelsAndFaces& p) { p.sigma[0][3] = 4; }) ==
        "bad input: sigma_1 sends dart 3 to 4, but level 0 has only 4 darts");
  CHECK(with([](LevelsAndFaces& p) { p.sigma[1][0] = 2; })
            .starts_with("bad input: condition (a): from dart 0 of level 2, alpha_0 and then sigma_2 lead to dart 1, "
                         "but sigma_2 and "
                         "then alpha_0 to 3"));
  CHECK(with([](LevelsAndFaces& p) {
          p.levels[1] = *GMap::make({{0, 1, 3, 2, 5, 4, 7, 6}}), p.sigma[1][1] = 0;
        }) ==
        "bad input: condition (a): sigma_2 sends both dart 0 and dart 1 of level 2 to 0, though one face has both: no "
        "cell "
        "may be folded");
  CHECK(
      with([](LevelsAndFaces& p) { std::swap(p.sigma[1][0], p.sigma[1][1]); }) ==
      "bad input: condition (b): sigma_2 sigma_1 lead from dart 0 of level 2 to dart 1, but from its image by alpha_1, "
      "dart 7, to 0");
}

TEST_CASE("levels and faces are a chain exactly when both conditions hold", "[maps]") {
  Random random(13);
  int chains = 0;
  int others = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const auto chain =
        chain_of_gmap(trial % 20 == 19 ? suspension_of(closed_polygon(3)) : random_surface_map(random, 2, false));
    if (!chain) {
      continue;
    }
    LevelsAndFaces parts = parts_of(*chain);
    for (int k = random.in(0, 2); k > 0; --k) {
      std::vector<Dart>& sigma =
          parts.sigma[static_cast<std::size_t>(random.in(0, static_cast<int>(parts.sigma.size()) - 1))];
      const auto any = [&] { return static_cast<std::size_t>(random.in(0, static_cast<int>(sigma.size()) - 1)); };
      sigma[any()] = sigma[any()];
    }
    const bool met = are_conditions_met(parts);
    const auto made = ChainOfMaps::make(parts.levels, parts.sigma);
    CHECK(made.has_value() == met);
    ++(met ? chains : others);
  }
  CHECK(chains > 50);
  CHECK(others > 50);
}

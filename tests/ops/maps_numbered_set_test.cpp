#include "tests/support/catch.hpp"
#include "tests/support/cell_models.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;

namespace {

struct Known {
  GMap map;
  FVector cells;
  FVector simplices;
  GroupNames homology;
};

/// Two triangles along an edge: vertices 0, 1 of the edge, then one for each triangle, numbered alike.
NumberedSet::Faces faces_of_two_triangles() {
  return {{{1, 0}, {2, 1}, {2, 0}, {3, 1}, {3, 0}}, {{1, 2, 0}, {3, 4, 0}}};
}

struct TrianglesAndEdges {
  std::vector<std::vector<SimplexNumber>> triangles;  // two with the same two vertices have that edge in common
  std::vector<std::vector<SimplexNumber>> edges;      // more edges, which are in no triangle
};

/// How many ways there are to number the vertices of an object, each with the faces in the order of its numbers.
int count_of_numberings(const TrianglesAndEdges& object, int vertices) {
  int count = 0;
  for (int code = 0; code < 81; ++code) {
    const std::vector<int> all{code % 3, code / 3 % 3, code / 9 % 3, code / 27};
    if (vertices == 3 && all[3] != 0) {
      continue;
    }
    const std::vector<int> numbers(all.begin(), all.begin() + vertices);
    const auto sorted = [&](std::vector<SimplexNumber> simplex) {
      std::ranges::stable_sort(simplex, {}, [&](SimplexNumber v) { return numbers[v]; });
      return simplex;
    };
    NumberedSet::Faces faces(2);
    std::map<std::vector<SimplexNumber>, SimplexNumber> edges;
    const auto edge = [&](SimplexNumber a, SimplexNumber b) {
      const auto [place, is_new] = edges.emplace(sorted({a, b}), faces[0].size());
      if (is_new) {
        faces[0].push_back({place->first[1], place->first[0]});
      }
      return place->second;
    };
    for (const auto& triangle : object.triangles) {
      const auto v = sorted(triangle);
      faces[1].push_back({edge(v[1], v[2]), edge(v[0], v[2]), edge(v[0], v[1])});
    }
    for (const auto& each : object.edges) {
      faces[0].push_back({sorted(each)[1], sorted(each)[0]});
    }
    count += NumberedSet::make(numbers, faces) ? 1 : 0;
  }
  return count;
}

}  // namespace

TEST_CASE("the analogues of known maps have their cells, simplices and homology", "[maps]") {
  const std::vector<Known> known{
      {sewn_square(torus_pairs), {1, 2, 1}, {4, 12, 8}, {"Z", "Z^2", "Z"}},
      {sewn_square(klein_bottle_pairs), {1, 2, 1}, {4, 12, 8}, {"Z", "Z + Z/2"}},
      {sewn_square(projective_plane_pairs), {2, 2, 1}, {5, 12, 8}, {"Z", "Z/2"}},
      {sewn_square(moebius_strip_pairs), {2, 3, 1}, {6, 14, 8}, {"Z", "Z"}},
      {sewn_square(annulus_pairs), {2, 3, 1}, {6, 14, 8}, {"Z", "Z"}},
      {sewn_square({}), {4, 4, 1}, {9, 16, 8}, {"Z"}},
      {surface_of_a_cube(), {8, 12, 6}, {26, 72, 48}, {"Z", "0", "Z"}},
      {extended(surface_of_a_cube()), {8, 12, 6, 1}, {27, 98, 120, 48}, {"Z"}},
      {suspension_of(surface_of_a_cube()), {8, 12, 6, 2}, {28, 124, 192, 96}, {"Z", "0", "0", "Z"}},
      {quad_torus(3), {9, 18, 9}, {36, 108, 72}, {"Z", "Z^2", "Z"}},
      {suspension_of(quad_torus(3)), {9, 18, 9, 2}, {38, 180, 288, 144}, {"Z", "0", "Z^2", "Z"}},
      {extended(sewn_square(projective_plane_pairs)), {2, 2, 1, 1}, {6, 17, 20, 8}, {"Z"}},
      {closed_polygon(5), {5, 5}, {10, 10}, {"Z", "Z"}},
      {GMap::points(3), {}, {}, {}},
  };
  for (const Known& each : known) {
    const NumberedSet set = simplicial_analogue(each.map);
    CAPTURE(each.cells, each.simplices);
    CHECK(set.cell_counts() == each.cells);
    CHECK(set.f_vector() == each.simplices);
    CHECK(homology_of(set) == each.homology);
  }
}

TEST_CASE("the suspension of a torus has the Euler characteristic 2 by its simplices, not by its cells", "[maps]") {
  const NumberedSet set = simplicial_analogue(suspension_of(quad_torus(3)));
  CHECK(set.euler_characteristic() == 2);
  CHECK(simplicial_analogue(quad_torus(3)).euler_characteristic() == 0);
  CHECK(NumberedSet().euler_characteristic() == 0);
}

TEST_CASE("the simplices of an analogue numbered I are orbits of the other involutions", "[maps]") {
  Random random(1);
  for (int trial = 0; trial < 60; ++trial) {
    const GMap map = trial % 10 == 9 ? random_cubes(random, 2) : random_surface_map(random, random.in(1, 8), false);
    const NumberedSet set = simplicial_analogue(map);
    std::map<IndexSet, std::uint32_t> counts;
    for (int p = 0; p <= set.dimension(); ++p) {
      for (SimplexNumber s = 0; s < set.count(p); ++s) {
        ++counts[set.numbers(p, s)];
      }
    }
    std::map<IndexSet, std::uint32_t> expected;
    for (IndexSet numbers = 1; numbers <= map.indices(); ++numbers) {
      expected[numbers] = orbits(map, map.indices() & ~numbers).count();
    }
    CHECK(counts == expected);
    // A principal simplex is a dart, and shares its face k exactly with the dart beyond alpha_k.
    const int n = map.dimension();
    REQUIRE(set.count(n) == map.size());
    for (Dart d = 0; d < map.size(); ++d) {
      for (int k = 0; k <= n; ++k) {
        const auto at = static_cast<std::size_t>(k);
        for (Dart e = 0; e < map.size(); ++e) {
          CHECK((set.faces(n, d)[at] == set.faces(n, e)[at]) == (d == e || e == map.alpha(k, d)));
        }
      }
    }
  }
}

TEST_CASE("a cell is the cone over its canonical boundary", "[maps]") {
  Random random(2);
  for (int trial = 0; trial < 30; ++trial) {
    const GMap map = trial % 10 == 9 ? random_cubes(random, 1) : random_surface_map(random, random.in(1, 8), false);
    const NumberedSet set = simplicial_analogue(map);
    FVector together(set.f_vector().size());
    for (SimplexNumber v = 0; v < set.count(0); ++v) {
      const auto cell = set.cell(v);
      const NumberedSet boundary = set.canonical_boundary(v);
      REQUIRE(static_cast<int>(cell.size()) == set.number_of_vertex(v) + 1);
      CHECK(boundary.dimension() == set.number_of_vertex(v) - 1);
      for (std::size_t p = 0; p < cell.size(); ++p) {
        together[p] += static_cast<std::uint32_t>(cell[p].size());
        CHECK(cell[p].size() == (p == 0 ? 1 : boundary.count(static_cast<int>(p) - 1)));
      }
    }
    CHECK(together == set.f_vector());  // each simplex is in the cell of its vertex with the largest number
  }
}

TEST_CASE("canonical boundaries are not glued where the object is", "[maps]") {
  const NumberedSet torus = simplicial_analogue(sewn_square(torus_pairs));
  CHECK(torus.canonical_boundary(3).f_vector() == FVector{8, 8});
  CHECK(homology_of(torus.canonical_boundary(3)) == GroupNames{"Z", "Z"});
  CHECK(torus.canonical_boundary(1).f_vector() == FVector{2});
  CHECK(torus.canonical_boundary(0).dimension() == -1);
  const NumberedSet solid = simplicial_analogue(extended(sewn_square(projective_plane_pairs)));
  CHECK(homology_of(solid.canonical_boundary(solid.count(0) - 1)) == GroupNames{"Z", "Z/2"});
}

TEST_CASE("a 3-cell over an annulus is a cone, not a solid cylinder, and its apex is no point of a manifold",
          "[maps]") {
  const NumberedSet set = simplicial_analogue(extended(sewn_square(annulus_pairs)));
  CHECK(homology_of(set) == GroupNames{"Z"});
  const NumberedSet boundary = set.canonical_boundary(set.count(0) - 1);
  CHECK(boundary.cell_counts() == FVector{2, 3, 1});
  CHECK(homology_of(boundary) == GroupNames{"Z", "Z"});
}

TEST_CASE("a numbered set may have principal simplices of several dimensions", "[maps]") {
  // A triangle, an edge at its vertex numbered 0, and a point.
  const auto set = NumberedSet::make({0, 1, 2, 1, 0}, {{{1, 0}, {2, 1}, {2, 0}, {3, 0}}, {{1, 2, 0}}, {}});
  REQUIRE(set);
  CHECK(set->dimension() == 2);
  CHECK(set->f_vector() == FVector{5, 4, 1});
  CHECK(set->cell_counts() == FVector{2, 2, 1});
  CHECK(set->numbers(2, 0) == 7);
  CHECK(set->vertices(2, 0) == std::vector<SimplexNumber>{0, 1, 2});
  CHECK(homology_of(*set) == GroupNames{"Z^2"});
}

TEST_CASE("faces of a numbered set lack the numbers in increasing order", "[maps]") {
  const NumberedSet set = simplicial_analogue(suspension_of(surface_of_a_cube()));
  for (int p = 1; p <= set.dimension(); ++p) {
    for (SimplexNumber s = 0; s < set.count(p); ++s) {
      for (std::size_t k = 0; k <= static_cast<std::size_t>(p); ++k) {
        std::vector<SimplexNumber> rest = set.vertices(p, s);
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
        REQUIRE(set.vertices(p - 1, set.faces(p, s)[k]) == rest);
      }
    }
  }
}

TEST_CASE("a set that breaks a law of numbered sets is refused, naming the law and the simplex", "[maps]") {
  const std::vector<int> numbers{0, 1, 2, 2};
  REQUIRE(NumberedSet::make(numbers, faces_of_two_triangles()));
  const auto with = [&](auto change) {
    std::vector<int> changed_numbers = numbers;
    NumberedSet::Faces faces = faces_of_two_triangles();
    change(changed_numbers, faces);
    return refusal_of(NumberedSet::make(changed_numbers, faces));
  };
  CHECK(with([](auto&, auto& f) { f[1][1].pop_back(); }) == "bad input: 2-simplex 1 has 2 faces: 3 are right");
  CHECK(with([](auto&, auto& f) { f[1][1][2] = 5; }) ==
        "bad input: face 2 of 2-simplex 1 is 5, but there are only 5 simplices of dimension 1");
  CHECK(with([](auto&, auto& f) { f[0][0][1] = 4; }) ==
        "bad input: face 1 of 1-simplex 0 is 4, but there are only 4 simplices of dimension 0");
  CHECK(with([](auto&, auto& f) { f[1][1][0] = 1; }) ==
        "bad input: faces of 2-simplex 1 do not agree: face 0 of its face 1 is 3, but face 0 of its face 0 is 2");
  CHECK(with([](auto&, auto& f) {
          std::swap(f[0][0][0], f[0][0][1]);
        }).starts_with("bad input: faces of 2-simplex 0 do not agree: "));
  CHECK(with([](auto& n, auto&) { n[3] = 1; }) ==
        "bad input: edge 3 has a vertex numbered 1 as face 0, and one numbered 1 as face 1: face 0 is the one with the "
        "larger number");
  CHECK(with([](auto& n, auto&) { n[3] = 3; }) ==
        "bad input: 2-simplex 1 is no face of another one and numbered 0, 1, 3: it should be numbered 0 to 2");
  CHECK(with([](auto& n, auto&) { n[3] = 31; }) == "bad input: vertex 3 has the number 31: 0 to 30 are possible");
  CHECK(with([](auto& n, auto&) { n[3] = -1; }) == "bad input: vertex 3 has the number -1: 0 to 30 are possible");
  CHECK(with([](auto& n, auto&) { n.push_back(1); }) ==
        "bad input: 0-simplex 4 is no face of another one and numbered 1: it should be numbered 0 to 0");
}

TEST_CASE("not every set of complete simplices has numbers", "[maps]") {
  // A triangle; three triangles around a vertex; and a triangle with a second edge between two of its vertices, twice.
  CHECK(count_of_numberings({{{0, 1, 2}}, {}}, 3) == 6);
  CHECK(count_of_numberings({{{0, 1, 3}, {1, 2, 3}, {0, 2, 3}}, {}}, 4) == 0);
  CHECK(count_of_numberings({{{0, 1, 2}}, {{0, 1}, {1, 2}}}, 3) == 0);
  CHECK(count_of_numberings({{{0, 1, 2}}, {{0, 1}}}, 3) == 2);
  // A triangle whose vertices are one, as in a torus of two triangles.
  CHECK(refusal_of(NumberedSet::make({0}, {{{0, 0}}, {{0, 0, 0}}})) ==
        "bad input: edge 0 has a vertex numbered 0 as face 0, and one numbered 0 as face 1: face 0 is the one with the "
        "larger number");
}

TEST_CASE("simplices with the same vertices are found, of least dimension first", "[maps]") {
  CHECK_FALSE(simplicial_analogue(suspension_of(surface_of_a_cube())).multi_incidence());
  const auto torus = simplicial_analogue(sewn_square(torus_pairs)).multi_incidence();
  REQUIRE(torus);
  CHECK(torus->dimension == 1);
  // One edge folded: two darts have the same cells, and all edges of the analogue are alone.
  const GMap folded = std::move(*GMap::make({{1, 0}, {1, 0}, {1, 0}}));
  const auto found = simplicial_analogue(folded).multi_incidence();
  REQUIRE(found);
  CHECK(found->dimension == 2);
  CHECK(found->one == 0);
  CHECK(found->other == 1);
}

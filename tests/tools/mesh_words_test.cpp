/// Polygons that meet a corner more than once are discs glued along the word that their corners spell.
#include <algorithm>
#include <random>
#include <sstream>

#include "engine/engine.hpp"
#include "replay/script/script.hpp"
#include "tests/support/catch.hpp"
#include "tests/tools/mesh_support.hpp"
#include "tools/mesh/mesh_homology.hpp"
#include "tools/mesh/normalise.hpp"
#include "tools/mesh/script.hpp"
#include "tools/mesh/triangulate.hpp"
#include "tools/mesh/validity.hpp"

namespace sesame::tools {

namespace {

using Catch::Matchers::Contains;
using sparse::Integer;
using Numbers = std::vector<std::int64_t>;
using Words = std::vector<std::vector<std::uint32_t>>;

struct Space {
  std::string name;
  Words words;
  Numbers betti;                             ///< over Z
  std::vector<Numbers> torsion{{}, {}, {}};  ///< over Z
  Numbers betti_modulo_2 = betti;
  std::vector<std::size_t> cells;       ///< points, edges, polygons
  std::vector<std::size_t> edge_kinds;  ///< boundary, non-manifold, reversed
  bool is_manifold = true, is_orientable = true;
};

const std::vector<Space> spaces{
    {.name = "square with a hole, through a bridge",
     .words = {{0, 1, 2, 3, 0, 4, 7, 6, 5, 4}},
     .betti = {1, 1, 0},
     .cells = {8, 9, 1},
     .edge_kinds = {8, 0, 0}},
    {.name = "square with two holes",
     .words = {{0, 1, 2, 3, 0, 4, 6, 5, 4, 0, 7, 9, 8, 7}},
     .betti = {1, 2, 0},
     .cells = {10, 12, 1},
     .edge_kinds = {10, 0, 0}},
    {.name = "disc with a spur",
     .words = {{0, 1, 2, 0, 3}},
     .betti = {1, 0, 0},
     .cells = {4, 4, 1},
     .edge_kinds = {3, 0, 0}},
    {.name = "disc pinched at a point",
     .words = {{0, 1, 2, 0, 3, 4}},
     .betti = {1, 1, 0},
     .cells = {5, 6, 1},
     .edge_kinds = {6, 0, 0},
     .is_manifold = false},
    {.name = "twice around a triangle: the projective plane",
     .words = {{0, 1, 2, 0, 1, 2}},
     .betti = {1, 0, 0},
     .torsion = {{}, {2}, {}},
     .betti_modulo_2 = {1, 1, 1},
     .cells = {3, 3, 1},
     .edge_kinds = {0, 0, 3},
     .is_orientable = false},
    {.name = "three times around a triangle",
     .words = {{0, 1, 2, 0, 1, 2, 0, 1, 2}},
     .betti = {1, 0, 0},
     .torsion = {{}, {3}, {}},
     .cells = {3, 3, 1},
     .edge_kinds = {0, 3, 0},
     .is_manifold = false},
    {.name = "dunce hat",
     .words = {{0, 1, 2, 0, 1, 2, 0, 2, 1}},
     .betti = {1, 0, 0},
     .cells = {3, 3, 1},
     .edge_kinds = {0, 3, 0},
     .is_manifold = false},
    {.name = "torus from one polygon",
     .words = {{0, 1, 2, 0, 3, 4, 0, 2, 1, 0, 4, 3}},
     .betti = {1, 2, 1},
     .cells = {5, 6, 1},
     .edge_kinds = {0, 0, 0}},
    {.name = "Klein bottle from one polygon",
     .words = {{0, 1, 2, 0, 3, 4, 0, 1, 2, 0, 4, 3}},
     .betti = {1, 1, 0},
     .torsion = {{}, {2}, {}},
     .betti_modulo_2 = {1, 2, 1},
     .cells = {5, 6, 1},
     .edge_kinds = {0, 0, 3},
     .is_orientable = false},
    {.name = "surface of genus two from one polygon",
     .words = {{0, 1, 2, 0, 3, 4, 0, 2, 1, 0, 4, 3, 0, 5, 6, 0, 7, 8, 0, 6, 5, 0, 8, 7}},
     .betti = {1, 4, 1},
     .cells = {9, 12, 1},
     .edge_kinds = {0, 0, 0}},
    {.name = "two discs along the same walk twice around: Z/2 and a sphere",
     .words = {{0, 1, 2, 0, 1, 2}, {0, 1, 2, 0, 1, 2, 3, 2}},
     .betti = {1, 0, 1},
     .torsion = {{}, {2}, {}},
     .betti_modulo_2 = {1, 1, 2},
     .cells = {4, 4, 2},
     .edge_kinds = {0, 3, 0},
     .is_manifold = false},
    {.name = "a boundary that takes back every step: a sphere",
     .words = {{0, 1, 0, 2}},
     .betti = {1, 0, 1},
     .cells = {3, 2, 1},
     .edge_kinds = {0, 0, 0}},
    {.name = "there and back twice: a sphere on an edge of four sides",
     .words = {{0, 1, 0, 1}},
     .betti = {1, 0, 1},
     .cells = {2, 1, 1},
     .edge_kinds = {0, 1, 0},
     .is_manifold = false},
    {.name = "sides without length vanish",
     .words = {{0, 0, 1, 1, 1, 2, 0}},
     .betti = {1, 0, 0},
     .cells = {3, 3, 1},
     .edge_kinds = {3, 0, 0}},
    {.name = "triangles without area are no discs",
     .words = {{0, 1, 2}, {0, 1, 0}, {2, 2, 1}, {1, 1, 1}, {1}},
     .betti = {1, 0, 0},
     .cells = {3, 3, 1},
     .edge_kinds = {3, 0, 0}},
    {.name = "box with a hole right through it: two of its faces are rings",
     .words = {{0, 1, 2, 3, 0, 8, 11, 10, 9, 8},
               {4, 12, 13, 14, 15, 12, 4, 7, 6, 5},
               {0, 4, 5, 1},
               {1, 5, 6, 2},
               {2, 6, 7, 3},
               {3, 7, 4, 0},
               {8, 9, 13, 12},
               {9, 10, 14, 13},
               {10, 11, 15, 14},
               {11, 8, 12, 15}},
     .betti = {1, 2, 1},
     .cells = {16, 26, 10},
     .edge_kinds = {0, 0, 0}},
};

/// The sixteen corners of a box of 3 by 3 by 1 with a hole of 1 by 1; shapes with fewer points take the first.
Mesh mesh_of(const Words& words) {
  std::uint32_t points = 0;
  for (const auto& word : words) {
    points = std::max(points, 1 + *std::max_element(word.begin(), word.end()));
  }
  Mesh mesh;
  for (const auto& [low, high] : {std::pair{0.0, 3.0}, std::pair{1.0, 2.0}}) {
    for (const double z : {0.0, 1.0}) {
      mesh.points.insert(mesh.points.end(), {{low, low, z}, {high, low, z}, {high, high, z}, {low, high, z}});
    }
  }
  mesh.points.resize(points);
  for (const auto& word : words) {
    mesh.faces.push_face(word);
  }
  return mesh;
}

std::vector<Numbers> as_numbers(const std::vector<std::vector<Integer>>& torsion) {
  std::vector<Numbers> result;
  for (const auto& degree : torsion) {
    auto& factors = result.emplace_back();
    for (const Integer& factor : degree) {
      factors.push_back(factor.to_int64().value());
    }
  }
  return result;
}

using Writer = Result<ScriptSummary> (*)(const Mesh&, std::ostream&, const ScriptOptions&);

engine::Homology replayed(Writer write, const Mesh& mesh, Polygons polygons, const sparse::AnyRing& ring) {
  std::stringstream text;
  REQUIRE(write(mesh, text, {.source = "words.off", .polygons = polygons}));
  replay::ScriptReader reader{replay::ByteSource::of_text(text.view(), "words.off")};
  REQUIRE(reader.header());
  engine::Engine engine{ring};
  for (auto operation = reader.next();; operation = reader.next()) {
    REQUIRE(operation);
    if (!operation->has_value()) {
      return engine.homology();
    }
    const auto report = engine.apply(**operation);
    INFO((report ? std::string{} : report.error().what));
    REQUIRE(report);
  }
}

void check_groups(const engine::Homology& found, const Space& space, bool modulo_2) {
  CHECK(found.betti == (modulo_2 ? space.betti_modulo_2 : space.betti));
  if (!modulo_2) {
    CHECK(as_numbers(found.torsion) == space.torsion);
  }
}

}  // namespace

TEST_CASE("a polygon has the homology of a disc glued along its corners, in every form it is built in", "[mesh]") {
  const auto space = GENERATE(from_range(spaces));
  const bool modulo_2 = GENERATE(false, true);
  INFO(space.name << (modulo_2 ? " over Z/2" : " over Z"));
  const sparse::AnyRing ring = modulo_2 ? sparse::AnyRing{sparse::Z2{}} : sparse::AnyRing{sparse::Integers{}};
  const Mesh mesh = mesh_of(space.words);
  const auto found = mesh_homology(mesh, {"words.off", ring, true});
  REQUIRE(found);
  check_groups(found->homology, space, modulo_2);
  for (const auto write : {write_complex_script, write_assembled_script}) {
    for (const auto polygons : {Polygons::fan, Polygons::cone}) {
      check_groups(replayed(write, mesh, polygons, ring), space, modulo_2);
    }
  }
}

TEST_CASE("the report on a polygon that meets itself is about the surface, not about the word", "[mesh]") {
  const auto space = GENERATE(from_range(spaces));
  INFO(space.name);
  const Validity found = validate(mesh_of(space.words));
  CHECK(std::vector{found.vertices, found.edges, found.faces} == space.cells);
  CHECK(std::vector{found.boundary_edges, found.non_manifold_edges, found.reversed_edges} == space.edge_kinds);
  CHECK(found.is_manifold() == space.is_manifold);
  CHECK(found.is_orientable() == space.is_orientable);
  CHECK(found.is_closed() == (space.edge_kinds[0] == 0));
  long long alternating = 0;
  for (std::size_t p = 0; p < space.betti.size(); ++p) {
    alternating += (p % 2 == 0 ? 1 : -1) * space.betti[p];
  }
  CHECK(found.euler() == alternating);
}

TEST_CASE("holes through bridges are boundary loops, and loops through polygons are handles", "[mesh]") {
  const Validity two_holes = validate(mesh_of(spaces[1].words));
  CHECK(two_holes.boundary_loops == 3);
  CHECK(two_holes.components.at(0).genus() == 0);
  CHECK(validate(mesh_of(spaces[9].words)).components.at(0).genus() == 2);
  CHECK(validate(mesh_of(spaces.back().words)).components.at(0).genus() == 1);
}

TEST_CASE("area, volume and centre of a box with a hole do not depend on how its faces are cut", "[mesh]") {
  const auto found = mesh_homology(mesh_of(spaces.back().words), {"box.off", sparse::Integers{}, true});
  REQUIRE(found);
  const auto& surface = found->generators.back();
  REQUIRE(surface.degree == 2);
  CHECK(surface.area.to_double() == Approx(2 * 8 + 12 + 4));
  CHECK(std::abs(surface.volume.value().to_double()) == Approx(8));
  CHECK(surface.centre[0] == Approx(1.5));
  CHECK(surface.centre[1] == Approx(1.5));
  CHECK(surface.centre[2] == Approx(0.5));
}

TEST_CASE("cutting polygons changes nothing in the report but the numbers of cells", "[mesh]") {
  std::mt19937 random{20};
  const auto below = [&random](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  for (int round = 0; round < 400; ++round) {
    Words words(1 + below(4));
    for (auto& word : words) {
      for (auto corners = 1 + below(10); corners > 0; --corners) {
        word.push_back(below(3 + below(9)));
      }
    }
    Mesh polygons = mesh_of(words);
    normalise(polygons);
    const Validity before = validate(polygons);
    for (const auto how : {Polygons::fan, Polygons::cone}) {
      Mesh triangles = polygons;
      const auto face_of_triangle = triangulate(triangles, how);
      REQUIRE(face_of_triangle.size() == triangles.faces.size());
      REQUIRE(std::is_sorted(face_of_triangle.begin(), face_of_triangle.end()));
      const Validity after = validate(triangles);
      INFO("round " << round);
      CHECK(after.faces == triangles.faces.size());
      CHECK(after.euler() == before.euler());
      CHECK(after.boundary_edges == before.boundary_edges);
      CHECK(after.boundary_loops == before.boundary_loops);
      CHECK(after.non_manifold_edges == before.non_manifold_edges);
      CHECK(after.non_manifold_vertices == before.non_manifold_vertices);
      CHECK(after.reversed_edges == before.reversed_edges);
      REQUIRE(after.components.size() == before.components.size());
      for (std::size_t c = 0; c < after.components.size(); ++c) {
        CHECK(after.components[c].is_manifold == before.components[c].is_manifold);
        CHECK(after.components[c].is_orientable == before.components[c].is_orientable);
        CHECK(after.components[c].genus() == before.components[c].genus());
      }
    }
  }
}

TEST_CASE("no face is left out without being counted", "[mesh]") {
  for (const auto& space : spaces) {
    INFO(space.name);
    const Validity found = validate(mesh_of(space.words));
    CHECK(found.faces_in_file ==
          found.faces + found.cleaning.degenerate_faces + found.cleaning.duplicate_faces + found.cleaning.segments);
    CHECK(found.left_out_faces().empty() == (found.faces_in_file == found.faces));
  }
  auto degenerate = mesh_of(spaces[14].words);
  CHECK(validate(degenerate).left_out_faces() == "left out 4 of 5 faces (4 degenerate, 0 duplicate)");
}

TEST_CASE("the same walk from another corner, or backwards, is the same polygon", "[mesh]") {
  const std::vector<std::uint32_t> word{0, 2, 0, 1, 3, 0, 2, 1};
  for (std::size_t turn = 0; turn < word.size(); ++turn) {
    auto turned = word;
    std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(turn), turned.end());
    Mesh mesh = mesh_of({word, turned, {turned.rbegin(), turned.rend()}});
    const auto cleaning = normalise(mesh);
    CHECK(cleaning.duplicate_faces == 2);
    CHECK_THAT(mesh.remarks.at(0), Contains("left out 2 duplicate faces"));
  }
  Mesh different = mesh_of({{0, 1, 2, 0, 1, 2}, {0, 1, 2}, {0, 1, 2, 0, 2, 1}, {0, 1, 2, 0, 1, 2, 0, 1, 2}});
  CHECK(normalise(different).duplicate_faces == 0);
}

TEST_CASE("a polygon of very many corners that are all alike is read in time", "[mesh]") {
  std::vector<std::uint32_t> word;
  for (std::uint32_t i = 0; i < 200'000; ++i) {
    word.push_back(i % 2 == 0 ? 0 : 1 + i % 3);
  }
  Mesh mesh = mesh_of({word, {word.rbegin(), word.rend()}});
  CHECK(normalise(mesh).duplicate_faces == 1);
}

}  // namespace sesame::tools

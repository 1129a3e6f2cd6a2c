// What becomes of the equivalence where a closed map bounds a cell, and where cells are glued: S. Peltier, habilitation
// (2023), figures 3.21 to 3.23. Of a cell only its boundary is asked; gluing changes the equivalence of none.
#include <numeric>
#include <string>
#include <vector>

#include "tests/support/cell_models.hpp"
#include "tests/support/engines.hpp"
#include "tests/support/solids.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

std::uint64_t all_of(const std::vector<std::uint64_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}
std::uint64_t generators_of_big(Engine& engine) {
  const auto homology = engine.homology();
  return all_of({homology.big.begin(), homology.big.end()});
}
std::uint64_t number_of_cells(Engine& engine) { return all_of({engine.cells().begin(), engine.cells().end()}); }

void check_laws(Engine& engine) {
  REQUIRE(engine.first_defect().value_or("") == "");
  REQUIRE(live_groups(engine) ==
          std::visit([&](const auto& r) { return groups_from_scratch(engine.structure(), r); }, engine.ring()));
}

}  // namespace

TEST_CASE("a closed map that bounds a cell has one generator more, and what it was a boundary of is a cone") {
  Engine engine(ring_named("Z"));
  build(engine, {R"({"op":"gmap","name":"c","alpha":[[1,0,3,2,5,4,7,6],[7,2,1,4,3,6,5,0]]})"});  // the rim of a square
  CHECK(engine.homology().betti == std::vector<std::int64_t>{1, 1});
  const std::uint64_t before = generators_of_big(engine);
  carry_out(engine, ops::Extend{{"c"}});
  CHECK(generators_of_big(engine) == before + 1);
  CHECK(engine.homology().betti == std::vector<std::int64_t>{1, 0, 0});
  check_laws(engine);
  carry_out(engine, make_map("s", map_of_faces(cube_faces())));
  CHECK(engine.homology().betti == std::vector<std::int64_t>{2, 0, 1});
  const std::uint64_t with_surface = generators_of_big(engine);
  carry_out(engine, ops::Extend{{"s"}});
  CHECK(generators_of_big(engine) == with_surface + 1);
  CHECK(engine.homology().betti == std::vector<std::int64_t>{2, 0, 0, 0});
  check_laws(engine);
}

TEST_CASE("a cell over a Klein bottle is a cone, by its simplices and by itself") {
  for (const std::string ring : {"Z", "Z/2"}) {
    Engine engine(ring_named(ring));
    carry_out(engine, make_map("k", klein_bottle_of_a_square().extended(), true));
    CHECK(engine.homology().betti == std::vector<std::int64_t>{1, 0, 0, 0});
    check_laws(engine);
    carry_out(engine, make_map("c", klein_bottle_of_a_square().extended()));
    CHECK(engine.homology().betti == std::vector<std::int64_t>{2, 0, 0, 0});
    check_laws(engine);
  }
}

TEST_CASE("cells that are glued add a generator for each cell, simplex by simplex or ball by ball, that goes") {
  const bool by_simplices = GENERATE(false, true);
  const std::string ring = GENERATE("Z", "Z/2");
  CAPTURE(by_simplices, ring);
  Engine engine(ring_named(ring));
  const auto sew_and_check = [&](int dimension, const std::string& one, const std::string& other, std::uint64_t gone) {
    const std::uint64_t cells = number_of_cells(engine), generators = generators_of_big(engine);
    carry_out(engine, sew_darts(dimension, one, other));
    CHECK(number_of_cells(engine) == cells - gone);
    CHECK(generators_of_big(engine) == generators + gone);
    check_laws(engine);
  };
  carry_out(engine, ops::MakePolygon{"a", 4, by_simplices});
  carry_out(engine, ops::MakePolygon{"b", 4, by_simplices});
  sew_and_check(2, "a:0", "b:1", by_simplices ? 5 : 3);  // an edge, of two halves, and its three or two vertices
  carry_out(engine, make_map("c", solid_of(cube_faces()), by_simplices));
  carry_out(engine, make_map("d", solid_of(cube_faces()), by_simplices));
  sew_and_check(3, "c:0", "d:0", by_simplices ? 9 + 16 + 8 : 9);
  CHECK(engine.homology().betti == std::vector<std::int64_t>{2, 0, 0, 0});
}

TEST_CASE("cells over Klein bottles are glued along these to their suspension") {
  Engine engine(ring_named("Z"));
  const GMap cone = klein_bottle_of_a_square().extended();
  carry_out(engine, make_map("k", cone, true));
  carry_out(engine, make_map("l", cone, true));
  const std::uint64_t cells = number_of_cells(engine), generators = generators_of_big(engine);
  carry_out(engine, sew_darts(3, "k:0", "l:0"));
  const std::uint64_t of_klein_bottle = 4 + 12 + 8;
  CHECK(number_of_cells(engine) == cells - of_klein_bottle);
  CHECK(generators_of_big(engine) == generators + of_klein_bottle);
  const engine::Homology homology = engine.homology();
  CHECK(homology.betti == std::vector<std::int64_t>{1, 0, 1, 0});
  CHECK(homology.torsion[2] == std::vector<Integer>{2});
  check_laws(engine);
  carry_out(engine, ops::Undo{1});
  CHECK(number_of_cells(engine) == cells);
  check_laws(engine);
}

TEST_CASE("a cube, a square and a cell over a Klein bottle are glued in one object") {
  const std::string ring = GENERATE("Z", "Z/2");
  Engine engine(ring_named(ring));
  carry_out(engine, make_map("k", klein_bottle_of_a_square().extended(), true));
  carry_out(engine, make_map("c", solid_of(cube_faces()), true));
  carry_out(engine, ops::MakePolygon{"s", 4, false});
  // A face of the cube onto the Klein bottle, whose sides are glued already: then those of the face are, too.
  carry_out(engine, sew_darts(3, "c:0", "k:0"));
  CHECK(engine.homology().betti == std::vector<std::int64_t>{2, 0, 0, 0});
  check_laws(engine);
  // The square, a ball by itself, on a vertex and on the two halves of an edge: that is an edge and vertices of
  // simplices.
  carry_out(engine, R"({"op":"identify","pairs":[["s.0:0","c.<0>:8"]]})");
  CHECK(engine.homology().betti == std::vector<std::int64_t>{1, 0, 0, 0});
  carry_out(engine, R"({"op":"identify","pairs":[["s.1:1","c.<0-1>:9"]]})");
  check_laws(engine);
  const auto refused = engine.apply(sew_darts(3, "s:0", "c:8"));
  REQUIRE_FALSE(refused);
  CHECK(refused.error().what.find("same dimension") != std::string::npos);
}

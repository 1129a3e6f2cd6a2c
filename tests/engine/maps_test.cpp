// Maps by their cells: one generator for each, live, against their simplicial analogues and Smith forms.
#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/engines.hpp"
#include "tests/support/groups.hpp"
#include "tests/support/plain_maps.hpp"
#include "tests/support/random_steps.hpp"
#include "tests/support/sewn_maps.hpp"
#include "tests/support/solids.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

std::vector<std::uint64_t> counts(const Engine& engine) {
  const auto cells = engine.cells();
  return {cells.begin(), cells.end()};
}

std::string refusal(Engine& engine, const ops::Operation& op) {
  const std::string before = dump(engine);
  const auto report = engine.apply(op);
  if (report) {
    return "";
  }
  CHECK(dump(engine) == before);
  return report.error().what;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a polygon is one face with its sides and corners, which answer to their darts") {
  Engine engine(ring_named("Z"));
  carry_out(engine, R"({"op":"polygon","name":"p","sides":5})");
  CHECK(counts(engine) == std::vector<std::uint64_t>{5, 5, 1});
  CHECK(engine.structure().lookup("p") == engine.structure().lookup("p.2:7"));
  CHECK(engine.structure().lookup("p.1:2") == engine.structure().lookup("p.1:3"));
  CHECK(engine.structure().lookup("p.0:1") == engine.structure().lookup("p.0:2"));
  CHECK(engine.structure().lookup("p.0:1") != engine.structure().lookup("p.0:3"));
  CHECK_FALSE(engine.structure().lookup("p.1:10").has_value());
  CHECK_FALSE(engine.structure().lookup("p.3:0").has_value());
  CHECK(live_groups(engine).size() == 1);
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("a cell of a map is oriented so that the dart in its name counts once") {
  Engine engine(ring_named("Z"));
  carry_out(engine, R"({"op":"polygon","name":"p","sides":4})");
  const auto boundary = [&](const std::string& name) {
    const auto denoted = engine.structure().denoted(name).value();
    const int sign = engine.structure().maps().sign(denoted.order);
    CellChain chain = engine.maps().boundary({engine.structure().dimension(denoted.node), {{sign, denoted.node}}});
    return chain;
  };
  CHECK(boundary("p.1:2").terms != boundary("p.1:3").terms);
  const auto corner = engine.structure().lookup("p.0:2").value();
  const CellChain edge = boundary("p.1:2");
  CHECK(std::ranges::count_if(edge.terms, [&](const auto& term) {
          return term.generator == corner && term.coefficient == sparse::Rational{1};
        }) == 1);
}

TEST_CASE("surfaces of one square have their groups, by cells and by simplices") {
  const auto [map, betti, torsion] =
      GENERATE(table<GMap, std::vector<std::int64_t>, int>({{torus_of_a_square(), {1, 2, 1}, 0},
                                                            {klein_bottle_of_a_square(), {1, 1, 0}, 2},
                                                            {projective_plane_of_a_square(), {1, 0, 0}, 2}}));
  const bool as_simplices = GENERATE(false, true);
  Engine engine(ring_named("Z"));
  carry_out(engine, make_map("m", map, as_simplices));
  const engine::Homology homology = engine.homology();
  CHECK(homology.betti == betti);
  CHECK(homology.torsion[1] == (torsion == 0 ? std::vector<Integer>{} : std::vector<Integer>{torsion}));
  CHECK(engine.first_defect().value_or("") == "");
  if (!as_simplices) {
    CHECK(counts(engine)[2] == 1);
  }
}

TEST_CASE("polygons sewn at random have the groups of their simplicial analogues after every sewing") {
  const auto seed = GENERATE(range(0U, 12U));
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  CAPTURE(seed, ring);
  Random random(seed);
  Sewn sewn(ring_named(ring), 2);
  const int faces = random.in(1, 5);
  for (int k = 0; k < faces; ++k) {
    sewn.make("p" + std::to_string(k), ops::polygon(static_cast<Dart>(random.in(1, 6))));
  }
  sew_at_random(sewn, random, 60);
}

TEST_CASE("solids sewn at random have the groups of their simplicial analogues after every sewing") {
  const auto seed = GENERATE(range(0U, 8U));
  const std::string ring = GENERATE("Z", "Z/2");
  CAPTURE(seed, ring);
  Random random(seed);
  Sewn sewn(ring_named(ring), 3);
  const int solids = random.in(1, 3);
  for (int k = 0; k < solids; ++k) {
    const std::vector<Polygons> kinds{tetrahedron_faces(), cube_faces(), prism_faces(3), pyramid_faces(4)};
    sewn.make("s" + std::to_string(k), solid_of(kinds[static_cast<std::size_t>(random.in(0, 3))]));
  }
  sew_at_random(sewn, random, 60);
}

TEST_CASE("the three-sphere of two cubes has one cell for each of theirs") {
  Engine engine(ring_named("Z"));
  carry_out(engine, make_map("a", solid_of(cube_faces())));
  carry_out(engine, make_map("b", solid_of(cube_faces())));
  for (Dart face = 0; face < 6; ++face) {
    carry_out(engine, sew_darts(3, dart_name("a", 8 * face), dart_name("b", 8 * face)));
    CHECK(engine.first_defect().value_or("") == "");
  }
  CHECK(counts(engine) == std::vector<std::uint64_t>{8, 12, 6, 2});
  CHECK(engine.homology().betti == std::vector<std::int64_t>{1, 0, 0, 1});
  CHECK(engine.euler_characteristic() == 0);
}

TEST_CASE("a map with a face that is no ball is refused by cells, naming its dart, and goes in by simplices") {
  Engine engine(ring_named("Z"));
  const GMap folded = square_with({1, 0, 2, 3, 4, 5, 6, 7});
  CHECK(has(refusal(engine, make_map("m", folded)), "is open or folded"));
  carry_out(engine, make_map("m", folded, true));
  CHECK(engine.homology().betti == std::vector<std::int64_t>{1, 0, 0});  // a cone
}

TEST_CASE("maps of two dimensions are not sewn in one step, as their darts have the same numbers") {
  Engine engine(ring_named("Z"));
  carry_out(engine, make_map("p", ops::polygon(3)));
  carry_out(engine, make_map("q", ops::polygon(3)));
  carry_out(engine, make_map("s", solid_of(cube_faces())));
  carry_out(engine, make_map("t", solid_of(cube_faces())));
  CHECK(has(refusal(engine, operation(R"({"op":"sew","dim":2,"pairs":[["p:0","q:0"],["s:0","t:0"]]})")),
            "sew maps of one dimension in a step"));
}

TEST_CASE("what cannot be sewn is refused with the darts, and nothing has changed") {
  Engine engine(ring_named("Z"));
  carry_out(engine, R"({"op":"polygon","name":"p","sides":3})");
  carry_out(engine, R"({"op":"polygon","name":"q","sides":4})");
  carry_out(engine, make_map("a", solid_of(prism_faces(3))));
  carry_out(engine, make_map("b", solid_of(cube_faces())));
  CHECK(has(refusal(engine, sew_darts(2, "p:0", "q:8")), "its darts are numbered from 0 to 7"));
  CHECK(has(refusal(engine, sew_darts(2, "p:0", "x:0")), "no map is called \"x\""));
  CHECK(has(refusal(engine, sew_darts(2, "p:0", "b:0")), "only maps of the same dimension"));
  CHECK(has(refusal(engine, sew_darts(3, "p:0", "q:0")), "in the dimensions 0 to 2"));
  CHECK(has(refusal(engine, sew_darts(1, "p:0", "q:0")), "would change what the cells of its map are"));
  CHECK(has(refusal(engine, sew_darts(2, "p:0", "p:0")), "cannot be sewn to itself"));
  CHECK(has(refusal(engine, sew_darts(2, "p:0", "p:1")), "fold"));
  CHECK(has(refusal(engine, sew_darts(3, "a:0", "b:0")), "not alike"));
  carry_out(engine, sew_darts(2, "p:0", "q:0"));
  CHECK(has(refusal(engine, sew_darts(2, "p:1", "q:3")), "is 2-sewn to \"q:1\" already"));
  carry_out(engine, ops::Undo{1});
  carry_out(engine, sew_darts(2, "p:1", "q:3"));
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("cells of maps are glued by identify as their darts see them") {
  Engine engine(ring_named("Z"));
  carry_out(engine, R"({"op":"polygon","name":"p","sides":5})");
  carry_out(engine, R"({"op":"polygon","name":"q","sides":5})");
  carry_out(engine, R"({"op":"identify","pairs":[["p.2:2","q.2:5"]]})");
  CHECK(counts(engine) == std::vector<std::uint64_t>{5, 5, 1});
  CHECK(engine.structure().find(*engine.structure().lookup("p.1:2")) ==
        engine.structure().find(*engine.structure().lookup("q.1:5")));
  CHECK(engine.structure().find(*engine.structure().lookup("p.0:2")) ==
        engine.structure().find(*engine.structure().lookup("q.0:5")));
  CHECK(engine.structure().find(*engine.structure().lookup("p.0:3")) ==
        engine.structure().find(*engine.structure().lookup("q.0:4")));
  CHECK(engine.first_defect().value_or("") == "");
  carry_out(engine, R"({"op":"polygon","name":"r","sides":4})");
  CHECK(has(refusal(engine, operation(R"({"op":"identify","pairs":[["p","r"]]})")), "polygon with 4 sides"));
  CHECK(has(refusal(engine, operation(R"({"op":"degenerate","cell":"r","along":0})")), "only simploids"));
  CHECK(has(refusal(engine, operation(R"({"op":"identify","pairs":[["r","r.2:1"]]})")), "fold"));
}

TEST_CASE("polygons sewn and unsewn at random are the map that their darts are") {
  const auto seed = GENERATE(range(0U, 10U));
  const std::string ring = GENERATE("Z", "Z/2");
  CAPTURE(seed, ring);
  Random random(seed);
  PlainMaps maps(ring_named(ring), 2);
  for (int k = 0; k < 4; ++k) {
    maps.make("p" + std::to_string(k), ops::polygon(static_cast<Dart>(random.in(2, 5))));
  }
  sew_and_unsew(maps, random, 60);
}

TEST_CASE("solids sewn and unsewn at random are the map that their darts are") {
  const auto seed = GENERATE(range(0U, 6U));
  CAPTURE(seed);
  Random random(seed);
  PlainMaps maps(ring_named("Z"), 3);
  for (int k = 0; k < 3; ++k) {
    const std::vector<Polygons> kinds{tetrahedron_faces(), cube_faces(), prism_faces(3), pyramid_faces(4)};
    maps.make("s" + std::to_string(k), solid_of(kinds[static_cast<std::size_t>(random.in(0, 3))]));
  }
  sew_and_unsew(maps, random, 120);
}

TEST_CASE("a closed surface that is extended bounds a cell") {
  Engine engine(ring_named("Z"));
  for (int k = 0; k < 6; ++k) {
    carry_out(engine, ops::MakePolygon{"f" + std::to_string(k), 4, false});
  }
  const GMap surface = map_of_faces(cube_faces());
  for (Dart d = 0; d < surface.size(); d += 2) {
    const Dart other = surface.alpha(2, d);
    if (d < other) {
      carry_out(engine, sew_darts(2, dart_name("f" + std::to_string(d / 8), d % 8),
                                  dart_name("f" + std::to_string(other / 8), other % 8)));
    }
  }
  CHECK(engine.homology().betti == std::vector<std::int64_t>{1, 0, 1});
  carry_out(engine, ops::Extend{{"f2"}});
  CHECK(counts(engine) == std::vector<std::uint64_t>{8, 12, 6, 1});
  CHECK(engine.homology().betti == std::vector<std::int64_t>{1, 0, 0, 0});
  CHECK(engine.first_defect().value_or("") == "");
  CHECK(engine.structure().lookup("f0.3:0") == engine.structure().lookup("f5.3:7"));
  carry_out(engine, make_map("c", solid_of(cube_faces())));
  carry_out(engine, sew_darts(3, "f1:0", "c:0"));
  CHECK(counts(engine) == std::vector<std::uint64_t>{12, 20, 11, 2});
  CHECK(engine.homology().betti == std::vector<std::int64_t>{1, 0, 0, 0});
  CHECK(engine.first_defect().value_or("") == "");
  carry_out(engine, ops::Undo{3});
  CHECK(has(refusal(engine, ops::Extend{{"f0", "x"}}), "there is no map \"x\""));
}

TEST_CASE("an n-map goes in as its G-map, with two darts for each of its own") {
  Engine engine(ring_named("Z"));
  carry_out(engine, R"({"op":"map","name":"m","beta":[[1,2,3,0,5,6,7,4],[4,null,null,null,0,null,null,null]]})");
  CHECK(counts(engine) == std::vector<std::uint64_t>{6, 7, 2});
  CHECK(engine.structure().lookup("m.1:0") == engine.structure().lookup("m.1:4'"));
  CHECK(engine.structure().lookup("m.0:0") == engine.structure().lookup("m.0:3'"));
  CHECK(engine.structure().lookup("m.0:0") == engine.structure().lookup("m.0:5"));
  carry_out(engine, sew_darts(2, "m:2", "m:6'"));
  CHECK(engine.first_defect().value_or("") == "");
  CHECK(has(refusal(engine, sew_darts(2, "m:8", "m:1")), "each k has another one, k'"));
  CHECK(has(refusal(engine, operation(R"({"op":"map","name":"k","beta":[[0],[0]]})")), "is no map"));
}

TEST_CASE("maps go with all other operations") {
  const auto seed = GENERATE(range(0U, 60U));
  const std::string ring = GENERATE("Z", "Z/2");
  CAPTURE(seed, ring);
  Engine engine(ring_named(ring));
  RandomSteps steps(seed, everything_and_maps(40));
  for (int k = 0; k < 25; ++k) {
    const ops::Operation op = steps.next(engine.structure());
    CAPTURE(k, ops::to_text(op));
    carry_out(engine, op);
    if (k % 5 == 4 || ring == "Z/2") {
      REQUIRE(engine.first_defect().value_or("") == "");
    }
    REQUIRE(std::visit([&](const auto& r) { return groups_from_scratch(engine.structure(), r); }, ring_named(ring)) ==
            live_groups(engine));
    if (steps.random().one_in(8)) {
      const std::string before = dump(engine.structure()) + answers(engine);
      carry_out(engine, steps.next(engine.structure()));
      carry_out(engine, ops::Undo{1});
      REQUIRE(dump(engine.structure()) + answers(engine) == before);
    }
  }
}

namespace {

/// Steps that must be possible, and then whether a chain is a cycle.
engine::StepReport last_of(Engine& engine, const std::vector<std::string>& lines) {
  engine::StepReport report;
  for (const std::string& line : lines) {
    report = carry_out(engine, line);
  }
  CHECK(engine.first_defect().value_or("") == "");
  return report;
}

}  // namespace

TEST_CASE("what is unsewn is called after darts that see it as its type does") {
  Engine engine(ring_named("Z"));
  const auto report =
      last_of(engine, {R"({"op":"polygon","name":"p","sides":3})", R"({"op":"sew","dim":2,"pairs":[["p:0","p:3"]]})",
                       R"({"op":"unsew","dim":2,"darts":["p:1"]})",
                       R"({"op":"class","chain":[[1,"p.1:0"],[1,"p.1:2"],[1,"p.1:4"]]})"});
  CHECK(report.answer->is_cycle);
  for (const engine::Generator& generator : engine.generators(1)) {
    CHECK(engine.maps().boundary(generator.cycle).terms.empty());
  }
}

TEST_CASE("what was split or squashed otherwise is not unsewn") {
  Engine engine(ring_named("Z"));
  last_of(engine, {R"({"op":"polygon","name":"p","sides":2})", R"({"op":"polygon","name":"q","sides":2})",
                   R"({"op":"deidentify","split":[{"cell":"p.0:0","as":"x","moves":[["p.1:0",0],["p.1:2",1]]}]})",
                   R"({"op":"sew","dim":2,"pairs":[["p:0","q:1"]]})"});
  CHECK(has(refusal(engine, ops::Unsew{2, {"p:0"}}), "has been split, and not by unsewing"));
  last_of(engine, {R"({"op":"polygon","name":"r","sides":3})", R"({"op":"sew","dim":2,"pairs":[["r:2","r:5"]]})",
                   R"({"op":"degenerate","cell":"r.1:0","along":0})"});
  CHECK(has(refusal(engine, ops::Unsew{2, {"r:2"}}), "became degenerate"));
  CHECK(has(refusal(engine, ops::Unsew{2, {}}), "list one at least"));
}

TEST_CASE("the name of a polygon goes with its darts") {
  const std::string dart = GENERATE("p:0", "q:0");
  Engine engine(ring_named("Z"));
  last_of(engine, {R"({"op":"polygon","name":"p","sides":2})", R"({"op":"sew","dim":2,"pairs":[["p:0","p:3"]]})",
                   R"({"op":"extend","maps":["p"]})", R"({"op":"polygon","name":"q","sides":2})",
                   R"({"op":"sew","dim":2,"pairs":[["q:0","q:3"]]})", R"({"op":"extend","maps":["q"]})",
                   R"({"op":"sew","dim":3,"pairs":[["p:0","q:0"]]})"});
  carry_out(engine, ops::Unsew{3, {dart}});
  CHECK(engine.first_defect().value_or("") == "");
  const auto cell = [&](const std::string& name) {
    return engine.structure().find(engine.structure().lookup(name).value());
  };
  CHECK(cell("p") == cell("p.2:0"));
  CHECK(cell("q") == cell("q.2:0"));
  CHECK(cell("p") != cell("q"));
}

TEST_CASE("a name that was given keeps its meaning") {
  Engine engine(ring_named("Z"));
  last_of(engine, {R"({"op":"polygon","name":"p","sides":2})", R"({"op":"sew","dim":2,"pairs":[["p:0","p:3"]]})",
                   R"({"op":"simplex","name":"p.3:3","dim":0})"});
  CHECK(has(refusal(engine, ops::Extend{{"p"}}), "the name \"p.3:3\" is in use"));
  carry_out(engine, R"({"op":"polygon","name":"o","sides":3})");
  CHECK(has(refusal(engine, ops::Extend{{"o"}}), "is 2-free"));
  CHECK(has(refusal(engine, operation(R"({"op":"remove","cells":["o:0"]})")), "this is a dart"));
}

// Products of maps by their cells: maps again, with the groups of Künneth's formula.
#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "ops/maps/map_product.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/plain_maps.hpp"
#include "tests/support/random_maps.hpp"
#include "tests/support/random_steps.hpp"
#include "tests/support/solids.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

using Lines = std::vector<std::string>;

GMap ring_of(Dart edges) { return ops::polygon(edges).restricted(1); }
GMap segment_map() { return *GMap::make({{1, 0}, {0, 1}}); }

std::vector<std::uint64_t> cells_counted(const Engine& engine) {
  const auto cells = engine.cells();
  return {cells.begin(), cells.end()};
}

std::string refusal(Engine& engine, const std::string& line) {
  const auto look = [&] { return dump(engine.structure()) + answers(engine); };  // factors have no classes
  const std::string before = look();
  const auto report = engine.apply(operation(line));
  CHECK_FALSE(report.has_value());
  CHECK(look() == before);
  return report ? "" : report.error().what;
}

/// A random map all of whose cells are balls, not too large.
GMap map_of_balls(Random& random, int dimension, bool closed) {
  while (true) {
    const GMap map = random_gmap(random, {dimension, closed, false});
    Engine engine(ring_named("Z"));
    if (map.size() <= 16 && engine.apply(make_map("m", map)).has_value() &&
        std::ranges::all_of(engine.structure().bodies().parts(), [](std::uint64_t parts) { return parts == 0; })) {
      return map;
    }
  }
}

std::vector<reductions::AbelianGroup> groups_of(const AnyRing& ring, const GMap& map, bool as_simplices = false) {
  Engine engine(ring);
  carry_out(engine, make_map("m", map, as_simplices));
  return live_groups(engine);
}

}  // namespace

TEST_CASE("a product of maps has the groups of Künneth's formula, and of its simplices", "[engine][maps][product]") {
  const unsigned seed = GENERATE(range(0U, 8U));
  CAPTURE(seed);
  Random random(seed);
  const GMap left = map_of_balls(random, 2, random.one_in(2)),
             right = map_of_balls(random, random.in(0, 2), random.one_in(2));
  const GMap map = ops::product(left, right);
  CAPTURE(ops::to_text(ops::Operation{make_map("l", left)}), ops::to_text(ops::Operation{make_map("r", right)}));
  for (const std::string& name : Lines{"Z", "Z/2", "Z/3"}) {
    CAPTURE(name);
    const AnyRing ring = ring_named(name);
    Engine engine(ring);
    carry_out(engine, make_map("l", left));
    carry_out(engine, make_map("r", right));
    carry_out(engine, ops::MakeProduct{"P", "l", "r"});
    REQUIRE(engine.structure().lazy().families() == 1);
    REQUIRE(engine.first_defect().value_or("") == "");
    const auto expected = reductions::kunneth(groups_of(ring_named("Z"), left), groups_of(ring_named("Z"), right));
    CHECK(live_groups(engine) == trimmed(over(ring, expected)));
    if (map.size() <= 200 && name == "Z") {
      CHECK(live_groups(engine) == groups_of(ring, map, true));
      CHECK(live_groups(engine) == groups_of(ring, map));
    }
  }
}

TEST_CASE("darts of a product see its cells, with the orientation that they give them", "[engine][maps][product]") {
  Engine engine(ring_named("Z"));
  carry_out(engine, make_map("l", ops::polygon(3)));
  carry_out(engine, make_map("r", ring_of(2)));
  carry_out(engine, ops::MakeProduct{"P", "l", "r"});
  const GMap map = ops::product(ops::polygon(3), ring_of(2));
  const ops::ProductDarts darts(6, 2, 4, 1);
  const ops::Structure& structure = engine.structure();
  const auto cell = [&](const std::string& name) {
    const auto denoted = structure.denoted(name).value();
    return std::pair{structure.find(denoted.node), structure.maps().sign(denoted.order)};
  };
  const auto boundary = [&](const std::string& name) {
    const auto [node, sign] = cell(name);
    return engine.maps().boundary({structure.dimension(node), {{sign, node}}});
  };
  for (Dart d = 0; d < map.size(); ++d) {
    const auto [e, f, word] = darts.place(d);
    for (int i = 0; i <= 3; ++i) {
      const int a = darts.left_steps(word, i);
      const std::string seen = "P." + std::to_string(i) + ":" + std::to_string(d);
      const std::string pair = "P.(l." + std::to_string(a) + ":" + std::to_string(e) + "|r." + std::to_string(i - a) +
                               ":" + std::to_string(f) + ")";
      const auto [node, sign] = cell(seen);
      const ops::ProductDarts of_cell(1, a, 1, i - a);
      REQUIRE(cell(pair) == std::pair{node, sign * ops::sign_of_word(of_cell, darts.beginning(word, i))});
      REQUIRE(
          (i == 0 || cell("P." + std::to_string(i) + ":" + std::to_string(map.alpha(0, d))) == std::pair{node, -sign}));
      if (i > 0) {
        const auto [face, sign_of_face] = cell("P." + std::to_string(i - 1) + ":" + std::to_string(d));
        const CellChain terms = boundary(seen);
        const auto term =
            std::ranges::find_if(terms.terms, [&, face = face](const auto& t) { return t.generator == face; });
        REQUIRE(term != terms.terms.end());
        REQUIRE(term->coefficient == sparse::Rational{sign_of_face});
      }
    }
  }
  CHECK(cells_counted(engine) == std::vector<std::uint64_t>{6, 12, 8, 2});
}

TEST_CASE("a product of a cell that is not its own mirror image may be oriented the other way",
          "[engine][maps][product]") {
  const GMap one = *GMap::make({{1, 0, 3, 2, 5, 4, 7, 6, 9, 8, 11, 10, 13, 12, 15, 14},
                                {1, 0, 11, 4, 3, 6, 5, 8, 7, 10, 9, 2, 13, 12, 15, 14},
                                {3, 2, 1, 0, 7, 6, 5, 4, 15, 14, 13, 12, 11, 10, 9, 8}});
  const GMap other = *GMap::make({{1, 0, 3, 2, 5, 4, 7, 6, 9, 8, 11, 10, 13, 12, 15, 14},
                                  {1, 0, 13, 4, 3, 6, 5, 8, 7, 10, 9, 12, 11, 2, 15, 14},
                                  {3, 2, 1, 0, 7, 6, 5, 4, 13, 12, 15, 14, 9, 8, 11, 10}});
  std::set<int> signs;
  for (const GMap& solid : {one.extended(), other.extended()}) {
    for (const bool is_left : {false, true}) {
      CAPTURE(is_left);
      Engine engine(ring_named("Z"));  // homotopies lead from edges of the other factor to its face
      carry_out(engine, make_map("l", is_left ? solid : ops::polygon(2)));
      carry_out(engine, make_map("r", is_left ? ops::polygon(2) : solid));
      carry_out(engine, ops::MakeProduct{"P", "l", "r"});
      const ops::Structure& structure = engine.structure();
      signs.insert(
          structure.maps().sign(structure.denoted(is_left ? "P.(l.3:0|r.1:0)" : "P.(l.1:0|r.3:0)").value().order));
      CHECK(engine.first_defect().value_or("") == "");
      CHECK(live_groups(engine).size() == 1);
    }
  }
  CHECK(signs == std::set<int>{-1, 1});
}

TEST_CASE("spaces that are products of maps", "[engine][maps][product]") {
  const auto [left, right, betti, torsion] = GENERATE(table<GMap, GMap, std::vector<std::int64_t>, int>({
      {ring_of(3), ring_of(4), {1, 2, 1}, 0},
      {torus_of_a_square(), ring_of(1), {1, 3, 3, 1}, 0},
      {projective_plane_of_a_square(), ring_of(2), {1, 1, 0, 0}, 2},
      {klein_bottle_of_a_square(), segment_map(), {1, 1, 0, 0}, 2},
      {torus_of_a_square(), torus_of_a_square(), {1, 4, 6, 4, 1}, 0},
  }));
  Engine engine(ring_named("Z"));
  carry_out(engine, make_map("l", left));
  carry_out(engine, make_map("r", right));
  carry_out(engine, ops::MakeProduct{"P", "l", "r"});
  const engine::Homology homology = engine.homology();
  CHECK(homology.betti == betti);
  CHECK(homology.torsion[1] == (torsion == 0 ? std::vector<Integer>{} : std::vector<Integer>{torsion}));
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("maps that are products are sewn, unsewn and changed locally as others are",
          "[engine][maps][product][stream]") {
  const unsigned seed = GENERATE(range(0U, 4U));
  const bool operates = GENERATE(false, true);
  CAPTURE(seed, operates);
  Random random(seed);
  SECTION("surfaces") {
    PlainMaps maps(ring_named(seed % 2 == 0 ? "Z" : "Z/2"), 2);
    maps.make_product("P", segment_map(), segment_map());
    maps.make_product("Q", ring_of(2), segment_map());
    maps.make("p", ops::polygon(4));
    sew_and_unsew(maps, random, 60, operates);
  }
  SECTION("solids") {
    PlainMaps maps(ring_named("Z"), 3);
    maps.make_product("P", ops::polygon(3), segment_map());
    maps.make("p", solid_of(prism_faces(3)));
    sew_and_unsew(maps, random, 60, operates);
  }
}

TEST_CASE("products of maps among all other steps, through undo and renewals", "[engine][maps][product][stream]") {
  const unsigned seed = GENERATE(range(0U, 4U));
  const std::string ring = seed % 2 == 0 ? "Z" : "Z/3";
  CAPTURE(seed, ring);
  Engine keeps(ring_named(ring), {}, taking_splits_in, {20, false});
  Engine forgets(ring_named(ring), {}, taking_splits_in, {20, false, true});
  RandomSteps random(seed, everything_and_maps(50));
  int products = 0;
  const auto any = [&](const std::vector<ops::BodyId>& bodies) {
    return bodies[static_cast<std::size_t>(random.random().in(0, static_cast<int>(bodies.size()) - 1))];
  };
  const auto product = [&]() -> std::optional<ops::Operation> {
    const ops::Structure& structure = keeps.structure();
    const auto bodies = structure.bodies().current();
    for (int tries = 0; tries < 8 && !bodies.empty(); ++tries) {
      const ops::BodyId left = any(bodies), right = any(bodies);
      const auto has_others = [&](ops::BodyId body) { return structure.bodies().kind(body).has_others; };
      const std::size_t pairs = structure.lazy().cells_of(left).size() * structure.lazy().cells_of(right).size();
      const auto name = [&](ops::BodyId body) { return std::string{structure.directory().name_of_body(body)}; };
      const ops::MakeProduct op{"M" + std::to_string(products), name(left), name(right)};
      if ((has_others(left) || has_others(right)) && pairs > 3 && pairs < 100 && keeps.apply(op)) {
        ++products;
        return op;
      }
    }
    return std::nullopt;
  };
  for (int k = 0; k < 120; ++k) {
    CAPTURE(k);
    std::optional<ops::Operation> step = random.random().one_in(4) ? product() : std::nullopt;
    if (!step) {
      const bool undoes = random.random().one_in(10) && keeps.undoable() > 0;
      step = undoes ? ops::Operation{ops::Undo{1}} : random.next(keeps.structure());
      carry_out(keeps, *step);
    }
    CAPTURE(ops::to_text(*step));
    carry_out(forgets, *step);
    REQUIRE(keeps.first_defect().value_or("") == "");
    REQUIRE(forgets.first_defect().value_or("") == "");
    REQUIRE(live_groups(keeps) == live_groups(forgets));
    REQUIRE(std::ranges::equal(keeps.cells(), forgets.cells()));
    REQUIRE(live_groups(keeps) ==
            std::visit([&](const auto& r) { return groups_from_scratch(keeps.structure(), r); }, ring_named(ring)));
  }
  CHECK(products > 0);
}

TEST_CASE("what is glued in a factor is glued in the product", "[engine][maps][product]") {
  Engine engine(ring_named("Z"));
  build(engine,
        Lines{R"({"op":"polygon","name":"a","sides":4})", R"({"op":"polygon","name":"b","sides":4})",
              R"({"op":"sew","dim":2,"pairs":[["a:0","b:1"]]})", R"({"op":"gmap","name":"s","alpha":[[1,0],[0,1]]})",
              R"({"op":"product","name":"P","left":"a","right":"s"})"});
  CHECK(cells_counted(engine) == std::vector<std::uint64_t>{12, 20, 11, 2});
  // The 16 darts of a and b, a's first, times the 2 of s, times three words; the first one ends with a step to the
  // left.
  const auto dart = [](int d, int e, int word) { return "P:" + std::to_string((d * 2 + e) * 3 + word); };
  const std::string sewn = R"({"op":"sew","dim":3,"pairs":[[")" + dart(0, 0, 0) + R"(",")" + dart(2, 0, 0) + R"("]]})";
  CHECK(refusal(engine, sewn).find("3-sewn") != std::string::npos);
  CHECK(engine.structure().lookup("P.2:" + std::to_string(0)).has_value());
  const std::vector<std::string> names{"P.(a.1:0|s.1:0)", "P.(b.1:0|s.1:0)", "P.(b.1:1|s.1:1)"};
  CHECK(engine.structure().lookup(names[0]) == engine.structure().lookup(names[1]));
  CHECK(engine.structure().lookup(names[0]) == engine.structure().lookup(names[2]));
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("products of maps are undone, and factors are there again", "[engine][maps][product]") {
  Engine engine(ring_named("Z"));
  build(engine, Lines{R"({"op":"polygon","name":"a","sides":3})", R"({"op":"gmap","name":"s","alpha":[[1,0],[0,1]]})"});
  const std::string before = dump(engine);
  const std::string product = R"({"op":"product","name":"P","left":"a","right":"s"})";
  carry_out(engine, product);
  CHECK(refusal(engine, R"({"op":"sew","dim":2,"pairs":[["a:0","a:2"]]})").find("went into the product") !=
        std::string::npos);
  carry_out(engine, R"({"op":"undo"})");
  CHECK(dump(engine) == before);
  CHECK_FALSE(engine.structure().lookup("P.1:0").has_value());
  carry_out(engine, R"({"op":"sew","dim":2,"pairs":[["a:0","a:2"]]})");
  carry_out(engine, product);
  CHECK(cells_counted(engine) == std::vector<std::uint64_t>{2, 5, 4, 1});
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("chains of maps have products, whose levels name their cells", "[engine][maps][product]") {
  Engine engine(ring_named("Z"));
  build(
      engine,
      Lines{R"({"op":"chain_of_maps","name":"t","levels":[{"darts":3},{"alpha":[[1,0,3,2,5,4]],"sigma":[0,1,1,2,2,0]},)"
            R"({"alpha":[[1,0,3,2,5,4],[5,2,1,4,3,0]],"sigma":[0,1,2,3,4,5]}]})",
            R"({"op":"chain_of_maps","name":"e","levels":[{"darts":2},{"alpha":[[1,0]],"sigma":[0,1]}]})",
            R"({"op":"product","name":"P","left":"t","right":"e"})"});
  CHECK(cells_counted(engine) == std::vector<std::uint64_t>{6, 9, 5, 1});
  // Level 2 has three times twelve darts of the squares, and then those of the two triangles.
  CHECK(engine.structure().lookup("P.2:0") == engine.structure().lookup("P.(t.1:0|e.1:0)"));
  CHECK(engine.structure().lookup("P.2:23") == engine.structure().lookup("P.(t.1:5|e.1:1)"));
  CHECK(engine.structure().lookup("P.2:24") == engine.structure().lookup("P.(t.2:0|e.0:0)"));
  CHECK_FALSE(engine.structure().lookup("P.2:36").has_value());
  carry_out(engine, R"({"op":"identify","pairs":[["P.2:24","P.2:25"]]})");
  CHECK(cells_counted(engine) == std::vector<std::uint64_t>{3, 6, 4, 1});
  CHECK(live_groups(engine).size() == 2);
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("a product of a map and of what has no darts is one by cells", "[engine][maps][product]") {
  Engine engine(ring_named("Z"));
  build(engine, Lines{R"({"op":"polygon","name":"a","sides":5})", R"({"op":"simplex","name":"e","dim":1})",
                      R"({"op":"product","name":"P","left":"a","right":"e"})"});
  CHECK(cells_counted(engine) == std::vector<std::uint64_t>{10, 15, 7, 1});
  CHECK_FALSE(engine.structure().lookup("P.1:0").has_value());
  CHECK(engine.structure().denoted("P.(a|e)")->node == engine.structure().denoted("P.(a|e.1-0)")->node);
  CHECK(engine.structure().denoted("P.(a|e)")->order != engine.structure().denoted("P.(a|e.1-0)")->order);
  carry_out(engine, ops::Identify{{{"P.(a|e.0)", "P.(a|e.1)"}}});
  CHECK(cells_counted(engine) == std::vector<std::uint64_t>{5, 10, 6, 1});
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("what cannot be multiplied is refused by name", "[engine][maps][product]") {
  Engine engine(ring_named("Z"));
  build(
      engine,
      {R"({"op":"polygon","name":"a","sides":3})", R"({"op":"simplex","name":"t","dim":2})",
       R"({"op":"gmap","name":"T","alpha":[[1,0,3,2,5,4,7,6],[7,2,1,4,3,6,5,0],[5,4,7,6,1,0,3,2],[0,1,2,3,4,5,6,7]]})",
       R"({"op":"polygon","name":"b","sides":3})", R"({"op":"degenerate","cell":"b.1:0","along":0})",
       R"({"op":"simplex","name":"Q.1:7","dim":0})"});
  const auto product = [](const std::string& left, const std::string& right, const std::string& more = "") {
    return R"({"op":"product","name":"Q","left":")" + left + R"(","right":")" + right + "\"" + more + "}";
  };
  const auto says = [&](const std::string& line, const std::string& part) {
    CAPTURE(line, part);
    CHECK(refusal(engine, line).find(part) != std::string::npos);
  };
  says(product("a", "t"), R"(the cell "t" is a simplex of dimension 2)");
  says(product("T", "a"), "is no ball");
  says(product("a", "b"), R"("b" of a map has a degenerate face)");
  says(product("a", "a", R"(,"kind":"simplicial")"), "a simplicial product is possible of simploids only");
  says(product("a", "a"), R"("Q.1:7" is in use)");
}

// Complexes of cells that are known by their boundaries: CW complexes as topologists write them.
#include <string>
#include <vector>

#include "tests/support/boundary_complexes.hpp"
#include "tests/support/engines.hpp"
#include "tests/support/groups.hpp"
#include "tests/support/random_steps.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

using Groups = std::vector<AbelianGroup>;

std::string complex_line(const std::string& name, const std::string& cells) {
  return R"({"op":"complex","name":")" + name + R"(","cells":[)" + cells + "]}";
}

Groups groups_of(const std::string& ring, const std::string& cells) {
  Engine engine(ring_named(ring));
  carry_out(engine, complex_line("k", cells));
  CHECK(engine.first_defect().value_or("") == "");
  return live_groups(engine);
}

std::string why_refused(const std::string& cells) {
  Engine engine(ring_named("Z"));
  const auto report = engine.apply(operation(complex_line("k", cells)));
  CHECK(engine.cells().empty());
  return report ? "" : report.error().what;
}

std::string why_refused(Engine& engine, const std::string& line) {
  const std::string before = dump(engine);
  const auto report = engine.apply(operation(line));
  CHECK(dump(engine) == before);
  return report ? "" : report.error().what;
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The real projective space of a dimension, with one cell of each.
std::string projective_space(int dimension) {
  std::string cells = R"({"id":"e0","dim":0},{"id":"e1","dim":1,"boundary":[[1,"e0"],[-1,"e0"]]})";
  for (int p = 2; p <= dimension; ++p) {
    const std::string boundary = p % 2 == 0 ? R"(,"boundary":[[2,"e)" + std::to_string(p - 1) + R"("]])" : "";
    cells += R"(,{"id":"e)" + std::to_string(p) + R"(","dim":)" + std::to_string(p) + boundary + "}";
  }
  return cells;
}

constexpr const char* torus_by_boundaries =
    R"({"id":"v","dim":0},{"id":"a","dim":1,"boundary":[[1,"v"],[-1,"v"]]},{"id":"b","dim":1,"boundary":[[1,"v"],[-1,"v"]]},)"
    R"({"id":"f","dim":2,"boundary":[[1,"a"],[1,"b"],[-1,"a"],[-1,"b"]]})";

}  // namespace

TEST_CASE("CW complexes have the homology that their boundaries say") {
  CHECK(groups_of("Z", torus_by_boundaries) == Groups{{1, {}}, {2, {}}, {1, {}}});
  CHECK(groups_of("Z", projective_space(4)) == Groups{{1, {}}, {0, {2}}, {0, {}}, {0, {2}}});
  CHECK(groups_of("Z", projective_space(5)) == Groups{{1, {}}, {0, {2}}, {0, {}}, {0, {2}}, {0, {}}, {1, {}}});
  CHECK(groups_of("Z/2", projective_space(4)) == Groups{{1, {}}, {1, {}}, {1, {}}, {1, {}}, {1, {}}});
  CHECK(groups_of("Z/3", projective_space(4)) == Groups{{1, {}}});
  // A lens space, and a sphere with a cell attached twelve times.
  CHECK(
      groups_of(
          "Z",
          R"({"id":"v","dim":0},{"id":"a","dim":1,"boundary":[[1,"v"],[-1,"v"]]},{"id":"f","dim":2,"boundary":[[7,"a"]]},{"id":"s","dim":3})") ==
      Groups{{1, {}}, {0, {7}}, {0, {}}, {1, {}}});
  CHECK(groups_of("Z", R"({"id":"v","dim":0},{"id":"s","dim":2},{"id":"b","dim":3,"boundary":[[12,"s"]]})") ==
        Groups{{1, {}}, {0, {}}, {0, {12}}});
  // In any order, and beside simplices; an edge counts from its beginning to its end however it is written.
  CHECK(
      groups_of(
          "Z",
          R"({"id":"f","dim":2,"boundary":[[1,"a"],[-1,"b"]]},{"id":"a","dim":1,"boundary":[[-1,"v"],[1,"w"]]},{"id":"b","faces":["w","v"]},{"id":"v"},{"id":"w","dim":0})") ==
      Groups{{1, {}}});
}

TEST_CASE("boundaries that are none are refused, with the cells named") {
  const std::string edges =
      R"({"id":"v","dim":0},{"id":"w","dim":0},{"id":"a","dim":1,"boundary":[[1,"w"],[-1,"v"]]},)";
  CHECK(says(why_refused(edges + R"({"id":"f","dim":2,"boundary":[[1,"a"]]})"),
             R"(the boundary of cell "f" of complex "k" is no cycle: "k.v" is left in the boundary of it)"));
  CHECK(
      says(why_refused(edges + R"({"id":"f","dim":2,"boundary":[[1,"v"]]})"),
           R"(cell "f" of complex "k" has the dimension 2, but "v" in its boundary the dimension 0: it should be 1)"));
  CHECK(says(why_refused(edges + R"({"id":"f","dim":2,"boundary":[[1,"x"]]})"), R"("x" that is not listed there)"));
  CHECK(says(why_refused(edges + R"({"id":"b","dim":1,"boundary":[[1,"v"]]})"), "its end less its beginning"));
  CHECK(says(why_refused(edges + R"({"id":"b","dim":1})"), "its end less its beginning"));
  CHECK(says(why_refused(edges + R"({"id":"x","dim":0,"boundary":[[1,"v"]]})"), "a vertex has none"));
  CHECK(says(why_refused(R"({"id":"f","dim":2,"boundary":[[1,"f"]]})"), "it should be 1"));
  CHECK(says(why_refused(R"({"id":"f","dim":63})"), "62 is the largest"));
  for (const char* wrong :
       {R"({"id":"f","dim":2,"boundary":[[0,"a"]]})", R"({"id":"f","dim":2,"boundary":[[1000000001,"a"]]})",
        R"({"id":"f","dim":2,"boundary":[["a",1]]})", R"({"id":"f","boundary":[[1,"a"]]})",
        R"({"id":"f","dim":2,"faces":["a"]})", R"({"id":"f","dim":2,"type":[2]})", R"({"id":"f","dim":-1})"}) {
    CHECK_FALSE(ops::parse_operation(complex_line("k", wrong)).has_value());
  }
  CHECK(groups_of("Z",
                  R"({"id":"s","dim":2},{"id":"b","dim":3,"boundary":[[400000001,"s"],[-399999999,"s"],[-1,"s"]]})") ==
        Groups{});
}

TEST_CASE("a simplex has no face that is known by its boundary") {
  const std::string why = why_refused(R"({"id":"s","dim":2},{"id":"t","faces":["s","s","s","s"]})");
  CHECK(says(why, "should be a simplex of dimension 2"));
}

TEST_CASE("lines of complexes by boundaries read back as they were written") {
  const std::string line = complex_line(
      "k",
      R"({"id":"v","dim":0},{"id":"a","dim":1,"boundary":[[1,"v"],[-1,"v"]]},{"id":"f","dim":2,"boundary":[[-2,"a"],[3,"a"]]},{"id":"s","dim":2})");
  CHECK(ops::to_text(operation(line)) == line);
}

TEST_CASE("cells that are known by equal boundaries are glued, face by face") {
  Engine engine(ring_named("Z"));
  carry_out(engine, complex_line("k", torus_by_boundaries));
  carry_out(engine, complex_line("l", torus_by_boundaries));
  carry_out(engine, R"({"op":"identify","pairs":[["k.f","l.f"]]})");
  CHECK(live_groups(engine) == Groups{{1, {}}, {2, {}}, {1, {}}});
  CHECK(engine.structure().lookup("k.a").has_value());
  CHECK(engine.structure().find(*engine.structure().lookup("k.a")) ==
        engine.structure().find(*engine.structure().lookup("l.a")));
  carry_out(engine, R"({"op":"identify","pairs":[["k.a","k.b"]]})");
  CHECK(live_groups(engine) == Groups{{1, {}}, {1, {}}, {1, {}}});
  CHECK(engine.first_defect().value_or("") == "");
  carry_out(engine, complex_line("p", projective_space(2)));
  CHECK(says(why_refused(engine, R"({"op":"identify","pairs":[["k.f","p.e2"]]})"),
             "a cell of dimension 2 with a boundary of 4 terms"));
  CHECK(
      says(why_refused(engine, R"({"op":"identify","pairs":[["k.f","l.f",[[0,1,2]]]]})"), "it is glued face by face"));
  CHECK(says(why_refused(engine, R"({"op":"degenerate","cell":"k.f","along":0})"), "only simploids"));
  carry_out(engine, R"({"op":"cone","apex":"x","over":"p"})");
  CHECK(live_groups(engine) == Groups{{2, {}}, {1, {}}, {1, {}}});
  CHECK(says(why_refused(engine, R"({"op":"product","name":"y","left":"k","right":"p"})"),
             "is known by its boundary: a product is one of"));
}

TEST_CASE("a split leaves the boundary of every cell a cycle") {
  Engine engine(ring_named("Z"));
  carry_out(engine, complex_line("k", torus_by_boundaries));
  carry_out(engine, R"({"op":"deidentify","split":[{"cell":"k.v","as":"w","moves":[["k.a",0]]}]})");
  CHECK(live_groups(engine) == Groups{{1, {}}, {1, {}}, {1, {}}});  // the face goes along a and back
  CHECK(engine.first_defect().value_or("") == "");
  Engine again(ring_named("Z"));
  carry_out(
      again,
      complex_line(
          "k",
          R"({"id":"v","dim":0},{"id":"a","dim":1,"boundary":[[1,"v"],[-1,"v"]]},{"id":"f","dim":2,"boundary":[[2,"a"]]})"));
  CHECK(says(why_refused(again, R"({"op":"deidentify","split":[{"cell":"k.v","as":"w","moves":[["k.a",0]]}]})"),
             R"(the boundary of "k.f" would be no cycle)"));
}

TEST_CASE("removing and squashing what bounds keeps the groups right") {
  Engine engine(ring_named("Z"));
  carry_out(engine, complex_line("k", projective_space(3)));
  carry_out(engine, R"({"op":"remove","cells":["k.e3"]})");
  CHECK(live_groups(engine) == Groups{{1, {}}, {0, {2}}});
  carry_out(engine, R"({"op":"degenerate","cell":"k.e1","along":0})");
  CHECK(live_groups(engine) == Groups{{1, {}}, {0, {}}, {1, {}}});  // the disk is a sphere then
  carry_out(engine, R"({"op":"undo","steps":2})");
  CHECK(live_groups(engine) == Groups{{1, {}}, {0, {2}}, {0, {}}, {1, {}}});
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("random complexes by boundaries, glued, split and cut at random, have the groups of a Smith form") {
  for (const char* ring : {"Z", "Z/2", "Z/3"}) {
    for (unsigned seed = 1; seed <= 25; ++seed) {
      CAPTURE(ring, seed);
      StreamShape shape{.most_cells = 60, .cones = false, .degeneracies = true, .splits = true, .removals = true};
      RandomSteps steps(seed, shape);
      Random draw(seed + 100);
      Engine engine(ring_named(ring));
      for (int k = 0; k < 3; ++k) {
        carry_out(engine, random_boundary_complex("r" + std::to_string(k), draw.in(1, 5), draw));
      }
      for (int step = 0; step < 25; ++step) {
        const ops::Operation op = steps.next(engine.structure());
        CAPTURE(ops::to_text(op));
        carry_out(engine, op);
        REQUIRE(engine.first_defect().value_or("") == "");
        const Groups scratch =
            std::visit([&](const auto& r) { return groups_from_scratch(engine.structure(), r); }, engine.ring());
        REQUIRE(live_groups(engine) == scratch);
      }
    }
  }
}

#include "ops/plan/planner.hpp"

#include <set>

#include "ops/plan/step_sequence.hpp"
#include "tests/support/cell_lists.hpp"
#include "tests/support/random_steps.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;
using Catch::Contains;

namespace {

/// A triangle t, a square q, an edge body "line".
Workshop& furnished(Workshop& shop) {
  shop.build({R"({"op":"simplex","name":"t","dim":2})", R"({"op":"simploid","name":"q","type":[1,1]})",
              R"({"op":"simplex","name":"line","dim":1})"});
  return shop;
}

/// Three vertices, three edges and what follows.
std::string triangle_with(const std::string& more) {
  return R"({"op":"complex","name":"K","cells":[{"id":"a"},{"id":"b"},{"id":"c"},{"id":"ab","faces":["b","a"]},)"
         R"({"id":"bc","faces":["c","b"]},{"id":"ac","faces":["c","a"]},)" +
         more + "]}";
}

}  // namespace

// ----------------------------------------------------------------------------------------------------------- names

TEST_CASE("a name in use is refused, whoever uses it", "[ops]") {
  Workshop shop;
  furnished(shop);
  shop.build({R"({"op":"cone","apex":"v","over":["t.0"]})", R"({"op":"simplex","name":"x.0","dim":0})"});
  for (const std::string line :
       {R"({"op":"simplex","name":"t","dim":0})", R"({"op":"simplex","name":"t.0-1","dim":2})",
        R"({"op":"simploid","name":"v*t.0","type":[]})", R"({"op":"complex","name":"q","cells":[]})",
        R"({"op":"cone","apex":"line"})", R"({"op":"cone","apex":"x.0.0"})"}) {
    CAPTURE(line);
    const Error error = refused(shop, line);
    CHECK(error.code == Errc::bad_input);
    CHECK_THAT(error.what, Contains("in use") && Contains("choose another"));
  }
}

TEST_CASE("a name in use by a face of the new cell is refused, and named", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"x.1","dim":0})", R"({"op":"simplex","name":"y.0","dim":0})",
              R"({"op":"simplex","name":"v*z","dim":0})", R"({"op":"simplex","name":"z","dim":0})",
              R"({"op":"simplex","name":"K.e","dim":0})"});
  CHECK_THAT(refused(shop, R"({"op":"simplex","name":"x","dim":2})").what, Contains("\"x.1\"") && Contains("\"x\""));
  CHECK_THAT(refused(shop, R"({"op":"simplex","name":"y","dim":0})").what, Contains("\"y.0\""));
  CHECK_THAT(refused(shop, R"({"op":"cone","apex":"v","over":["z"]})").what, Contains("\"v*z\""));
  CHECK_THAT(refused(shop, R"({"op":"complex","name":"K","cells":[{"id":"e"}]})").what, Contains("\"K.e\""));
}

TEST_CASE("a name of an undone step is free again", "[ops]") {
  Workshop shop;
  const StructureMark start = mark_of(shop.structure());
  shop.build({R"({"op":"simplex","name":"t","dim":2})"});
  shop.go_back_to(start);
  CHECK(shop.apply(operation(R"({"op":"complex","name":"t","cells":[{"id":"0-1"}]})")));
}

TEST_CASE("white space, control characters and broken UTF-8 are no part of a name", "[ops]") {
  Workshop shop;
  for (const std::string& name : {std::string{}, std::string{"a b"}, std::string{"a\tb"}, std::string{"\n"},
                                  std::string{"a\x7f"}, std::string{"a\0b", 3}, std::string{"a\xc2\xa0"},
                                  std::string{"\xe2\x80\xa8"}, std::string{"\xff"}, std::string{"a\xc3"}}) {
    CAPTURE(name);
    CHECK_THAT(refused(shop, MakeSimplex{name, 1, {}}).what, Contains("is not a name"));
    CHECK_THAT(refused(shop, MakeSimploid{name, {1}, {}}).what, Contains("is not a name"));
    CHECK_THAT(refused(shop, MakeComplex{name, {}}).what, Contains("is not a name"));
    CHECK_THAT(refused(shop, MakeCone{name, {}, {}}).what, Contains("is not a name"));
    CHECK_THAT(refused(shop, MakeComplex{"K", {{name, {}, {}, {}}}}).what, Contains("needs an id"));
  }
  CHECK(shop.apply(MakeSimplex{"é∂(a|b)*.", 1, {}}));
}

TEST_CASE("unknown cells are named, and a body is no cell nor a cell a body", "[ops]") {
  Workshop shop;
  furnished(shop);
  shop.build({R"({"op":"complex","name":"K","cells":[{"id":"a"}]})"});
  const Error unknown = refused(shop, R"({"op":"identify","pairs":[["t.0","t.1"],["t.0","t.7"]]})");
  CHECK(unknown.code == Errc::unknown_name);
  CHECK_THAT(unknown.what, Contains("no cell \"t.7\""));
  CHECK_THAT(refused(shop, R"({"op":"identify","pairs":[["K","t.0"]]})").what, Contains("name of a body"));
  CHECK_THAT(refused(shop, R"({"op":"cone","apex":"v","over":["K"]})").what, Contains("name of a body"));
  const Error cell = refused(shop, R"({"op":"cone","apex":"v","over":"t.0"})");
  CHECK(cell.code == Errc::unknown_name);
  CHECK_THAT(cell.what, Contains("no body \"t.0\"") && Contains("[\"t.0\"]"));
  CHECK_THAT(refused(shop, R"({"op":"cone","apex":"v","over":"nobody"})").what, Contains("no body \"nobody\""));
  CHECK_THAT(refused(shop, R"({"op":"cone","apex":"v","over":["nobody"]})").what, Contains("no cell \"nobody\""));
}

// ----------------------------------------------------------------------------------------------------------- sizes

TEST_CASE("what is too large is refused before any memory is asked for", "[ops]") {
  Workshop shop;
  for (const int dimension : {20, 61, 62, 63, 1'000'000}) {
    CAPTURE(dimension);
    const Error error = refused(shop, MakeSimplex{"s", dimension, {}});
    CHECK(error.code == Errc::refused);
    CHECK_THAT(error.what, Contains("limit"));
    CHECK(refused(shop, MakeSimploid{"s", {1, dimension}, {}}).code == Errc::refused);
  }
  CHECK(refused(shop, MakeSimploid{"s", CellType(13, 1), {}}).code == Errc::refused);
  CHECK(refused(shop, MakeSimploid{"s", CellType(100'000, 2), {}}).code == Errc::refused);
  CHECK(refused(shop, MakeComplex{"K", {{"a", CellType{1, 1'000'000}, {}, {}}}}).code == Errc::refused);
  CHECK(refused(shop, MakeComplex{"K", {{"a", CellType(1000, 1), {}, {}}}}).code == Errc::refused);
  const MakeComplex wide{"K", {{"a", {}, std::vector<std::string>(1'000'000, "a"), {}}}};
  CHECK(refused(shop, wide).code == Errc::refused);
}

TEST_CASE("dimensions below zero and empty factors are refused", "[ops]") {
  Workshop shop;
  for (const int dimension : {-1, -5, -1'000'000'000}) {
    CHECK(refused(shop, MakeSimplex{"s", dimension, {}}).code == Errc::bad_input);
    CHECK(refused(shop, MakeSimploid{"s", {1, dimension}, {}}).code == Errc::bad_input);
    CHECK(refused(shop, MakeComplex{"K", {{"a", CellType{dimension}, {}, {}}}}).code == Errc::bad_input);
  }
  CHECK(refused(shop, MakeSimploid{"s", {0}, {}}).code == Errc::bad_input);
}

TEST_CASE("limits are those given: per standard cell, per step, and for the workspace", "[ops]") {
  Workshop shop(Limits{.cells_of_standard = 15, .cells_per_step = 15, .cells = 30});
  CHECK(shop.apply(MakeSimplex{"a", 3, {}}));
  CHECK_THAT(refused(shop, MakeSimplex{"b", 4, {}}).what, Contains("31") && Contains("15"));
  CHECK_THAT(refused(shop, MakeComplex{"K", {{"a", {}, {"a", "a", "a", "a", "a"}, {}}}}).what, Contains("at most 15"));
  CHECK_THAT(refused(shop, MakeCone{"v", {}, {}}).what, Contains("16 cells") && Contains("one step"));
  CHECK_THAT(refused(shop, MakeComplex{"K", CellList(std::vector<MakeComplex::Cell>(16))}).what, Contains("one step"));
  CHECK(shop.apply(MakeSimploid{"q", {1, 1}, {}}));
  CHECK_THAT(refused(shop, MakeSimplex{"c", 2, {}}).what, Contains("workspace") && Contains("31") && Contains("30"));
  CHECK(shop.apply(MakeSimplex{"d", 1, {}}));
  CHECK_THAT(
      refused(shop, MakeComplex{"K", {{"a", {}, {}, {}}, {"b", {}, {}, {}}, {"c", {}, {}, {}}, {"d", {}, {}, {}}}})
          .what,
      Contains("workspace"));
}

// --------------------------------------------------------------------------------------------------------- complex

TEST_CASE("a broken face law is reported with the cells that should be one", "[ops]") {
  Workshop shop;
  const Error triangle = refused(shop, triangle_with(R"({"id":"T","faces":["bc","ab","ac"]})"));
  CHECK(triangle.code == Errc::bad_input);
  CHECK_THAT(triangle.what, Contains("\"T\"") && Contains("face law") && Contains("\"K.") && Contains("one cell"));
  // d_0 T = bc, d_1 T = ab, d_2 T = ac: already d_0 d_1 = b and d_0 d_0 = c differ.
  CHECK_THAT(triangle.what, Contains("\"K.b\"") && Contains("\"K.c\""));

  const Error square =
      refused(shop, R"({"op":"complex","name":"S","cells":[{"id":"a"},{"id":"b"},{"id":"e","faces":["b","a"]},)"
                    R"({"id":"q","type":[1,1],"faces":["e","e","e","e"]}]})");
  CHECK_THAT(square.what, Contains("\"q\"") && Contains("face law") && Contains("\"S.a\"") && Contains("\"S.b\""));
  CHECK(shop.apply(operation(triangle_with(R"({"id":"T","faces":["bc","ac","ab"]})"))));
}

TEST_CASE("a wrong number of faces, or faces of wrong types, are reported with what would be right", "[ops]") {
  Workshop shop;
  CHECK_THAT(refused(shop, triangle_with(R"({"id":"T","faces":["ab"]})")).what,
             Contains("\"T\"") && Contains("1 face"));
  CHECK_THAT(refused(shop, triangle_with(R"({"id":"T","type":[2],"faces":["bc","ac"]})")).what,
             Contains("needs 3 faces") && Contains("2 are listed"));
  CHECK_THAT(refused(shop, triangle_with(R"({"id":"T","type":[],"faces":["a"]})")).what, Contains("vertex"));
  CHECK_THAT(refused(shop, triangle_with(R"({"id":"T","type":[1,1]})")).what, Contains("needs 4 faces"));
  CHECK_THAT(refused(shop, triangle_with(R"({"id":"T","faces":["bc","a","ab"]})")).what,
             Contains("face 1 of cell \"T\"") && Contains("simplex of dimension 1") && Contains("\"a\" is a vertex"));
  CHECK_THAT(refused(shop, triangle_with(R"({"id":"T","faces":["bc","ac","ab","ab"]})")).what,
             Contains("face 0 of cell \"T\"") && Contains("simplex of dimension 2"));
  const Error missing = refused(shop, triangle_with(R"({"id":"T","faces":["bc","ac","xy"]})"));
  CHECK(missing.code == Errc::unknown_name);
  CHECK_THAT(missing.what, Contains("\"xy\"") && Contains("not listed"));
  CHECK_THAT(refused(shop, triangle_with(R"({"id":"ab"})")).what, Contains("\"ab\" twice"));
}

TEST_CASE("a cell cannot be its own face, directly or around a circle", "[ops]") {
  Workshop shop;
  CHECK(refused(shop, R"({"op":"complex","name":"K","cells":[{"id":"e","faces":["e","e"]}]})").code == Errc::bad_input);
  CHECK(refused(shop, R"({"op":"complex","name":"K","cells":[{"id":"e","faces":["f","f"]},)"
                      R"({"id":"f","faces":["e","e"]}]})")
            .code == Errc::bad_input);
  CHECK(refused(shop, R"({"op":"complex","name":"K","cells":[{"id":"t","faces":["e","e","e"]},)"
                      R"({"id":"e","faces":["t","t"]}]})")
            .code == Errc::bad_input);
}

TEST_CASE("deep and malicious listings neither overflow the stack nor take long", "[ops]") {
  Workshop shop;
  MakeComplex chain{"K", {}};
  for (int k = 0; k < 200'000; ++k) {  // each an edge whose ends are the next edge
    const std::string next = "e" + std::to_string(k + 1);
    chain.cells.push_back({"e" + std::to_string(k), {}, {next, next}, {}});
  }
  chain.cells.push_back({"e200000", {}, {}, {}});
  CHECK(refused(shop, chain).code == Errc::bad_input);

  // A path listed last edge first is legal, in any order.
  MakeComplex path{"P", {}};
  for (int k = 20'000; k > 0; --k) {
    path.cells.push_back({"e" + std::to_string(k), {}, {"v" + std::to_string(k), "v" + std::to_string(k - 1)}, {}});
  }
  for (int k = 0; k <= 20'000; ++k) {
    path.cells.push_back({"v" + std::to_string(k), {}, {}, {}});
  }
  REQUIRE(shop.apply(path));
  CHECK(shop.structure().counts()[0] == 20'001);
  CHECK(shop.structure().counts()[1] == 20'000);
}

TEST_CASE("cells made in one step cannot have names that are in use, whatever others there are", "[ops]") {
  const int others = GENERATE(0, 1, 60);
  CAPTURE(others);
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"K.b","dim":1})", R"({"op":"simplex","name":"Kc","dim":0})",
              R"({"op":"simplex","name":"{u}","dim":0})"});
  for (int k = 0; k < others; ++k) {
    REQUIRE(shop.apply(MakeSimplex{"p" + std::to_string(k), 0, {}}));
  }
  for (const std::string taken : {"b", "b.0", "b.1"}) {
    MakeComplex complex{"K", {{"a", {}, {}, {}}, {taken, {}, {}, {}}, {"c", {}, {}, {}}, {"d", {}, {}, {}}}};
    CHECK_THAT(refused(shop, complex).what, Contains("the name \"K." + taken + "\" is in use"));
  }
  CHECK_THAT(refused(shop, Insert{{{"v"}, {"u"}, {"w"}, {"x"}, {"y"}}, true}).what,
             Contains("the name \"{u}\", which a new cell would have, is in use"));
  CHECK(shop.apply(MakeComplex{"K", {{"a", {}, {}, {}}, {"c", {}, {}, {}}, {"b.2", {}, {}, {}}, {"e", {}, {}, {}}}}));
  CHECK(shop.apply(Insert{{{"v"}, {"w"}, {"x"}, {"y"}}, true}));
}

TEST_CASE("the order of a listing does not matter for what is made", "[ops]") {
  const Operation straight = operation(triangle_with(R"({"id":"T","faces":["bc","ac","ab"]})"));
  const MakeComplex shuffled{"K", reversed(std::get<MakeComplex>(straight).cells)};
  Workshop one;
  Workshop other;
  REQUIRE(one.apply(straight));
  REQUIRE(other.apply(shuffled));
  for (const MakeComplex::Cell& cell : shuffled.cells) {
    const auto faces = other.structure().cells().faces(other.cell("K." + cell.id));
    const auto wanted = one.structure().cells().faces(one.cell("K." + cell.id));
    REQUIRE(faces.size() == wanted.size());
    for (std::size_t k = 0; k < faces.size(); ++k) {
      CHECK(other.structure().directory().own_name(faces[k]) == one.structure().directory().own_name(wanted[k]));
    }
  }
}

// ------------------------------------------------------------------------------------------------------------ cone

TEST_CASE("a cone over a simploid has the type of the simploid times an edge, over its sides alone, a simplex's",
          "[ops]") {
  Workshop shop;
  furnished(shop);
  const StructureMark before = mark_of(shop.structure());
  for (const std::string line : {R"({"op":"cone","apex":"v"})", R"({"op":"cone","apex":"v","over":"q"})",
                                 R"({"op":"cone","apex":"v","over":["t","q"]})"}) {
    CAPTURE(line);
    shop.build({line});
    CHECK(shop.structure().cells().type(shop.cell("v*q")).type == CellType{1, 1, 1});
    CHECK(shop.structure().cells().type(shop.cell("v*q.0-1x0")).type == CellType{1, 1});
    if (shop.structure().lookup("v*t")) {  // every cell of the cone is of one kind
      CHECK(shop.structure().cells().type(shop.cell("v*t")).type == CellType{2, 1});
    }
    shop.go_back_to(before);
  }
  CHECK(shop.apply(operation(R"({"op":"cone","apex":"v","over":["q.0-1x0"]})")));
  CHECK(shop.structure().cells().type(shop.cell("v*q.0-1x0")).type == CellType{2});
}

TEST_CASE("a cone over nothing is a vertex in a body of its own", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"cone","apex":"v"})", R"({"op":"cone","apex":"w","over":[]})"});
  CHECK(shop.structure().cells().size() == 2);
  CHECK(shop.structure().bodies().current().size() == 2);
  CHECK(shop.structure().directory().name_of_body(*shop.structure().lookup_body("w")) == "w");
}

TEST_CASE("a cone over a cell takes its closure, with the faces of the construction", "[ops]") {
  Workshop shop;
  furnished(shop);
  shop.build({R"({"op":"cone","apex":"v","over":["t"]})"});
  const auto faces = [&](const std::string& name) {
    std::vector<std::string> names;
    for (const CellId face : shop.structure().cells().faces(shop.cell(name))) {
      names.emplace_back(shop.structure().name(face));
    }
    return names;
  };
  using Names = std::vector<std::string>;
  CHECK(faces("v*t.1") == Names{"v", "t.1"});
  CHECK(faces("v*t.0-2") == Names{"v*t.2", "v*t.0", "t.0-2"});
  CHECK(faces("v*t") == Names{"v*t.1-2", "v*t.0-2", "v*t.0-1", "t"});
  CHECK(shop.structure().directory().name_of_body(shop.structure().body_of(shop.cell("v"))) == "t");
  CHECK_FALSE(shop.structure().lookup_body("v"));
  CHECK_FALSE(shop.structure().lookup("v*line"));
}

TEST_CASE("a cone over several bodies makes them one, named like the oldest", "[ops]") {
  Workshop shop;
  furnished(shop);
  const StructureMark before = mark_of(shop.structure());
  shop.build({R"({"op":"cone","apex":"v","over":["line.1","q.0x0"]})"});
  CHECK(shop.structure().bodies().current().size() == 2);
  CHECK(shop.structure().directory().name_of_body(*shop.structure().lookup_body("line")) == "q");
  CHECK(shop.structure().lazy().cells_of(*shop.structure().lookup_body("line")).size() == 9 + 3 + 3);
  shop.go_back_to(before);
  shop.build({R"({"op":"simplex","name":"dot","dim":0})", R"({"op":"cone","apex":"v","over":"line"})"});
  CHECK(shop.structure().directory().name_of_body(shop.structure().body_of(shop.cell("v*line"))) == "line");
  CHECK(shop.structure().bodies().current().size() == 4);
}

TEST_CASE("a cone follows identifications: over a loop, both ends are one vertex", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"e","dim":1})", R"({"op":"identify","pairs":[["e.1","e.0"]]})",
              R"({"op":"cone","apex":"v"})"});
  const auto faces = shop.structure().cells().faces(shop.cell("v*e"));
  REQUIRE(faces.size() == 3);
  CHECK(faces[0] == faces[1]);
  CHECK(shop.structure().name(faces[0]) == "v*e.0");
  CHECK(faces[2] == shop.cell("e"));
}

TEST_CASE("a cone over a simplex of the largest dimension is refused", "[ops]") {
  Workshop shop(Limits{.cells_of_standard = 7, .cells_per_step = 100, .cells = 100});
  REQUIRE(shop.apply(MakeSimplex{"t", 2, {}}));
  CHECK(refused(shop, MakeCone{"v", {}, {}}).code == Errc::refused);
  CHECK(shop.apply(MakeCone{"v", std::vector<std::string>{"t.0-1"}, {}}));
}

// ------------------------------------------------------------------------------------------------------ suspension

TEST_CASE("a suspension is two cones over the same cells, in one step", "[ops]") {
  Workshop shop;
  furnished(shop);
  shop.build({R"({"op":"suspend","apexes":["n","s"],"over":["t"]})"});
  CHECK(faces(shop, "n*t") == Texts{"n*t.1-2", "n*t.0-2", "n*t.0-1", "t"});
  CHECK(faces(shop, "s*t") == Texts{"s*t.1-2", "s*t.0-2", "s*t.0-1", "t"});
  CHECK(faces(shop, "s*t.1") == Texts{"s", "t.1"});
  CHECK_FALSE(shop.structure().lookup("s*n"));
  CHECK_FALSE(shop.structure().lookup("n*line"));
  CHECK(shop.structure().directory().name_of_body(shop.structure().body_of(shop.cell("s"))) == "t");
}

TEST_CASE("a suspension is what one cone, and another over a list of the same cells, make together", "[ops]") {
  const std::string over = GENERATE(R"(["t"])", R"(["q"])", R"(["t","line"])", R"(["q","t.0"])");
  Workshop one;
  Workshop two;
  furnished(one);
  furnished(two);
  one.build({R"({"op":"suspend","apexes":["n","s"],"over":)" + over + "}"});
  two.build({R"({"op":"cone","apex":"n","over":)" + over + "}", R"({"op":"cone","apex":"s","over":)" + over + "}"});
  CHECK(first_difference(dump(one.structure()), dump(two.structure())) == "");
}

TEST_CASE("a suspension over everything is taken over all bodies, over nothing it is two points", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"suspend","apexes":["n","s"]})"});
  CHECK(counts(shop) == Counts{2});
  CHECK(shop.structure().bodies().current().size() == 1);
  CHECK(shop.structure().directory().name_of_body(shop.structure().body_of(shop.cell("s"))) == "n");
  shop.build({R"({"op":"suspend","apexes":["e","w"]})"});
  CHECK(counts(shop) == Counts{4, 4});
  CHECK(shop.structure().bodies().current().size() == 1);
}

TEST_CASE("a suspension is refused when its names would be given twice, or its base cannot be listed", "[ops]") {
  Workshop shop(Limits{.cells_per_step = 100});
  furnished(shop);
  const auto what = [&shop](const std::string& line) { return refused(shop, line).what; };
  CHECK_THAT(what(R"({"op":"suspend","apexes":["n","n"]})"), Contains("both apexes are called \"n\""));
  CHECK_THAT(what(R"({"op":"suspend","apexes":["n","t"]})"), Contains("\"t\" is in use"));
  CHECK_THAT(what(R"({"op":"suspend","apexes":["n","a b"]})"), Contains("is not a name"));
  CHECK_THAT(what(R"({"op":"suspend","apexes":["n","n*t.0"],"over":["t"]})"), Contains("\"n*t.0\""));
  CHECK_THAT(what(R"({"op":"suspend","apexes":["n","s"],"over":"nobody"})"), Contains("no body \"nobody\""));
  CHECK_THAT(what(R"({"op":"suspend","apexes":["n","s"],"over":["nobody"]})"), Contains("no cell \"nobody\""));
  shop.build({R"({"op":"cone","apex":"m","over":["t.0"]})"});
  CHECK_THAT(what(R"({"op":"suspend","apexes":["x","x*m"],"over":["m*t.0","t.0"]})"),
             Contains("the apexes \"x\" and \"x*m\"") && Contains("could be mistaken"));
  shop.build({R"({"op":"product","name":"P","left":"q","right":"t"})",
              R"({"op":"product","name":"Q","left":"P","right":"P"})"});
  CHECK_THAT(what(R"({"op":"suspend","apexes":["n","s"],"over":"Q"})"),
             Contains("cells; the limit is 100 cells a step"));
}

// ------------------------------------------------------------------------------------------------------ vertex maps

TEST_CASE("each vertex of the first cell is glued to the one of the second that the map gives it", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"a","dim":2})", R"({"op":"simplex","name":"b","dim":2})",
              R"({"op":"identify","pairs":[["a","b",[2,0,1]]]})"});
  for (const auto& [one, other] : std::vector<std::pair<std::string, std::string>>{{"a.0", "b.2"},
                                                                                   {"a.1", "b.0"},
                                                                                   {"a.2", "b.1"},
                                                                                   {"a.0-1", "b.0-2"},
                                                                                   {"a.1-2", "b.0-1"},
                                                                                   {"a.0-2", "b.1-2"}}) {
    CHECK(shop.cell(one) == shop.cell(other));
  }
  const Structure& s = shop.structure();
  CHECK(s.forest().find_oriented(*s.lookup("a.0-1")).sign * s.forest().find_oriented(*s.lookup("b.0-2")).sign == -1);
  CHECK(s.forest().find_oriented(*s.lookup("a.1-2")).sign * s.forest().find_oriented(*s.lookup("b.0-1")).sign == 1);
  CHECK(first_broken_face_law(s, cells_at(s, now(s))).value_or("") == "");
}

TEST_CASE("a simploid has a vertex map for each component", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simploid","name":"p","type":[1,1]})", R"({"op":"simploid","name":"q","type":[1,1]})",
              R"({"op":"identify","pairs":[["p","q",[[1,0],[0,1]]]]})"});
  CHECK(shop.cell("p.0x0-1") == shop.cell("q.1x0-1"));
  CHECK(shop.cell("p.0-1x0") == shop.cell("q.0-1x0"));
  CHECK(shop.cell("p.1x1") == shop.cell("q.0x1"));
  CHECK(counts(shop) == Counts{4, 4, 1});
}

TEST_CASE("a gluing that folds a cell is refused, and the cell named", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"t","dim":2})", R"({"op":"simplex","name":"u","dim":2})",
              R"({"op":"simplex","name":"e","dim":1})", R"({"op":"degenerate","cell":"e","along":0})"});
  const auto what = [&shop](const std::string& pairs) {
    const Error error = refused(shop, R"({"op":"identify","pairs":)" + pairs + "}");
    CHECK(error.code == Errc::refused);
    return error.what;
  };
  CHECK_THAT(what(R"([["t.0-1","t.0-1",[1,0]]])"), Contains("\"t.0-1\" to itself with its vertices in the order 1-0"));
  CHECK_THAT(what(R"([["t","t",[1,2,0]]])"), Contains("\"t\" to itself"));
  CHECK_THAT(what(R"([["t","u"],["t","u",[1,0,2]]])"), Contains("\"t") && Contains("to itself"));
  CHECK_THAT(what(R"([["t.0-1","u.0-1"],["u.0-1","t.1-2"],["t.0-1","t.1-2",[1,0]]])"), Contains("order 1-0"));
  shop.build({R"({"op":"identify","pairs":[["t.0-1","t.0-1",[1,0]],["t.0-1","e"]]})"});  // it becomes degenerate
  CHECK(shop.structure().find(*shop.structure().lookup("t.0-1")) == none);
  CHECK(shop.structure().find(*shop.structure().lookup("t")) != none);
}

TEST_CASE("a vertex map is a permutation of the vertices of the type", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"t","dim":2})", R"({"op":"simploid","name":"q","type":[1,1]})"});
  for (const std::string pair :
       {R"(["t.0-1","t.1-2",[1]])", R"(["t.0-1","t.1-2",[0,0]])", R"(["t.0-1","t.1-2",[0,1,2]])",
        R"(["t.0-1","t.1-2",[[0,1],[0,1]]])", R"(["q","q",[0,1]])", R"(["t.0","t.1",[1]])"}) {
    CAPTURE(pair);
    const Error error = refused(shop, R"({"op":"identify","pairs":[)" + pair + "]}");
    CHECK(error.code == Errc::bad_input);
    CHECK_THAT(error.what, Contains("permutation of its vertices"));
  }
  CHECK(shop.apply(operation(R"({"op":"identify","pairs":[["t.0","t.1",[0]]]})")));
}

// -------------------------------------------------------------------------------------------------- identification

TEST_CASE("cells of different types never glue, and nothing beside them does either", "[ops]") {
  Workshop shop;
  furnished(shop);
  shop.build({R"({"op":"simploid","name":"p","type":[2,1]})", R"({"op":"simploid","name":"r","type":[1,2]})"});
  const Error error = refused(shop, R"({"op":"identify","pairs":[["t.0","t.1"],["t","q"]]})");
  CHECK(error.code == Errc::refused);
  CHECK_THAT(error.what, Contains("\"t\" is a simplex of dimension 2") && Contains("\"q\" a cube of dimension 2"));
  CHECK(refused(shop, R"({"op":"identify","pairs":[["p","r"]]})").code == Errc::refused);
  CHECK(refused(shop, R"({"op":"identify","pairs":[["t.0","line"]]})").code == Errc::refused);
}

TEST_CASE("gluing is recursive on the faces in order", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"s","dim":2})", R"({"op":"simplex","name":"t","dim":2})",
              R"({"op":"identify","pairs":[["t","s"]]})"});
  for (const std::string suffix : {"", ".0", ".1", ".2", ".0-1", ".0-2", ".1-2"}) {
    CHECK(shop.cell("s" + suffix) == shop.cell("t" + suffix));
  }
  CHECK(shop.structure().counts()[0] == 3);
  CHECK(shop.structure().counts()[2] == 1);
}

TEST_CASE("S. Peltier, habilitation (2023), figure 2.5: two edges glued head to tail become one loop", "[ops]") {
  const std::vector<std::string> edges{
      R"({"op":"complex","name":"k","cells":[{"id":"v"},{"id":"w"},{"id":"s","faces":["w","v"]},{"id":"m","faces":["v","w"]}]})"};
  Workshop at_once;
  at_once.build(edges);
  at_once.build({R"({"op":"identify","pairs":[["k.s","k.m"]]})"});
  CHECK(at_once.cell("k.v") == at_once.cell("k.w"));
  CHECK(at_once.cell("k.s") == at_once.cell("k.m"));
  Workshop vertices_first;
  vertices_first.build(edges);
  vertices_first.build({R"({"op":"identify","pairs":[["k.v","k.w"]]})"});
  CHECK(vertices_first.structure().counts()[1] == 2);
  vertices_first.build({R"({"op":"identify","pairs":[["k.s","k.m"]]})"});
  CHECK(dump(vertices_first.structure()) == dump(at_once.structure()));
}

TEST_CASE("a cell glues to its own faces' copies: self-gluing and multi-incidence", "[ops]") {
  Workshop shop;
  shop.build(
      {R"({"op":"simplex","name":"t","dim":2})", R"({"op":"identify","pairs":[["t.0-1","t.1-2"],["t.0-1","t.0-2"]]})"});
  CHECK(shop.structure().counts()[0] == 1);
  CHECK(shop.structure().counts()[1] == 1);
  for (const CellId face : shop.structure().cells().faces(shop.cell("t"))) {
    CHECK(shop.structure().find(face) == shop.cell("t.0-1"));
  }
}

TEST_CASE("classes are transitive over the pairs of one step, in any order and with repeats", "[ops]") {
  Workshop shop;
  for (int k = 0; k < 6; ++k) {
    REQUIRE(shop.apply(MakeSimplex{"v" + std::to_string(k), 0, {}}));
  }
  shop.build(
      {R"({"op":"identify","pairs":[["v4","v5"],["v0","v1"],["v1","v1"],["v5","v0"],["v5","v4"],["v0","v4"]]})"});
  CHECK(shop.last_plan().merges.size() == 3);
  CHECK(shop.structure().counts()[0] == 3);
  CHECK(shop.structure().name(shop.cell("v5")) == "v0");
  CHECK(shop.structure().forest().members(shop.cell("v4")) == 4);
}

TEST_CASE("identifying what is one already plans nothing", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"e","dim":1})", R"({"op":"identify","pairs":[["e.0","e.1"]]})"});
  const std::string before = dump(shop.structure());
  for (const std::string line : {R"({"op":"identify","pairs":[["e.0","e.1"]]})",
                                 R"({"op":"identify","pairs":[["e","e"]]})", R"({"op":"identify","pairs":[]})"}) {
    REQUIRE(shop.apply(operation(line)));
    CHECK(shop.last_plan().changes_nothing());
    CHECK(dump(shop.structure()) == before);
  }
}

TEST_CASE("what a plan says is exactly what happens", "[ops][stream]") {
  const unsigned seed = GENERATE(range(100U, 108U));
  CAPTURE(seed);
  Workshop shop;
  RandomSteps steps(seed);
  for (int k = 0; k < 40; ++k) {
    const Operation op = steps.next(shop.structure());
    CAPTURE(k, to_text(op));
    const std::string untouched = dump(shop.structure());
    REQUIRE(shop.plan(op));
    REQUIRE(dump(shop.structure()) == untouched);
    const Plan plan = shop.last_plan();
    const StructureMark before = mark_of(shop.structure());
    std::vector<bool> was_current;
    for (CellId c = 0; c < before.moment.created; ++c) {
      was_current.push_back(shop.structure().is_current(c));
    }
    int dimension = 0;
    for (const Merge& merge : plan.merges) {  // by dimension, each cell removed once, none of them a survivor
      REQUIRE(shop.structure().cells().type_id(merge.removed) == shop.structure().cells().type_id(merge.survivor));
      REQUIRE(shop.structure().dimension(merge.removed) >= dimension);
      dimension = shop.structure().dimension(merge.removed);
    }
    REQUIRE(shop.apply(op));
    const Structure& after = shop.structure();
    REQUIRE(after.cells().size() == before.moment.created + plan.cells.size());
    REQUIRE(after.forest().links() == before.moment.links + plan.merges.size());
    REQUIRE(plan.changes_nothing() == (dump(after) == untouched));
    std::set<CellId> removed;
    for (const Merge& merge : plan.merges) {
      REQUIRE(removed.insert(merge.removed).second);
      REQUIRE(after.forest().parent(merge.removed) == merge.survivor);
      REQUIRE(after.is_current(merge.survivor));
    }
    for (CellId c = 0; c < before.moment.created; ++c) {
      REQUIRE(after.is_current(c) == (was_current[c] && !removed.contains(c)));
    }
    // Merged cells have the same faces by now.
    for (const Merge& merge : plan.merges) {
      const auto one = after.cells().faces(merge.removed);
      const auto other = after.cells().faces(merge.survivor);
      for (std::size_t f = 0; f < one.size(); ++f) {
        REQUIRE(after.find(one[f]) == after.find(other[f]));
      }
    }
  }
}

TEST_CASE("every cell obeys its face laws after every step", "[ops][stream]") {
  const unsigned seed = GENERATE(range(200U, 230U));
  CAPTURE(seed);
  Workshop shop(seed % 2 == 0 ? Limits{} : Limits{.cells_of_explicit_cone = 0});
  RandomSteps steps(seed, seed < 206 ? StreamShape{} : everything_and_maps(40));
  for (int k = 0; k < 40; ++k) {
    const Operation op = steps.next(shop.structure());
    CAPTURE(k, to_text(op));
    REQUIRE(shop.apply(op));
    const Structure& s = shop.structure();
    for (const CellId c : current_cells(s)) {
      const Value whole{c, s.cells().type_id(c), 0};
      for (const FaceLaw& law : s.cells().type(c).laws) {
        const Value other = s.values().face(s.values().face(whole, law.other_first), law.other_second);
        REQUIRE(s.values().face(s.values().face(whole, law.first), law.second) ==
                (law.other_dart == 0 ? other : s.maps().seen_from(law.other_dart, other)));
      }
    }
  }
}

TEST_CASE("planning changes nothing, whatever is planned", "[ops][stream]") {
  const unsigned seed = GENERATE(range(300U, 312U));
  CAPTURE(seed);
  Workshop shop(seed % 2 == 0 ? Limits{} : Limits{.cells_of_explicit_cone = 0});
  RandomSteps steps(seed, everything_and_maps(30));
  for (int k = 0; k < 30; ++k) {
    const Operation op = steps.next(shop.structure());
    CAPTURE(k, to_text(op));
    const std::string before = dump(shop.structure());
    REQUIRE(shop.plan(op));
    REQUIRE(first_difference(dump(shop.structure()), before) == "");
    const Plan plan = shop.last_plan();
    REQUIRE(shop.apply(op));
    const bool sews = std::holds_alternative<Sew>(op) || std::holds_alternative<Unsew>(op);
    REQUIRE((plan.changes_nothing() && !sews) == (dump(shop.structure()) == before));
    // What makes something gives it names, so it cannot be done twice, and darts are sewn and unsewn once.
    const bool makes = std::holds_alternative<Deidentify>(op) ? !plan.changes_nothing() : plan.merges.empty();
    const bool equates = std::holds_alternative<Identify>(op) || std::holds_alternative<Degenerate>(op);
    REQUIRE(shop.plan(op).has_value() == (equates || (!makes && !sews)));
  }
}

TEST_CASE("a squashing is refused with what would be right", "[ops]") {
  Workshop shop;
  furnished(shop);
  shop.build({R"({"op":"complex","name":"K","cells":[{"id":"a"}]})", R"({"op":"simplex","name":"e","dim":1})",
              R"({"op":"degenerate","cell":"e","along":0})"});
  const std::vector<std::tuple<std::string, Errc, std::string>> wrong{
      {R"({"op":"degenerate","cell":"nobody","along":0})", Errc::unknown_name, "no cell \"nobody\""},
      {R"({"op":"degenerate","cell":"K","along":0})", Errc::unknown_name, "name of a body"},
      {R"({"op":"degenerate","cell":"t.0","along":0})", Errc::bad_input, "\"t.0\" is a vertex"},
      {R"({"op":"degenerate","cell":"t","along":2})", Errc::bad_input, "from 0 to 1"},
      {R"({"op":"degenerate","cell":"t","along":[2,0]})", Errc::bad_input, "its components are 1 to 1"},
      {R"({"op":"degenerate","cell":"t","along":[1,2]})", Errc::bad_input, "from 0 to 1"},
      {R"({"op":"degenerate","cell":"q","along":0})", Errc::bad_input, "\"along\" should be [i,j]"},
      {R"({"op":"degenerate","cell":"q","along":[3,0]})", Errc::bad_input, "its components are 1 to 2"},
      {R"({"op":"degenerate","cell":"q","along":[2,1]})", Errc::bad_input, "from 0 to 0"},
      {R"({"op":"degenerate","cell":"e","along":1})", Errc::bad_input, "from 0 to 0"}};
  for (const auto& [line, code, what] : wrong) {
    CAPTURE(line);
    const Error error = refused(shop, line);
    CHECK(error.code == code);
    CHECK_THAT(error.what, Contains(what));
  }
  for (const auto& [component, index] :
       {std::pair{0, 0}, std::pair{-1, 0}, std::pair{1, -1}, std::pair{1, -1'000'000}}) {
    CHECK(refused(shop, Degenerate{"t", component, index}).code == Errc::bad_input);
  }
}

TEST_CASE("names that are almost those of lazy cells are as good as any", "[ops]") {
  Workshop shop(Limits{.cells_of_explicit_cone = 0});
  shop.build({R"({"op":"simplex","name":"t","dim":1})", R"({"op":"simplex","name":"b","dim":0})",
              R"({"op":"cone","apex":"u","over":"t"})", R"({"op":"cone","apex":"w","over":"b"})",
              R"({"op":"simplex","name":"w*u*t","dim":1})"});
  CHECK(face_texts(shop.structure(), shop.cell("w*u*t")) == std::vector<std::string>{"w*u*t.1", "w*u*t.0"});
}

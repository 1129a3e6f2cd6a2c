// What names denote: all names of a cell in the names of cones and products, orders of vertices, names of any text.
#include "ops/cells/name_reader.hpp"

#include <map>
#include <set>

#include "tests/support/abstract_steps.hpp"
#include "tests/support/plain_names.hpp"
#include "tests/support/random_steps.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;
using Catch::Matchers::Contains;

namespace {

const Limits lazy{.cells_of_explicit_cone = 0};

std::optional<Value> value_of(const Structure& structure, const std::string& name) {
  const auto node = structure.lookup(name);
  return node ? std::optional{structure.values().of(*node)} : std::nullopt;
}

std::vector<std::string> given_names(const Structure& structure) {
  std::vector<std::string> names;
  for (CellId c = 0; c < structure.cells().size(); ++c) {
    names.push_back(structure.directory().own_name(c));
    if (const auto further = structure.directory().find(names.back() + ".0"); further && further->cell == c) {
      names.push_back(names.back() + ".0");
    }
  }
  return names;
}

const std::string& any_of(const std::vector<std::string>& names, Random& random) {
  return names[static_cast<std::size_t>(random.in(0, static_cast<int>(names.size()) - 1))];
}

/// Names put together from others, mostly from cells of the right bodies, some of them damaged.
std::vector<std::string> corpus(const Structure& structure, std::vector<std::string> parts, Random& random, int size) {
  const PlainReader plain(structure);
  std::vector<std::string> names;
  for (FamilyId f = 0; f < structure.lazy().families(); ++f) {
    const LazyFamily& family = structure.lazy().family(f);
    const auto part = [&](BodyId body) {
      std::string one = any_of(parts, random);
      for (int tries = random.in(0, 30); tries > 0 && !plain.in_bodies(one, {body}); --tries) {
        one = any_of(parts, random);
      }
      const std::vector<std::string> ends{"", "", "", "", "", "", "^0", "^1", "^0,1", "^x", ")", "|", "("};
      return one + any_of(ends, random);
    };
    for (int k = 0; k * static_cast<int>(structure.lazy().families()) < size; ++k) {
      std::string name = family.kind == FamilyKind::cone
                             ? family.name + "*" + part(family.bodies.front())
                             : family.name + ".(" + part(family.bodies[0]) + "|" + part(family.bodies[1]) + ")";
      if (random.one_in(10)) {
        name.erase(static_cast<std::size_t>(random.in(0, static_cast<int>(name.size()) - 1)), 1);
      }
      names.push_back(name);
      if (name.size() < 60) {
        parts.push_back(name);
      }
    }
  }
  return names;
}

/// Tries an operation, which may be refused.
void attempt(Workshop& shop, const Operation& op) {
  if (shop.plan(op)) {
    shop.carry_out();
  }
}

/// The number of look-ups that reading a name takes, whatever it denotes.
std::uint64_t work_of(const Structure& structure, const std::string& name) {
  const auto looked_up = [&] { return structure.directory().looked_up() + structure.abstract().labels_looked_up(); };
  const std::uint64_t before = looked_up();
  (void)structure.lookup(name);
  return looked_up() - before;
}

std::string times(int n, const std::string& text) {
  std::string all;
  for (int k = 0; k < n; ++k) {
    all += text;
  }
  return all;
}

/// "P29.(...P1.(P0.(v|w0)|w1)...|w29)"
std::string nested(int levels) {
  std::string name = "v";
  for (int k = 0; k < levels; ++k) {
    name = "P" + std::to_string(k) + ".(" + name + "|w" + std::to_string(k) + ")";
  }
  return name;
}

void build_nested(Workshop& shop, int levels) {
  REQUIRE(shop.apply(MakeSimplex{"v", 0, {}}));
  std::string body = "v";
  for (int k = 0; k < levels; ++k) {
    const std::string number = std::to_string(k);
    REQUIRE(shop.apply(MakeSimplex{"w" + number, 0, {}}));
    REQUIRE(shop.apply(MakeProduct{"P" + number, body, "w" + number, false}));
    body = "P" + number;
  }
}

}  // namespace

// ------------------------------------------------------------------------------------------------- taking names apart

TEST_CASE("a name out of order keeps its order where cells have met as degenerate ones", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simploid","name":"q1","type":[2]})", R"({"op":"degenerate","cell":"q1.0-1","along":0})",
              R"({"op":"identify","pairs":[["q1.0","q1.2"]]})",
              R"({"op":"suspend","over":["q1"],"apexes":["v4","s5"]})", R"({"op":"simplex","name":"t8","dim":0})",
              R"({"op":"product","name":"P9","left":"t8","right":"t8","kind":"simplicial"})",
              R"({"op":"identify","pairs":[["q1","s5*q1.0-2"]]})", R"({"op":"simploid","name":"q2","type":[3]})",
              R"({"op":"identify","pairs":[["v4*q1.0-2","q2.0-1-2"]]})",
              R"({"op":"identify","pairs":[["q2.0-1-2","q2.0-2-3"]]})",
              R"({"op":"degenerate","cell":"s5*q1.1-2","along":0})"});
  // q2.2-3 and q1.0-2, over which the cone was taken, are degenerate by the step that makes them one.
  CHECK(shop.structure().lookup("v4*q2.3-2") == shop.structure().lookup("v4*q2.2-3"));
  CHECK(shop.structure().denoted("v4*q2.2-3")->order == shop.structure().denoted("v4*q1.0-2")->order);
  CHECK(sign_denoted(shop.structure(), "v4*q2.3-2") == -sign_denoted(shop.structure(), "v4*q2.2-3"));
}

TEST_CASE("edges that a step makes degenerate meet in no order, whatever became of them on the way", "[ops]") {
  Workshop shop;
  shop.build(
      {R"({"op":"simploid","name":"q1","type":[2,1]})",
       R"({"op":"cone","apex":"v1","over":["q1.0-2x0-1","q1.0-1-2x0"],"at":[0,0,2]})",
       R"({"op":"deidentify","split":[{"cell":"q1.1-2x0","as":"x6","moves":[["x9",3]]},{"cell":"q1.1-2x1","as":"x7","moves":[["x9",2]]},{"cell":"q1.1x0-1","as":"x5","moves":[["x9",1]]},{"cell":"q1.1x1","as":"x3","moves":[["x7",1],["x5",0]]},{"cell":"q1.1-2x0-1","as":"x9","moves":[]}]})",
       R"({"op":"suspend","over":["q1.2x0-1","x5","v1*q1.0-1x0"],"at":[[0,0,3],[0,0,-1]],"apexes":["v11","s1"]})",
       R"({"op":"identify","pairs":[["q1","v1*q1.2-0-1x0"],["q1.0-1-2x1","q1.0-1-2x0"],["v1*q1.1-2x0","s1*v1*q1.0x0"]]})",
       R"({"op":"identify","pairs":[["s1*v1*q1.0-1x0","v1*q1.0-2x0-1"]]})"});
  CHECK(shop.structure().lookup("v11*q1.0-2x0") == shop.structure().lookup("v11*q1.0-1x0"));
  CHECK(shop.structure().denoted("v11*q1.0-2x0")->order == shop.structure().denoted("v11*q1.0-1x0")->order);
}

TEST_CASE("names that are put together denote what they do when every way to take them apart is tried",
          "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 20U));
  CAPTURE(seed);
  Workshop shop(lazy);
  StreamShape shape = everything(24);
  shape.replacements = false;  // their names are given
  RandomSteps steps(seed, shape);
  Random random(seed);
  int found = 0;
  for (int k = 0; k < 20; ++k) {
    REQUIRE(shop.apply(steps.next(shop.structure())));
    const PlainReader plain(shop.structure());
    std::vector<std::string> parts = given_names(shop.structure());
    for (const CellId c : current_cells(shop.structure())) {
      parts.emplace_back(shop.structure().name(c));
    }
    for (const std::string& name : corpus(shop.structure(), parts, random, 40)) {
      CAPTURE(name);
      const auto wanted = plain.read(name);
      if (wanted) {
        REQUIRE(value_of(shop.structure(), name) == wanted);
        ++found;
      }
    }
  }
  CHECK((found > 0 || shop.structure().lazy().families() == 0));
}

TEST_CASE("names of any text, with brackets that do not match and bars, denote what they always did", "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 60U));
  CAPTURE(seed);
  Random random(seed);
  Workshop shop(lazy);
  const std::vector<std::string> tokens{"x", "y",  "|",  "|", "(",   ")",    "{", "}",
                                        "*", ".(", "^0", "P", "x|y", "P.(x", ","};
  const auto text = [&] {
    std::string all;
    for (int n = random.in(1, 4); n > 0; --n) {
      all += any_of(tokens, random);
    }
    return all;
  };
  for (int k = 0; k < 14; ++k) {
    attempt(shop, MakeSimplex{text(), random.in(0, 1), {}});
    const auto bodies = shop.structure().bodies().current();
    if (k < 4 || bodies.empty()) {
      continue;
    }
    const auto body = [&] {
      return std::string{shop.structure().directory().name_of_body(
          bodies[static_cast<std::size_t>(random.in(0, static_cast<int>(bodies.size()) - 1))])};
    };
    const std::string left = body();
    if (random.one_in(3)) {
      attempt(shop, MakeCone{random.one_in(2) ? text() : "P", left, {}});
    } else {
      attempt(shop, MakeProduct{random.one_in(2) ? text() : "P", left, body(), random.one_in(2)});
    }
  }
  const PlainReader plain(shop.structure());
  std::vector<std::string> parts = given_names(shop.structure());
  parts.insert(parts.end(), tokens.begin(), tokens.end());
  for (const std::string& name : corpus(shop.structure(), parts, random, 400)) {
    CAPTURE(name);
    const auto found = value_of(shop.structure(), name);
    REQUIRE(found == plain.read(name));
    REQUIRE(shop.structure().is_name_taken(name) == (found || shop.structure().lookup_body(name)));
  }
}

TEST_CASE("where a name can be taken apart in two ways the shorter left part counts, as ever", "[ops]") {
  Workshop shop;
  for (const std::string name : {"x", "x|y", "z"}) {
    REQUIRE(shop.apply(MakeSimplex{name, 0, {}}));
  }
  shop.build({R"({"op":"identify","pairs":[["x","x"]]})"});
  REQUIRE(shop.apply(MakeComplex{"L", {{"a", {}, {}, {}}}}));
  REQUIRE(shop.apply(Identify{{{"x", "L.a"}, {"x|y", "L.a"}}}));
  REQUIRE(shop.apply(MakeSimplex{"y|z", 1, {}}));
  REQUIRE(shop.apply(Identify{{{"z", "y|z.0"}}}));
  REQUIRE(shop.apply(MakeProduct{"P", "L", "z", false}));
  const Structure& s = shop.structure();
  CHECK(meaning(s, "P.(x|y|z)") == "P.(x|y|z)");                         // (x) and (y|z), an edge
  CHECK(s.cells().type(shop.cell("P.(x|y|z)")).type == CellType{1});     // not the vertex of (x|y) and (z)
  CHECK(s.cells().type(shop.cell("P.(x|y|y|z.1)")).type == CellType{});  // here only (x|y) is a name
  CHECK(shop.cell("P.(x|z)") == shop.cell("P.(L.a|y|z.0)"));
}

TEST_CASE("a nested name is read by its brackets, in no more look-ups than it has characters", "[ops][cost]") {
  Workshop shop;
  build_nested(shop, 60);
  const std::string name = nested(60);
  CHECK(shop.structure().name(shop.cell(name)) == name);
  CHECK(work_of(shop.structure(), name) < 60 * 8);
  // Neither a name with odd brackets elsewhere nor one that is part of it makes that much worse.
  Workshop odd;
  REQUIRE(odd.apply(MakeSimplex{"a|(", 0, {}}));
  build_nested(odd, 60);
  CHECK(work_of(odd.structure(), name) < 60 * 8);
  REQUIRE(odd.apply(MakeProduct{"Q", "P59", "a|(", false}));
  CHECK(work_of(odd.structure(), "Q.(" + name + "|a|()") < 18 * (name.size() + 9) + 600);
  CHECK_THAT(error_of(odd, Degenerate{"Q.(" + name + "|a|()", {}, 0}).what, Contains("in too many ways"));
  Workshop few;
  REQUIRE(few.apply(MakeSimplex{"a|(", 0, {}}));
  build_nested(few, 12);
  REQUIRE(few.apply(MakeProduct{"Q", "P11", "a|(", false}));
  CHECK(few.structure().name(few.cell("Q.(" + nested(12) + "|a|()")) == "Q.(" + nested(12) + "|a|()");
}

TEST_CASE("a megabyte of hostile names costs look-ups in proportion to its length", "[ops][cost]") {
  const bool with_odd_names = GENERATE(false, true);
  CAPTURE(with_odd_names);
  Workshop shop;
  build_nested(shop, 30);
  REQUIRE(shop.apply(MakeSimplex{"t", 3, {}}));
  REQUIRE(shop.apply(MakeCone{"a", std::vector<std::string>{"t"}, {}}));
  for (const std::string label : {"p", "q"}) {
    REQUIRE(shop.apply(Insert{{{label}}}));
  }
  if (with_odd_names) {
    for (const std::string name : {"x|", "x|x", "(", "P2.(", "a*a", "a*"}) {
      REQUIRE(shop.apply(MakeSimplex{name, 0, {}}));
    }
  }
  std::vector<std::string> names{nested(30), nested(30) + ")", nested(31), nested(30) + "^0",
                                 "P2.(P1.(P0.(v|w0)|w1)|w2)"};
  for (const int n : {10, 300, 2500}) {
    for (const std::string part :
         {"P2.(",     "a*",      "(",       ")",  "|",   "{",   "}",  "*",    ".(",
          "x|",       "P29.(x|", "a*P29.(", "0-", "{p,", "^0,", "t.", "|w2)", "P29.(P28.(P27.(|||",
          "a*t.0-1|", "{p,q}|",  "a*a*x*"}) {
      names.push_back(times(n, part));
      names.push_back("P29.(" + times(n, part) + ")");
      names.push_back("P29.(P28.(" + times(n, part) + "|w28)|w29)");
      names.push_back("a*" + times(n, part) + "t");
      names.push_back("{" + times(n, part) + "}");
      names.push_back("t." + times(n, part) + "0");
    }
  }
  std::uint64_t bytes = 0;
  std::uint64_t work = 0;
  for (const std::string& name : names) {
    const std::uint64_t own = work_of(shop.structure(), name);
    CHECK(own <= (with_odd_names ? 18 * name.size() + 600 : 3 * name.size() + 20));
    bytes += name.size();
    work += own;
  }
  CHECK(bytes > 1'000'000);
  CHECK(work < (with_odd_names ? 18 : 2) * bytes);
}

TEST_CASE("hostile texts can be given as names, and found again", "[ops][cost]") {
  Workshop shop(lazy);
  for (const std::string part : {"*", ".(", "(", "|", "{", "a*", "P.(x|"}) {
    const std::string name = times(20000, part);
    const StructureMark before = mark_of(shop.structure());
    REQUIRE(shop.apply(MakeSimplex{name, 0, {}}));
    CHECK(shop.structure().lookup(name));
    CHECK(refused(shop, MakeSimplex{name, 0, {}}).code == Errc::bad_input);
    shop.go_back_to(before);
    CHECK_FALSE(shop.structure().lookup(name));
    CHECK(shop.structure().directory().odd_names().empty());
  }
}

TEST_CASE("names and products are nested to a limit, and what is above it says so", "[ops]") {
  Workshop shop;
  REQUIRE(shop.apply(MakeSimplex{"t", 1, {}}));
  REQUIRE(shop.apply(MakeCone{"v", {}, {}}));
  CHECK_THAT(refused(shop, Degenerate{times(258, "v*") + "t", {}, 0}).what,
             Contains("256") && Contains("within one another") && Contains("limit"));
  CHECK_THAT(refused(shop, Degenerate{times(257, "v*") + "t", {}, 0}).what, Contains("there is no cell"));
  CHECK_THAT(refused(shop, Degenerate{times(100'000, "v*") + "t", {}, 0}).what, Contains("... (200001 bytes)"));

  Workshop deep;
  build_nested(deep, 194);
  CHECK(deep.structure().name(deep.cell(nested(194))) == nested(194));
  const Error error = error_of(deep, MakeProduct{"Q", "P193", "P193", false});
  CHECK(error.code == Errc::refused);
  CHECK_THAT(error.what, Contains("194 products and cones") && Contains("limit"));
  // Bodies that become one are as deep as the deeper of them, until that is taken back.
  REQUIRE(deep.apply(MakeSimplex{"e", 1, {}}));
  const StructureMark apart = mark_of(deep.structure());
  REQUIRE(deep.apply(Identify{{{"e.0", nested(194)}}}));
  CHECK(error_of(deep, MakeProduct{"Q", "e", "e", false}).code == Errc::refused);
  deep.go_back_to(apart);
  CHECK(deep.plan(MakeProduct{"Q", "e", "e", false}));
}

TEST_CASE("no apex and no product may have a name that could begin the names of another's cells", "[ops]") {
  Workshop shop(GENERATE(Limits{}, lazy));
  REQUIRE(shop.apply(MakeSimplex{"t", 1, {}}));
  REQUIRE(shop.apply(MakeSimplex{"s", 1, {}}));
  REQUIRE(shop.apply(MakeSimplex{"r", 1, {}}));
  REQUIRE(shop.apply(MakeCone{"u*v", std::vector<std::string>{"t"}, {}}));
  REQUIRE(shop.apply(MakeProduct{"P", "s", "s", false}));
  for (const std::string name : {"u", "u*v*w", "u*v.(x", "P*x", "P.(x"}) {
    CAPTURE(name);
    CHECK_THAT(refused(shop, MakeCone{name, std::vector<std::string>{"t"}, {}}).what, Contains("could be mistaken"));
    CHECK_THAT(refused(shop, MakeProduct{name, "r", "r", false}).what, Contains("could be mistaken"));
  }
  for (const std::string name : {"u*", "u*w", "v", "u*v.x", "P.x", "Q"}) {
    CAPTURE(name);
    CHECK(shop.plan(MakeCone{name, std::vector<std::string>{"t"}, {}}));
  }
}

// ------------------------------------------------------------------------------------- every name in every other name

TEST_CASE("a cone's cell answers to its derived name for every name of the coned cell", "[ops]") {
  Workshop shop(GENERATE(Limits{}, lazy));
  shop.build({R"({"op":"simplex","name":"s1","dim":3})", R"({"op":"simplex","name":"s2","dim":3})",
              R"({"op":"identify","pairs":[["s1.0-1-2","s2.0-1-3"]]})"});
  REQUIRE(
      shop.apply(MakeCone{"v", GENERATE(std::vector<std::string>{"s2.3"}, std::vector<std::string>{"s1", "s2"}), {}}));
  CHECK(shop.cell("v*s2.3") == shop.cell("v*s1.2"));
  CHECK(meaning(shop.structure(), "v*s2.3") == "v*s1.2");
  CHECK_THAT(refused(shop, MakeSimplex{"v*s2.3", 0, {}}).what, Contains("in use"));
}

TEST_CASE("a cone over a list has cones over the cells of the closure only", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"t","dim":2})", R"({"op":"cone","apex":"v","over":["t.0-1"]})"});
  CHECK(shop.structure().lookup("v*t.1-0"));
  for (const std::string name : {"v*t", "v*t.2", "v*t.2-0", "v*v", "v*v*t.0", "v*", "v*x", "t*v", "v.(t.0|t.1)"}) {
    CAPTURE(name);
    CHECK_FALSE(shop.structure().lookup(name));
  }
}

TEST_CASE("names that a coned cell gets later serve as well, and those of a copy do not", "[ops]") {
  Workshop shop(GENERATE(Limits{}, lazy));
  shop.build({R"({"op":"simplex","name":"t","dim":1})", R"({"op":"cone","apex":"v","over":"t"})",
              R"({"op":"simplex","name":"n","dim":0})", R"({"op":"simplex","name":"m","dim":0})"});
  CHECK_FALSE(shop.structure().lookup("v*n"));
  const StructureMark apart = mark_of(shop.structure());
  shop.build({R"({"op":"identify","pairs":[["m","n"]]})", R"({"op":"identify","pairs":[["n","t.1"]]})"});
  CHECK(shop.cell("v*n") == shop.cell("v*t.1"));
  CHECK(shop.cell("v*m") == shop.cell("v*t.1"));
  // The cones over two cells that become one stay two, and a name stays with the one that it was of first.
  shop.build({R"({"op":"identify","pairs":[["t.0","t.1"]]})"});
  CHECK(shop.cell("v*t.0") != shop.cell("v*t.1"));
  CHECK(shop.cell("v*n") == shop.cell("v*t.1"));
  // What becomes of both at once is called after the older one.
  shop.build({R"({"op":"simplex","name":"o","dim":0})", R"({"op":"identify","pairs":[["o","n"]]})"});
  CHECK(shop.cell("v*o") == shop.cell("v*t.0"));
  shop.build({R"({"op":"deidentify","split":[{"cell":"n","as":"copy","moves":[["t",0],["v*t.1",1]]}]})"});
  CHECK(shop.cell("v*n") == shop.cell("v*t.1"));
  CHECK_FALSE(shop.structure().lookup("v*copy"));
  shop.go_back_to(apart);
  CHECK_FALSE(shop.structure().lookup("v*n"));
}

TEST_CASE("a name that was given is never taken for another cell's", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"t","dim":1})", R"({"op":"simplex","name":"n","dim":0})",
              R"({"op":"simplex","name":"v*n","dim":0})", R"({"op":"cone","apex":"v","over":["t"]})"});
  const CellId own = shop.cell("v*n");
  shop.build({R"({"op":"identify","pairs":[["n","t.0"]]})"});
  CHECK(shop.cell("v*n") == own);
  CHECK(shop.structure().name(own) == "v*n");
  CHECK(shop.structure().cells().type(shop.cell("v*t.0")).type == CellType{1});
}

TEST_CASE("a cone over a degenerate cell's name is degenerate, whether it is written out or not", "[ops]") {
  Workshop shop(GENERATE(Limits{}, lazy));
  shop.build({R"({"op":"simplex","name":"t","dim":2})", R"({"op":"degenerate","cell":"t.0-1","along":0})",
              R"({"op":"cone","apex":"v","over":"t"})"});
  CHECK(meaning(shop.structure(), "v*t.0-1") == "v*t.0^0 of a simplex of dimension 2");
  // A cell that is squashed later has been coned as it was.
  shop.build({R"({"op":"degenerate","cell":"t.1-2","along":0})"});
  CHECK(shop.cell("v*t.1-2") != none);
  CHECK(shop.cell("t.1-2") == none);
  // A cell that is glued to it is squashed in the same way, and has become what it is.
  shop.build({R"({"op":"simplex","name":"e","dim":1})", R"({"op":"identify","pairs":[["e","t.1-2"]]})"});
  CHECK(shop.cell("v*e") == shop.cell("v*t.1-2"));
}

TEST_CASE("names of cones and products are put together to any depth from any names", "[ops]") {
  Workshop shop(GENERATE(Limits{}, lazy));
  shop.build({R"({"op":"simplex","name":"e","dim":1})", R"({"op":"identify","pairs":[["e.0","e.1"]]})",
              R"({"op":"cone","apex":"u","over":"e"})", R"({"op":"simplex","name":"n","dim":0})",
              R"({"op":"identify","pairs":[["n","u"]]})", R"({"op":"cone","apex":"w","over":"e"})",
              R"({"op":"simplex","name":"f","dim":1})", R"({"op":"product","name":"P","left":"e","right":"f"})",
              R"({"op":"cone","apex":"x","over":"P"})"});
  const auto same = [&](const std::string& one, const std::string& other) {
    CAPTURE(one, other);
    CHECK(shop.cell(one) == shop.cell(other));
  };
  same("P.(w*u*e.1|f.1)", "P.(w*u*e.0|f.1)");
  same("P.(w*n|f)", "P.(w*u|f)");
  same("x*P.(w*u*e.1|f.1-0)", "x*P.(w*u*e.0|f)");
  same("x*P.(w*n|f.0)", "x*P.(w*u|f.0)");
  shop.build({R"({"op":"simplex","name":"k","dim":2})", R"~({"op":"identify","pairs":[["k","P.(w*u*e.1|f.1)"]]})~"});
  same("x*k", "x*P.(w*u*e.0|f.1)");
  CHECK_FALSE(shop.structure().lookup("P.(k|f)"));
}

namespace {

/// What names of cones should denote, kept in tables from the steps at which they came about.
class ConeNames {
 public:
  /// Before a step: what names denote.
  void before(const Structure& structure) {
    known_.clear();
    std::vector<std::string> names = given_names(structure);
    for (const CellId c : current_cells(structure)) {
      if (structure.lazy().is_lazy(c)) {
        names.emplace_back(structure.name(c));
      }
    }
    for (const std::string& name : names) {
      const Value v = *value_of(structure, name);
      known_.push_back({name, std::string{structure.name(v.cell)}, v, structure.forest().oldest(v.cell)});
    }
    std::stable_sort(known_.begin(), known_.end(), [&](const Known& one, const Known& other) {
      return structure.lazy().is_older(one.oldest, other.oldest);
    });
  }

  void after(const Structure& structure, const Operation& op) {
    if (const auto* cone = std::get_if<MakeCone>(&op)) {
      add_cone(structure, cone->apex);
    }
    for (auto& [apex, table] : tables_) {
      std::unordered_map<Value, std::string, ValueHash> oldest;  // of what is coned, by what it is now
      for (const std::string& name : table.coned) {
        oldest.emplace(without_order(*value_of(structure, name)), name);
      }
      for (const std::string& name : given_names(structure)) {
        if (const auto met = oldest.find(without_order(*value_of(structure, name))); met != oldest.end()) {
          table.entries.emplace(name, Entry{met->second, 0, 0});
        }
      }
    }
  }

  /// Every name in the tables denotes what they say, and no other makes the name of a cone's cell.
  [[nodiscard]] std::string defect(const Structure& structure) const {
    for (const auto& [apex, table] : tables_) {
      for (const auto& [name, entry] : table.entries) {
        const std::string full = apex + "*" + name;
        const auto found = value_of(structure, full);
        if (!is_given(structure, full) &&
            (!found || without_order(*found) != without_order(wanted(structure, apex, entry)))) {
          return full + " is not as " + apex + "*" + entry.coned;
        }
      }
      for (const std::string& name : given_names(structure)) {
        const std::string full = apex + "*" + name;
        if (!table.entries.contains(name) && !is_given(structure, full) && structure.lookup(full)) {
          return full + " is a name";
        }
      }
    }
    return "";
  }

  /// Names other than those that cells were made with.
  [[nodiscard]] std::size_t others() const {
    std::size_t number = 0;
    for (const auto& [apex, table] : tables_) {
      number += table.entries.size() - table.coned.size();
    }
    return number;
  }

 private:
  struct Known {
    std::string name, canonical;
    Value value;
    CellId oldest;
  };
  /// The cone over a cell, by its canonical name of the time, or a degeneracy of it.
  struct Entry {
    std::string coned;
    TypeId type;
    Degeneracy collapsed;
  };
  struct Table {
    std::vector<std::string> coned;  ///< by age
    std::map<std::string, Entry> entries;
  };

  /// Which cell something is, or a degeneracy of which, in whatever order.
  static Value without_order(Value v) {
    v.order = same_order;
    return v;
  }

  static bool is_given(const Structure& structure, const std::string& name) {
    const auto found = structure.directory().find(name);
    return found && found->cell != none;
  }

  void add_cone(const Structure& structure, const std::string& apex) {
    Table& table = tables_[apex];
    for (const Known& known : known_) {
      if (structure.lookup(apex + "*" + known.canonical)) {
        table.entries.emplace(known.name, Entry{known.canonical, known.value.type, known.value.collapsed});
        if (known.name == known.canonical) {
          table.coned.push_back(known.name);
        }
      }
    }
  }

  static Value wanted(const Structure& structure, const std::string& apex, const Entry& entry) {
    const CellId cone = *structure.lookup(apex + "*" + entry.coned);
    const bool by_edges = structure.cones().from(structure.directory().find(apex)->cell)->by_edges;
    return entry.collapsed == 0
               ? structure.values().of(cone)
               : structure.values().normal_form({cone, structure.types().coned(entry.type, by_edges), entry.collapsed});
  }

  std::vector<Known> known_;
  std::map<std::string, Table> tables_;
};

}  // namespace

TEST_CASE("names of cones denote from step to step what tables of all names say", "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 40U));
  const bool is_lazy = GENERATE(false, true);
  CAPTURE(seed, is_lazy);
  Workshop shop(is_lazy ? lazy : Limits{});
  RandomSteps steps(seed, everything(20));
  Random random(seed);
  ConeNames names;
  std::vector<std::pair<StructureMark, ConeNames>> past;
  for (int k = 0; k < 30; ++k) {
    past.emplace_back(mark_of(shop.structure()), names);
    const Operation op =
        k % 7 == 3 ? Operation{MakeCone{"top" + std::to_string(k), {}, {}}} : steps.next(shop.structure());
    CAPTURE(k, to_text(op));
    names.before(shop.structure());
    if (const Status status = shop.apply(op); !status) {
      REQUIRE(k % 7 == 3);  // a cone of too large a dimension, say
      continue;
    }
    names.after(shop.structure(), op);
    REQUIRE(names.defect(shop.structure()) == "");
    if (random.one_in(6)) {
      const auto back = past.begin() + random.in(0, static_cast<int>(past.size()) - 1);
      shop.go_back_to(back->first);
      names = back->second;
      past.erase(back, past.end());
      REQUIRE(names.defect(shop.structure()) == "");
    }
  }
}

// --------------------------------------------------------------------------------------------------- orders of
// vertices

TEST_CASE("a name that lists vertices denotes the simplex in that order", "[ops]") {
  Workshop shop(GENERATE(Limits{}, lazy));
  shop.build({R"({"op":"simplex","name":"t","dim":2})", R"({"op":"simploid","name":"q","type":[1,2]})",
              R"({"op":"insert","simplex":[0,2,10]})", R"({"op":"cone","apex":"v"})",
              R"({"op":"simplex","name":"e","dim":1})", R"({"op":"simplex","name":"f","dim":1})",
              R"({"op":"product","name":"P","left":"e","right":"f"})"});
  const std::vector<std::tuple<std::string, int, std::string>> names{{"t.2-0", -1, "t.0-2"},
                                                                     {"t.2-0-1", 1, "t"},
                                                                     {"t.1-0-2", -1, "t"},
                                                                     {"t.0-1-2", 1, "t"},
                                                                     {"q.1-0x1", -1, "q.0-1x1"},
                                                                     {"q.1-0x2-0", 1, "q.0-1x0-2"},
                                                                     {"q.0x2-1-0", -1, "q.0x0-1-2"},
                                                                     {"{2,0}", -1, "{0,2}"},
                                                                     {"{10,0}", -1, "{0,10}"},
                                                                     {"{2,10,0}", 1, "{0,2,10}"},
                                                                     {"v*{2,0}", -1, "v*{0,2}"},
                                                                     {"v*t.2-1-0", -1, "v*t"},
                                                                     {"v*q.1-0x2-0", 1, "v*q.0-1x0-2"},
                                                                     {"P.(e.1-0|f)", -1, "P.(e|f)"},
                                                                     {"P.(e.1-0|f.1-0)", 1, "P.(e|f)"},
                                                                     {"P.(e.0|f.1-0)", -1, "P.(e.0|f)"}};
  for (const auto& [name, sign, plain] : names) {
    CAPTURE(name);
    CHECK(shop.cell(name) == shop.cell(plain));
    CHECK(sign_denoted(shop.structure(), name) == sign);
    CHECK(sign_denoted(shop.structure(), plain) == 1);
    CHECK(shop.structure().name(shop.cell(name)) == plain);
  }
  for (const std::string name :
       {"t.0-0", "t.3", "t.1-3", "t.", "t.2-0x1", "q.1-0", "{2,2}", "{0,2,2}", "{2,0", "e.1-0-"}) {
    CAPTURE(name);
    CHECK_FALSE(shop.structure().lookup(name));
  }
}

TEST_CASE("cells of a complex have ids that only look like vertices", "[ops]") {
  Workshop shop;
  REQUIRE(shop.apply(MakeComplex{"K", {{"0-1", {}, {}, {}}, {"2", {}, {}, {}}}}));
  CHECK(shop.structure().lookup("K.0-1"));
  CHECK_FALSE(shop.structure().lookup("K.1-0"));
  CHECK(shop.apply(MakeSimplex{"K.1-0", 1, {}}));
}

TEST_CASE("where faces are counted or matched, that goes by the order that a name lists", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"insert","simplex":[0,2,7]})", R"({"op":"simplex","name":"t","dim":2})"});
  const StructureMark before = mark_of(shop.structure());
  const auto same = [&](const std::string& one, const std::string& other) {
    CAPTURE(one, other);
    CHECK(shop.cell(one) == shop.cell(other));
  };
  shop.build({R"({"op":"identify","pairs":[["{2,0}","t.0-1"]]})"});
  same("{2}", "t.0");
  same("{0}", "t.1");
  CHECK(shop.cell("{7}") != shop.cell("t.2"));
  shop.go_back_to(before);
  shop.build({R"({"op":"identify","pairs":[["{2,7,0}","t.1-0-2"]]})"});
  same("{2}", "t.1");
  same("{7}", "t.0");
  same("{0}", "t.2");
  same("{0,2}", "t.1-2");
  CHECK(sign_denoted(shop.structure(), "{2,7,0}") == 1);
  shop.go_back_to(before);
  shop.build({R"({"op":"degenerate","cell":"t.2-0-1","along":0})"});  // from 2 to 0
  same("t.0", "t.2");
  CHECK(shop.cell("t.0-2") == none);
  CHECK(shop.cell("t.0-1") != none);
  shop.go_back_to(before);
  shop.build({R"({"op":"deidentify","split":[{"cell":"t.2","as":"x","moves":[["t.0-2",0],["t.2-1",1]]}]})"});
  CHECK(faces(shop, "t.0-2") == Texts{"x", "t.0"});
  CHECK(faces(shop, "t.1-2") == Texts{"x", "t.1"});
  shop.go_back_to(before);
  shop.build({R"({"op":"cone","apex":"v","over":["{2,0}","t.1-0"]})"});
  CHECK(shop.structure().name(shop.cell("v*{2,0}")) == "v*{0,2}");
  CHECK(sign_denoted(shop.structure(), "v*{2,0}") == -1);
}

TEST_CASE("a simplicial product has simplices with their vertices in any order, if there are such simplices", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"e","dim":1})", R"({"op":"simplex","name":"f","dim":1})",
              R"({"op":"product","name":"P","left":"e","right":"f","kind":"simplicial"})"});
  const std::vector<std::tuple<std::string, int, std::string>> names{{"P.(e.1-0|f.1-0)", -1, "P.(e|f)"},
                                                                     {"P.(e.1-0|f.0^0)", -1, "P.(e|f.0^0)"},
                                                                     {"P.(e.1-0^0|f.1-0^1)", -1, "P.(e^1|f^0)"}};
  for (const auto& [name, sign, plain] : names) {
    CAPTURE(name);
    CHECK(shop.structure().name(shop.cell(name)) == plain);
    CHECK(sign_denoted(shop.structure(), name) == sign);
  }
  for (const std::string name : {"P.(e.1-0|f)", "P.(e.1-0^0|f^1)"}) {
    CAPTURE(name);
    CHECK_FALSE(shop.structure().lookup(name));
  }
}

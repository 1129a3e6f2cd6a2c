#include <bit>
#include <set>

#include "tests/support/monotone_maps.hpp"
#include "tests/support/random_steps.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;
using Catch::Contains;

namespace {

/// The cells of the body "P", oldest first.
Texts cells_of(const Workshop& shop, const std::string& body = "P") {
  Texts names;
  for (const CellId c : shop.structure().lazy().cells_of(shop.structure().lookup_body(body).value())) {
    names.emplace_back(shop.structure().name(c));
  }
  return names;
}

/// Bodies to multiply, each by the lines that make it under some name N.
struct Recipe {
  bool is_simplicial;
  Texts lines;
};
const std::vector<Recipe> recipes{
    {true, {R"({"op":"simplex","name":"N","dim":0})"}},
    {true, {R"({"op":"simplex","name":"N","dim":1})"}},
    {true, {R"({"op":"simplex","name":"N","dim":2})"}},
    {true, {R"({"op":"simplex","name":"N","dim":1})", R"({"op":"identify","pairs":[["N.0","N.1"]]})"}},
    {true, {R"({"op":"simplex","name":"N","dim":2})", R"({"op":"identify","pairs":[["N.0-1","N.1-2"]]})"}},
    {true, {R"({"op":"simplex","name":"N","dim":2})", R"({"op":"degenerate","cell":"N.0-1","along":0})"}},
    {true,
     {R"({"op":"simplex","name":"N","dim":2})", R"({"op":"degenerate","cell":"N.0-1","along":0})",
      R"({"op":"degenerate","cell":"N.1-2","along":0})", R"({"op":"degenerate","cell":"N.0-2","along":0})"}},
    {true, {R"({"op":"simplex","name":"N","dim":3})", R"({"op":"degenerate","cell":"N.0-1-2","along":1})"}},
    {false, {R"({"op":"simploid","name":"N","type":[1,1]})"}},
    {false,
     {R"({"op":"simploid","name":"N","type":[2,1]})", R"({"op":"degenerate","cell":"N.0-1x0-1","along":[1,0]})"}},
    {false,
     {R"({"op":"simploid","name":"N","type":[1,1]})",
      R"({"op":"identify","pairs":[["N.0-1x0","N.0-1x1"],["N.0x0-1","N.1x0-1"]]})"}}};

void build(Workshop& shop, const Recipe& recipe, const std::string& name) {
  for (std::string line : recipe.lines) {
    for (std::size_t at = line.find('N'); at != std::string::npos; at = line.find('N', at + 1)) {
      line.replace(at, 1, name);
    }
    shop.build({line});
  }
}

/// One factor as it was before the product: what is looked up here, the product cannot have a say in.
struct Factor {
  const Structure& structure;
  std::vector<CellId> cells;

  [[nodiscard]] PlainValue face(const PlainValue& v, std::uint32_t k) const {
    return plain_face(v, k, [&](CellId c, std::uint32_t number) {
      return plain_value(structure, structure.values().of(structure.faces().of(c)[number]));
    });
  }
  [[nodiscard]] PlainValue whole(CellId c) const { return plain_value(c, structure.cells().type(c).type); }
  [[nodiscard]] std::string name(CellId c) const { return std::string{structure.name(c)}; }
};

std::string directions(Degeneracy collapsed) {
  std::string text;
  for (int d = 0; d <= largest_dimension; ++d) {
    if ((collapsed >> d & 1) != 0) {
      text += (text.empty() ? "^" : ",") + std::to_string(d);
    }
  }
  return text;
}
std::string degeneracy(Degeneracy collapsed, const CellType& type) {
  return collapsed == 0 ? "" : directions(collapsed) + " of a " + describe(type);
}

/// Name and faces of the pair (a|b) of a simploidal product.
std::pair<std::string, Texts> simploidal(const Factor& left, const Factor& right, CellId a, CellId b) {
  Texts wanted;
  const PlainValue x = left.whole(a);
  const PlainValue y = right.whole(b);
  const auto add = [&](const PlainValue& one, const PlainValue& other) {
    PlainValue both = one;
    both.maps.insert(both.maps.end(), other.maps.begin(), other.maps.end());
    wanted.push_back("P.(" + left.name(one.cell) + "|" + right.name(other.cell) + ")" +
                     degeneracy(both.collapsed(), both.type()));
  };
  for (std::uint32_t k = 0; k < number_of_faces(x.type()); ++k) {
    add(left.face(x, k), y);
  }
  for (std::uint32_t k = 0; k < number_of_faces(y.type()); ++k) {
    add(x, right.face(y, k));
  }
  return {"P.(" + left.name(a) + "|" + right.name(b) + ")", wanted};
}

/// What a pair of values of one dimension is: directions that both collapse are the pair's own.
std::string pair_text(const Factor& left, const Factor& right, PlainValue x, PlainValue y) {
  const CellType type = x.type();
  const Degeneracy common = x.collapsed() & y.collapsed();
  for (int d = largest_dimension; d >= 0; --d) {
    if ((common >> d & 1) != 0) {
      for (PlainValue* v : {&x, &y}) {
        v->maps[0].erase(v->maps[0].begin() + d);
      }
    }
  }
  return "P.(" + left.name(x.cell) + directions(x.collapsed()) + "|" + right.name(y.cell) + directions(y.collapsed()) +
         ")" + degeneracy(common, type);
}

/// The cells over (a|b) of a simplicial product with their faces, in the order of their collapsed directions.
std::vector<std::pair<std::string, Texts>> simplicial(const Factor& left, const Factor& right, CellId a, CellId b) {
  std::vector<std::pair<std::string, Texts>> wanted;
  const int most = left.structure.dimension(a) + right.structure.dimension(b);
  const auto simplices_over = [&](const PlainValue& cell) {
    std::vector<PlainValue> all;
    for (const PlainValue& v : with_degeneracies(cell, most)) {
      if (v.maps.size() <= 1) {
        all.push_back(v);
      }
    }
    std::sort(all.begin(), all.end(),
              [](const PlainValue& v, const PlainValue& w) { return v.collapsed() < w.collapsed(); });
    return all;
  };
  for (const PlainValue& x : simplices_over(left.whole(a))) {
    for (const PlainValue& y : simplices_over(right.whole(b))) {
      if (x.dimension() == y.dimension() && (x.collapsed() & y.collapsed()) == 0) {
        Texts of_pair;
        for (std::uint32_t k = 0; k < number_of_faces(x.type()); ++k) {
          of_pair.push_back(pair_text(left, right, left.face(x, k), right.face(y, k)));
        }
        wanted.emplace_back(pair_text(left, right, x, y), of_pair);
      }
    }
  }
  return wanted;
}

}  // namespace

TEST_CASE("what was asked for counts against no limit", "[ops]") {
  Workshop shop(Limits{.cells = 75});
  shop.build({R"({"op":"simplex","name":"a","dim":1})", R"({"op":"simplex","name":"b","dim":1})",
              R"({"op":"product","name":"P","left":"a","right":"b"})"});
  const Operation simplex = operation(R"({"op":"simplex","name":"s","dim":5})");
  REQUIRE(shop.plan(simplex));
  shop.structure().lazy().make_all();
  CHECK(number_of(shop.structure().cells().asked()) > 6);
  CHECK(shop.structure().cells().size() == 6);
  REQUIRE(shop.apply(simplex));
  CHECK(refused(shop, R"({"op":"simplex","name":"t","dim":2})").what ==
        "this step would bring the workspace to 76 cells; the limit is 75");
  REQUIRE(shop.apply(operation(R"({"op":"insert","simplices":[["x","y"]]})")));
  CHECK(refused(shop, R"({"op":"insert","simplices":[["x","y","z"]]})").what ==
        "this step would make more than 3 cells, as many as there is room for");
}

TEST_CASE("a product has the cells and faces that its definition says, in the order of its factors", "[ops]") {
  const std::size_t one = GENERATE(range(std::size_t{0}, std::size_t{11}));
  const std::size_t other = GENERATE(range(std::size_t{0}, std::size_t{11}));
  const bool is_simplicial = GENERATE(false, true);
  if (is_simplicial && !(recipes[one].is_simplicial && recipes[other].is_simplicial)) {
    return;
  }
  CAPTURE(one, other, is_simplicial);
  Workshop shop;
  build(shop, recipes[one], "A");
  build(shop, recipes[other], "B");
  const Structure& s = shop.structure();
  const Factor left{s, s.lazy().cells_of(*s.lookup_body("A"))};
  const Factor right{s, s.lazy().cells_of(*s.lookup_body("B"))};
  std::vector<std::pair<std::string, Texts>> wanted;
  for (const CellId a : left.cells) {
    for (const CellId b : right.cells) {
      if (is_simplicial) {
        const auto over = simplicial(left, right, a, b);
        wanted.insert(wanted.end(), over.begin(), over.end());
      } else {
        wanted.push_back(simploidal(left, right, a, b));
      }
    }
  }
  REQUIRE(shop.apply(MakeProduct{"P", "A", "B", is_simplicial}));
  std::uint64_t sum = 0;
  for (const std::uint64_t n : s.counts()) {
    sum += n;
  }
  REQUIRE(sum == wanted.size());
  std::vector<std::uint64_t> by_dimension(s.counts().size(), 0);
  for (const auto& [name, texts] : wanted) {
    CAPTURE(name);
    REQUIRE(faces(shop, name) == texts);
    ++by_dimension[static_cast<std::size_t>(s.dimension(shop.cell(name)))];
  }
  CHECK(by_dimension == counts(shop));
  Texts names;
  for (const auto& [name, texts] : wanted) {
    names.push_back(name);
  }
  CHECK(cells_of(shop) == names);
  CHECK(s.bodies().simploids(*s.lookup_body("P")) ==
        static_cast<std::uint64_t>(std::count_if(names.begin(), names.end(), [&](const std::string& name) {
          return !is_simplex(s.cells().type(shop.cell(name)).type);
        })));
}

TEST_CASE("a square is 4, 4, 1 cells as a product of simploids, and 4, 5, 2 triangulated", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"e","dim":1})", R"({"op":"simplex","name":"f","dim":1})"});
  const StructureMark before = mark_of(shop.structure());
  shop.build({R"({"op":"product","name":"P","left":"e","right":"f"})"});
  CHECK(counts(shop) == Counts{4, 4, 1});
  CHECK(faces(shop, "P.(e|f)") == Texts{"P.(e.1|f)", "P.(e.0|f)", "P.(e|f.1)", "P.(e|f.0)"});
  CHECK(shop.structure().cells().type(shop.cell("P.(e|f)")).type == CellType{1, 1});
  shop.go_back_to(before);
  shop.build({R"({"op":"product","name":"P","left":"e","right":"f","kind":"simplicial"})"});
  CHECK(counts(shop) == Counts{4, 5, 2});
  CHECK(faces(shop, "P.(e^0|f^1)") == Texts{"P.(e|f.1^0)", "P.(e|f)", "P.(e.0^0|f)"});
  CHECK(faces(shop, "P.(e^1|f^0)") == Texts{"P.(e.1^0|f)", "P.(e|f)", "P.(e|f.0^0)"});
  CHECK(faces(shop, "P.(e|f)") == Texts{"P.(e.1|f.1)", "P.(e.0|f.0)"});
  CHECK(faces(shop, "P.(e|f.0^0)") == Texts{"P.(e.1|f.0)", "P.(e.0|f.0)"});
}

TEST_CASE("any names of the two cells name their product, and a product of products says all of it", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"e","dim":1})", R"({"op":"identify","pairs":[["e.0","e.1"]]})",
              R"({"op":"simplex","name":"v","dim":0})", R"({"op":"product","name":"P","left":"e","right":"v"})"});
  for (const std::string left : {"e.0", "e.1"}) {
    for (const std::string right : {"v", "v.0"}) {
      CHECK(meaning(shop.structure(), "P.(" + left + "|" + right + ")") == "P.(e.0|v)");
    }
  }
  shop.build({R"({"op":"simplex","name":"f","dim":1})", R"({"op":"product","name":"Q","left":"P","right":"f"})",
              R"({"op":"product","name":"R","left":"Q","right":"Q"})"});
  CHECK(meaning(shop.structure(), "R.(Q.(P.(e|v.0)|f)|Q.(P.(e.1|v)|f.1))") == "R.(Q.(P.(e|v)|f)|Q.(P.(e.0|v)|f.1))");
  CHECK(shop.structure().cells().type(shop.cell("R.(Q.(P.(e|v)|f)|Q.(P.(e|v)|f))")).type == CellType{1, 1, 1, 1});
  CHECK(counts(shop) == Counts{4, 12, 13, 6, 1});
  for (const std::string name : {"P.(e|v", "P.(e)", "P.()", "P.(|)", "P.(e|)", "P.(e|v)x", "P.(v|e)", "P.(e^0|v^0)",
                                 "Q.(e|f)", "Q.(P.(e|v)|f^0)", "P", "R", "Q.P.(e|v)"}) {
    CAPTURE(name);
    CHECK((!shop.structure().lookup(name) || shop.structure().lazy().is_consumed(*shop.structure().lookup(name))));
  }
}

TEST_CASE("in a triangulated product a name may have collapsed directions that its cells do not ask for", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"e","dim":1})", R"({"op":"simplex","name":"t","dim":2})",
              R"({"op":"degenerate","cell":"t.0-1","along":0})",
              R"({"op":"product","name":"P","left":"e","right":"t","kind":"simplicial"})"});
  // The side t.0-1 is the vertex t.0 doubled.
  CHECK(meaning(shop.structure(), "P.(e|t.0-1)") == "P.(e|t.0^0)");
  CHECK(meaning(shop.structure(), "P.(e.0^0|t.0-1)") == "P.(e.0|t.0)^0 of a simplex of dimension 1");
  CHECK(meaning(shop.structure(), "P.(e^0|t.0-1^1)") == "P.(e|t.0^0)^0 of a simplex of dimension 2");
  for (const std::string name : {"P.(e|t)", "P.(e^2|t)", "P.(e^|t)", "P.(e^x|t)", "P.(e^0,|t.0^0,1)", "P.(e^1|t)^0",
                                 "P.(e^99|t)", "P.(e^0,1,2,3|t)"}) {
    CAPTURE(name);
    CHECK((name == "P.(e^1|t)" || !shop.structure().lookup(name)));
  }
  CHECK(meaning(shop.structure(), "P.(e^1|t)") == "P.(e^1|t)");
}

TEST_CASE("the factors' cells and names are used up, and say where they went", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"e","dim":1})", R"({"op":"simplex","name":"f","dim":1})",
              R"({"op":"simplex","name":"g","dim":1})", R"({"op":"identify","pairs":[["f.0","g.0"]]})",
              R"({"op":"simplex","name":"h","dim":1})", R"({"op":"product","name":"P","left":"g","right":"e"})"});
  CHECK(counts(shop) == Counts{6 + 2, 3 + 4 + 1, 2});
  for (const std::string line :
       {R"({"op":"identify","pairs":[["e.0","h.0"]]})", R"({"op":"degenerate","cell":"f","along":0})",
        R"({"op":"deidentify","split":[{"cell":"g.0","as":"x","moves":[]}]})",
        R"({"op":"deidentify","split":[{"cell":"h","as":"x","moves":[["e",0]]}]})",
        R"({"op":"cone","apex":"v","over":["f"]})"}) {
    const Error error = refused(shop, line);
    CHECK(error.code == Errc::unknown_name);
    CHECK_THAT(error.what, Contains("went into the product \"P\"") && Contains("P.(a|b)"));
  }
  for (const std::string line :
       {R"({"op":"cone","apex":"v","over":"f"})", R"({"op":"product","name":"Q","left":"h","right":"g"})",
        R"({"op":"product","name":"Q","left":"e","right":"h"})"}) {
    const Error error = refused(shop, line);
    CHECK(error.code == Errc::unknown_name);
    CHECK_THAT(error.what, Contains("went into the product \"P\""));
  }
  for (const std::string line :
       {R"({"op":"simplex","name":"e","dim":0})", R"({"op":"cone","apex":"f.0"})",
        R"({"op":"product","name":"g","left":"h","right":"h"})", R"({"op":"simplex","name":"P","dim":0})",
        R"~({"op":"deidentify","split":[{"cell":"h","as":"P.(f|e)","moves":[]}]})~"}) {
    CHECK_THAT(refused(shop, line).what, Contains("in use"));
  }
  CHECK(shop.structure().bodies().current().size() == 2);
  CHECK(shop.structure().directory().name_of_body(shop.structure().bodies().current()[1]) == "P");
}

TEST_CASE("a product is refused with what is wrong", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"e","dim":1})", R"({"op":"simploid","name":"q","type":[1,1]})",
              R"({"op":"simplex","name":"w.(x","dim":0})", R"({"op":"simplex","name":"u*x","dim":0})"});
  CHECK(refused(shop, R"({"op":"product","name":"P","left":"e","right":"nobody"})").code == Errc::unknown_name);
  CHECK_THAT(refused(shop, R"({"op":"product","name":"P","left":"nobody","right":"e"})").what,
             Contains("no body \"nobody\""));
  CHECK_THAT(refused(shop, R"({"op":"product","name":"P","left":"e.0","right":"e"})").what,
             Contains("no body \"e.0\"") && Contains("this is a cell"));
  CHECK_THAT(refused(shop, R"({"op":"product","name":"q","left":"e","right":"e"})").what, Contains("in use"));
  CHECK_THAT(refused(shop, MakeProduct{"a b", "e", "e", false}).what, Contains("is not a name"));
  for (const std::string name : {"w", "u"}) {
    CHECK_THAT(refused(shop, MakeProduct{name, "e", "e", false}).what,
               Contains("begin with \"" + name + "*\" or \"" + name + ".(\""));
  }
  for (const auto& [left, right] : {std::pair{"e", "q"}, std::pair{"q", "e"}}) {
    const Error error = refused(shop, MakeProduct{"P", left, right, true});
    CHECK(error.code == Errc::refused);
    CHECK_THAT(error.what, Contains("\"q\"") && Contains("no simplices") && Contains("simploidal"));
  }
  CHECK(shop.apply(MakeProduct{"P", "e", "q", false}));
}

TEST_CASE("what a body is now decides whether it can be triangulated, not what it once was", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simploid","name":"q","type":[1,1]})", R"({"op":"simplex","name":"e","dim":1})"});
  const StructureMark square = mark_of(shop.structure());
  shop.build({R"({"op":"degenerate","cell":"q","along":[1,0]})"});
  CHECK(shop.structure().bodies().simploids(*shop.structure().lookup_body("q")) == 0);
  REQUIRE(shop.apply(MakeProduct{"P", "e", "q", true}));
  CHECK(counts(shop) == Counts{4, 5, 2});
  shop.go_back_to(square);
  CHECK(refused(shop, MakeProduct{"P", "e", "q", true}).code == Errc::refused);
}

TEST_CASE("products out of all proportion are refused, by cells and by dimension", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"s2","dim":2})", R"({"op":"degenerate","cell":"s2.0-1","along":0})",
              R"({"op":"degenerate","cell":"s2.1-2","along":0})", R"({"op":"degenerate","cell":"s2.0-2","along":0})"});
  const auto square = [&](int n) {
    const std::string half = "s" + std::to_string(n);
    return MakeProduct{"s" + std::to_string(2 * n), half, half, false};
  };
  for (int n = 2; n < 32; n *= 2) {
    REQUIRE(shop.apply(square(n)));
  }
  CHECK(counts(shop).size() == 33);
  CHECK(number_of(shop.structure().cells().asked()) < 30);
  const Error deep = error_of(shop, square(32));
  CHECK(deep.code == Errc::refused);
  CHECK_THAT(deep.what, Contains("dimension 64") && Contains("62"));
  Workshop many;
  many.build({R"({"op":"complex","name":"d1","cells":[{"id":"0"},{"id":"1"},{"id":"2"},{"id":"3"}]})"});
  for (int n = 1; n < 16; n *= 2) {
    REQUIRE(
        many.apply(MakeProduct{"d" + std::to_string(2 * n), "d" + std::to_string(n), "d" + std::to_string(n), true}));
  }
  CHECK(counts(many) == Counts{std::uint64_t{1} << 32});
  CHECK_THAT(error_of(many, MakeProduct{"P", "d16", "d16", true}).what, Contains("cells, the limit"));
}

TEST_CASE("a body times itself, a point, or nothing", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"e","dim":1})", R"({"op":"simplex","name":"v","dim":0})",
              R"({"op":"complex","name":"K","cells":[]})"});
  const StructureMark start = mark_of(shop.structure());
  shop.build({R"({"op":"product","name":"P","left":"e","right":"e"})"});
  CHECK(counts(shop) == Counts{5, 4, 1});
  CHECK(faces(shop, "P.(e|e)") == Texts{"P.(e.1|e)", "P.(e.0|e)", "P.(e|e.1)", "P.(e|e.0)"});
  shop.go_back_to(start);
  CHECK(counts(shop) == Counts{3, 1});
  shop.build({R"({"op":"product","name":"P","left":"v","right":"e"})"});
  CHECK(counts(shop) == Counts{2, 1});
  CHECK(faces(shop, "P.(v|e)") == Texts{"P.(v|e.1)", "P.(v|e.0)"});
  CHECK(shop.structure().bodies().simploids(*shop.structure().lookup_body("P")) == 0);
  shop.go_back_to(start);
  shop.build({R"({"op":"product","name":"P","left":"e","right":"K","kind":"simplicial"})"});
  CHECK(counts(shop) == Counts{1});
  CHECK(shop.structure().bodies().current().size() == 2);
}

TEST_CASE("cells of a product are younger than what was there, and older than what comes after", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"a","dim":0})", R"({"op":"simplex","name":"e","dim":1})",
              R"({"op":"product","name":"P","left":"e","right":"e"})", R"({"op":"simplex","name":"z","dim":0})"});
  CHECK(cells_of(shop) == Texts{"P.(e.0|e.0)", "P.(e.0|e.1)", "P.(e.0|e)", "P.(e.1|e.0)", "P.(e.1|e.1)", "P.(e.1|e)",
                                "P.(e|e.0)", "P.(e|e.1)", "P.(e|e)"});
  REQUIRE(shop.apply(Identify{{{"z", "P.(e.1|e.1)"}, {"P.(e.1|e.0)", "P.(e.1|e.1)"}}}));
  CHECK(meaning(shop.structure(), "z") == "P.(e.1|e.0)");
  CHECK(shop.structure().directory().name_of_body(shop.structure().body_of(shop.cell("z"))) == "P");
  shop.build({R"({"op":"identify","pairs":[["z","a"]]})"});
  CHECK(meaning(shop.structure(), "P.(e.1|e.1)") == "a");
  CHECK(faces(shop, "P.(e.1|e)") == Texts{"a", "a"});
  CHECK(faces(shop, "P.(e|e.1)") == Texts{"a", "P.(e.0|e.1)"});
}

TEST_CASE("within a product everything goes on: gluing, squashing, splitting", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"e","dim":1})", R"({"op":"identify","pairs":[["e.0","e.1"]]})",
              R"({"op":"simplex","name":"f","dim":1})", R"({"op":"product","name":"P","left":"e","right":"f"})"});
  const StructureMark cylinder = mark_of(shop.structure());
  CHECK(counts(shop) == Counts{2, 3, 1});
  REQUIRE(shop.apply(Identify{{{"P.(e|f.0)", "P.(e|f.1)"}}}));
  CHECK(counts(shop) == Counts{1, 2, 1});
  CHECK(faces(shop, "P.(e|f)") == Texts{"P.(e.0|f)", "P.(e.0|f)", "P.(e|f.0)", "P.(e|f.0)"});
  REQUIRE(shop.apply(Deidentify{
      {{"P.(e|f.0)", "top", {{"P.(e|f)", 2}}}, {"P.(e.1|f.1)", "north", {{"top", 0}, {"top", 1}, {"P.(e.0|f)", 0}}}}}));
  CHECK(counts(shop) == Counts{2, 3, 1});
  CHECK(faces(shop, "P.(e|f)") == Texts{"P.(e.0|f)", "P.(e.0|f)", "top", "P.(e|f.0)"});
  shop.build({R"({"op":"degenerate","cell":"top","along":0})"});
  CHECK(counts(shop) == Counts{2, 2, 1});
  CHECK(faces(shop, "P.(e|f)") == Texts{"P.(e.0|f)", "P.(e.0|f)", "north^0 of a simplex of dimension 1", "P.(e|f.0)"});
  REQUIRE(shop.apply(Degenerate{"P.(e|f)", 1, 0}));
  CHECK(meaning(shop.structure(), "P.(e|f)") == "P.(e.0|f)^0 of a cube of dimension 2");
  CHECK(counts(shop) == Counts{2, 1});
  shop.go_back_to(cylinder);
  CHECK(counts(shop) == Counts{2, 3, 1});
  CHECK(faces(shop, "P.(e|f)") == Texts{"P.(e.0|f)", "P.(e.0|f)", "P.(e|f.1)", "P.(e|f.0)"});
}

TEST_CASE("a product of large bodies makes no cells but those that are asked for", "[ops]") {
  Workshop shop;
  MakeComplex path{"K", {{"v0", {}, {}, {}}}};
  for (int k = 1; k <= 1000; ++k) {
    path.cells.push_back({"v" + std::to_string(k), {}, {}, {}});
    path.cells.push_back({"e" + std::to_string(k), {}, {"v" + std::to_string(k), "v" + std::to_string(k - 1)}, {}});
  }
  REQUIRE(shop.apply(path));
  shop.build({R"({"op":"product","name":"P","left":"K","right":"K"})",
              R"({"op":"product","name":"Q","left":"P","right":"P","kind":"simploidal"})"});
  const CellId before = shop.structure().cells().asked();
  CHECK(shop.structure().cells().size() == 2001);
  CHECK(counts(shop)[4] == 1'000'000'000'000);
  REQUIRE(shop.apply(Identify{{{"Q.(P.(K.e7|K.v9)|P.(K.e8|K.v3))", "Q.(P.(K.e1|K.v2)|P.(K.e3|K.v4))"}}}));
  CHECK(shop.structure().cells().size() == 2001);
  CHECK(shop.structure().cells().asked() - before < 100);
  CHECK(shop.structure().forest().links() == 9);
}

#include <map>

#include "tests/support/monotone_maps.hpp"
#include "tests/support/random_steps.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;
using Catch::Contains;

namespace {

const Limits lazy{.cells_of_explicit_cone = 0};

/// Cells by the age of what their names denote first.
std::vector<CellId> by_age(const Structure& structure, std::vector<CellId> cells) {
  std::sort(cells.begin(), cells.end(), [&](CellId a, CellId b) {
    return structure.lazy().is_older(structure.forest().oldest(a), structure.forest().oldest(b));
  });
  return cells;
}

/// All that names can say of a structure; ids, which tell made cells from lazy ones, are left out.
std::string by_names(const Structure& structure) {
  std::string text;
  for (const BodyId body : structure.bodies().current()) {
    text += "body " + std::string{structure.directory().name_of_body(body)} + " with " +
            std::to_string(structure.bodies().simploids(body)) + " simploids\n";
    for (const CellId c : by_age(structure, structure.lazy().cells_of(body))) {
      text += std::string{structure.name(c)} + " " + describe(structure.cells().type(c).type) + ":";
      for (const std::string& face : face_texts(structure, c)) {
        text += " " + face;
      }
      text += " in " + std::string{structure.directory().name_of_body(structure.body_of(c))} + "\n";
    }
  }
  for (const std::uint64_t count : structure.counts()) {
    text += " " + std::to_string(count);
  }
  return text;
}

std::string degeneracy(const PlainValue& v) {
  std::string text;
  for (int d = 0; d <= v.dimension(); ++d) {
    if ((v.collapsed() >> d & 1) != 0) {
      text += (text.empty() ? "^" : ",") + std::to_string(d);
    }
  }
  return v.is_degenerate() ? text + " of a " + describe(v.type()) : text;
}

/// The faces of v*c, from those of c: with one more vertex, or times an edge whose far end is the apex.
Texts wanted_faces(const Structure& structure, CellId c, bool by_edges) {
  Texts wanted;
  const auto name = [&](CellId cell) { return std::string{structure.name(cell)}; };
  for (const CellId face : structure.faces().of(c)) {
    PlainValue v = plain_value(structure, structure.values().of(face));
    if (by_edges) {
      v.maps.push_back({0, 1});
    } else if (v.maps.empty()) {
      v.maps = {{0, 1}};
    } else {
      v.maps[0].push_back(v.maps[0].back() + 1);
    }
    wanted.push_back("v*" + name(v.cell) + degeneracy(v));
  }
  const CellType& type = structure.cells().type(c).type;
  if (type.empty()) {
    wanted.emplace_back("v");
  } else if (by_edges) {
    PlainValue end = plain_value(none, type);
    for (auto& map : end.maps) {
      map.assign(map.size(), 0);
    }
    wanted.push_back("v" + degeneracy(end));
  }
  wanted.push_back(name(c));
  return wanted;
}

}  // namespace

TEST_CASE("S. Peltier, habilitation (2023), figures 2.46, 2.47: the cone over a square is a pyramid", "[ops]") {
  Workshop shop(GENERATE(Limits{}, lazy));
  shop.build({R"({"op":"simploid","name":"q","type":[1,1]})", R"({"op":"cone","apex":"v"})"});
  CHECK(counts(shop) == Counts{5, 8, 5, 1});
  CHECK(faces(shop, "v*q") ==
        Texts{"v*q.1x0-1", "v*q.0x0-1", "v*q.0-1x1", "v*q.0-1x0", "v^0,1 of a cube of dimension 2", "q"});
  CHECK(faces(shop, "v*q.0-1x0") == Texts{"v*q.1x0", "v*q.0x0", "v^0 of a simplex of dimension 1", "q.0-1x0"});
  CHECK(faces(shop, "v*q.0x0") == Texts{"v", "q.0x0"});
}

TEST_CASE("every cell of a cone has the faces of its definition, over any body", "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 24U));
  CAPTURE(seed);
  Workshop shop(seed % 2 == 0 ? lazy : Limits{});
  StreamShape shape{.most_cells = 40, .simploids = seed % 3 != 0, .degeneracies = true, .splits = true};
  shape.products = seed % 4 == 0;
  RandomSteps steps(seed, shape);
  for (int k = 0; k < 25; ++k) {
    REQUIRE(shop.apply(steps.next(shop.structure())));
  }
  const Structure& s = shop.structure();
  const std::vector<CellId> cells = by_age(s, current_cells(s));
  const bool by_edges =
      std::any_of(cells.begin(), cells.end(), [&](CellId c) { return !is_simplex(s.cells().type(c).type); });
  std::map<std::string, Texts> wanted;
  Texts order;
  for (const CellId c : cells) {
    order.emplace_back(s.name(c));
    wanted["v*" + order.back()] = wanted_faces(s, c, by_edges);
    wanted[order.back()] = face_texts(s, c);
  }
  REQUIRE(shop.apply(MakeCone{"v", {}, {}}));
  std::uint64_t sum = 0;
  for (const std::uint64_t n : s.counts()) {
    sum += n;
  }
  CHECK(sum == wanted.size() + 1);
  for (const auto& [name, texts] : wanted) {
    CAPTURE(name);
    REQUIRE(faces(shop, name) == texts);
  }
  // The cells that were there keep their places, before the apex and the new ones.
  const std::vector<CellId> after = by_age(s, s.lazy().cells_of(s.body_of(shop.cell("v"))));
  REQUIRE(after.size() == sum);
  for (std::size_t k = 0; k < order.size(); ++k) {
    REQUIRE(s.name(after[k]) == order[k]);
  }
  CHECK(s.name(after[order.size()]) == "v");
}

TEST_CASE("a lazy cone is the same object as one whose cells are made, whatever follows", "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 30U));
  CAPTURE(seed);
  Workshop made;
  Workshop asked(lazy);
  RandomSteps steps(seed, everything(30));
  for (int k = 0; k < 30; ++k) {
    const Operation op =
        k % 10 == 5 ? Operation{MakeCone{"v" + std::to_string(k), {}, {}}} : steps.next(made.structure());
    CAPTURE(k, to_text(op));
    REQUIRE(made.apply(op).has_value() == asked.apply(op).has_value());
    REQUIRE(first_difference(by_names(asked.structure()), by_names(made.structure())) == "");
  }
}

TEST_CASE("a cone over degenerate faces is degenerate in the same directions", "[ops]") {
  Workshop shop(GENERATE(Limits{}, lazy));
  shop.build({R"({"op":"simplex","name":"t","dim":2})", R"({"op":"degenerate","cell":"t.0-1","along":0})"});
  const StructureMark before = mark_of(shop.structure());
  shop.build({R"({"op":"cone","apex":"v","over":"t"})"});
  CHECK(faces(shop, "v*t") == Texts{"v*t.1-2", "v*t.0-2", "v*t.0^0 of a simplex of dimension 2", "t"});
  CHECK(counts(shop) == Counts{3, 4, 3, 1});
  shop.go_back_to(before);
  shop.build({R"({"op":"simploid","name":"q","type":[1,1]})", R"({"op":"cone","apex":"v"})"});
  CHECK(faces(shop, "v*t") ==
        Texts{"v*t.1-2", "v*t.0-2", "v*t.0^0 of a cube of dimension 2", "v^0,1 of a simplex of dimension 2", "t"});
}

TEST_CASE("a degenerate cell in a list stands for the cell that it is degenerate over", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"t","dim":2})", R"({"op":"degenerate","cell":"t","along":0})",
              R"({"op":"cone","apex":"v","over":["t.0-1"]})", R"({"op":"cone","apex":"w","over":["t"]})"});
  CHECK(faces(shop, "v*t.0") == Texts{"v", "t.0"});
  CHECK_FALSE(shop.structure().lookup("v*t.2"));
  CHECK(faces(shop, "w*t.0-2") == Texts{"w*t.2", "w*t.0", "t.0-2"});
  CHECK(meaning(shop.structure(), "w*t") == "w*t.0-2^0 of a simplex of dimension 3");
}

TEST_CASE("cones over cones, of both kinds: suspensions and joins by hand", "[ops]") {
  Workshop shop(GENERATE(Limits{}, lazy));
  shop.build({R"({"op":"simplex","name":"e","dim":1})", R"({"op":"cone","apex":"u"})", R"({"op":"cone","apex":"v"})"});
  CHECK(counts(shop) == Counts{4, 6, 4, 1});
  CHECK(faces(shop, "v*u*e") == Texts{"v*u*e.1", "v*u*e.0", "v*e", "u*e"});
  CHECK(faces(shop, "v*u") == Texts{"v", "u"});
  shop.build({R"({"op":"simploid","name":"q","type":[1,1]})", R"({"op":"cone","apex":"w"})"});
  CHECK(counts(shop) == Counts{9, 18, 15, 6, 1});
  CHECK(shop.structure().cells().type(shop.cell("w*v*u*e")).type == CellType{3, 1});
}

TEST_CASE("names of bodies under a lazy cone denote the cone's body, and their cells' names cells of the cone",
          "[ops]") {
  Workshop shop(lazy);
  shop.build({R"({"op":"simplex","name":"a","dim":1})", R"({"op":"simplex","name":"b","dim":1})",
              R"({"op":"simplex","name":"c","dim":0})", R"({"op":"identify","pairs":[["a.0","b.0"]]})",
              R"({"op":"cone","apex":"v","over":"b"})"});
  const Structure& s = shop.structure();
  CHECK(s.lookup_body("a") == s.lookup_body("b"));
  CHECK(s.directory().name_of_body(*s.lookup_body("b")) == "a");
  CHECK_FALSE(s.lookup_body("v"));
  CHECK(s.bodies().current().size() == 2);
  CHECK_FALSE(s.lazy().is_consumed(*s.lookup("a.1")));
  CHECK(s.body_of(shop.cell("v*b.0")) == *s.lookup_body("a"));
  CHECK(shop.cell("v*a.0") == shop.cell("v*b.0"));
  CHECK_FALSE(s.lookup("v*c"));
  CHECK_FALSE(s.lookup("v*v"));
  shop.build({R"({"op":"identify","pairs":[["c","a.1"],["v","b.1"]]})"});
  CHECK(meaning(s, "c") == "a.1");
  CHECK(faces(shop, "v*a") == Texts{"v*a.1", "v*a.0", "a"});
  CHECK(faces(shop, "v*b.1") == Texts{"b.1", "b.1"});
  CHECK(s.directory().name_of_body(s.body_of(shop.cell("c"))) == "a");
  CHECK(refused(shop, R"({"op":"simplex","name":"v*a","dim":0})").code == Errc::bad_input);
}

TEST_CASE("a lazy cone's apex needs a prefix of its own", "[ops]") {
  Workshop shop(lazy);
  REQUIRE(shop.apply(MakeSimplex{"v*x", 0, {}}));
  REQUIRE(shop.apply(MakeSimplex{"w.(x|y)", 0, {}}));
  REQUIRE(shop.apply(MakeSimplex{"t", 2, {}}));
  for (const std::string apex : {"v", "w"}) {
    CHECK_THAT(refused(shop, MakeCone{apex, {}, {}}).what, Contains("begin with \"" + apex + "*\""));
    CHECK(shop.plan(MakeCone{apex, std::vector<std::string>{"t"}, {}}));
  }
  CHECK_THAT(refused(shop, MakeCone{"t", {}, {}}).what, Contains("in use"));
  const StructureMark before = mark_of(shop.structure());
  REQUIRE(shop.apply(MakeCone{"u", {}, {}}));
  shop.go_back_to(before);
  REQUIRE(shop.apply(MakeSimplex{"u*t", 0, {}}));
  CHECK_THAT(refused(shop, MakeCone{"u", {}, {}}).what, Contains("begin with \"u*\""));
  shop.go_back_to(before);
  CHECK(shop.apply(MakeCone{"u", {}, {}}));
}

TEST_CASE("a large body is coned without a look at its cells, from the limit on", "[ops]") {
  Workshop shop(Limits{.cells_of_explicit_cone = 7});
  shop.build({R"({"op":"simplex","name":"s","dim":2})", R"({"op":"simplex","name":"t","dim":2})"});
  const StructureMark before = mark_of(shop.structure());
  shop.build({R"({"op":"cone","apex":"v","over":"s"})"});
  CHECK(shop.structure().lazy().families() == 0);
  shop.go_back_to(before);
  shop.build({R"({"op":"cone","apex":"v"})"});
  CHECK(shop.structure().lazy().families() == 1);
  CHECK(shop.structure().cells().size() == 15);
  CHECK(shop.last_plan().cells.size() == 1);
  shop.go_back_to(before);
  CHECK(shop.structure().lazy().families() == 0);
  shop.build({R"({"op":"cone","apex":"v","over":["s","t"]})"});
  CHECK(shop.structure().lazy().families() == 0);
}

TEST_CASE("a cone beyond the largest dimension is refused", "[ops]") {
  Workshop shop(lazy);
  REQUIRE(shop.apply(MakeSimplex{"s", 6, {}}));
  for (int p = 1; p <= 5; ++p) {  // a sphere of dimension 6: one vertex, one cell
    for (const CellId c : current_cells(shop.structure())) {
      if (shop.structure().is_current(c) && shop.structure().dimension(c) == p) {
        REQUIRE(shop.apply(Degenerate{std::string{shop.structure().name(c)}, {}, 0}));
      }
    }
  }
  REQUIRE(counts(shop) == Counts{1, 0, 0, 0, 0, 0, 1});
  for (int n = 7; n <= 62; ++n) {
    REQUIRE(shop.apply(MakeCone{"v" + std::to_string(n), {}, {}}));
  }
  CHECK(counts(shop).size() == 63);
  const Error deep = error_of(shop, MakeCone{"w", {}, {}});
  CHECK(deep.code == Errc::refused);
  CHECK_THAT(deep.what, Contains("limit"));
}

TEST_CASE("a lazy cone over a product makes none of its cells", "[ops]") {
  Workshop shop(lazy);
  MakeComplex path{"K", {{"v0", {}, {}, {}}}};
  for (int k = 1; k <= 60; ++k) {
    path.cells.push_back({"v" + std::to_string(k), {}, {}, {}});
    path.cells.push_back({"e" + std::to_string(k), {}, {"v" + std::to_string(k), "v" + std::to_string(k - 1)}, {}});
  }
  REQUIRE(shop.apply(path));
  shop.build({R"({"op":"product","name":"P","left":"K","right":"K"})"});
  const CellId before = shop.structure().cells().asked();
  shop.build({R"({"op":"cone","apex":"v"})"});
  CHECK(shop.structure().cells().asked() - before < 10);
}

TEST_CASE("the cells of a body are listed by the age of their oldest members, with a cone and without", "[ops]") {
  Workshop shop(GENERATE(Limits{}, lazy));
  shop.build({R"({"op":"simplex","name":"a","dim":0})", R"({"op":"simplex","name":"b","dim":0})",
              R"({"op":"simplex","name":"c","dim":0})", R"({"op":"simplex","name":"d","dim":0})",
              R"({"op":"identify","pairs":[["c","d"]]})", R"({"op":"simplex","name":"e","dim":1})",
              R"({"op":"identify","pairs":[["b","e.0"]]})", R"({"op":"identify","pairs":[["a","c"]]})",
              R"({"op":"identify","pairs":[["a","e.1"]]})"});
  const auto names = [&] {
    Texts all;
    for (const CellId c : shop.structure().lazy().cells_of(*shop.structure().lookup_body("a"))) {
      all.emplace_back(shop.structure().name(c));
    }
    return all;
  };
  CHECK(names() == Texts{"a", "b", "e"});
  shop.build({R"({"op":"cone","apex":"v"})"});
  CHECK(names() == Texts{"a", "b", "e", "v", "v*a", "v*b", "v*e"});
}

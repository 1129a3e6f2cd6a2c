#include <map>

#include "tests/support/monotone_maps.hpp"
#include "tests/support/random_steps.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;
using Catch::Contains;

namespace {

/// Two triangles s and t, glued along s.1-2 = t.0-1.
Workshop& two_triangles(Workshop& shop) {
  shop.build({R"({"op":"simplex","name":"s","dim":2})", R"({"op":"simplex","name":"t","dim":2})",
              R"({"op":"identify","pairs":[["s.1-2","t.0-1"]]})"});
  return shop;
}

/// The faces of all cells, copies under the ids from first_copy on; a de-identification done to it in the plainest way.
class SlowSplit {
 public:
  static constexpr CellId first_copy = 1'000'000;

  explicit SlowSplit(const Structure& structure) : structure_{structure} {
    for (const CellId c : current_cells(structure)) {
      for (const CellId face : structure.faces().of(c)) {
        faces_[c].push_back(plain_value(structure, structure.values().of(face)));
      }
      types_[c] = structure.cells().type(c).type;
    }
  }

  void apply(const Deidentify& op) {
    for (std::size_t k = 0; k < op.splits.size(); ++k) {
      const CellId source = find(op.splits[k].cell);
      const CellId copy = first_copy + k;
      types_[copy] = types_.at(source);
      faces_[copy] = faces_[source];
      copies_[op.splits[k].copy] = copy;
    }
    for (std::size_t k = 0; k < op.splits.size(); ++k) {
      for (const auto& [cell, slot] : op.splits[k].moves) {
        faces_[find(cell)][static_cast<std::size_t>(slot)].cell = first_copy + k;
      }
    }
  }

  [[nodiscard]] bool obeys_laws() const {
    const auto face_of = [this](CellId c, std::uint32_t k) { return faces_.at(c)[k]; };
    for (const auto& [cell, type] : types_) {
      const PlainValue whole = plain_value(cell, type);
      for (const FaceLaw& law : structure_.types().info(structure_.types().intern(type)).laws) {
        if (plain_face(plain_face(whole, law.first, face_of), law.second, face_of) !=
            plain_face(plain_face(whole, law.other_first, face_of), law.other_second, face_of)) {
          return false;
        }
      }
    }
    return true;
  }

  /// Empty when the structure has these cells with these faces.
  [[nodiscard]] std::string difference(const Structure& structure) const {
    const auto cell_now = [&](CellId c) {
      for (const auto& [name, copy] : copies_) {
        if (copy == c) {
          return structure.lookup(name).value_or(none);
        }
      }
      return c;
    };
    std::uint64_t count = 0;
    for (const std::uint64_t n : structure.counts()) {
      count += n;
    }
    if (count != types_.size()) {
      return "counts";
    }
    for (const auto& [cell, values] : faces_) {
      for (std::size_t k = 0; k < values.size(); ++k) {
        PlainValue wanted = values[k];
        wanted.cell = cell_now(wanted.cell);
        if (plain_value(structure, structure.values().of(structure.faces().of(cell_now(cell))[k])) != wanted) {
          return "face " + std::to_string(k) + " of " + std::string{structure.name(cell_now(cell))};
        }
      }
    }
    return "";
  }

 private:
  [[nodiscard]] CellId find(const std::string& name) const {
    const auto copy = copies_.find(name);
    return copy != copies_.end() ? copy->second : structure_.find(structure_.lookup(name).value());
  }

  const Structure& structure_;
  std::map<CellId, CellType> types_;
  std::map<CellId, std::vector<PlainValue>> faces_;
  std::map<std::string, CellId> copies_;
};

/// Splits drawn without any thought for the face laws, but each move one of an incidence that is there.
Deidentify random_splits(const Structure& structure, Random& random, const std::string& prefix) {
  Deidentify op;
  const std::vector<CellId> cells = current_cells(structure);
  std::vector<CellId> sources;
  for (int wanted = random.in(1, 3); wanted > 0; --wanted) {
    sources.push_back(cells[static_cast<std::size_t>(random.in(0, static_cast<int>(cells.size()) - 1))]);
    op.splits.push_back({std::string{structure.name(sources.back())}, prefix + std::to_string(wanted), {}});
  }
  const int rarity = random.in(1, 4);
  const auto offer = [&](CellId faces_of, const std::string& name) {
    for (std::uint32_t k = 0; k < structure.faces().of(faces_of).size(); ++k) {
      const Value v = structure.values().of(structure.faces().of(faces_of)[k]);
      const auto at = std::find(sources.begin(), sources.end(), v.cell);
      if (at != sources.end() && !v.is_degenerate() && random.one_in(rarity)) {
        op.splits[static_cast<std::size_t>(at - sources.begin())].moves.emplace_back(name, k);
      }
    }
  };
  for (const CellId c : cells) {
    offer(c, std::string{structure.name(c)});
  }
  for (std::size_t k = 0; k < sources.size(); ++k) {
    offer(sources[k], op.splits[k].copy);
  }
  return op;
}

}  // namespace

TEST_CASE("a copy has the faces of its source, and takes the incidences listed", "[ops]") {
  Workshop shop;
  two_triangles(shop);
  shop.build({R"({"op":"deidentify","split":[{"cell":"s.1-2","as":"x","moves":[["t",2]]}]})"});
  CHECK(counts(shop) == Counts{4, 6, 2});
  CHECK(faces(shop, "x") == Texts{"s.2", "s.1"});
  CHECK(faces(shop, "t") == Texts{"t.1-2", "t.0-2", "x"});
  CHECK(faces(shop, "s") == Texts{"s.1-2", "s.0-2", "s.0-1"});
  CHECK(shop.structure().splits().copy(shop.cell("x"))->source == shop.cell("s.1-2"));
  CHECK(shop.structure().directory().name_of_body(shop.structure().body_of(shop.cell("x"))) == "s");
}

TEST_CASE("all names of what is split go on denoting it, and any of them names it", "[ops]") {
  Workshop shop;
  two_triangles(shop);
  shop.build({R"({"op":"deidentify","split":[{"cell":"t.0-1","as":"x","moves":[["s",0]]}]})"});
  CHECK(shop.cell("t.0-1") == shop.cell("s.1-2"));
  CHECK(shop.structure().name(shop.cell("t.0-1")) == "s.1-2");
  CHECK(faces(shop, "s") == Texts{"x", "s.0-2", "s.0-1"});
  CHECK(faces(shop, "t") == Texts{"t.1-2", "t.0-2", "s.1-2"});
}

TEST_CASE("an edge comes apart with both its ends in one step, whatever was done since it was glued", "[ops]") {
  Workshop shop;
  two_triangles(shop);
  shop.build({R"({"op":"simplex","name":"u","dim":2})", R"({"op":"identify","pairs":[["u.0-1","s.0-1"]]})"});
  // The edge s.1-2 stays with s; its copy x goes to t, with ends of its own.
  const std::string line =
      R"({"op":"deidentify","split":[{"cell":"s.1","as":"a","moves":[["x",1],["t.0-2",1]]},)"
      R"({"cell":"s.2","as":"b","moves":[["x",0],["t.1-2",1]]},{"cell":"s.1-2","as":"x","moves":[["t",2]]}]})";
  shop.build({line});
  CHECK(faces(shop, "x") == Texts{"b", "a"});
  CHECK(faces(shop, "t") == Texts{"t.1-2", "t.0-2", "x"});
  CHECK(faces(shop, "t.0-2") == Texts{"t.2", "a"});
  CHECK(faces(shop, "t.1-2") == Texts{"t.2", "b"});
  CHECK(faces(shop, "s.1-2") == Texts{"s.2", "s.1"});
  CHECK(counts(shop) == Counts{7, 8, 3});
}

TEST_CASE("every member of a cell sees what becomes of its faces", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"a","dim":1})", R"({"op":"simplex","name":"b","dim":1})",
              R"({"op":"identify","pairs":[["a","b"]]})",
              R"({"op":"deidentify","split":[{"cell":"a.1","as":"x","moves":[["b",0]]}]})"});
  CHECK(faces(shop, "a") == Texts{"x", "a.0"});
  CHECK(faces(shop, "b") == Texts{"x", "a.0"});
  // And it goes on for what is glued to it later, in whichever direction.
  shop.build({R"({"op":"simplex","name":"c","dim":1})", R"({"op":"identify","pairs":[["c","b"]]})"});
  CHECK(faces(shop, "c") == Texts{"x", "a.0"});
  CHECK(shop.cell("c.1") == shop.cell("x"));
  CHECK(shop.cell("a.1") != shop.cell("x"));
}

TEST_CASE("copies have copies, and come together again", "[ops]") {
  Workshop shop;
  shop.build(
      {R"({"op":"complex","name":"K","cells":[{"id":"v"},{"id":"a","faces":["v","v"]},{"id":"b","faces":["v","v"]}]})",
       R"({"op":"deidentify","split":[{"cell":"K.v","as":"x","moves":[["K.a",0],["K.a",1],["K.b",0]]}]})",
       R"({"op":"deidentify","split":[{"cell":"x","as":"y","moves":[["K.a",1]]},{"cell":"x","as":"z","moves":[["K.b",0]]}]})"});
  CHECK(faces(shop, "K.a") == Texts{"x", "y"});
  CHECK(faces(shop, "K.b") == Texts{"z", "K.v"});
  CHECK(counts(shop) == Counts{4, 2});
  shop.build({R"({"op":"identify","pairs":[["z","y"],["K.v","x"]]})"});
  CHECK(faces(shop, "K.a") == Texts{"K.v", "y"});
  CHECK(faces(shop, "K.b") == Texts{"y", "K.v"});
  shop.build({R"({"op":"deidentify","split":[{"cell":"z","as":"w","moves":[["K.b",0]]}]})"});
  CHECK(faces(shop, "K.a") == Texts{"K.v", "y"});
  CHECK(faces(shop, "K.b") == Texts{"w", "K.v"});
}

TEST_CASE("a cell that is split without moves leaves a copy beside it", "[ops]") {
  Workshop shop;
  shop.build(
      {R"({"op":"simplex","name":"t","dim":2})",
       R"({"op":"deidentify","split":[{"cell":"t","as":"lid","moves":[]},{"cell":"t.0","as":"dot","moves":[]}]})"});
  CHECK(counts(shop) == Counts{4, 3, 2});
  CHECK(faces(shop, "lid") == faces(shop, "t"));
  CHECK(shop.structure().bodies().current().size() == 1);
}

TEST_CASE("a torus is cut along its two circles into a square", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simploid","name":"q","type":[1,1]})",
              R"({"op":"identify","pairs":[["q.0x0-1","q.1x0-1"],["q.0-1x0","q.0-1x1"]]})"});
  CHECK(counts(shop) == Counts{1, 2, 1});
  shop.build({R"({"op":"deidentify","split":[)"
              R"({"cell":"q.0x0-1","as":"right","moves":[["q",0]]},{"cell":"q.0-1x0","as":"top","moves":[["q",2]]},)"
              R"({"cell":"q.0x0","as":"v10","moves":[["q.0-1x0",0],["right",1]]},)"
              R"({"cell":"q.0x0","as":"v01","moves":[["q.0x0-1",0],["top",1]]},)"
              R"({"cell":"q.0x0","as":"v11","moves":[["top",0],["right",0]]}]})"});
  CHECK(counts(shop) == Counts{4, 4, 1});
  CHECK(faces(shop, "q") == Texts{"right", "q.0x0-1", "top", "q.0-1x0"});
  CHECK(faces(shop, "right") == Texts{"v11", "v10"});
  CHECK(faces(shop, "top") == Texts{"v11", "v01"});
  CHECK(faces(shop, "q.0-1x0") == Texts{"v10", "q.0x0"});
  CHECK(faces(shop, "q.0x0-1") == Texts{"v01", "q.0x0"});
}

TEST_CASE("what is degenerate over a cell stays over it when the cell is split", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"t","dim":2})", R"({"op":"degenerate","cell":"t.0-1","along":0})"});
  const Error error = refused(shop, R"({"op":"deidentify","split":[{"cell":"t.0","as":"x","moves":[["t.0-2",1]]}]})");
  CHECK(error.code == Errc::refused);
  CHECK_THAT(error.what, Contains("\"t\" would break a face law"));
  shop.build({R"({"op":"deidentify","split":[{"cell":"t.2","as":"x","moves":[["t.0-2",0],["t.1-2",0]]}]})"});
  CHECK(faces(shop, "t") == Texts{"t.1-2", "t.0-2", "t.0^0 of a simplex of dimension 1"});
}

TEST_CASE("a split that breaks a face law is refused, with the cell and the faces that should be one", "[ops]") {
  Workshop shop;
  two_triangles(shop);
  const Error error = refused(shop, R"({"op":"deidentify","split":[{"cell":"s.1","as":"x","moves":[["t.0-2",1]]}]})");
  CHECK(error.code == Errc::refused);
  CHECK_THAT(error.what, Contains("\"t\" would break a face law") && Contains("\"x\"") && Contains("\"s.1\"") &&
                             Contains("split more, or move more"));
  // A copy in the wrong place: its ends are its own.
  CHECK_THAT(refused(shop, R"({"op":"deidentify","split":[{"cell":"s.1","as":"y","moves":[["x",1]]},)"
                           R"({"cell":"s.1-2","as":"x","moves":[["t",2]]}]})")
                 .what,
             Contains("\"t\" would break a face law"));
}

TEST_CASE("a split of what is not there is refused with what is wrong", "[ops]") {
  Workshop shop;
  two_triangles(shop);
  shop.build({R"({"op":"simplex","name":"e","dim":1})", R"({"op":"degenerate","cell":"e","along":0})",
              R"({"op":"simplex","name":"u","dim":2})", R"({"op":"degenerate","cell":"u.0-1","along":0})",
              R"({"op":"complex","name":"K","cells":[{"id":"a"}]})"});
  const auto split = [](const std::string& cell, const std::string& copy, const std::string& moves) {
    return R"({"op":"deidentify","split":[{"cell":")" + cell + R"(","as":")" + copy + R"(","moves":[)" + moves + "]}]}";
  };
  const std::vector<std::tuple<std::string, Errc, std::string>> wrong{
      {split("nobody", "x", ""), Errc::unknown_name, "no cell \"nobody\""},
      {split("K", "x", ""), Errc::unknown_name, "name of a body"},
      {split("s.0", "t.0", ""), Errc::bad_input, "\"t.0\" is in use"},
      {split("s.0", "s", ""), Errc::bad_input, "\"s\" is in use"},
      {split("s.0", "K", ""), Errc::bad_input, "\"K\" is in use"},
      {split("s.0", "", ""), Errc::bad_input, "is not a name"},
      {split("s.0", "a b", ""), Errc::bad_input, "is not a name"},
      {split("e", "x", ""), Errc::refused, "\"e\" is degenerate"},
      {split("s.0", "x", R"(["nobody",0])"), Errc::unknown_name, "no cell \"nobody\""},
      {split("s.0", "x", R"(["e",0])"), Errc::refused, "\"e\" is degenerate"},
      {split("s.0", "x", R"(["s.0-1",2])"), Errc::bad_input, "\"s.0-1\" has 2 faces"},
      {split("s.0", "x", R"(["s.0",0])"), Errc::bad_input, "\"s.0\" has 0 faces"},
      {split("s.0", "x", R"(["s.0-1",0])"), Errc::bad_input, "face 0 of \"s.0-1\" is \"s.1\", not \"s.0\""},
      {split("u.0", "x", R"(["u",2])"), Errc::bad_input, "face 2 of \"u\" is degenerate over \"u.0\""},
      {split("s.0", "x", R"(["s.0-1",1],["s.0-1",1])"), Errc::bad_input, "face 1 of \"s.0-1\" is moved twice"},
      {R"({"op":"deidentify","split":[{"cell":"s.0","as":"x","moves":[["s.0-1",1]]},{"cell":"s.0","as":"y","moves":[["s.0-1",1]]}]})",
       Errc::bad_input, "face 1 of \"s.0-1\" is moved twice"},
      {R"({"op":"deidentify","split":[{"cell":"s.0","as":"x","moves":[]},{"cell":"s.1","as":"x","moves":[]}]})",
       Errc::bad_input, "\"x\" is given to two copies"},
      {R"({"op":"deidentify","split":[{"cell":"s","as":"x","moves":[]},{"cell":"x","as":"y","moves":[]}]})",
       Errc::unknown_name, "no cell \"x\""}};
  for (const auto& [line, code, what] : wrong) {
    CAPTURE(line);
    const Error error = refused(shop, line);
    CHECK(error.code == code);
    CHECK_THAT(error.what, Contains(what));
  }
}

TEST_CASE("a move of a face with a negative number, which only a program can ask for, is refused", "[ops]") {
  Workshop shop;
  two_triangles(shop);
  for (const std::int64_t face : {std::int64_t{-1}, std::numeric_limits<std::int64_t>::min()}) {
    CHECK(refused(shop, Deidentify{{{"s.0", "x", {{"s.0-1", face}}}}}).code == Errc::bad_input);
  }
}

TEST_CASE("splitting nothing changes nothing", "[ops]") {
  Workshop shop;
  two_triangles(shop);
  const std::string before = dump(shop.structure());
  shop.build({R"({"op":"deidentify","split":[]})"});
  CHECK(shop.last_plan().changes_nothing());
  CHECK(dump(shop.structure()) == before);
}

TEST_CASE("copies count as cells of a step and of the workspace", "[ops]") {
  Workshop shop(Limits{.cells_per_step = 2, .cells = 3});
  REQUIRE(shop.apply(MakeSimplex{"a", 0, {}}));
  Deidentify op{{{"a", "b", {}}, {"a", "c", {}}}};
  CHECK(shop.apply(op));
  CHECK_THAT(refused(shop, Deidentify{{{"a", "d", {}}}}).what, Contains("workspace") && Contains("4"));
  CHECK_THAT(refused(shop, Deidentify{{{"a", "d", {}}, {"a", "e", {}}, {"a", "f", {}}}}).what, Contains("one step"));
}

TEST_CASE("a split is legal exactly when all cells obey the face laws after it, and does what it says",
          "[ops][stream]") {
  int legal = 0;
  int illegal = 0;
  for (unsigned seed = 0; seed < 32; ++seed) {
    CAPTURE(seed);
    Workshop shop;
    StreamShape shape{.most_cells = 30, .simploids = seed % 3 != 0, .degeneracies = seed % 2 == 0, .splits = true};
    shape.products = seed % 4 == 1;
    RandomSteps steps(seed, shape);
    for (int k = 0; k < 20; ++k) {
      REQUIRE(shop.apply(steps.next(shop.structure())));
      const Deidentify op = random_splits(shop.structure(), steps.random(), "c" + std::to_string(k) + "-");
      CAPTURE(k, to_text(op));
      SlowSplit slow(shop.structure());
      slow.apply(op);
      const Status status = shop.apply(op);
      REQUIRE(status.has_value() == slow.obeys_laws());
      if (status) {
        REQUIRE(slow.difference(shop.structure()) == "");
        ++legal;
      } else {
        REQUIRE(status.error().code == Errc::refused);
        REQUIRE_THAT(status.error().what, Contains("would break a face law"));
        ++illegal;
      }
    }
  }
  CHECK(legal > 50);
  CHECK(illegal > 50);
}

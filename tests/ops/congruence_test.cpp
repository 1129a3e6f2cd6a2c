#include <map>
#include <numeric>
#include <set>

#include "tests/support/monotone_maps.hpp"
#include "tests/support/random_steps.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;

namespace {

/// Every cell and everything degenerate over it up to a dimension, as elements of one list; and the finest partition of
/// them that is closed under faces and degeneracies and equates what it is told to. Nothing is known here of normal
/// forms, of sections or of the Eilenberg-Zilber lemma.
class SlowCongruence {
 public:
  SlowCongruence(const Structure& structure, int most) {
    const auto face_of = [&](CellId c, std::uint32_t k) {
      return plain_value(structure, structure.values().of(structure.faces().of(c)[k]));
    };
    for (const CellId c : current_cells(structure)) {
      for (const PlainValue& v : with_degeneracies(plain_value(c, structure.cells().type(c).type), most)) {
        index_.emplace(v, elements_.size());
        elements_.push_back(v);
      }
    }
    for (const PlainValue& v : elements_) {
      std::vector<std::size_t>& images = images_.emplace_back();
      for (std::uint32_t k = 0; k < number_of_faces(v.type()); ++k) {
        images.push_back(index_.at(plain_face(v, k, face_of)));
      }
      if (v.dimension() < most) {
        for (const PlainValue& degenerate : degeneracies(v)) {
          images.push_back(index_.at(degenerate));
        }
      }
    }
    parent_.resize(elements_.size());
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  void equate(const PlainValue& one, const PlainValue& other) {
    std::vector<std::pair<std::size_t, std::size_t>> pending{{index_.at(one), index_.at(other)}};
    while (!pending.empty()) {
      const std::size_t a = root(pending.back().first);
      const std::size_t b = root(pending.back().second);
      pending.pop_back();
      if (a != b) {
        parent_[a] = b;
        for (std::size_t k = 0; k < images_[a].size(); ++k) {
          pending.emplace_back(images_[a][k], images_[b][k]);
        }
      }
    }
  }

  /// Empty when two elements are one cell of the structure exactly when they are in one class.
  [[nodiscard]] std::string difference(const Structure& structure) {
    std::map<std::size_t, Value> value_of_class;
    std::map<std::pair<std::pair<CellId, TypeId>, Degeneracy>, std::size_t> class_of_value;
    std::set<CellId> cells;
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      const PlainValue& v = elements_[e];
      const Value value = structure.values().normal_form({v.cell, structure.types().intern(v.type()), v.collapsed()});
      const auto [first, is_new] = value_of_class.emplace(root(e), value);
      if (!(first->second == value)) {
        return text_of(structure, first->second) + " and " + text_of(structure, value) + " should be one";
      }
      if (class_of_value.emplace(std::pair{std::pair{value.cell, value.type}, value.collapsed}, root(e))
              .first->second != root(e)) {
        return text_of(structure, value) + " should be two";
      }
      cells.insert(value.cell);
    }
    std::uint64_t count = 0;
    for (const std::uint64_t n : structure.counts()) {
      count += n;
    }
    return count == cells.size() ? "" : "counts";
  }

 private:
  std::size_t root(std::size_t e) const {
    while (parent_[e] != e) {
      e = parent_[e];
    }
    return e;
  }

  std::vector<PlainValue> elements_;
  std::map<PlainValue, std::size_t> index_;
  std::vector<std::vector<std::size_t>> images_;  // faces, then degeneracies
  std::vector<std::size_t> parent_;
};

PlainValue named(const Structure& structure, const std::string& name) {
  return plain_value(structure, structure.values().of(structure.lookup(name).value()));
}

void equate(SlowCongruence& slow, const Structure& structure, const Operation& op) {
  if (const auto* identify = std::get_if<Identify>(&op)) {
    for (const auto& [one, other] : identify->pairs) {
      slow.equate(named(structure, one), named(structure, other));
    }
    return;
  }
  const auto& degenerate = std::get<Degenerate>(op);
  const auto face_of = [&](CellId c, std::uint32_t k) {
    return plain_value(structure, structure.values().of(structure.faces().of(c)[k]));
  };
  const PlainValue cell = named(structure, degenerate.cell);
  const auto i = static_cast<std::size_t>(degenerate.component.value_or(1) - 1);
  const auto j = static_cast<std::size_t>(degenerate.index);
  const bool vanishes = cell.maps[i].size() == 2;
  const PlainValue face = plain_face(cell, i, j, face_of);
  slow.equate(cell, vanishes ? thickened(face, i) : doubled(face, i, j));
}

/// Applies lines, and checks each that glues or squashes against the slow congruence.
void build_checked(Workshop& shop, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    const Operation op = operation(line);
    CAPTURE(line);
    if (!std::holds_alternative<Identify>(op) && !std::holds_alternative<Degenerate>(op)) {
      shop.build({line});
      continue;
    }
    SlowCongruence slow(shop.structure(), 4);
    equate(slow, shop.structure(), op);
    shop.build({line});
    REQUIRE(slow.difference(shop.structure()) == "");
  }
}

}  // namespace

TEST_CASE("gluing and squashing make the least congruence of faces and degeneracies", "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 40U));
  CAPTURE(seed);
  Workshop shop;
  StreamShape shape{.most_cells = seed % 3 == 0 ? 45U : 22U, .simploids = seed % 4 != 0, .degeneracies = true};
  shape.products = seed % 5 == 0;
  shape.splits = seed % 2 == 0;
  RandomSteps steps(seed, shape);
  int compared = 0;
  for (int k = 0; k < 30; ++k) {
    const Operation op = steps.next(shop.structure());
    CAPTURE(k, to_text(op));
    const bool equates = std::holds_alternative<Identify>(op) || std::holds_alternative<Degenerate>(op);
    const auto dimension = static_cast<int>(shop.structure().counts().size()) - 1;
    if (equates && dimension <= 3) {
      SlowCongruence slow(shop.structure(), 3);
      equate(slow, shop.structure(), op);
      REQUIRE(shop.apply(op));
      REQUIRE(slow.difference(shop.structure()) == "");
      ++compared;
    } else {
      REQUIRE(shop.apply(op));
    }
  }
  CHECK(compared >= 3);
}

TEST_CASE("a squashed edge makes its ends one vertex, over which it is degenerate", "[ops]") {
  Workshop shop;
  build_checked(shop, {R"({"op":"simplex","name":"e","dim":1})", R"({"op":"degenerate","cell":"e","along":0})"});
  CHECK(counts(shop) == Counts{1});
  CHECK(meaning(shop.structure(), "e") == "e.0^0 of a simplex of dimension 1");
  CHECK(shop.structure().lookup("e"));
  CHECK(shop.structure().name(*shop.structure().lookup("e")) == "e");
  CHECK(shop.structure().find(*shop.structure().lookup("e")) == none);
  CHECK(shop.cell("e.1") == shop.cell("e.0"));
}

TEST_CASE("S. Peltier, habilitation (2023), figure 2.43: the squashed edge leaves the boundary of its triangle",
          "[ops]") {
  Workshop shop;
  build_checked(shop, {R"({"op":"simplex","name":"t","dim":2})", R"({"op":"degenerate","cell":"t.0-1","along":0})"});
  CHECK(counts(shop) == Counts{2, 2, 1});
  CHECK(face_texts(shop.structure(), shop.cell("t")) == Texts{"t.1-2", "t.0-2", "t.0^0 of a simplex of dimension 1"});
  // What is left of the triangle has two sides; to squash it onto one glues them.
  build_checked(shop, {R"({"op":"degenerate","cell":"t","along":0})"});
  CHECK(counts(shop) == Counts{2, 1});
  CHECK(meaning(shop.structure(), "t") == "t.0-2^0 of a simplex of dimension 2");
}

TEST_CASE("S. Peltier, habilitation (2023), figure 2.44: what is glued to a degenerate edge is squashed with it",
          "[ops]") {
  Workshop shop;
  build_checked(shop, {R"({"op":"simplex","name":"s","dim":1})", R"({"op":"simplex","name":"t","dim":2})",
                       R"({"op":"degenerate","cell":"s","along":0})", R"({"op":"identify","pairs":[["t.0-2","s"]]})"});
  CHECK(counts(shop) == Counts{2, 2, 1});
  CHECK(meaning(shop.structure(), "t.0-2") == "s.0^0 of a simplex of dimension 1");
  CHECK(shop.cell("t.2") == shop.cell("s.1"));
  CHECK(shop.structure().directory().name_of_body(shop.structure().body_of(shop.cell("t"))) == "s");
}

TEST_CASE("a triangle squashes along either of its directions, with all that this says of its sides", "[ops]") {
  Workshop shop;
  build_checked(shop, {R"({"op":"simplex","name":"t","dim":2})"});
  const StructureMark whole = mark_of(shop.structure());
  SECTION("along 0: s_0 of d_0, so d_2 is s_0 of its end and d_1 is d_0") {
    build_checked(shop, {R"({"op":"degenerate","cell":"t","along":0})"});
    CHECK(counts(shop) == Counts{2, 1});
    CHECK(meaning(shop.structure(), "t") == "t.0-2^0 of a simplex of dimension 2");
    CHECK(meaning(shop.structure(), "t.0-1") == "t.0^0 of a simplex of dimension 1");
    CHECK(shop.cell("t.0-2") == shop.cell("t.1-2"));
  }
  SECTION("along 1: s_1 of d_1, so d_0 is s_0 of its end and d_2 is d_1") {
    build_checked(shop, {R"({"op":"degenerate","cell":"t","along":[1,1]})"});
    CHECK(counts(shop) == Counts{2, 1});
    CHECK(meaning(shop.structure(), "t") == "t.0-1^1 of a simplex of dimension 2");
    CHECK(meaning(shop.structure(), "t.1-2") == "t.1^0 of a simplex of dimension 1");
    CHECK(shop.cell("t.0-2") == shop.cell("t.0-1"));
  }
  shop.go_back_to(whole);
  CHECK(counts(shop) == Counts{3, 3, 1});
}

TEST_CASE("a cell that is degenerate in two ways is degenerate over less: s_0 b = s_1 b makes b a point", "[ops]") {
  Workshop shop;
  build_checked(shop, {R"({"op":"simplex","name":"s","dim":2})", R"({"op":"simplex","name":"t","dim":2})",
                       R"({"op":"degenerate","cell":"s","along":0})", R"({"op":"degenerate","cell":"t","along":1})"});
  CHECK(counts(shop) == Counts{4, 2});
  SECTION("two triangles") {
    build_checked(shop, {R"({"op":"identify","pairs":[["s.1-2","t.0-1"]]})"});
    CHECK(counts(shop) == Counts{2, 1});
    build_checked(shop, {R"({"op":"identify","pairs":[["s","t"]]})"});
  }
  SECTION("s_0 b = s_1 c for two edges makes each the degenerate cell of an end of the other") {
    build_checked(shop, {R"({"op":"identify","pairs":[["s","t"]]})"});
  }
  CHECK(counts(shop) == Counts{1});
  CHECK(meaning(shop.structure(), "t") == "s.0^0,1 of a simplex of dimension 2");
  CHECK(meaning(shop.structure(), "t.0-2") == "s.0^0 of a simplex of dimension 1");
}

TEST_CASE("one triangle squashed along both directions is a point", "[ops]") {
  Workshop shop;
  build_checked(shop, {R"({"op":"simplex","name":"t","dim":2})", R"({"op":"degenerate","cell":"t","along":0})",
                       R"({"op":"degenerate","cell":"t","along":1})"});
  CHECK(counts(shop) == Counts{1});
  const std::string before = dump(shop.structure());
  build_checked(shop, {R"({"op":"degenerate","cell":"t","along":0})", R"({"op":"degenerate","cell":"t","along":1})"});
  CHECK(shop.last_plan().changes_nothing());
  CHECK(dump(shop.structure()) == before);
}

TEST_CASE("equal degenerate cells have equal cells underneath", "[ops]") {
  Workshop shop;
  build_checked(shop, {R"({"op":"simplex","name":"s","dim":3})", R"({"op":"simplex","name":"t","dim":3})",
                       R"({"op":"degenerate","cell":"s","along":1})", R"({"op":"degenerate","cell":"t","along":1})",
                       R"({"op":"identify","pairs":[["t","s"]]})"});
  CHECK(counts(shop) == Counts{3, 3, 1});
  CHECK(shop.cell("t.0-1-3") == shop.cell("s.0-2-3"));
}

TEST_CASE("degenerate faces of different components: a square squashes onto a side, and a prism onto a square",
          "[ops]") {
  Workshop shop;
  build_checked(shop, {R"({"op":"simploid","name":"q","type":[1,1]})", R"({"op":"simploid","name":"p","type":[2,1]})",
                       R"({"op":"degenerate","cell":"q","along":[1,0]})"});
  // The two sides across become points, the two others one edge.
  CHECK(meaning(shop.structure(), "q") == "q.0x0-1^0 of a cube of dimension 2");
  CHECK(meaning(shop.structure(), "q.0-1x1") == "q.0x1^0 of a simplex of dimension 1");
  CHECK(shop.cell("q.0x0-1") == shop.cell("q.1x0-1"));
  build_checked(shop, {R"({"op":"degenerate","cell":"p","along":[1,1]})"});
  CHECK(meaning(shop.structure(), "p") == "p.0-1x0-1^1 of a simploid [2,1]");
  CHECK(meaning(shop.structure(), "p.1-2x0-1") == "p.1x0-1^0 of a cube of dimension 2");
  CHECK(meaning(shop.structure(), "p.0-1-2x0") == "p.0-1x0^1 of a simplex of dimension 2");
  build_checked(shop, {R"({"op":"identify","pairs":[["q","p.0-2x0-1"]]})"});
  CHECK(meaning(shop.structure(), "p") == "q.0x0-1^0,1 of a simploid [2,1]");
}

TEST_CASE("degeneracy says which direction: squashed across and along, a square is a point", "[ops]") {
  Workshop shop;
  build_checked(shop,
                {R"({"op":"simploid","name":"q","type":[1,1]})", R"({"op":"degenerate","cell":"q","along":[2,0]})",
                 R"({"op":"degenerate","cell":"q","along":[1,0]})"});
  CHECK(counts(shop) == Counts{1});
  CHECK(meaning(shop.structure(), "q") == "q.0x0^0,1 of a cube of dimension 2");
}

TEST_CASE("a class of several cells becomes degenerate as one", "[ops]") {
  Workshop shop;
  build_checked(shop, {R"({"op":"simplex","name":"a","dim":1})", R"({"op":"simplex","name":"b","dim":1})",
                       R"({"op":"simplex","name":"c","dim":1})", R"({"op":"degenerate","cell":"c","along":0})",
                       R"({"op":"identify","pairs":[["a","b"],["b","c"]]})"});
  CHECK(counts(shop) == Counts{1});
  for (const std::string name : {"a", "b", "c"}) {
    CHECK(meaning(shop.structure(), name) == "a.0^0 of a simplex of dimension 1");
  }
}

TEST_CASE("what becomes degenerate over a cell stays so when that cell changes its own mind", "[ops]") {
  Workshop shop;
  build_checked(shop, {R"({"op":"simplex","name":"t","dim":2})", R"({"op":"simplex","name":"e","dim":1})",
                       R"({"op":"degenerate","cell":"t","along":0})", R"({"op":"identify","pairs":[["t.0-2","e"]]})"});
  CHECK(meaning(shop.structure(), "t") == "t.0-2^0 of a simplex of dimension 2");
  build_checked(shop, {R"({"op":"degenerate","cell":"e","along":0})"});
  CHECK(meaning(shop.structure(), "t") == "t.0^0,1 of a simplex of dimension 2");
  // A triangle all of whose sides are degenerate is a sphere, until it is squashed too.
  shop.build({R"({"op":"simplex","name":"u","dim":2})"});
  build_checked(shop, {R"({"op":"identify","pairs":[["u.0-1","e"],["u.0-2","e"],["u.1-2","e"]]})"});
  CHECK(counts(shop) == Counts{1, 0, 1});
  build_checked(shop, {R"({"op":"identify","pairs":[["u","t"]]})"});
  CHECK(counts(shop) == Counts{1});
}

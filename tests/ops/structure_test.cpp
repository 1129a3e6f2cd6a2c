#include "ops/cells/structure.hpp"
#include "ops/cells/cofaces.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "tests/support/random_steps.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::ops;
using namespace sesame::tests;

namespace {

/// The same thing as a Structure, in the plainest way: everything relabelled at every merge, whole copies for undo.
struct SlowStructure {
  struct Cell {
    CellType type;
    std::vector<CellId> faces;
    std::string name;
    CellId label;  ///< of its class: the id of the member that survived
    int body;      ///< the number of the oldest body of its merged body
  };
  std::vector<Cell> cells;
  std::map<std::string, CellId> names;
  std::vector<std::string> bodies;
  std::vector<int> body_label;

  void apply(const Plan& plan, TypeTable& types) {
    if (plan.new_body) {
      bodies.push_back(*plan.new_body);
      body_label.push_back(static_cast<int>(bodies.size()) - 1);
    }
    const std::vector<std::string> new_names = names_of_new_cells(plan, types);
    auto name = new_names.begin();
    for (const Plan::NewCell& cell : plan.cells) {
      Cell made{types.info(cell.type).type, {}, *name++, static_cast<CellId>(cells.size()), 0};
      for (std::size_t k = 0; k < types.info(cell.type).faces.size(); ++k) {
        made.faces.push_back(plan.faces[cell.first_face + k]);
      }
      made.body = plan.new_body ? static_cast<int>(bodies.size()) - 1 : static_cast<int>(*plan.into_body);
      names[made.name] = made.label;
      cells.push_back(std::move(made));
    }
    if (plan.standard == types.vertex()) {
      names[*plan.new_body + ".0"] = cells.back().label;
    }
    for (const BodyId joined : plan.joined_bodies) {
      join(static_cast<int>(*plan.into_body), static_cast<int>(joined));
    }
    for (const Merge& merge : plan.merges) {
      join(cells[merge.survivor].body, cells[merge.removed].body);
      for (Cell& cell : cells) {
        cell.label = cell.label == merge.removed ? merge.survivor : cell.label;
      }
    }
  }

  void join(int a, int b) {
    const int kept = std::min(body_label[static_cast<std::size_t>(a)], body_label[static_cast<std::size_t>(b)]);
    const int gone = std::max(body_label[static_cast<std::size_t>(a)], body_label[static_cast<std::size_t>(b)]);
    std::replace(body_label.begin(), body_label.end(), gone, kept);
  }

  CellId oldest(CellId c) const {
    for (CellId other = 0;; ++other) {
      if (cells[other].label == cells[c].label) {
        return other;
      }
    }
  }
  std::uint32_t members(CellId c) const {
    return static_cast<std::uint32_t>(
        std::count_if(cells.begin(), cells.end(), [&](const Cell& other) { return other.label == cells[c].label; }));
  }
  int body_of(CellId c) const { return body_label[static_cast<std::size_t>(cells[c].body)]; }
};

/// The first way in which a structure and its slow twin differ; empty when they do not.
std::string difference(const Structure& fast, const SlowStructure& slow) {
  if (fast.cells().size() != slow.cells.size()) {
    return "number of cells";
  }
  std::vector<std::uint32_t> counts;
  for (CellId c = 0; c < fast.cells().size(); ++c) {
    const SlowStructure::Cell& cell = slow.cells[c];
    const auto faces = fast.cells().faces(c);
    const std::string at = " of cell " + std::to_string(c);
    if (fast.cells().type(c).type != cell.type ||
        !std::equal(faces.begin(), faces.end(), cell.faces.begin(), cell.faces.end())) {
      return "faces" + at;
    }
    if (fast.find(c) != cell.label || fast.is_current(c) != (cell.label == c)) {
      return "class" + at;
    }
    if (fast.forest().oldest(c) != slow.oldest(c) || fast.name(c) != slow.cells[slow.oldest(c)].name ||
        fast.directory().own_name(c) != cell.name) {
      return "name" + at;
    }
    if (fast.forest().members(fast.find(c)) != slow.members(c)) {
      return "members" + at;
    }
    if (fast.directory().name_of_body(fast.body_of(c)) != slow.bodies[static_cast<std::size_t>(slow.body_of(c))]) {
      return "body" + at;
    }
    if (cell.label == c) {
      const auto p = static_cast<std::size_t>(fast.dimension(c));
      counts.resize(std::max(counts.size(), p + 1), 0);
      ++counts[p];
    }
  }
  if (!std::equal(counts.begin(), counts.end(), fast.counts().begin(), fast.counts().end())) {
    return "counts";
  }
  for (const auto& [name, cell] : slow.names) {
    if (fast.lookup(name) != cell || !fast.is_name_taken(name)) {
      return "lookup of " + name;
    }
  }
  std::vector<std::string> current;
  for (std::size_t b = 0; b < slow.bodies.size(); ++b) {
    const auto found = fast.lookup_body(slow.bodies[b]);
    const int label = slow.body_label[b];
    if (!found || fast.directory().name_of_body(*found) != slow.bodies[static_cast<std::size_t>(label)]) {
      return "lookup of body " + slow.bodies[b];
    }
    if (label == static_cast<int>(b)) {
      current.push_back(slow.bodies[b]);
      std::vector<CellId> cells;
      for (CellId c = 0; c < slow.cells.size(); ++c) {
        if (slow.cells[c].label == c && slow.body_of(c) == label) {
          cells.push_back(c);
        }
      }
      std::vector<CellId> listed_cells = fast.lazy().cells_of(*found);
      std::sort(listed_cells.begin(), listed_cells.end());
      if (listed_cells != cells) {
        return "cells of body " + slow.bodies[b];
      }
    }
  }
  std::vector<std::string> listed;
  for (const BodyId b : fast.bodies().current()) {
    listed.emplace_back(fast.directory().name_of_body(b));
  }
  return listed == current ? "" : "current bodies";
}

}  // namespace

TEST_CASE("a structure is what its slow twin is, after every step and every truncation", "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 12U));
  CAPTURE(seed);
  Workshop shop;
  SlowStructure slow;
  RandomSteps steps(seed, {.most_cells = 80, .simploids = true, .cones = true});
  std::vector<StructureMark> marks;
  std::vector<SlowStructure> states;
  std::vector<std::string> dumps;
  std::set<std::string> names_ever;
  for (int k = 0; k < 50; ++k) {
    const Operation op = steps.next(shop.structure());
    CAPTURE(k, to_text(op));
    marks.push_back(mark_of(shop.structure()));
    states.push_back(slow);
    dumps.push_back(dump(shop.structure()));
    const Status status = shop.apply(op);
    REQUIRE(status);
    slow.apply(shop.last_plan(), shop.structure().types());
    for (const auto& [name, cell] : slow.names) {
      names_ever.insert(name);
    }
    REQUIRE(difference(shop.structure(), slow) == "");
    if (steps.random().one_in(6)) {
      const auto back = static_cast<std::size_t>(steps.random().in(0, static_cast<int>(marks.size()) - 1));
      shop.go_back_to(marks[back]);
      slow = states[back];
      REQUIRE(mark_of(shop.structure()) == marks[back]);
      REQUIRE(dump(shop.structure()) == dumps[back]);
      REQUIRE(difference(shop.structure(), slow) == "");
      for (const std::string& name : names_ever) {
        REQUIRE(shop.structure().lookup(name).has_value() == slow.names.contains(name));
      }
      marks.resize(back);
      states.resize(back);
      dumps.resize(back);
    }
  }
  while (!marks.empty()) {
    shop.go_back_to(marks.back());
    REQUIRE(dump(shop.structure()) == dumps.back());
    marks.pop_back();
    dumps.pop_back();
  }
  CHECK(mark_of(shop.structure()) == StructureMark{});
  CHECK(shop.structure().counts().empty());
  CHECK(shop.structure().bodies().current().empty());
}

TEST_CASE("a merged cell answers to every name of its members, and is called by the oldest", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"a","dim":0})", R"({"op":"simplex","name":"b","dim":0})",
              R"({"op":"simplex","name":"c","dim":0})", R"({"op":"simplex","name":"d","dim":0})",
              R"({"op":"identify","pairs":[["c","b"],["b","d"]]})"});
  CHECK(shop.structure().name(shop.cell("d")) == "b");
  shop.build({R"({"op":"identify","pairs":[["d","a"]]})"});
  // The class of three outweighs a alone, so its cell survives; the name is that of a all the same.
  CHECK(shop.cell("a") != *shop.structure().lookup("a"));
  for (const std::string name : {"a", "b", "c", "d", "a.0", "d.0"}) {
    CHECK(shop.structure().name(shop.cell(name)) == "a");
  }
  CHECK(shop.structure().directory().own_name(*shop.structure().lookup("d")) == "d");
  CHECK(shop.structure().forest().members(shop.cell("a")) == 4);
  CHECK(shop.structure().counts().size() == 1);
  CHECK(shop.structure().counts()[0] == 1);
}

TEST_CASE("merged bodies keep the older name, and the younger one stays an alias", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"a","dim":1})", R"({"op":"simplex","name":"b","dim":1})",
              R"({"op":"simplex","name":"c","dim":1})"});
  const StructureMark before = mark_of(shop.structure());
  shop.build({R"({"op":"identify","pairs":[["c.0","b.0"]]})"});
  const auto names = [&] {
    std::vector<std::string> all;
    for (const BodyId b : shop.structure().bodies().current()) {
      all.emplace_back(shop.structure().directory().name_of_body(b));
    }
    return all;
  };
  CHECK(names() == std::vector<std::string>{"a", "b"});
  CHECK(shop.structure().lookup_body("c") == shop.structure().lookup_body("b"));
  CHECK(shop.structure().lazy().cells_of(*shop.structure().lookup_body("c")).size() == 5);
  shop.build({R"({"op":"identify","pairs":[["c.1","a.0"]]})"});
  CHECK(names() == std::vector<std::string>{"a"});
  CHECK(shop.structure().directory().name_of_body(*shop.structure().lookup_body("b")) == "a");
  CHECK(shop.structure().lookup_body("nobody") == std::nullopt);
  shop.go_back_to(before);
  CHECK(names() == std::vector<std::string>{"a", "b", "c"});
}

TEST_CASE("a past moment can be asked for any cell", "[ops]") {
  const unsigned seed = GENERATE(range(0U, 4U));
  CAPTURE(seed);
  Workshop shop;
  RandomSteps steps(seed);
  std::vector<std::vector<CellId>> found_then;
  std::vector<LinkId> links_then;
  for (int k = 0; k < 30; ++k) {
    REQUIRE(shop.apply(steps.next(shop.structure())));
    links_then.push_back(shop.structure().forest().links());
    found_then.emplace_back();
    for (CellId c = 0; c < shop.structure().cells().size(); ++c) {
      found_then.back().push_back(shop.structure().find(c));
    }
  }
  for (std::size_t k = 0; k < found_then.size(); ++k) {
    for (CellId c = 0; c < found_then[k].size(); ++c) {
      REQUIRE(shop.structure().forest().find_at(c, links_then[k]) == found_then[k][c]);
    }
  }
}

TEST_CASE("no path of the union-find forest is longer than the logarithm of its tree", "[ops]") {
  const unsigned seed = GENERATE(range(0U, 5U));
  CAPTURE(seed);
  Workshop shop;
  Random random(seed);
  for (int k = 0; k < 256; ++k) {
    REQUIRE(shop.apply(MakeSimplex{"v" + std::to_string(k), 0, {}}));
  }
  for (int k = 0; k < 400; ++k) {
    Identify identify;
    for (int pairs = random.in(1, 3); pairs > 0; --pairs) {
      identify.pairs.emplace_back("v" + std::to_string(random.in(0, 255)), "v" + std::to_string(random.in(0, 255)));
    }
    REQUIRE(shop.apply(identify));
  }
  for (CellId c = 0; c < shop.structure().cells().size(); ++c) {
    int depth = 0;
    for (CellId at = c; !shop.structure().is_current(at); at = shop.structure().forest().parent(at)) {
      ++depth;
    }
    CHECK((std::uint32_t{1} << depth) <= shop.structure().forest().members(shop.structure().find(c)));
  }
}

namespace {

const Limits lazy_cones{.cells_of_explicit_cone = 0};

/// The cofaces of each current cell, straight from the definition.
std::map<CellId, std::set<std::string>> slow_cofaces(const Structure& structure) {
  std::map<CellId, std::set<std::string>> above;
  for (const CellId c : current_cells(structure)) {
    for (const CellId face : structure.faces().of(c)) {
      above[structure.values().of(face).cell].emplace(structure.name(c));
    }
  }
  return above;
}

/// The first cell whose cofaces are not those of the definition, once each and oldest first; empty when there is none.
std::string wrong_cofaces(const Structure& structure) {
  auto above = slow_cofaces(structure);
  for (const CellId c : current_cells(structure)) {
    std::set<std::string> found;
    CellId before = none;
    for (const CellId coface : cofaces(structure, c)) {
      if (!found.emplace(structure.name(coface)).second || !structure.is_current(coface) ||
          (before != none &&
           !structure.lazy().is_older(structure.forest().oldest(before), structure.forest().oldest(coface)))) {
        return std::string{structure.name(c)} + ": order or twice";
      }
      before = coface;
    }
    if (found != above[c]) {
      return std::string{structure.name(c)} + ": " + std::to_string(found.size()) + " found, " +
             std::to_string(above[c].size()) + " are there";
    }
  }
  return "";
}

/// A stream of operations of all kinds that are legal one after the other.
std::vector<Operation> random_operations(unsigned seed, int count, Limits limits, StreamShape shape) {
  Workshop shop(limits);
  RandomSteps steps(seed, shape);
  std::vector<Operation> operations;
  while (static_cast<int>(operations.size()) < count) {
    operations.push_back(steps.next(shop.structure()));
    const Status status = shop.apply(operations.back());
    REQUIRE(status);
  }
  return operations;
}

}  // namespace

TEST_CASE("a random stream of everything has every operation in it", "[ops][stream]") {
  std::map<std::string, int> seen;
  for (unsigned seed = 0; seed < 160; ++seed) {
    const StreamShape shape = seed < 40 ? everything(30) : everything_and_maps(30);
    for (const Operation& op : random_operations(seed, 40, lazy_cones, shape)) {
      ++seen[std::string{keyword(op)}];
      if (const auto* product = std::get_if<MakeProduct>(&op)) {
        ++seen[product->simplicial ? "triangulated" : "of simploids"];
        ++seen[product->left == product->right ? "square" : "of two"];
      } else if (const auto* split = std::get_if<Deidentify>(&op)) {
        ++seen[split->splits.size() > 1 ? "several" : "single"];
      } else if (const auto* cone = std::get_if<MakeCone>(&op)) {
        ++seen["over " + std::to_string(cone->over.index())];
      } else if (const auto* suspension = std::get_if<MakeSuspension>(&op)) {
        ++seen["over " + std::to_string(suspension->over.index())];
      }
    }
  }
  for (const std::string what :
       {"simplex",    "simploid", "complex", "cone",   "suspend", "product",      "identify",     "degenerate",
        "deidentify", "gmap",     "polygon", "sew",    "unsew",   "triangulated", "of simploids", "square",
        "of two",     "several",  "single",  "over 0", "over 1",  "over 2"}) {
    CAPTURE(what);
    CHECK(seen[what] >= 3);
  }
}

TEST_CASE("undo of any steps of all kinds restores everything, one by one and many at once", "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 30U));
  CAPTURE(seed);
  Workshop shop(seed % 2 == 0 ? lazy_cones : Limits{});
  RandomSteps steps(seed, everything_and_maps(seed % 3 == 0 ? 50 : 25));
  std::vector<StructureMark> marks;
  std::vector<std::string> dumps;
  for (int k = 0; k < 40; ++k) {
    const Operation op = steps.next(shop.structure());
    CAPTURE(k, to_text(op));
    dumps.push_back(dump(shop.structure()));
    marks.push_back(mark_of(shop.structure()));
    REQUIRE(shop.apply(op));
    if (steps.random().one_in(2)) {
      (void)dump(shop.structure());  // asks for everything
    }
    if (steps.random().one_in(5)) {
      const auto back = static_cast<std::size_t>(steps.random().in(0, static_cast<int>(marks.size()) - 1));
      shop.go_back_to(marks[back]);
      REQUIRE(mark_of(shop.structure()) == marks[back]);
      REQUIRE(first_difference(dump(shop.structure()), dumps[back]) == "");
      marks.resize(back);
      dumps.resize(back);
    }
  }
  while (!marks.empty()) {
    shop.go_back_to(marks.back());
    REQUIRE(mark_of(shop.structure()) == marks.back());
    REQUIRE(first_difference(dump(shop.structure()), dumps.back()) == "");
    marks.pop_back();
    dumps.pop_back();
  }
  CHECK(mark_of(shop.structure()) == StructureMark{});
  CHECK(shop.structure().counts().empty());
  CHECK(shop.structure().bodies().current().empty());
}

TEST_CASE("lazy cells that were asked for make no difference, and undo takes them back too", "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 24U));
  CAPTURE(seed);
  // One structure is asked about much, the other never: they are compared at the end, and at moments of the past to
  // which both are taken back.
  const std::vector<Operation> operations = random_operations(seed, 25, lazy_cones, everything_and_maps(30));
  Workshop asked(lazy_cones);
  Workshop quiet(lazy_cones);
  std::vector<StructureMark> asked_marks;
  std::vector<StructureMark> quiet_marks;
  Random random(seed);
  for (const Operation& op : operations) {
    asked_marks.push_back(mark_of(asked.structure()));
    quiet_marks.push_back(mark_of(quiet.structure()));
    CAPTURE(to_text(op));
    REQUIRE(asked.apply(op));
    REQUIRE(quiet.apply(op));
    for (const CellId c : current_cells(asked.structure())) {
      if (random.one_in(2)) {
        (void)cofaces(asked.structure(), c);
        (void)asked.structure().faces().of(c);
      }
    }
  }
  const auto difference = [&] { return first_difference(dump(asked.structure()), dump(quiet.structure())); };
  REQUIRE(difference() == "");
  while (!asked_marks.empty()) {
    const auto back = static_cast<std::size_t>(random.in(0, static_cast<int>(asked_marks.size()) - 1));
    asked.go_back_to(asked_marks[back]);
    quiet.go_back_to(quiet_marks[back]);
    REQUIRE(mark_of(asked.structure()) == asked_marks[back]);
    REQUIRE(mark_of(quiet.structure()) == quiet_marks[back]);
    REQUIRE(difference() == "");
    asked_marks.resize(back);
    quiet_marks.resize(back);
  }
}

TEST_CASE("a body knows how many of its cells are no simplices", "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 16U));
  CAPTURE(seed);
  Workshop shop(seed % 2 == 0 ? lazy_cones : Limits{});
  RandomSteps steps(seed, everything_and_maps(30));
  for (int k = 0; k < 30; ++k) {
    REQUIRE(shop.apply(steps.next(shop.structure())));
    const Structure& s = shop.structure();
    for (const BodyId body : s.bodies().current()) {
      std::vector<std::uint64_t> counts(s.bodies().counts(body).size(), 0);
      std::uint64_t simploids = 0;
      for (const CellId c : s.lazy().cells_of(body)) {
        if (is_cone_part(s.cells().type(c).type)) {
          continue;  // it counts as no cell
        }
        ++counts[static_cast<std::size_t>(s.dimension(c))];
        simploids += is_simplex(s.cells().type(c).type) ? 0 : 1;
      }
      REQUIRE(s.bodies().simploids(body) == simploids);
      REQUIRE(std::equal(counts.begin(), counts.end(), s.bodies().counts(body).begin(), s.bodies().counts(body).end()));
    }
  }
}

TEST_CASE("undone and done again, steps of all kinds give the same object", "[ops][stream]") {
  const unsigned seed = GENERATE(range(100U, 110U));
  CAPTURE(seed);
  const std::vector<Operation> operations = random_operations(seed, 25, lazy_cones, everything_and_maps(30));
  Workshop shop(lazy_cones);
  const StructureMark start = mark_of(shop.structure());
  std::vector<std::string> dumps;
  for (const Operation& op : operations) {
    REQUIRE(shop.apply(op));
    dumps.push_back(dump(shop.structure()));
  }
  shop.go_back_to(start);
  for (std::size_t k = 0; k < operations.size(); ++k) {
    REQUIRE(shop.apply(operations[k]));
    REQUIRE(first_difference(dump(shop.structure()), dumps[k]) == "");
  }
}

TEST_CASE("the cofaces of a cell are the cells that have it as a face, or something degenerate over it",
          "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 30U));
  CAPTURE(seed);
  Workshop shop(seed % 2 == 0 ? lazy_cones : Limits{});
  RandomSteps steps(seed, everything_and_maps(seed % 3 == 0 ? 40 : 25));
  std::vector<StructureMark> marks;
  for (int k = 0; k < 40; ++k) {
    marks.push_back(mark_of(shop.structure()));
    REQUIRE(shop.apply(steps.next(shop.structure())));
    REQUIRE(wrong_cofaces(shop.structure()) == "");
  }
  shop.go_back_to(marks[20]);
  CHECK(wrong_cofaces(shop.structure()) == "");
}

TEST_CASE("cofaces are those of the definition whenever they are asked for, through undo", "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 60U));
  CAPTURE(seed);
  Workshop shop(seed % 2 == 0 ? lazy_cones : Limits{});
  RandomSteps steps(seed, everything_and_maps(seed % 3 == 0 ? 40 : 20));
  Random random(seed + 1);
  std::vector<StructureMark> marks;
  int asked = 0;
  for (int k = 0; k < 120; ++k) {
    if (marks.size() > 5 && random.one_in(4)) {
      // Often a little, at times far beyond the first question.
      const int most = static_cast<int>(marks.size());
      const auto back = static_cast<std::size_t>(random.in(1, random.one_in(8) ? most : std::min(most, 4)));
      shop.go_back_to(marks[marks.size() - back]);
      marks.resize(marks.size() - back);
    } else {
      marks.push_back(mark_of(shop.structure()));
      REQUIRE(shop.apply(steps.next(shop.structure())));
    }
    if (k > static_cast<int>(seed) && random.one_in(3)) {
      CAPTURE(k);
      REQUIRE(wrong_cofaces(shop.structure()) == "");
      ++asked;
    }
  }
  CHECK(asked > 0);
  shop.go_back_to({});
  CHECK(wrong_cofaces(shop.structure()) == "");
}

TEST_CASE("cells that are glued, and the gluing undone, again and again have few entries to look through", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"t","dim":2})", R"({"op":"simplex","name":"u","dim":2})",
              R"({"op":"identify","pairs":[["t.0-1","u.0-1"]]})",
              R"({"op":"deidentify","split":[{"cell":"t.0-1","as":"c","moves":[["u",2]]}]})"});
  const StructureMark split = mark_of(shop.structure());
  for (int k = 0; k < 300; ++k) {
    REQUIRE(shop.apply(ops::Identify{{{"t.0-1", "c"}, {"t.1-2", "u.1-2"}}}));
    shop.go_back_to(split);
  }
  REQUIRE(wrong_cofaces(shop.structure()) == "");
  for (const std::string cell : {"t.0-1", "c", "t.1-2", "u.1-2", "t.0", "t.1", "t.2", "u.2"}) {
    CAPTURE(cell);
    CHECK(shop.structure().coface_index().held(shop.cell(cell)) <= 40);
  }
}

TEST_CASE("a place that is glued and split again and again has few entries to look through", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"t","dim":2})", R"({"op":"simplex","name":"u","dim":2})",
              R"({"op":"identify","pairs":[["t.0-1","u.0-1"]]})"});
  const bool undoes = GENERATE(false, true);
  const StructureMark glued = mark_of(shop.structure());
  for (int k = 0; k < 300; ++k) {
    const std::string copy = "c" + std::to_string(k);
    REQUIRE(shop.apply(ops::Deidentify{{{"t.0-1", copy, {{"u", 2}}}}}));
    CHECK(shop.structure().coface_index().entries(shop.cell(copy)).size() == 1);
    if (undoes) {
      shop.go_back_to(glued);
    } else {
      REQUIRE(shop.apply(ops::Identify{{{"t.0-1", copy}}}));
    }
  }
  const ops::CofaceIndex& index = shop.structure().coface_index();
  CHECK(index.held(shop.cell("t.0-1")) <= 24);
  CHECK(index.entries(shop.cell("t.0-1")).size() == 2);
  CHECK(wrong_cofaces(shop.structure()) == "");
}

TEST_CASE("the apex of a lazy cone has the cone's edges as cofaces, and what is squashed onto it", "[ops]") {
  Workshop shop(lazy_cones);
  SECTION("of simplices") { shop.build({R"({"op":"simplex","name":"t","dim":2})", R"({"op":"cone","apex":"v"})"}); }
  SECTION("of simploids, where more is degenerate over it") {
    shop.build({R"({"op":"simploid","name":"t","type":[1,1]})", R"({"op":"cone","apex":"v"})"});
  }
  CHECK(wrong_cofaces(shop.structure()) == "");
  shop.build({R"({"op":"simplex","name":"e","dim":1})", R"({"op":"identify","pairs":[["e.0","v"]]})"});
  CHECK(wrong_cofaces(shop.structure()) == "");
}

TEST_CASE("in a triangulated product, what has a face degenerate over a cell is among its cofaces", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"e","dim":1})", R"({"op":"simplex","name":"t","dim":2})",
              R"({"op":"degenerate","cell":"t.0-1","along":0})",
              R"({"op":"product","name":"P","left":"e","right":"t","kind":"simplicial"})"});
  CHECK(wrong_cofaces(shop.structure()) == "");
}

TEST_CASE("what cells, and which faces, there were can be said of every past moment", "[ops][stream]") {
  const unsigned seed = GENERATE(range(0U, 16U));
  CAPTURE(seed);
  Workshop shop(seed % 2 == 0 ? lazy_cones : Limits{});
  RandomSteps steps(seed, everything_and_maps(30));
  struct Past {
    Moment moment;
    std::map<std::string, std::vector<CellId>> cells;  // by label: the cells that the faces were
  };
  std::vector<Past> pasts;
  const Structure& s = shop.structure();
  for (int k = 0; k < 30; ++k) {
    const Operation op = steps.next(shop.structure());
    REQUIRE(shop.apply(op));
    Past past{s.now(), {}};
    for (const CellId c : current_cells(s)) {
      std::vector<CellId>& faces = past.cells[label(s, c)];
      for (const CellId face : s.faces().of(c)) {
        faces.push_back(s.find(face));
      }
    }
    pasts.push_back(std::move(past));
  }
  s.lazy().make_all();
  for (const auto& [moment, cells] : pasts) {
    std::map<std::string, std::vector<CellId>> found;
    s.cells().for_each_node([&, at = moment](CellId c) {
      if (ops::was_current(s, c, at)) {
        std::vector<CellId>& faces = found[label(s, c)];
        for (std::uint32_t f = 0; f < s.cells().type(c).faces.size(); ++f) {
          faces.push_back(s.faces().at(c, f, at).cell);
        }
      }
    });
    REQUIRE(found == cells);
  }
}

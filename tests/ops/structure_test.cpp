#include "ops/structure.hpp"

#include <algorithm>
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

  void apply(const Plan& plan, const TypeTable& types) {
    if (plan.new_body) {
      bodies.push_back(*plan.new_body);
      body_label.push_back(static_cast<int>(bodies.size()) - 1);
    }
    std::size_t begin = 0;
    for (const Plan::NewCell& cell : plan.cells) {
      Cell made{types.info(cell.type).type,
                {},
                plan.names.substr(begin, cell.name_end - begin),
                static_cast<CellId>(cells.size()),
                0};
      begin = cell.name_end;
      for (std::size_t k = 0; k < types.info(cell.type).faces.size(); ++k) {
        made.faces.push_back(plan.faces[cell.first_face + k]);
      }
      made.body = plan.new_body ? static_cast<int>(bodies.size()) - 1 : static_cast<int>(*plan.into_body);
      names[made.name] = made.label;
      cells.push_back(std::move(made));
    }
    for (const auto& [name, cell] : plan.aliases) {
      names[name] = cell;
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
  if (fast.created() != slow.cells.size()) {
    return "number of cells";
  }
  std::vector<std::uint32_t> counts;
  for (CellId c = 0; c < fast.created(); ++c) {
    const SlowStructure::Cell& cell = slow.cells[c];
    const auto faces = fast.faces_as_created(c);
    const std::string at = " of cell " + std::to_string(c);
    if (fast.type(c).type != cell.type ||
        !std::equal(faces.begin(), faces.end(), cell.faces.begin(), cell.faces.end())) {
      return "faces" + at;
    }
    if (fast.find(c) != cell.label || fast.is_current(c) != (cell.label == c)) {
      return "class" + at;
    }
    if (fast.oldest(c) != slow.oldest(c) || fast.name(c) != slow.cells[slow.oldest(c)].name ||
        fast.own_name(c) != cell.name) {
      return "name" + at;
    }
    if (fast.members(fast.find(c)) != slow.members(c)) {
      return "members" + at;
    }
    if (fast.body_name(fast.body_of(c)) != slow.bodies[static_cast<std::size_t>(slow.body_of(c))]) {
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
    if (!found || fast.body_name(*found) != slow.bodies[static_cast<std::size_t>(label)]) {
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
      if (fast.cells_of(*found) != cells) {
        return "cells of body " + slow.bodies[b];
      }
    }
  }
  std::vector<std::string> listed;
  for (const BodyId b : fast.current_bodies()) {
    listed.emplace_back(fast.body_name(b));
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
    marks.push_back(shop.structure().mark());
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
      shop.structure().truncate(marks[back]);
      slow = states[back];
      REQUIRE(shop.structure().mark() == marks[back]);
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
    shop.structure().truncate(marks.back());
    REQUIRE(dump(shop.structure()) == dumps.back());
    marks.pop_back();
    dumps.pop_back();
  }
  CHECK(shop.structure().mark() == StructureMark{});
  CHECK(shop.structure().counts().empty());
  CHECK(shop.structure().current_bodies().empty());
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
  CHECK(shop.structure().own_name(*shop.structure().lookup("d")) == "d");
  CHECK(shop.structure().members(shop.cell("a")) == 4);
  CHECK(shop.structure().counts().size() == 1);
  CHECK(shop.structure().counts()[0] == 1);
}

TEST_CASE("merged bodies keep the older name, and the younger one stays an alias", "[ops]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"a","dim":1})", R"({"op":"simplex","name":"b","dim":1})",
              R"({"op":"simplex","name":"c","dim":1})"});
  const StructureMark before = shop.structure().mark();
  shop.build({R"({"op":"identify","pairs":[["c.0","b.0"]]})"});
  const auto names = [&] {
    std::vector<std::string> all;
    for (const BodyId b : shop.structure().current_bodies()) {
      all.emplace_back(shop.structure().body_name(b));
    }
    return all;
  };
  CHECK(names() == std::vector<std::string>{"a", "b"});
  CHECK(shop.structure().lookup_body("c") == shop.structure().lookup_body("b"));
  CHECK(shop.structure().cells_of(*shop.structure().lookup_body("c")).size() == 5);
  shop.build({R"({"op":"identify","pairs":[["c.1","a.0"]]})"});
  CHECK(names() == std::vector<std::string>{"a"});
  CHECK(shop.structure().body_name(*shop.structure().lookup_body("b")) == "a");
  CHECK(shop.structure().lookup_body("nobody") == std::nullopt);
  shop.structure().truncate(before);
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
    links_then.push_back(shop.structure().links());
    found_then.emplace_back();
    for (CellId c = 0; c < shop.structure().created(); ++c) {
      found_then.back().push_back(shop.structure().find(c));
    }
  }
  for (std::size_t k = 0; k < found_then.size(); ++k) {
    for (CellId c = 0; c < found_then[k].size(); ++c) {
      REQUIRE(shop.structure().find_at(c, links_then[k]) == found_then[k][c]);
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
  for (CellId c = 0; c < shop.structure().created(); ++c) {
    int depth = 0;
    for (CellId at = c; !shop.structure().is_current(at); at = shop.structure().parent(at)) {
      ++depth;
    }
    CHECK((std::uint32_t{1} << depth) <= shop.structure().members(shop.structure().find(c)));
  }
}

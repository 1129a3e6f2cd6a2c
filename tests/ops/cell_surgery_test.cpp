// Local operations on cells of maps, as steps: the cells are those of the map that the darts are, after each of them.
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ops/maps/cell_surgery.hpp"
#include "ops/maps/numbered_set.hpp"
#include "ops/maps/orbits.hpp"
#include "ops/plan/step_sequence.hpp"
#include "ops/plan/workspace.hpp"
#include "reductions/homology.hpp"
#include "sparse/archive_memory.hpp"
#include "tests/support/cell_models.hpp"
#include "tests/support/solids.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::tests;
using ops::Workspace;

namespace {

std::string step(Workspace& workspace, const ops::Operation& op) {
  if (const auto* undo = std::get_if<ops::Undo>(&op)) {
    const Status taken = workspace.take_back(undo->steps);
    return taken ? "" : taken.error().what;
  }
  const std::string before = dump(workspace.structure());
  const Status planned = workspace.plan(op);
  if (!planned) {
    CHECK(dump(workspace.structure()) == before);
    return planned.error().what;
  }
  workspace.carry_out();
  return "";
}

void do_all(Workspace& workspace, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    INFO(line);
    REQUIRE(step(workspace, operation(line)) == "");
  }
}

std::string refusal(Workspace& workspace, const std::string& line) { return step(workspace, operation(line)); }

bool has_part(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::vector<std::uint64_t> counts_of(const Workspace& workspace) {
  const auto counts = workspace.structure().counts();
  return {counts.begin(), counts.end()};
}

std::vector<std::string> groups_of(const ops::Structure& structure) {
  const ops::CellBasis basis = ops::cells_at(structure, ops::now(structure));
  CHECK(ops::first_broken_face_law(structure, basis).value_or("") == "");
  std::vector<std::string> groups;
  for (const auto& group :
       reductions::homology_groups(ops::chain_complex(structure, basis, ops::now(structure), sparse::Integers{}))) {
    groups.push_back(group.to_string());
  }
  while (!groups.empty() && groups.back() == "0") {
    groups.pop_back();
  }
  return groups;
}

/// Maps as lists of involutions, on which all is done the plain way, beside an object.
class PlainDarts {
 public:
  explicit PlainDarts(int dimension) : n_{dimension}, alpha_(static_cast<std::size_t>(dimension) + 1) {}

  Workspace& object() { return object_; }
  [[nodiscard]] std::size_t size() const { return names_.size(); }
  void make(const std::string& name, const GMap& map) {
    REQUIRE(step(object_, make_map(name, map)) == "");
    append(map.involutions(), name);
  }
  /// What was done, or nothing when it was not legal.
  std::string random_step(Random& random) {
    const auto any = [&] { return static_cast<Dart>(random.in(0, static_cast<int>(names_.size()) - 1)); };
    const Dart a = any(), b = any();
    const int kind = random.in(1, 12);
    if (kind <= 3) {
      return sew(a, b);
    }
    if (kind == 4) {
      return unsew(a);
    }
    if (kind <= 7) {
      const int i = random.in(0, n_);
      return change(ops::RemoveCell{cell_name(i, a)}, ops::removal_of_cell(ops::view_of(map()), i, a), "");
    }
    if (kind <= 9) {
      const int i = random.in(0, n_);
      return change(ops::ContractCell{cell_name(i, a)}, ops::contraction_of_cell(ops::view_of(map()), i, a), "");
    }
    const int i = random.in(0, 2);
    std::vector<Dart> darts{a};
    if (i == 1 && random.one_in(2)) {
      darts.push_back(b);
    }
    while (i == 2 && darts.size() < 6 && !random.one_in(4)) {
      const Dart next = alpha_[1][alpha_[0][darts.back()]];
      darts.push_back(random.one_in(2) ? next : alpha_[1][alpha_[2][next]]);
    }
    const std::string name = "x" + std::to_string(++made_);
    std::vector<std::string> names;
    for (const Dart d : darts) {
      names.push_back(names_[d]);
    }
    return random.one_in(2) ? change(ops::InsertCell{name, i, names, {}},
                                     ops::insertion_of_cell(ops::view_of(map()), i, darts), name)
                            : change(ops::SplitCell{name, n_ - i, names, {}},
                                     ops::splitting_of_cell(ops::view_of(map()), n_ - i, darts), name);
  }
  void undo() {
    REQUIRE(step(object_, ops::Undo{1}) == "");
    std::tie(alpha_, names_) = before_.back();
    before_.pop_back();
  }
  [[nodiscard]] bool can_undo() const { return !before_.empty(); }
  [[nodiscard]] GMap map() const { return *GMap::make(alpha_); }

  void check() { check_is(object_.structure()); }
  void check_is(const ops::Structure& structure) {
    const GMap plain = map();
    for (int i = 0; i <= n_; ++i) {
      REQUIRE(structure.counts()[static_cast<std::size_t>(i)] == ops::cells(plain, i).count());
    }
    REQUIRE(groups_of(structure) == homology_of(ops::simplicial_analogue(plain)));
    for (int i = 0; i <= n_; ++i) {  // darts see one cell if and only if they are in one orbit
      const ops::Orbits orbits = ops::cells(plain, i);
      std::map<ops::CellId, std::uint32_t> orbit_of;
      for (Dart d = 0; d < plain.size(); ++d) {
        const ops::CellId cell = structure.find(structure.lookup(cell_name(i, d)).value());
        REQUIRE(orbit_of.emplace(cell, orbits.of[d]).first->second == orbits.of[d]);
      }
      REQUIRE(orbit_of.size() == orbits.count());
      for (const auto& [cell, orbit] : orbit_of) {  // and what a cell is called is read as that cell
        REQUIRE(structure.find(structure.lookup(structure.name(cell)).value()) == cell);
      }
    }
  }

 private:
  [[nodiscard]] std::string cell_name(int i, Dart d) const {
    std::string name = names_[d];
    return name.replace(name.find(':'), 1, "." + std::to_string(i) + ":");
  }
  using Lists = std::vector<std::vector<Dart>>;
  void append(const Lists& alpha, const std::string& name) {
    const auto first = static_cast<Dart>(names_.size());
    for (std::size_t i = 0; i < alpha_.size(); ++i) {
      for (const Dart image : alpha[i]) {
        alpha_[i].push_back(first + image);
      }
    }
    for (Dart d = 0; d < alpha[0].size(); ++d) {
      names_.push_back(dart_name(name, d));
    }
  }

  std::string change(const ops::Operation& op, const Result<ops::CellSurgery>& surgery, const std::string& name) {
    const std::string why = step(object_, op);
    if (!surgery) {
      REQUIRE(why != "");
      return "";
    }
    if (why != "") {
      REQUIRE((has_part(why, "would be no ball") || has_part(why, "is open")));
      return "";
    }
    before_.emplace_back(alpha_, names_);
    for (Dart d = 0; d < surgery->made; ++d) {
      names_.push_back(dart_name(name, d));
    }
    alpha_ = ops::after_surgery(map(), *surgery).involutions();
    std::set<Dart> gone(surgery->gone.begin(), surgery->gone.end());
    std::vector<std::string> left;
    for (Dart d = 0; d < names_.size(); ++d) {
      if (!gone.contains(d)) {
        left.push_back(names_[d]);
      }
    }
    for (const Dart d : gone) {
      const std::string other = names_[d];
      REQUIRE(has_part(step(object_, sew_darts(n_, other, other)), "it went out of its map with the cell"));
    }
    names_ = std::move(left);
    return ops::to_text(op);
  }
  std::string sew(Dart a, Dart b) {
    const ops::Sew op = sew_darts(n_, names_[a], names_[b]);
    if (step(object_, op) != "") {
      return "";
    }
    before_.emplace_back(alpha_, names_);
    for (const auto& [x, y] : pairs(a, b)) {
      alpha_.back()[x] = y;
      alpha_.back()[y] = x;
    }
    return ops::to_text(op);
  }
  std::string unsew(Dart a) {
    if (alpha_.back()[a] == a) {
      return "";
    }
    const ops::Unsew op{n_, {names_[a]}};
    REQUIRE(step(object_, op) == "");
    before_.emplace_back(alpha_, names_);
    for (const auto& [x, y] : pairs(a, alpha_.back()[a])) {
      alpha_.back()[x] = x;
      alpha_.back()[y] = y;
    }
    return ops::to_text(op);
  }
  std::vector<std::pair<Dart, Dart>> pairs(Dart a, Dart b) {
    std::vector<std::pair<Dart, Dart>> found{{a, b}};
    std::set<Dart> met{a};
    for (std::size_t at = 0; at < found.size(); ++at) {
      for (int j = 0; j + 2 <= n_; ++j) {
        const auto& alpha = alpha_[static_cast<std::size_t>(j)];
        if (met.insert(alpha[found[at].first]).second) {
          found.emplace_back(alpha[found[at].first], alpha[found[at].second]);
        }
      }
    }
    return found;
  }

  Workspace object_;
  int n_;
  Lists alpha_;
  std::vector<std::string> names_;
  std::vector<std::pair<Lists, std::vector<std::string>>> before_;
  int made_ = 0;
};

/// The same object, begun anew, and read from an archive.
void check_copies(PlainDarts& darts) {
  Workspace begun;
  begun.begin_with(darts.object());
  darts.check_is(begun.structure());
  std::vector<char> bytes;
  sparse::ArchiveWriter writer(sparse::sink_into(bytes));
  darts.object().save(writer);
  REQUIRE(writer.finish().has_value());
  sparse::ArchiveReader reader(sparse::source_of(bytes), bytes.size());
  Workspace read;
  read.load(reader);
  REQUIRE(reader.is_good());
  darts.check_is(read.structure());
  REQUIRE(dump(read.structure()) == dump(darts.object().structure()));
}

void operate_at_random(PlainDarts& darts, Random& random, int tries, std::size_t most) {
  int done = 0;
  for (int k = 0; k < tries && darts.size() < most; ++k) {
    if (darts.can_undo() && random.one_in(15)) {
      darts.undo();
    } else {
      const std::string before = dump(darts.object().structure());
      const std::string what = darts.random_step(random);
      if (what == "") {
        continue;
      }
      INFO(what);
      ++done;
      darts.check();
      if (random.one_in(6)) {
        darts.undo();
        REQUIRE(dump(darts.object().structure()) == before);
      }
    }
    darts.check();
    if (random.one_in(10)) {
      check_copies(darts);
    }
  }
  REQUIRE(done > 10);
  while (darts.can_undo()) {
    darts.undo();
  }
  darts.check();
}

}  // namespace

TEST_CASE("polygons operated on at random are the map that their darts are") {
  const auto seed = GENERATE(range(0U, 24U));
  CAPTURE(seed);
  Random random(seed);
  PlainDarts darts(2);
  for (int k = 0; k < 4; ++k) {
    darts.make("p" + std::to_string(k), ops::polygon(static_cast<Dart>(random.in(2, 5))));
  }
  operate_at_random(darts, random, 150, 90);
}

TEST_CASE("solids operated on at random are the map that their darts are") {
  const auto seed = GENERATE(range(0U, 12U));
  CAPTURE(seed);
  Random random(seed);
  PlainDarts darts(3);
  for (int k = 0; k < 3; ++k) {
    const std::vector<Polygons> kinds{tetrahedron_faces(), cube_faces(), prism_faces(3), pyramid_faces(4)};
    darts.make("s" + std::to_string(k), solid_of(kinds[static_cast<std::size_t>(random.in(0, 3))]));
  }
  operate_at_random(darts, random, 150, 250);
}

TEST_CASE("a surface is simplified down to one face, one vertex and its loops") {
  const auto [map, loops] = GENERATE(table<GMap, std::uint64_t>(
      {{map_of_faces(cube_faces()), 0}, {torus_of_a_square(), 2}, {projective_plane_of_a_square(), 1}}));
  PlainDarts darts(2);
  darts.make("m", map);
  const std::vector<std::string> groups = groups_of(darts.object().structure());
  for (Dart d = 0; d < map.size(); ++d) {  // edges between two faces, then those with two ends
    const std::string edge = "m.1:" + std::to_string(d);
    const auto& structure = darts.object().structure();
    const auto face = [&](Dart of) { return structure.find(*structure.lookup("m.2:" + std::to_string(of))); };
    if (!structure.darts().taken_out_with(2, d) && face(d) != face(structure.darts().alpha(2, 2, d))) {
      REQUIRE(step(darts.object(), ops::RemoveCell{edge}) == "");
      REQUIRE(groups_of(structure) == groups);
    }
  }
  for (Dart d = 0; d < map.size(); ++d) {
    const auto& structure = darts.object().structure();
    const auto vertex = [&](Dart of) { return structure.find(*structure.lookup("m.0:" + std::to_string(of))); };
    if (!structure.darts().taken_out_with(2, d) && structure.counts()[1] > std::max<std::uint64_t>(loops, 1) &&
        vertex(d) != vertex(structure.darts().alpha(2, 0, d))) {
      REQUIRE(step(darts.object(), ops::ContractCell{"m.1:" + std::to_string(d)}) == "");
      REQUIRE(groups_of(structure) == groups);
    }
  }
  CHECK(counts_of(darts.object()) ==
        (loops == 0 ? std::vector<std::uint64_t>{2, 1, 1} : std::vector<std::uint64_t>{1, loops, 1}));
}

TEST_CASE("two cubes become one box, and its edges go where only two faces meet") {
  Workspace workspace;
  REQUIRE(step(workspace, make_map("a", solid_of(cube_faces()))) == "");
  REQUIRE(step(workspace, make_map("b", solid_of(cube_faces()))) == "");
  REQUIRE(step(workspace, sew_darts(3, "a:0", "b:0")) == "");
  CHECK(counts_of(workspace) == std::vector<std::uint64_t>{12, 20, 11, 2});
  do_all(workspace, {R"({"op":"remove_cell","cell":"a.2:0"})"});
  CHECK(counts_of(workspace) == std::vector<std::uint64_t>{12, 20, 10, 1});
  CHECK(groups_of(workspace.structure()) == std::vector<std::string>{"Z"});
  CHECK(has_part(refusal(workspace, R"({"op":"remove_cell","cell":"a.2:0"})"),
                 "there is no dart \"a:0\": it went out of its map with the cell \"a.2:0\""));
  const std::string outside = "a.1:" + std::to_string(solid_of(cube_faces()).alpha(2, 0));
  do_all(workspace, {R"({"op":"remove_cell","cell":")" + outside + R"("})"});
  CHECK(counts_of(workspace) == std::vector<std::uint64_t>{12, 19, 9, 1});
  CHECK(groups_of(workspace.structure()) == std::vector<std::string>{"Z"});
}

TEST_CASE("an edge with one face on both sides is removed, and then the surface is another one") {
  Workspace workspace;
  REQUIRE(step(workspace, make_map("t", torus_of_a_square())) == "");
  do_all(workspace, {R"({"op":"remove_cell","cell":"t.1:0"})"});
  CHECK(counts_of(workspace) == std::vector<std::uint64_t>{1, 1, 2});  // a sphere: the torus was cut and closed
  CHECK(groups_of(workspace.structure()) == std::vector<std::string>{"Z", "0", "Z"});
  CHECK(has_part(refusal(workspace, R"({"op":"remove_cell","cell":"t.1:2"})"), "nothing would be left"));
}

TEST_CASE("what cannot be done to a cell of a map is refused with its name") {
  Workspace workspace;
  do_all(workspace, {R"({"op":"polygon","name":"p","sides":4})", R"({"op":"polygon","name":"q","sides":4})",
                     R"({"op":"sew","dim":2,"pairs":[["p:0","q:0"]]})", R"({"op":"polygon","name":"r","sides":4})",
                     R"({"op":"polygon","name":"s","sides":4,"as":"simplices"})",
                     R"({"op":"simplex","name":"t","dim":1})", R"({"op":"simplex","name":"u","dim":2})",
                     R"({"op":"gmap","name":"f","alpha":[[1,0,3,2],[3,2,1,0],[0,1,2,3],[0,1,2,3]]})"});
  const auto why = [&](const std::string& line) { return refusal(workspace, line); };
  CHECK(has_part(why(R"({"op":"remove_cell","cell":"f.1:2"})"),
                 "the 2-cell of \"f:0\" would be no ball: its canonical boundary is open or folded"));
  CHECK(has_part(why(R"({"op":"remove_cell","cell":"p.0:0"})"), "at \"p:0\" alpha_1 and alpha_2 do not commute"));
  CHECK(has_part(why(R"({"op":"remove_cell","cell":"p"})"), "cells of the dimensions 0 to 1 can be removed, not of 2"));
  CHECK(has_part(why(R"({"op":"remove_cell","cell":"p.3:0"})"), "the map \"p\" has dimension 2"));
  CHECK(has_part(why(R"({"op":"remove_cell","cell":"t"})"), "there is no cell \"t\" of a map"));
  CHECK(has_part(why(R"({"op":"remove_cell","cell":"p.1:9"})"), "its darts are numbered from 0 to 7"));
  CHECK(has_part(why(R"({"op":"remove_cell","cell":"s.1:0"})"), "is a dart of a map by simplices"));
  CHECK(has_part(why(R"({"op":"insert_cell","name":"x","dim":1,"darts":["p:0","q:0"]})"),
                 "alpha_0 and alpha_1 do not lead from \"p:0\" to \"q:0\""));
  CHECK(has_part(why(R"({"op":"insert_cell","name":"p","dim":1,"darts":["p:0","p:4"]})"), "\"p\" is in use"));
  CHECK(has_part(why(R"({"op":"insert_cell","name":"x","dim":1,"darts":["p:0","p:4"],"at":[0,0]})"),
                 "makes no new vertex"));
  CHECK(has_part(why(R"({"op":"insert_cell","name":"x","dim":0,"darts":[]})"), "list one at least"));
  do_all(workspace, {R"({"op":"identify","pairs":[["p.1:0","u.0-1"]]})"});
  CHECK(has_part(why(R"({"op":"remove_cell","cell":"p.1:0"})"), "is glued to other cells, and not only by sewing"));
  CHECK(why(R"({"op":"contract_cell","cell":"r.1:0"})") == "");
  CHECK(why(R"({"op":"insert_cell","name":"x","dim":1,"darts":["r:2","r:5"]})") == "");
  CHECK(why(R"({"op":"remove_cell","cell":"x.1:0"})") == "");
  CHECK(groups_of(workspace.structure()) == std::vector<std::string>{"Z^5"});
}

TEST_CASE("what is left of a map after removals is extended") {
  Workspace workspace;
  REQUIRE(step(workspace, make_map("c", map_of_faces(cube_faces()))) == "");
  do_all(workspace, {R"({"op":"remove_cell","cell":"c.1:0"})", R"({"op":"contract_cell","cell":"c.1:8"})",
                     R"({"op":"extend","maps":["c"]})"});
  CHECK(counts_of(workspace) == std::vector<std::uint64_t>{7, 10, 5, 1});
  CHECK(groups_of(workspace.structure()) == std::vector<std::string>{"Z"});
  CHECK(has_part(refusal(workspace, R"({"op":"remove_cell","cell":"c.1:0"})"), "it went out of its map"));
  do_all(workspace, {R"({"op":"remove_cell","cell":"c.1:16"})"});
  CHECK(counts_of(workspace) == std::vector<std::uint64_t>{7, 9, 4, 1});
  CHECK(groups_of(workspace.structure()) == std::vector<std::string>{"Z"});
}

TEST_CASE("cells of a map that are glued to each other, and not by sewing, are not replaced") {
  Workspace workspace;
  do_all(workspace,
         {R"({"op":"polygon","name":"p","sides":3})", R"({"op":"polygon","name":"q","sides":3})",
          R"({"op":"sew","dim":2,"pairs":[["p:0","q:0"]]})", R"({"op":"identify","pairs":[["p.2:0","q.2:0"]]})"});
  CHECK(counts_of(workspace) == std::vector<std::uint64_t>{3, 3, 1});
  CHECK(has_part(refusal(workspace, R"({"op":"remove_cell","cell":"p.1:0"})"), "is glued to other cells"));
  CHECK(has_part(refusal(workspace, R"({"op":"insert_cell","name":"k","dim":1,"darts":["q:2","q:5"]})"),
                 "is glued to other cells"));
}

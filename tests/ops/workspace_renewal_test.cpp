// Workspaces that begin with the object of another one: the same cells, whatever had happened before.
#include <map>

#include "ops/plan/step_sequence.hpp"
#include "tests/support/abstract_steps.hpp"
#include "tests/support/random_steps.hpp"
#include "tests/support/snapshots.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::tests;
using ops::Workspace;

namespace {

bool do_step(Workspace& workspace, const ops::Operation& operation) {
  if (!workspace.plan(operation)) {
    return false;
  }
  workspace.carry_out();
  return true;
}

/// The boundaries of the cells, all by name, in the orientations for which names stand.
std::map<std::string, std::map<std::string, int>> boundaries(const ops::Structure& structure) {
  const auto& directory = structure.directory();
  std::map<std::string, std::map<std::string, int>> all;
  for (const ops::CellId c : current_cells(structure)) {
    auto& boundary = all[structure.name(c)];
    structure.faces().for_each_now(c, [&](ops::CellId face, int sign) {
      boundary[structure.name(face)] += sign * directory.sign_of_name(face) * directory.sign_of_name(c);
    });
  }
  return all;
}

void check_is_same(const Workspace& one, const Workspace& other) {
  REQUIRE(std::ranges::equal(one.structure().counts(), other.structure().counts()));
  REQUIRE(boundaries(one.structure()) == boundaries(other.structure()));
  const ops::CellBasis basis = ops::cells_at(one.structure(), ops::now(one.structure()));
  REQUIRE(ops::first_broken_face_law(one.structure(), basis).value_or("") == "");
}

/// It is sound to whoever reads it.
void check_is_sound(const Workspace& workspace) {
  Bytes bytes;
  sparse::ArchiveWriter to(sink_into(bytes));
  workspace.save(to);
  REQUIRE(to.finish());
  sparse::ArchiveReader from(source_of(bytes), bytes.size());
  Workspace again;
  again.load(from);
  const Status read = from.finish();
  CAPTURE(read ? "" : read.error().what);
  REQUIRE(read);
  check_is_same(again, workspace);
}

}  // namespace

TEST_CASE("a workspace begins with the cells of another one, and takes the same steps from there",
          "[ops][renewal][stream]") {
  const unsigned seed = GENERATE(range(0U, 60U));
  CAPTURE(seed);
  Workspace workspace;
  RandomSteps random(seed, everything_and_maps(40));
  for (int k = 0; k < 20; ++k) {
    REQUIRE(do_step(workspace, random.next(workspace.structure())));
  }
  Workspace next;
  next.begin_with(workspace);
  check_is_same(next, workspace);
  check_is_sound(next);
  CHECK_FALSE(next.take_back(1));
  for (int k = 0; k < 12; ++k) {
    const ops::Operation step = random.next(next.structure());
    CAPTURE(k, ops::to_text(step));
    REQUIRE(do_step(next, step));
    REQUIRE(do_step(workspace, step));
    check_is_same(next, workspace);
  }
  REQUIRE(next.take_back(12));
  REQUIRE(workspace.take_back(12));
  check_is_same(next, workspace);
}

TEST_CASE("names that cells had denote what these have become also in a workspace that begins with the object",
          "[ops][renewal][stream]") {
  const unsigned seed = GENERATE(range(100U, 140U));
  CAPTURE(seed);
  Workspace workspace;
  RandomSteps random(seed, {.most_cells = 40, .degeneracies = true, .splits = true});
  for (int k = 0; k < 25; ++k) {
    REQUIRE(do_step(workspace, random.next(workspace.structure())));
  }
  Workspace next;
  next.begin_with(workspace);
  const ops::Structure& before = workspace.structure();
  for (ops::CellId c = 0; c < before.cells().size(); ++c) {
    const std::string name = before.directory().own_name(c);
    CAPTURE(name);
    const auto denoted = next.structure().denoted(name);
    REQUIRE(denoted);
    const ops::Value now = next.structure().values().of(denoted->node);
    const ops::Value then = before.values().of(c);
    REQUIRE(next.structure().name(now.cell) == before.name(then.cell));
    REQUIRE(now.collapsed == then.collapsed);
  }
}

TEST_CASE("abstract complexes go on in a workspace that begins with the object of another one",
          "[ops][renewal][stream]") {
  const unsigned seed = GENERATE(range(0U, 30U));
  CAPTURE(seed);
  Workspace workspace;
  RandomAbstractSteps random(seed, 8, 3);
  for (int k = 0; k < 30; ++k) {
    (void)do_step(workspace, random.next());
  }
  Workspace next;
  next.begin_with(workspace);
  check_is_same(next, workspace);
  check_is_sound(next);
  for (int k = 0; k < 30; ++k) {
    const ops::Operation step = random.next();
    CAPTURE(k, ops::to_text(step));
    REQUIRE(do_step(next, step) == do_step(workspace, step));
    check_is_same(next, workspace);
  }
}

TEST_CASE("a workspace that begins with an object has the darts of maps of which something is left") {
  Workspace workspace;
  for (const char* line :
       {R"({"op":"polygon","name":"p","sides":4})", R"({"op":"polygon","name":"q","sides":4})",
        R"({"op":"polygon","name":"r","sides":5})", R"({"op":"polygon","name":"s","sides":3})",
        R"({"op":"sew","dim":2,"pairs":[["p:0","q:0"]]})", R"({"op":"remove","cells":["q.2:2"]})",
        R"({"op":"remove","cells":["r.0:0","r.0:2","r.0:4","r.0:6","r.0:8"],"cofaces":true})",
        R"({"op":"chain_of_maps","name":"h","levels":[{"darts":2},{"alpha":[[1,0]],"sigma":[0,1]}]})",
        R"({"op":"remove","cells":["h.0:0","h.0:1"],"cofaces":true})",
        R"({"op":"gmap","name":"c","alpha":[[1,0,3,2],[3,2,1,0],[3,2,1,0]]})", R"({"op":"extend","maps":["c"]})"}) {
    CAPTURE(line);
    REQUIRE(do_step(workspace, operation(line)));
  }
  for (int k = 0; k < 30; ++k) {  // with a vertex that is called after a new dart
    const std::string name = "k" + std::to_string(k);
    REQUIRE(do_step(workspace, operation(R"({"op":"insert_cell","name":")" + name + R"(","dim":1,"darts":["s:2"]})")));
    REQUIRE(do_step(workspace, operation(R"({"op":"remove_cell","cell":")" + name + R"(.1:0"})")));
  }
  REQUIRE(workspace.structure().darts().darts(2) == 8 + 8 + 10 + 6 + 4 + 30 * 4);
  Workspace next;
  next.begin_with(workspace);
  check_is_same(next, workspace);
  check_is_sound(next);
  const ops::DartStore& darts = next.structure().darts();
  CHECK(darts.darts(2) == 8 + 8 + 6);
  CHECK(darts.darts(3) == 4);
  CHECK(darts.maps() == 4);
  CHECK_FALSE(do_step(next, operation(R"({"op":"sew","dim":2,"pairs":[["r:0","p:4"]]})")));
  CHECK_FALSE(do_step(next, operation(R"({"op":"sew","dim":2,"pairs":[["q:0","p:4"]]})")));  // which is sewn
  REQUIRE(do_step(next, operation(R"({"op":"sew","dim":2,"pairs":[["s:0","p:5"]]})")));
  REQUIRE(do_step(next, operation(R"({"op":"insert_cell","name":"z","dim":1,"darts":["s:2"]})")));
  check_is_sound(next);
}

TEST_CASE("a map stays when a cell is called after a dart of it that is gone") {
  Workspace workspace;
  for (const char* line :
       {R"({"op":"polygon","name":"p","sides":3})", R"({"op":"insert_cell","name":"k","dim":0,"darts":["p:1"]})",
        R"({"op":"insert_cell","name":"l","dim":1,"darts":["p:1","p:4"]})", R"({"op":"remove_cell","cell":"l.1:0"})"}) {
    CAPTURE(line);
    REQUIRE(do_step(workspace, operation(line)));
  }
  const ops::DartStore& before = workspace.structure().darts();
  Workspace next;
  next.begin_with(workspace);
  const ops::DartStore& after = next.structure().darts();
  CHECK(after.darts(2) == before.darts(2) - 4);  // without those of l
  check_is_same(next, workspace);
  for (Workspace* each : {&workspace, &next}) {
    REQUIRE(do_step(*each, operation(R"({"op":"remove_cell","cell":"k.0:0"})")));
  }
  check_is_same(next, workspace);
}

TEST_CASE(
    "simplices of maps that were unsewn are called by the same darts in a workspace that begins with the object") {
  Workspace workspace;
  for (const char* line :
       {R"({"op":"polygon","name":"p","sides":4,"as":"simplices"})",
        R"({"op":"polygon","name":"q","sides":4,"as":"simplices"})",
        R"({"op":"polygon","name":"r","sides":4,"as":"simplices"})", R"({"op":"sew","dim":2,"pairs":[["p:0","q:0"]]})",
        R"({"op":"sew","dim":2,"pairs":[["q:2","r:0"]]})",  // at a vertex with p, which keeps it
        R"({"op":"unsew","dim":2,"darts":["p:0"]})", R"({"op":"unsew","dim":1,"darts":["q:2"]})"}) {
    CAPTURE(line);
    REQUIRE(do_step(workspace, operation(line)));
  }
  Workspace next;
  next.begin_with(workspace);
  check_is_sound(next);
  std::vector<std::string> names;
  for (const char* map : {"p", "q", "r"}) {
    for (const char* numbers : {"0", "1", "2", "0-1", "0-2", "1-2", "0-1-2"}) {
      for (int k = 0; k < 8; ++k) {
        names.push_back(map + std::string(".<") + numbers + ">:" + std::to_string(k));
      }
    }
  }
  const auto node = [](const Workspace& of, const std::string& name) {
    const auto found = of.structure().lookup(name);
    return found ? of.structure().find(*found) : ops::CellId{UINT32_MAX};
  };
  std::map<ops::CellId, ops::CellId> same;  // of the one by that of the other
  for (const std::string& name : names) {
    CAPTURE(name);
    const auto [at, is_new] = same.try_emplace(node(workspace, name), node(next, name));
    CHECK(at->second == node(next, name));
  }
  CHECK(same.size() > 40);
}

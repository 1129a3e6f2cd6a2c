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

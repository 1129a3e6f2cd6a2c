// Workspaces to archives and back: the structure is the same, but for what can be undone.
#include "tests/support/random_steps.hpp"
#include "tests/support/snapshots.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::tests;
using ops::Workspace;

namespace {

Bytes written(const Workspace& workspace) {
  Bytes bytes;
  sparse::ArchiveWriter to(sink_into(bytes));
  workspace.save(to);
  REQUIRE(to.finish());
  return bytes;
}

Status read(const Bytes& bytes, Workspace& workspace) {
  sparse::ArchiveReader from(source_of(bytes), bytes.size());
  workspace.load(from);
  return from.finish();
}

void carry_out(Workspace& workspace, const ops::Operation& operation) {
  CAPTURE(ops::to_text(operation));
  REQUIRE(workspace.plan(operation));
  workspace.carry_out();
}

}  // namespace

TEST_CASE("a workspace that was read has the structure of the one that was written", "[ops][archive][stream]") {
  const unsigned seed = GENERATE(range(0U, 40U));
  CAPTURE(seed);
  Workspace workspace;
  RandomSteps random(seed, everything_and_maps(40));
  for (int k = 0; k < 25; ++k) {
    carry_out(workspace, random.next(workspace.structure()));
  }
  const Bytes bytes = written(workspace);
  Workspace again;
  REQUIRE(read(bytes, again));
  CHECK(written(again) == bytes);
  CHECK(first_difference(dump(again.structure()), dump(workspace.structure())) == "");
  CHECK(again.structure().journal().begin() == 0);
  CHECK(again.steps().empty());
  CHECK(again.steps_below() == 25);
  for (int k = 0; k < 8; ++k) {
    const ops::Operation next = random.next(workspace.structure());
    carry_out(workspace, next);
    carry_out(again, next);
    REQUIRE(first_difference(dump(again.structure()), dump(workspace.structure())) == "");
  }
  REQUIRE(workspace.take_back(8));
  REQUIRE(again.take_back(8));
  CHECK(first_difference(dump(again.structure()), dump(workspace.structure())) == "");
  CHECK_FALSE(again.take_back(1));
}

TEST_CASE("a workspace that was cut off is told", "[ops][archive]") {
  Workspace workspace;
  RandomSteps random(3, everything_and_maps(30));
  for (int k = 0; k < 15; ++k) {
    carry_out(workspace, random.next(workspace.structure()));
  }
  const Bytes whole = written(workspace);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    Workspace again;
    const Status status = read(part, again);
    CAPTURE(size);
    REQUIRE_FALSE(status);
    REQUIRE(status.error().code == Errc::bad_input);
  }
}

#include "tools/bench/soak.hpp"

#include "tests/support/catch.hpp"

using namespace sesame;

TEST_CASE("laws and groups hold all through a soak, and memory stays where cells that are gone are forgotten",
          "[bench][soak]") {
  tools::SoakPlan plan;
  plan.steps = 200'000;
  plan.cells = 2'000;
  plan.undo_limit = 1'000;
  plan.forgets_cells = GENERATE(true, false);
  CAPTURE(plan.forgets_cells);
  const auto outcome = tools::soak(plan, [](const tools::SoakTenth&) {});
  REQUIRE(outcome);
  for (const char* operation : {"simplex", "simploid", "complex", "cone", "suspend", "product", "identify",
                                "degenerate", "deidentify", "insert", "collapse", "expect", "class", "undo", "note"}) {
    CAPTURE(operation);
    REQUIRE(outcome->counts.contains(operation));
    CHECK(outcome->counts.find(operation)->second.accepted > 0);
  }
  const tools::SoakTenth& second = outcome->tenths[1];
  const tools::SoakTenth& last = outcome->tenths.back();
  CHECK(last.cells < 2 * plan.cells);
  // Where they are forgotten, what there is goes up and down by some megabytes, as they are all forgotten at a time.
  const auto grown = static_cast<double>(last.heap_bytes) - static_cast<double>(second.heap_bytes);
  CHECK(grown / static_cast<double>(last.steps - second.steps) < (plan.forgets_cells ? 100 : 700));
  CHECK((last.renewals > 10) == plan.forgets_cells);
  CHECK((last.nodes < 50 * plan.cells) == plan.forgets_cells);
}

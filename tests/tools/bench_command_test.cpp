#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

#include "tests/support/captured.hpp"
#include "tests/support/catch.hpp"
#include "tests/tools/command_run.hpp"
#include "tools/bench/comparison.hpp"
#include "tools/bench/measurement.hpp"
#include "tools/bench/processes.hpp"
#include "tools/commands/commands.hpp"

namespace sesame::tools {
namespace {

using Catch::Matchers::Contains;

CommandRun bench(const std::string& arguments) { return run_command(add_bench_command, "bench " + arguments); }

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>{file}, {}};
}

}  // namespace

TEST_CASE("bench measures what is named and prints a table", "[bench]") {
  const CommandRun run = bench("torus-random methods --quick --repeat 1 --method live,recompute");
  CHECK(run.status == 0);
  CHECK(run.errors.empty());
  CHECK_THAT(run.out, Contains("mean") && Contains("torus-random") && Contains("methods-menger") &&
                          !Contains("klein-bottle-random") && !Contains("eager"));
  CHECK_THAT(bench("torus-random --size 5 --repeat 1").out, Contains("torus-random                        5 live"));
}

TEST_CASE("bench names what there is when it is asked for something else", "[bench]") {
  const auto refused = [](const std::string& arguments) {
    const CommandRun run = bench(arguments);
    CHECK(run.status == 1);
    CHECK(run.out.empty());
    return run.errors;
  };
  CHECK_THAT(refused("nothing"), Contains("there is no scenario or family \"nothing\"") &&
                                     Contains("scaling, torus-inside-out, torus-random"));
  CHECK_THAT(refused("torus-random --method best"),
             Contains("there is no method \"best\"") && Contains("live, eager") && Contains("phat"));
  CHECK_THAT(refused("--size 5"), Contains("--size is for one scenario"));
  CHECK_THAT(refused("torus-random --compare /nowhere/old.json"), Contains("cannot read /nowhere/old.json"));
  CHECK_THAT(refused("torus-random --against /nowhere/counts.json"), Contains("cannot read /nowhere/counts.json"));
  CHECK_THAT(refused("torus-random --out /nowhere/new.json"), Contains("cannot write /nowhere/new.json"));
  CHECK_THAT(refused("--mesh /nowhere/mesh.off"), Contains("/nowhere/mesh.off"));
  CHECK_THROWS_AS(bench("--repeat 0"), CLI::ParseError);
}

TEST_CASE("bench lists scenarios, experiments and methods", "[bench]") {
  const CommandRun run = bench("--list");
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("menger-4-random") && Contains("expected exponent 1") && Contains("method recompute"));
  CHECK_THAT(run.out, Contains("zigzag-growing") && Contains("temporal-network") && Contains("edit "));
}

TEST_CASE("bench writes a report that can be compared with the next one", "[bench]") {
  const ScratchDirectory directory;
  const std::string report = directory.path("report.json"), page = directory.path("page.html");
  REQUIRE(bench("torus-random scaling --quick --repeat 3 --out " + report + " --html " + page).status == 0);
  const auto read = read_report(report);
  REQUIRE(read);
  CHECK(read->measurements.size() == 1);
  CHECK(read->scalings.size() > 3);
  CHECK_THAT(text_of(page), Contains("<svg") && Contains("torus-random"));
  const CommandRun run = bench("torus-random --quick --repeat 3 --compare " + report);
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("1 compared"));
  CHECK(parse_report(bench("torus-random --quick --repeat 1 --json").out));
}

TEST_CASE("bench draws a report again without measuring", "[bench]") {
  const ScratchDirectory directory;
  const std::string report = directory.path("report.json"), first = directory.path("first.svg"),
                    second = directory.path("second.svg");
  REQUIRE(bench("scaling --quick --method live --out " + report + " --svg " + first).status == 0);
  const CommandRun run = bench("--from " + report + " --svg " + second);
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("exponent of the mean"));
  CHECK_THAT(text_of(first), Contains("</svg>"));
  CHECK(text_of(second) == text_of(first));
  CHECK_THROWS_AS(bench("torus-random --from " + report), CLI::ParseError);
  CHECK(bench("--from /nowhere/report.json").status == 1);
}

TEST_CASE("the gate fails when a count is larger than in the golden file, and shows which", "[bench]") {
  const ScratchDirectory directory;
  const std::string golden = directory.path("golden.json");
  REQUIRE(bench("torus --quick --counts " + golden).status == 1);  // no such scenario
  REQUIRE(bench("surfaces filtration-torus --quick --counts " + golden).status == 0);
  CHECK(bench("surfaces filtration-torus --quick --against " + golden).status == 0);

  std::vector<CountRow> rows = *read_counts(golden);
  REQUIRE(rows.size() > 9);
  rows[0].counts[0].second = rows[0].counts[0].second * 9 / 10;
  std::ofstream{golden} << to_text(rows);
  const CommandRun grown = bench("surfaces filtration-torus --quick --against " + golden);
  CHECK(grown.status == 3);
  CHECK_THAT(grown.errors, Contains("grew") && Contains(rows[0].scenario) && Contains(rows[0].counts[0].first));

  rows[0].counts[0].second *= 2;
  std::ofstream{golden} << to_text(rows);
  const CommandRun shrunk = bench("surfaces filtration-torus --quick --against " + golden);
  CHECK(shrunk.status == 0);
  CHECK_THAT(shrunk.errors, Contains("tools/bench_gate --renew"));

  rows.pop_back();
  std::ofstream{golden} << to_text(rows);
  CHECK(bench("surfaces filtration-torus --quick --against " + golden).status == 3);
}

TEST_CASE("a mesh is a scenario", "[bench]") {
  const CommandRun run = bench("--repeat 1 --mesh " + std::string{SESAME_TEST_MESHES} + "/torus.off");
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("mesh-torus"));
}

}  // namespace sesame::tools

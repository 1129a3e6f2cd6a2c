// Methods whose answers are not always right, and what the harness makes of them. This program has a list of methods of
// its own, in place of that in tools/bench/methods.cpp.
#include <algorithm>
#include <functional>

#include "tests/support/catch.hpp"
#include "tests/tools/command_run.hpp"
#include "tools/bench/constructions.hpp"
#include "tools/bench/live_method.hpp"
#include "tools/bench/method.hpp"
#include "tools/bench/recompute_method.hpp"
#include "tools/bench/runner.hpp"
#include "tools/bench/scaling.hpp"

namespace sesame::tools {
namespace {

using Catch::Matchers::Contains;
using Falsify = std::function<void(std::uint64_t step, engine::Homology&)>;

/// The engine, but for its answers.
class Liar final : public Method {
 public:
  Liar(const sparse::AnyRing& ring, Falsify falsify) : honest_{make_live_method(ring)}, falsify_{std::move(falsify)} {}

  Status apply(const ops::Operation& operation) override {
    ++step_;
    return honest_->apply(operation);
  }
  engine::Homology homology() override {
    engine::Homology homology = honest_->homology();
    falsify_(step_, homology);
    return homology;
  }
  std::uint64_t generators() override { return honest_->generators(); }
  [[nodiscard]] std::vector<std::pair<std::string, std::uint64_t>> counts() const override { return honest_->counts(); }

 private:
  std::unique_ptr<Method> honest_;
  Falsify falsify_;
  std::uint64_t step_ = 0;
};

MethodEntry lying(std::string name, std::string what, Falsify falsify) {
  return {std::move(name), std::move(what), [falsify = std::move(falsify)](const sparse::AnyRing& ring) {
            return std::make_unique<Liar>(ring, falsify);
          }};
}

void never_come_back() {
  for (const volatile bool always = true; always;) {
  }
}

constexpr RunnerOptions once{1, 60};

Measurement measured(const std::string& name, const std::string& method, const RunnerOptions& options = once) {
  const Scenario& scenario = *(*find_scenarios({name})).front();
  return measure(scenario, scenario.quick_size, method, options);
}

}  // namespace

// NOLINTNEXTLINE(misc-definitions-in-headers): it stands for the one of the library
const std::vector<MethodEntry>& methods() {
  static const std::vector<MethodEntry> entries{
      {"live", "honest", make_live_method},
      {"recompute", "honest", make_recompute_method},
      lying("silent", "answers nothing", [](std::uint64_t, engine::Homology& homology) { homology = {}; }),
      lying("late", "answers nothing before step 1000",
            [](std::uint64_t step, engine::Homology& homology) {
              homology = step < 1000 ? engine::Homology{} : homology;
            }),
      // One of those that the scaling experiments are made with.
      lying("eager", "has two groups wrong after step 17, so that the Euler characteristic stays right",
            [](std::uint64_t step, engine::Homology& homology) {
              if (step == 17) {
                homology.betti.resize(std::max<std::size_t>(homology.betti.size(), 3));
                ++homology.betti[1];
                ++homology.betti[2];
              }
            }),
      lying("torsion-free", "forgets torsion",
            [](std::uint64_t, engine::Homology& homology) { homology.torsion.assign(homology.torsion.size(), {}); }),
      lying("stuck", "does not come back from step 20", [](std::uint64_t step, engine::Homology&) {
        if (step == 20) {
          never_come_back();
        }
      })};
  return entries;
}

TEST_CASE("a method that answers nothing is found out where the object is empty in the end", "[bench]") {
  for (const std::string scenario : {"torus-backwards", "menger-backwards"}) {
    const Measurement m = measured(scenario, "silent");
    CHECK(m.verdict == Verdict::wrong);
    CHECK_THAT(m.remark, Contains("after step 1 of") && Contains("found Betti numbers"));
    CHECK_FALSE(m.has_times());
    CHECK(measured(scenario, "live").verdict == Verdict::right);
  }
}

TEST_CASE("a method that is right in the end only is found out", "[bench]") {
  for (const std::string scenario : {"genus-random", "glue-and-split", "glue-and-undo"}) {
    const Measurement m = measured(scenario, "late");
    CHECK(m.verdict == Verdict::wrong);
    CHECK_THAT(m.remark, Contains("after step 1 of"));
  }
}

TEST_CASE("a method that is wrong after a single step is found out, whatever the answers are known from", "[bench]") {
  // From counting, in closed form, from another method.
  for (const std::string scenario : {"torus-random", "torus-backwards", "graph-30", "glue-and-cut", "menger-1-random",
                                     "glued-triangles", "methods-random-triangles"}) {
    CAPTURE(scenario);
    const Measurement m = measured(scenario, "eager");
    CHECK(m.verdict == Verdict::wrong);
    CHECK_THAT(m.remark, Contains("after step 17 of") && Contains("right is"));
    CHECK(m.steps == 16);
    for (const std::string honest : {"live", "recompute"}) {
      const Measurement right = measured(scenario, honest);
      CHECK(right.verdict == Verdict::right);
      CHECK(right.checked == right.steps);
    }
  }
}

TEST_CASE("a method without torsion is found out while there is some", "[bench]") {
  const Measurement m = measured("glued-triangles", "torsion-free");  // where there is none in the end
  CHECK(m.verdict == Verdict::wrong);
  CHECK_THAT(m.remark, Contains("after step") && Contains("torsion; right is") && Contains("torsion [] ["));
}

TEST_CASE("a wrong answer on the way is exit status 3", "[bench]") {
  const auto bench = [](const std::string& arguments) { return run_command(add_bench_command, "bench " + arguments); };
  const CommandRun late = bench("torus-backwards --quick --repeat 1 --method silent");
  CHECK(late.status == 3);
  CHECK_THAT(late.errors, Contains("torus-backwards, silent: wrong: after step 1 of"));
  const CommandRun once_wrong = bench("menger-2-random --quick --repeat 1 --method live,eager");
  CHECK(once_wrong.status == 3);
  CHECK_THAT(once_wrong.errors, Contains("menger-2-random, eager: wrong: after step 17 of"));
  CHECK(bench("torus-backwards menger-2-random --quick --repeat 1 --method live").status == 0);
}

TEST_CASE("a wrong answer in a scaling experiment ends it, and is exit status 3", "[bench]") {
  for (const Experiment& experiment : experiments()) {
    CAPTURE(experiment.name);
    const Scaling scaling = run_experiment(experiment, "silent", Extent::quick, 60);
    CHECK(scaling.is_wrong);
    CHECK(scaling.points.empty());
    CHECK_THAT(scaling.remark, Contains("step 1 of round 1") && Contains("right is"));
  }
  const CommandRun run = run_command(add_bench_command, "bench scaling --quick --method eager");
  CHECK(run.status == 3);
  CHECK_THAT(run.errors, Contains("claim: generators, eager: wrong: at 1000: step 1 of round 4"));
}

TEST_CASE("a run that does not come back from a step is cut there, and what was measured stands", "[bench]") {
  const Measurement m = measured("torus-random", "stuck", {3, 0.2});
  CHECK(m.verdict == Verdict::cut);
  CHECK(m.remark == "the time was up in the middle of step 20");
  CHECK(m.steps == 19);
  CHECK(m.checked == 19);
  CHECK(m.seconds.runs == 1);
  CHECK(m.step.max > 1e5);  // the step that did not end is among the latencies
  CHECK(m.step.p50 < m.step.max);
}

}  // namespace sesame::tools

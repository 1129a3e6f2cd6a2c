#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "tests/support/catch.hpp"
#include "tools/bench/constructions.hpp"
#include "tools/bench/heap_count.hpp"
#include "tools/bench/machine.hpp"
#include "tools/bench/mesh_scenario.hpp"
#include "tools/bench/processes.hpp"
#include "tools/bench/runner.hpp"
#include "tools/bench/runs.hpp"
#include "tools/bench/scaling.hpp"

using namespace sesame;
using namespace sesame::tools;
using Catch::Matchers::Contains;

namespace {

Scenario torus_with(Answer answer) {
  return {.name = "torus",
          .family = "test",
          .what = "a test",
          .size_name = "squares",
          .size = 4,
          .quick_size = 4,
          .input = Construction{[](std::uint64_t n) { return torus(static_cast<std::uint32_t>(n)); }},
          .answer = [answer](std::uint64_t) { return answer; }};
}

Scenario filtration_with(Answer answer) {
  return {.name = "filtration",
          .family = "test",
          .what = "a test",
          .size_name = "vertices",
          .size = 4,
          .quick_size = 4,
          .input = CellFiltration{[](std::uint64_t n) { return torus_filtration(static_cast<std::uint32_t>(n)); }},
          .answer = [answer](std::uint64_t) { return answer; }};
}

std::uint64_t count_of(const Measurement& m, const std::string& name) {
  const auto found = std::ranges::find(m.counts, name, &Counts::value_type::first);
  REQUIRE(found != m.counts.end());
  return found->second;
}

constexpr RunnerOptions once{1, 60};

}  // namespace

TEST_CASE("a construction is measured with every method, and the answer is right", "[bench]") {
  const Scenario scenario = torus_with({{1, 2, 1}});
  for (const std::string& method : methods_of(scenario)) {
    CAPTURE(method);
    const Measurement m = measure(scenario, 4, method, {3, 60});
    CHECK(m.verdict == Verdict::right);
    CHECK(m.remark.empty());
    CHECK(m.steps == torus(4).size());
    CHECK(m.seconds.runs == 3);
    CHECK(m.seconds.median > 0);
    CHECK(m.step.p50 <= m.step.p99);
    CHECK(m.step.p99 <= m.step.max);
    CHECK(m.memory.heap > 1000);
    CHECK(count_of(m, "allocations") > m.steps);
    CHECK(m.timeline.back().last_step == m.steps);
  }
}

TEST_CASE("a wrong answer is a wrong run, whatever the method", "[bench]") {
  const Scenario betti = torus_with({{1, 1, 1}}), torsion = torus_with({{1, 2, 1}, {{}, {2}}});
  for (const std::string& method : methods_of(betti)) {
    CAPTURE(method);
    const Measurement m = measure(betti, 4, method, once);
    CHECK(m.verdict == Verdict::wrong);
    CHECK(m.remark == "found Betti numbers 1 2 1, torsion; right is Betti numbers 1 1 1, torsion");
    CHECK_FALSE(m.has_times());
    CHECK_THAT(measure(torsion, 4, method, once).remark, Contains("right is Betti numbers 1 2 1, torsion [] [2]"));
  }
  const Scenario filtration = filtration_with({{1, 2, 2}});
  for (const std::string& method : methods_of(filtration)) {
    CAPTURE(method);
    const Verdict verdict = measure(filtration, 4, method, once).verdict;
    CHECK((verdict == Verdict::wrong || verdict == Verdict::absent));
  }
}

TEST_CASE("a filtration is measured with every method that is there", "[bench]") {
  const Scenario scenario = filtration_with({{1, 2, 1}});
  for (const std::string& method : methods_of(scenario)) {
    CAPTURE(method);
    const Measurement m = measure(scenario, 5, method, once);
    CAPTURE(m.remark);
    CHECK((m.verdict == Verdict::right || m.verdict == Verdict::absent));
    CHECK((m.verdict == Verdict::absent) == (m.seconds.runs == 0));
    CHECK((m.steps == 150 || m.verdict == Verdict::absent));
  }
  CHECK(measure(scenario, 5, "sesame", once).verdict == Verdict::right);
  CHECK(measure(scenario, 5, "cycles", once).verdict == Verdict::right);
}

TEST_CASE("a zigzag is measured in both ways, which find the same bars", "[bench]") {
  for (const char* name : {"zigzag-growing", "zigzag-oscillating", "temporal-network"}) {
    const Scenario* scenario = find_scenarios({name})->at(0);
    CAPTURE(name);
    REQUIRE(methods_of(*scenario) == std::vector<std::string>{"online", "offline"});
    std::set<std::uint64_t> bars;
    for (const std::string& method : methods_of(*scenario)) {
      CAPTURE(method);
      const Measurement m = measure(*scenario, 2'000, method, once);
      CAPTURE(m.remark);
      CHECK(m.verdict == Verdict::right);
      CHECK(m.steps >= 2'000);
      CHECK(m.checked == m.steps);
      bars.insert(count_of(m, "bars"));
      Scenario wrong = *scenario;
      wrong.answer = [](std::uint64_t) { return Answer{{7}}; };
      CHECK_THAT(measure(wrong, 500, method, once).remark, Contains("right is Betti numbers 7"));
    }
    CHECK(bars.size() == 1);
    CHECK(*bars.begin() > 500);
  }
  CHECK(find_scenarios({"zigzag"})->size() == 3);
}

TEST_CASE("counts are the same in every run", "[bench]") {
  const Scenario scenario = torus_with({{1, 2, 1}});
  const Measurement one = measure(scenario, 6, "live", {0, 60}), other = measure(scenario, 6, "live", {0, 60});
  CHECK(one.counts == other.counts);
  CHECK(one.seconds.runs == 0);
  CHECK(count_of(measure(scenario, 7, "live", {0, 60}), "rewritten_terms") > count_of(one, "rewritten_terms"));
}

TEST_CASE("a run that takes too long is cut, and what was measured stands", "[bench]") {
  const Measurement m = measure(torus_with({{1, 2, 1}}), 30, "live", {5, 1e-5});
  CHECK(m.verdict == Verdict::cut);
  CHECK(m.steps > 0);
  CHECK(m.steps < torus(30).size());
  CHECK(m.seconds.runs == 1);
}

TEST_CASE("a method that refuses a step, and one that breaks off, end the run with a sentence", "[bench]") {
  Scenario scenario = torus_with({{}});
  scenario.input = Construction{[](std::uint64_t) { return Operations{ops::Identify{{{"no", "such"}}}}; }};
  const Measurement refused = measure(scenario, 1, "live", once);
  CHECK(refused.verdict == Verdict::refused);
  CHECK_THAT(refused.remark, Contains("no"));
  scenario.input = Construction{[](std::uint64_t) -> Operations { throw std::runtime_error("out of ideas"); }};
  const Measurement failed = measure(scenario, 1, "live", once);
  CHECK(failed.verdict == Verdict::failed);
  CHECK(failed.remark == "out of ideas");
}

TEST_CASE("generators on demand are counted", "[bench]") {
  Scenario scenario = torus_with({{1, 2, 1}});
  const auto make = [](std::uint64_t n) { return torus(static_cast<std::uint32_t>(n)); };
  scenario.input = Construction{make, nullptr, 5};
  const std::uint64_t often = count_of(measure(scenario, 4, "live", once), "terms_of_generators");
  scenario.input = Construction{make, nullptr, 20};
  CHECK(often > count_of(measure(scenario, 4, "live", once), "terms_of_generators"));
}

TEST_CASE("work in another process hands back its text, or why there is none", "[bench]") {
  CHECK(*in_child([] { return std::string(300'000, 'x'); }, 60) == std::string(300'000, 'x'));
  const auto dies = [] {
    kill(getpid(), SIGKILL);
    return std::string{};
  };
  CHECK_THAT(in_child(dies, 60).error().what, Contains("ended by signal 9"));
  CHECK(in_child([]() -> std::string { throw std::bad_alloc{}; }, 60).error().what == "ran out of memory");
  CHECK(in_child([]() -> std::string { throw std::runtime_error("no"); }, 60).error().what == "no");
  const auto sleeps = [] {
    sleep(30);
    return std::string{};
  };
  CHECK(in_child(sleeps, 1).error().what == "took longer than 1 s");
}

TEST_CASE("another program is run to its end, and found on the path", "[bench]") {
  REQUIRE(find_program("sh"));
  const std::string sh = *find_program("sh");
  CHECK(run_program({sh, "-c", "echo out; echo err >&2"}, 60)->output == "out\n");
  CHECK_THAT(run_program({sh, "-c", "exit 3"}, 60).error().what, Contains("exit status 3"));
  CHECK_FALSE(run_program({"/nowhere/program"}, 60));
  CHECK_FALSE(find_program("no-such-program-anywhere"));
}

TEST_CASE("a scratch directory is gone in the end", "[bench]") {
  std::string path;
  {
    const ScratchDirectory directory;
    path = directory.path("file");
    std::ofstream{path} << "text";
    CHECK(std::filesystem::exists(path));
  }
  CHECK_FALSE(std::filesystem::exists(path));
}

TEST_CASE("the heap is counted while it is asked to be", "[bench]") {
  begin_heap_count();
  void* const given_back = ::operator new(100'000);  // no new-expressions: a compiler may leave those out
  ::operator delete(given_back);
  void* const kept = ::operator new(300'000);
  const HeapUse use = end_heap_count();
  ::operator delete(kept);
  CHECK(use.allocations == 2);
  CHECK(use.peak_bytes >= 300'000);
  CHECK(use.peak_bytes < 390'000);
}

TEST_CASE("the machine and the build have names", "[bench]") {
  CHECK(this_machine().cores > 0);
  CHECK(this_machine().memory_bytes > 1'000'000);
  CHECK_FALSE(this_build().commit.empty());
  CHECK_THAT(this_build().compiler, Contains("g"));
  CHECK(time_stamp().size() == 20);
}

TEST_CASE("every scenario has a name of its own, an answer and a method", "[bench]") {
  std::set<std::string> names;
  for (const Scenario& scenario : scenarios()) {
    CAPTURE(scenario.name);
    CHECK(names.insert(scenario.name).second);
    CHECK_FALSE(scenario.family.empty());
    CHECK_FALSE(scenario.what.empty());
    CHECK(scenario.size > 0);
    CHECK(scenario.quick_size <= scenario.size);
    CHECK(scenario.answer(scenario.size).has_value());
    CHECK_FALSE(methods_of(scenario).empty());
  }
}

TEST_CASE("an experiment says how cost grows, and counts do not depend on the machine", "[bench]") {
  for (const Experiment& experiment : experiments()) {
    CAPTURE(experiment.name);
    const Scaling scaling = run_experiment(experiment, "live", Extent::quick, 60);
    REQUIRE(scaling.points.size() >= 2);
    CHECK(scaling.remark.empty());
    CHECK(std::ranges::is_sorted(scaling.points, {}, &ScalingPoint::x));
    REQUIRE(fit_times(scaling, &Latency::mean).has_value());
    const bool is_counted = experiment.name != "homology: products";  // the boundary of a product is none of the counts
    REQUIRE(fit_counts(scaling).has_value() == is_counted);
    // What generators cost grows with their length, and splits of the same place cost more each time; the coefficients
    // of a class are not counted.
    if (is_counted && !experiment.with_generators && experiment.name != "history of splits" &&
        experiment.name != "homology: classes") {
      CHECK(fit_counts(scaling)->exponent == Approx(experiment.expected).margin(0.05));
    }
  }
}

TEST_CASE("a mesh is assembled, and its homology is known from counting", "[bench]") {
  const std::string meshes = SESAME_TEST_MESHES;
  const auto torus_mesh = mesh_scenario(meshes + "/torus.off");
  REQUIRE(torus_mesh);
  CHECK(torus_mesh->name == "mesh-torus");
  CHECK(torus_mesh->answer(0)->betti == std::vector<std::int64_t>{1, 2, 1});
  CHECK(measure(*torus_mesh, 1, "live", once).verdict == Verdict::right);
  const auto moebius = mesh_scenario(meshes + "/moebius.off");
  REQUIRE(moebius);
  CHECK(moebius->answer(0)->betti == std::vector<std::int64_t>{1, 1, 0});
  CHECK(measure(*moebius, 1, "live", once).verdict == Verdict::right);
  const auto book = mesh_scenario(meshes + "/book.off");
  REQUIRE(book);
  CHECK_FALSE(book->answer(0).has_value());
  CHECK_FALSE(mesh_scenario(meshes + "/wrong_index.off"));
}

TEST_CASE("pairs of PHAT are compared when all of them can be read, else the run has failed", "[bench]") {
  const Scenario circle{.name = "circle",
                        .family = "test",
                        .what = "a test",
                        .size_name = "vertices",
                        .size = 3,
                        .quick_size = 3,
                        .input = CellFiltration{[](std::uint64_t) { return random_two_complex(3, 0, 1); }},
                        .answer = [](std::uint64_t) {
                          return Answer{{1, 1}};
                        }};
  // A program of that name, which writes what it finds.
  const ScratchDirectory folder;
  const std::string program = folder.path("phat"), pairs = folder.path("pairs");
  std::ofstream(program) << "#!/bin/sh\nfor out; do :; done\ntest ! -e " << pairs << " || cp " << pairs << " $out\n";
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const std::string path = std::getenv("PATH");
  setenv("PATH", (folder.path("") + ":" + path).c_str(), 1);
  const auto run = [&](const std::vector<std::uint64_t>& words, std::size_t bytes) {
    std::ofstream(pairs, std::ios::binary)
        .write(reinterpret_cast<const char*>(words.data()), static_cast<std::streamsize>(bytes));
    return FiltrationProgram(circle, 3, "phat").run(60);
  };
  const Sample absent = FiltrationProgram(circle, 3, "phat").run(60);
  const Sample right = run({2, 1, 3, 2, 4}, 40), other = run({1, 1, 3}, 24), cut = run({2, 1, 3, 2, 4}, 36),
               empty = run({}, 0);
  setenv("PATH", path.c_str(), 1);
  CHECK(right.verdict == Verdict::right);
  CHECK(other.verdict == Verdict::wrong);
  CHECK_THAT(other.remark, Contains("other bars than the 4 of sesame"));
  CHECK(cut.verdict == Verdict::failed);
  CHECK_THAT(cut.remark, Contains("ends too early"));
  CHECK(empty.verdict == Verdict::failed);
  CHECK(absent.verdict == Verdict::failed);
  CHECK_THAT(absent.remark, Contains("cannot read"));
}

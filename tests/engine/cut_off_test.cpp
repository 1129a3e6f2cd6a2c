// Memory that runs out at any allocation: the step has not happened, the log does not have it, and all goes on.
#include <flint/flint.h>
#include <gmp.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>

#include "engine/answer_hash.hpp"
#include "engine/open.hpp"
#include "engine/renewal.hpp"
#include "engine/view.hpp"
#include "tests/support/engines.hpp"
#include "tests/support/logs.hpp"
#include "tests/support/temporary_file.hpp"

using namespace sesame;
using namespace sesame::tests;

extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* __libc_calloc(std::size_t count, std::size_t size);
extern "C" void* __libc_realloc(void* memory, std::size_t size);
extern "C" void __libc_free(void* memory);

namespace {

/// Allocations that are counted, from 1, while `armed`; that of this number fails.
struct Failure {
  bool armed = false;
  std::uint64_t count = 0, failing = 0;
};
Failure failure;

bool fails() {
  if (!failure.armed || ++failure.count != failure.failing) {
    return false;
  }
  failure.armed = false;
  errno = ENOMEM;
  return true;
}

}  // namespace

extern "C" void* malloc(std::size_t size) { return fails() ? nullptr : __libc_malloc(size); }
extern "C" void* realloc(void* memory, std::size_t size) { return fails() ? nullptr : __libc_realloc(memory, size); }

namespace {

/// GMP and FLINT cannot pass an exception on: who uses them gives them a reserve, as the program does.
void keep_gmp_and_flint_out() {
  mp_set_memory_functions([](std::size_t size) { return __libc_malloc(size); },
                          [](void* memory, std::size_t, std::size_t size) { return __libc_realloc(memory, size); },
                          [](void* memory, std::size_t) { __libc_free(memory); });
  __flint_set_memory_functions([](std::size_t size) { return __libc_malloc(size); },
                               [](std::size_t count, std::size_t size) { return __libc_calloc(count, size); },
                               [](void* memory, std::size_t size) { return __libc_realloc(memory, size); },
                               [](void* memory) { __libc_free(memory); });
}

/// Every operation, questions and a coefficient beyond 2^200 too.
const std::vector<std::string> script{
    R"({"op":"simplex","name":"t","dim":2})",
    R"({"op":"simploid","name":"q","type":[1,1]})",
    R"({"op":"identify","pairs":[["q.0x0-1","q.1x0-1"],["q.0-1x0","q.0-1x1"]]})",
    R"({"op":"expect","betti":[2,2,1]})",
    R"({"op":"cone","apex":"v","over":"t"})",
    R"({"op":"suspend","apexes":["n","s"],"over":["t.0-1"]})",
    R"({"op":"complex","name":"K","cells":[{"id":"a"},{"id":"e","faces":["a","a"]},{"id":"f","faces":["a","a"]},{"id":"d","faces":["e","f","e"]},{"id":"c","faces":["f","f","f"]}]})",
    R"({"op":"class","chain":[["1606938044258990275541962092341162602522202993782792835301377","K.e"],["9223372036854775809","K.f"]]})",
    R"({"op":"degenerate","cell":"t","along":0})",
    R"({"op":"insert","simplices":[["a","b","c"],["c","d"],["d","a"]]})",
    R"({"op":"collapse","from":"d","to":"a"})",
    R"({"op":"note","text":"half way"})",
    R"({"op":"simplex","name":"x","dim":1})",
    R"({"op":"simplex","name":"y","dim":1})",
    R"({"op":"identify","pairs":[["x.0","y.0"],["x.1","y.1"]]})",
    R"({"op":"deidentify","split":[{"cell":"x.0","as":"x2","moves":[["x",1]]}]})",
    R"({"op":"product","name":"P","left":"K","right":"x"})",
    R"({"op":"simplex","name":"w","dim":1})",
    R"({"op":"product","name":"Q","left":"w","right":"w","kind":"simplicial"})",
    R"({"op":"undo","steps":1})",
    R"-({"op":"identify","pairs":[["P.(K.a|x.0)","P.(K.a|x.1)"]]})-",
    R"({"op":"undo","steps":3})",
    R"({"op":"simplex","name":"z","dim":3})",
};

/// What can be asked.
std::string answers_of(Engine& engine) {
  std::string text = std::to_string(engine::answer_hash(engine.cells(), engine.homology()));
  for (int degree = 0; degree < static_cast<int>(engine.cells().size()); ++degree) {
    for (const engine::Generator& generator : engine.generators(degree)) {
      text += " " + generator.order.to_string();
      if (!engine.classify(generator.cycle).is_cycle) {
        text += "!";
      }
    }
  }
  return text + " " + std::to_string(engine.undoable());
}

/// The answers after each step, of an engine that nothing happens to.
std::vector<std::string> right_answers() {
  Engine engine;
  std::vector<std::string> answers{answers_of(engine)};
  for (const std::string& line : script) {
    carry_out(engine, line);
    answers.push_back(answers_of(engine));
  }
  return answers;
}

/// Runs the script with one allocation that fails; whether it came to that.
bool survives(std::uint64_t failing, const std::vector<std::string>& right, bool has_file) {
  const TemporaryFile log("");
  engine::OpenOptions options;
  options.sync = engine::SyncPolicy::never();
  std::unique_ptr<Engine> engine;
  if (has_file) {
    auto opened = engine::Engine::open(log.path(), options);
    engine = std::move(opened->engine);
  } else {
    engine = std::make_unique<Engine>();
  }
  std::vector<ops::Operation> operations;
  for (const std::string& line : script) {
    operations.push_back(operation(line));
  }
  failure = {false, 0, failing};
  bool has_failed = false;
  for (std::size_t k = 0; k < operations.size(); ++k) {
    ops::Operation step = operations[k];
    bool was_cut_off = false;
    failure.armed = !has_failed;
    try {
      const auto report = engine->apply(std::move(step));
      was_cut_off = !report;
      failure.armed = false;
      if (was_cut_off) {
        REQUIRE(report.error().code == Errc::limit);
      }
    } catch (const std::bad_alloc&) {  // even the sentence had no room
      was_cut_off = true;
    }
    failure.armed = false;
    if (was_cut_off) {
      REQUIRE(!has_failed);
      has_failed = true;
      REQUIRE(answers_of(*engine) == right[k]);
      if (has_file) {
        REQUIRE(read_log(text_of(log.path())).steps.size() == k);
      }
      carry_out(*engine, operations[k]);  // now it can
    }
    failure.armed = !has_failed;
    try {
      const std::string answers = answers_of(*engine);
      failure.armed = false;
      REQUIRE(answers == right[k + 1]);
    } catch (const std::bad_alloc&) {  // a question that was cut off
      failure.armed = false;
      has_failed = true;
      REQUIRE(answers_of(*engine) == right[k + 1]);
    }
    has_failed = has_failed || failure.count >= failing;
  }
  REQUIRE(engine->first_defect() == std::nullopt);
  if (has_file) {
    REQUIRE(read_log(text_of(log.path())).steps.size() == script.size());
  }
  return failure.count >= failing;
}

}  // namespace

TEST_CASE("memory that runs out at any allocation of any operation leaves the state and the log before it",
          "[engine][log]") {
  keep_gmp_and_flint_out();
  const bool has_file = GENERATE(true, false);
  const std::vector<std::string> right = right_answers();
  std::uint64_t failing = 1;
  constexpr std::uint64_t one_by_one = 2000;
  for (; survives(failing, right, has_file); failing += failing < one_by_one ? 1 : 17) {
  }
  CHECK(failing > 1000);
}

TEST_CASE("memory that runs out while a line is read or written is an exception, and nothing else", "[engine][log]") {
  keep_gmp_and_flint_out();
  const auto read_and_written = [](const std::string& line) { return to_text(*ops::parse_operation(line)); };
  std::vector<std::string> lines = script;
  lines.push_back(R"({"op":"note","text":"quoted \"text\", \u00e9 \u0001"})");
  lines.push_back(
      R"({"op":"expect","torsion":[[2],[],["1606938044258990275541962092341162602522202993782792835301377"]]})");
  for (const std::string& line : lines) {
    CAPTURE(line);
    const std::string right = read_and_written(line);
    std::uint64_t failures = 0;
    for (bool is_cut_off = true; is_cut_off; failures += is_cut_off ? 1 : 0) {
      failure = {true, 0, failures + 1};
      is_cut_off = false;
      try {
        const std::string text = read_and_written(line);
        failure.armed = false;
        CHECK(text == right);
      } catch (const std::bad_alloc&) {
        is_cut_off = true;
      }
      failure.armed = false;
    }
    CHECK(failures > 0);
  }
}

TEST_CASE("memory that runs out while a view is taken or asked leaves engine and view as they were", "[engine][view]") {
  keep_gmp_and_flint_out();
  Engine engine;
  build(engine, {script.begin(), script.begin() + 7});
  const std::string right = answers_of(engine);
  const auto betti = engine.homology().betti;
  std::shared_ptr<const engine::View> view;
  bool is_cut_off = true;
  std::uint64_t failing = 1;
  for (; is_cut_off; ++failing) {
    view.reset();
    is_cut_off = false;
    for (int tries = 0; tries < 2; ++tries) {  // the second one must be a success
      failure = {tries == 0, 0, failing};
      try {
        if (view == nullptr) {
          view = *engine::View::of(engine);
        }
        const auto found = view->homology().betti;
        failure.armed = false;
        REQUIRE(found == betti);
        break;
      } catch (const std::bad_alloc&) {
        failure.armed = false;
        is_cut_off = true;
        REQUIRE(tries == 0);
      }
    }
    REQUIRE(answers_of(engine) == right);
  }
  CHECK(failing > 100);
}

TEST_CASE("memory that runs out while an object is renewed is no matter to the object", "[engine][renewal]") {
  keep_gmp_and_flint_out();
  static constexpr std::uint64_t undoable = 4;
  const auto new_object = [] {
    return std::make_unique<engine::LiveObject>(sparse::Integers{}, ops::Limits{}, engine::RebasePolicy{}, undoable);
  };
  int cut_off = 0, renewals = 0;
  for (std::uint64_t failing = 1; failing < 2000; failing = failing * 5 / 4 + 1) {
    CAPTURE(failing);
    std::unique_ptr<engine::LiveObject> object = new_object();
    engine::Renewal renewal(undoable, new_object);
    const auto carry_out = [&](const ops::Operation& step) {
      REQUIRE(object->apply(step, [](const ops::Operation&) { return Done{}; }));
      failure = {true, 0, failing};
      bool is_ready = false;
      try {
        is_ready = renewal.after_step(*object, step);
        failure.armed = false;
      } catch (const std::bad_alloc&) {
        failure.armed = false;
        ++cut_off;
        renewal.end(*object);
      }
      if (is_ready) {
        if (auto successor = renewal.successor(*object, object->homology())) {
          object = std::move(successor);
          ++renewals;
        }
      }
    };
    carry_out(ops::MakeSimplex{"t", 2, {}});
    for (int k = 0; k < 1800; ++k) {  // cells come and go
      const std::string name = "x" + std::to_string(k);
      carry_out(ops::MakeSimplex{name, 1, {}});
      carry_out(ops::Degenerate{name, 1, 0});
      carry_out(ops::Identify{{{"t.0", name + ".0"}}});
    }
    REQUIRE(object->cells()[0] == 3);
    REQUIRE(object->homology().betti == std::vector<std::int64_t>{1, 0, 0});
    REQUIRE(object->first_defect() == std::nullopt);
  }
  CHECK(cut_off > 20);
  CHECK(renewals > 0);
}

TEST_CASE("an observer that throws stops neither the step nor the other observers", "[engine]") {
  Engine engine;
  int called = 0;
  engine.observe([](const ops::Operation&, const engine::StepReport&) { throw std::runtime_error("observer"); });
  engine.observe([&](const ops::Operation&, const engine::StepReport&) { ++called; });
  CHECK_THROWS_WITH(engine.apply(operation(script[0])), "observer");
  CHECK(called == 1);
  CHECK(engine.homology().betti == std::vector<std::int64_t>{1, 0, 0});
  CHECK_THROWS_WITH(engine.apply(operation(script[1])), "observer");
  CHECK(engine.log().size() == 2);
}

TEST_CASE("a visitor of generators that throws ends the visit, and may ask meanwhile", "[engine]") {
  Engine engine;
  build(engine, {script[0], script[1]});
  int visited = 0;
  const auto visit = [&](const engine::Generator&) -> bool {
    ++visited;
    CHECK(engine.homology().betti[0] == 2);
    throw std::runtime_error("visitor");
  };
  CHECK_THROWS_WITH(engine.visit_generators(0, UINT64_MAX, visit), "visitor");
  CHECK(visited == 1);
  CHECK(engine.generators(0).size() == 2);
  build(engine, {script[2]});
  CHECK(engine.first_defect() == std::nullopt);
}

TEST_CASE("an engine without any log that is cut off takes no further call", "[engine]") {
  Engine engine(sparse::Integers{}, {}, {}, engine::HistoryPolicy{UINT64_MAX, false});
  build(engine, {script[0]});
  engine.give_up();
  CHECK_THROWS(engine.homology());
}

// What the engine says of its work, by spdlog.
#include "engine/log.hpp"

#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <sstream>

#include "tests/support/engines.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

/// Takes down what a logger says from a level on, or from its own when none is given.
class Listener {
 public:
  explicit Listener(spdlog::logger& logger, std::optional<spdlog::level::level_enum> level = {})
      : logger_{logger}, sinks_{logger.sinks()}, level_{logger.level()} {
    auto sink = std::make_shared<spdlog::sinks::ostream_sink_st>(text_);
    sink->set_pattern("%n %l: %v");
    logger.sinks() = {sink};
    logger.set_level(level.value_or(level_));
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener() {
    logger_.sinks() = sinks_;
    logger_.set_level(level_);
  }
  [[nodiscard]] std::string text() const { return text_.str(); }
  [[nodiscard]] bool has(const std::string& part) const { return text().find(part) != std::string::npos; }

 private:
  std::ostringstream text_;
  spdlog::logger& logger_;
  std::vector<spdlog::sink_ptr> sinks_;
  spdlog::level::level_enum level_;
};

const auto glue = operation(R"({"op":"identify","pairs":[["t.0","t.1"]]})");
const auto tear = operation(R"({"op":"deidentify","split":[{"cell":"t.0","as":"c","moves":[["t",0]]}]})");
const auto wrong = operation(R"({"op":"identify","pairs":[["t","t.0"]]})");

/// A loop that is torn, with a step that is refused.
void edit(Engine& engine) {
  carry_out(engine, R"({"op":"simplex","name":"t","dim":1})");
  carry_out(engine, glue);
  REQUIRE_FALSE(engine.apply(wrong));
  carry_out(engine, tear);
  (void)engine.homology();
}

constexpr engine::RebasePolicy after_each_split{1, UINT64_MAX, 0, 0, UINT64_MAX / 4096, 0, UINT64_MAX, 0};

}  // namespace

TEST_CASE("an engine says nothing unless it is asked to", "[engine][log]") {
  const Listener steps(engine::step_log()), rebases(engine::rebase_log()), refusals(engine::refusal_log());
  Engine engine({}, {}, after_each_split);
  edit(engine);
  CHECK(engine.rebases() == 1);
  CHECK(steps.text() + rebases.text() + refusals.text() == "");
}

TEST_CASE("a step says at the level debug what it did and what it took", "[engine][log]") {
  const Listener steps(engine::step_log(), spdlog::level::debug);
  Engine engine;
  edit(engine);
  CHECK(steps.text().starts_with("sesame.engine debug: step 1 (simplex): cells made: 3; bodies made: 1; took "));
  CHECK(steps.has("\nsesame.engine debug: step 2 (identify): cells merged or squashed: 1; took "));
  CHECK(steps.has("\nsesame.engine debug: step 3 (deidentify): cells made: 1; incidences moved: 1; took "));
  CHECK(steps.has(" terms read, "));
}

TEST_CASE("a refused step says at the level debug why", "[engine][log]") {
  const Listener refusals(engine::refusal_log(), spdlog::level::debug);
  Engine engine;
  edit(engine);
  CHECK(refusals.text() ==
        "sesame.refusals debug: step 3 (identify) did not happen: \"t\" is a simplex of dimension 1 and \"t.0\" a "
        "vertex: only cells of the same type can be identified\n");
}

TEST_CASE("an equivalence that is begun afresh says at the level info why", "[engine][log][rebase]") {
  const Listener rebases(engine::rebase_log(), spdlog::level::info);
  const bool by_cost = GENERATE(false, true);
  Engine engine({}, {},
                by_cost ? engine::RebasePolicy{UINT64_MAX / 2, 1, 0, 0, 0, 0, UINT64_MAX, 0} : after_each_split);
  edit(engine);
  carry_out(engine, R"({"op":"identify","pairs":[["t.0","c"]]})");
  CHECK(rebases.text().starts_with("sesame.rebase info: begun afresh from "));
  CHECK(rebases.has(by_cost ? "would have read more than 0 terms; took "
                            : "1 cells were split since the last time; took "));
}

TEST_CASE("torsion and bases that are computed anew say so at the level debug", "[engine][log]") {
  const Listener steps(engine::step_log(), spdlog::level::debug);
  Engine engine;
  build(engine, {R"({"op":"simplex","name":"a","dim":2})", R"({"op":"simplex","name":"b","dim":2})"});
  (void)engine.homology();
  CHECK_FALSE(steps.has("torsion was"));
  build(engine, {R"({"op":"identify","pairs":[["a.0-1","b.0-1"],["a.1-2","b.0-2"],["a.0-2","b.1-2"]]})"});
  CHECK(engine.homology().torsion[1] == std::vector<Integer>{2});
  CHECK(steps.has("torsion was brought up to date with 1 columns in 1 degrees; took "));
  (void)engine.generators(1);
  CHECK(steps.has("H_1 was computed with its basis: 0 free classes"));
}

#include "engine/engine.hpp"

#include "tests/support/engines.hpp"
#include "tests/support/random_steps.hpp"

using namespace sesame;
using namespace sesame::tests;
using Catch::Contains;

TEST_CASE("an observer sees each step that was applied, with the sizes of its sequence", "[engine][stream]") {
  const unsigned seed = GENERATE(range(0U, 4U));
  CAPTURE(seed);
  Engine engine;
  std::vector<engine::StepReport> reports;
  std::vector<std::string> texts;
  engine.observe([&](const ops::Operation& op, const engine::StepReport& report) {
    reports.push_back(report);
    texts.push_back(ops::to_text(op));
  });
  RandomSteps random(seed);
  for (int k = 0; k < 40; ++k) {
    const ops::Moment before = ops::now(engine.structure());
    const ops::Operation op = random.next(engine.structure());
    carry_out(engine, op);
    REQUIRE(reports.size() == static_cast<std::size_t>(k) + 1);
    const engine::StepReport& report = reports.back();
    CHECK(texts.back() == ops::to_text(op));
    CHECK(report.step == static_cast<std::uint64_t>(k) + 1);
    CHECK(report.op == ops::keyword(op));
    CHECK(report.before == before);
    CHECK(report.after == ops::now(engine.structure()));
    CHECK(report.steps_undone == 0);
    CHECK_FALSE(report.answer);
    const auto step = only(engine.sequences(engine.undoable(), Integers{}));
    REQUIRE(step.has_value() == report.sequence.has_value());
    if (step) {
      CHECK(report.sequence->direction == step->direction);
      CHECK(report.sequence->c0 == step->sequence.c0.total_size());
      CHECK(report.sequence->c1 == step->sequence.c1.total_size());
      CHECK(report.sequence->c2 == step->sequence.c2.total_size());
    }
  }
}

TEST_CASE("a report says what a step was, and an undo what it took back", "[engine]") {
  using ops::EventKind;
  using ops::StepKind;
  const std::vector<std::pair<std::string, StepKind>> steps{
      {R"({"op":"simplex","name":"t","dim":2})", StepKind::addition},
      {R"({"op":"simplex","name":"s","dim":2})", StepKind::addition},
      {R"({"op":"identify","pairs":[["t.0-1","s.0-1"]]})", StepKind::removal},
      {R"({"op":"note","text":""})", StepKind::nothing},
      {R"({"op":"deidentify","split":[{"cell":"t.0-1","as":"x","moves":[["s",2]]}]})", StepKind::split},
      {R"({"op":"degenerate","cell":"t.0-2","along":0})", StepKind::removal},
      {R"({"op":"class","chain":[[1,"x"]]})", StepKind::nothing},
      {R"({"op":"insert","simplex":["a","b"]})", StepKind::addition},
      {R"({"op":"insert","simplex":["a","b"],"exist_ok":true})", StepKind::nothing},
      {R"({"op":"collapse","from":"a","to":"b"})", StepKind::removal},
      {R"({"op":"simplex","name":"e","dim":1})", StepKind::addition},
      {R"({"op":"product","name":"P","left":"e","right":"e"})", StepKind::product},
      {R"({"op":"cone","apex":"v"})", StepKind::lazy_cone}};
  Engine engine(Integers{}, ops::Limits{.cells_of_explicit_cone = 0});
  std::vector<engine::StepReport> reports;
  engine.observe([&](const ops::Operation&, const engine::StepReport& report) { reports.push_back(report); });
  for (const auto& [line, kind] : steps) {
    CAPTURE(line);
    build(engine, {line});
    CHECK(reports.back().kind == kind);
    CHECK(reports.back().sequence.has_value() == (kind != StepKind::nothing && kind != StepKind::product));
    CHECK((reports.back().events[EventKind::removal] > 0) == (kind == StepKind::removal));
    CHECK((reports.back().events[EventKind::copy] > 0) == (kind == StepKind::split));
  }
  for (std::size_t k = steps.size(); k-- > 0;) {
    const ops::EventCounts made = reports[k].events;
    REQUIRE(engine.undo());
    for (const EventKind kind :
         {EventKind::cell, EventKind::copy, EventKind::removal, EventKind::move, EventKind::family, EventKind::name,
          EventKind::body, EventKind::union_of_bodies, EventKind::simplicial}) {
      CHECK(reports.back().events[kind] == made[kind]);
    }
  }
  CHECK(engine.structure().journal().end() == 0);
}

TEST_CASE("undo, questions and notes are steps that observers see too", "[engine]") {
  Engine engine;
  std::vector<engine::StepReport> reports;
  int second = 0;
  engine.observe([&](const ops::Operation&, const engine::StepReport& report) { reports.push_back(report); });
  engine.observe([&](const ops::Operation&, const engine::StepReport&) { ++second; });
  build(engine, {R"({"op":"simplex","name":"t","dim":1})", R"({"op":"note","text":"here"})",
                 R"({"op":"class","chain":[[1,"t"]]})", R"({"op":"expect","betti":[1]})", R"({"op":"undo","steps":3})",
                 R"({"op":"identify","pairs":[["t.0","t.0"]]})"});
  REQUIRE(reports.size() == 6);
  CHECK(second == 6);
  CHECK(reports[0].sequence->c2 == 3);
  CHECK_FALSE(reports[1].sequence);
  CHECK(reports[2].answer.has_value());
  CHECK_FALSE(reports[2].answer->is_cycle);
  CHECK(reports[4].steps_undone == 3);
  CHECK(reports[4].op == "undo");
  CHECK(reports[5].step == 6);
  CHECK_FALSE(reports[5].sequence);
  CHECK(engine.undoable() == 2);
  CHECK(engine.log().size() == 6);
}

TEST_CASE("an observer sees what was undone, from and to", "[engine]") {
  Engine engine;
  engine::StepReport last;
  engine.observe([&](const ops::Operation&, const engine::StepReport& report) { last = report; });
  build(engine, {R"({"op":"simplex","name":"t","dim":2})", R"({"op":"identify","pairs":[["t.0","t.1"]]})"});
  REQUIRE(engine.undo(2));
  CHECK(last.before == ops::Moment{7, 1});
  CHECK(last.after == ops::Moment{0, 0});
}

TEST_CASE("an expectation holds with trailing zeros left out or added, and says what differs", "[engine]") {
  Engine engine;
  build(engine, {R"({"op":"simploid","name":"q","type":[1,1]})",
                 R"({"op":"identify","pairs":[["q.0-1x0","q.0-1x1"],["q.0x0-1","q.1x0-1"]]})"});
  build(engine, {R"({"op":"expect","betti":[1,2,1],"torsion":[],"euler":0,"cells":[1,2,1]})",
                 R"({"op":"expect","betti":[1,2,1,0,0],"torsion":[[],[],[],[]]})", R"({"op":"expect"})"});
  const auto what = [&](const std::string& line) {
    const auto result = engine.apply(operation(line));
    REQUIRE_FALSE(result);
    CHECK(result.error().code == Errc::expectation);
    return result.error().what;
  };
  CHECK_THAT(what(R"({"op":"expect","betti":[1,2]})"), Contains("betti should be [1,2] but is [1,2,1]"));
  CHECK_THAT(what(R"({"op":"expect","torsion":[[],[2]]})"), Contains("torsion should be [[],[2]]"));
  CHECK_THAT(what(R"({"op":"expect","betti":[1,2,1],"euler":1,"cells":[1,2,2]})"),
             Contains("cells should be [1,2,2] but is [1,2,1]") && Contains("euler should be 1 but is 0") &&
                 !Contains("betti"));
}

TEST_CASE("several bodies add up, and merge when they are glued", "[engine]") {
  Engine engine;
  build(engine, {R"({"op":"simplex","name":"a","dim":2})", R"({"op":"simplex","name":"b","dim":2})"});
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{group(2)});
  CHECK(engine.structure().bodies().current().size() == 2);
  carry_out(engine, R"({"op":"identify","pairs":[["a.0","b.0"],["a.1","b.1"],["a.2","b.2"]]})");
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{group(1), group(2)});
  CHECK(engine.structure().bodies().current().size() == 1);
  carry_out(engine, R"({"op":"identify","pairs":[["a","b"]]})");
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{group(1)});
}

TEST_CASE("the moment before a step and its sequence can be asked for every step that is not undone", "[engine]") {
  Engine engine;
  build(engine,
        {R"({"op":"simplex","name":"a","dim":1})", R"({"op":"note","text":""})",
         R"({"op":"simplex","name":"b","dim":1})", R"({"op":"undo"})", R"({"op":"identify","pairs":[["a.0","a.1"]]})"});
  REQUIRE(engine.undoable() == 3);
  CHECK(engine.before_step(1) == ops::Moment{0, 0});
  CHECK(engine.before_step(3) == ops::Moment{3, 0});
  CHECK(only(engine.sequences(1, Z2{}))->direction == ops::Direction::backward);
  CHECK(engine.sequences(2, Z2{}).empty());
  CHECK(only(engine.sequences(3, Z2{}))->direction == ops::Direction::forward);
  CHECK_THROWS_AS(engine.before_step(0), sparse::ContractViolation);
  CHECK_THROWS_AS(engine.before_step(4), sparse::ContractViolation);
}

TEST_CASE("a complex without cells is a body and a step that can be undone", "[engine]") {
  Engine engine;
  const std::string empty = dump(engine);
  const auto report = carry_out(engine, R"({"op":"complex","name":"K","cells":[]})");
  CHECK_FALSE(report.sequence);
  CHECK(engine.structure().lookup_body("K").has_value());
  CHECK(engine.first_defect().value_or("") == "");
  const auto refused = engine.apply(operation(R"({"op":"simplex","name":"K","dim":0})"));
  CHECK_FALSE(refused);
  build(engine, {R"({"op":"cone","apex":"v","over":"K"})"});
  CHECK(engine.cells().size() == 1);
  REQUIRE(engine.undo(2));
  CHECK(dump(engine) == empty);
  CHECK(engine.apply(operation(R"({"op":"simplex","name":"K","dim":0})")));
}

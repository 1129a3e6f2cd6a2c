// State is the fold of the log: undo, determinism, refusals.
#include "tests/support/engines.hpp"
#include "tests/support/random_steps.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

/// What a fresh engine says after these operations.
std::string dump_of(const AnyRing& ring, const std::vector<ops::Operation>& operations) {
  Engine engine(ring, {}, taking_splits_in);
  for (const ops::Operation& op : operations) {
    carry_out(engine, op);
  }
  return dump(engine);
}

/// Reads this and that, so that results are memoised at all moments.
void look_around(Engine& engine, Random& random) {
  const auto cells = current_cells(engine.structure());
  if (cells.empty()) {
    return;
  }
  switch (random.in(0, 4)) {
    case 0:
      (void)engine.homology();
      break;
    case 1:
      (void)engine.generators(random.in(0, 2));
      break;
    case 2: {
      const ops::CellId c = cells[static_cast<std::size_t>(random.in(0, static_cast<int>(cells.size()) - 1))];
      carry_out(engine, ops::AskClass{{{Integer{random.in(-3, 3)}, std::string{engine.structure().name(c)}}}});
      break;
    }
    case 3:
      for (const ops::CellId c : cells) {
        (void)engine.maps().apply_F({engine.structure().dimension(c), {{1, c}}});
      }
      break;
    default:
      break;
  }
}

}  // namespace

TEST_CASE("after undo the engine is a fresh one that was given what is left", "[engine][stream]") {
  const unsigned seed = GENERATE(range(0U, 30U));
  const std::string ring = GENERATE("Z", "Z/2", "Z/3");
  CAPTURE(seed, ring);
  Engine engine(ring_named(ring), {}, taking_splits_in);
  RandomSteps random(seed, {.most_cells = 35, .simploids = true, .cones = true});
  std::vector<ops::Operation> left;
  for (int k = 0; k < 40; ++k) {
    look_around(engine, random.random());
    while (left.size() < engine.undoable()) {
      left.push_back(engine.log().back());  // look_around may ask a question, which is a step
    }
    if (!left.empty() && random.random().one_in(5)) {
      const int most = static_cast<int>(left.size());
      const auto steps =
          static_cast<std::size_t>(random.random().one_in(4) ? most : random.random().in(1, std::min(most, 4)));
      CAPTURE(k, steps);
      REQUIRE(engine.undo(steps));
      left.resize(left.size() - steps);
      REQUIRE(engine.undoable() == left.size());
      REQUIRE(dump(engine) == dump_of(ring_named(ring), left));
      continue;
    }
    const ops::Operation op = random.next(engine.structure());
    carry_out(engine, op);
    left.push_back(op);
  }
  REQUIRE(dump(engine) == dump_of(ring_named(ring), left));
  REQUIRE(engine.undo(engine.undoable()));
  CHECK(dump(engine) == dump_of(ring_named(ring), {}));
  for (const ops::Operation& op : left) {
    carry_out(engine, op);
  }
  CHECK(dump(engine) == dump_of(ring_named(ring), left));
}

TEST_CASE("undoing one step at a time passes through every earlier state", "[engine][stream]") {
  const unsigned seed = GENERATE(range(30U, 50U));
  CAPTURE(seed);
  Engine engine({}, {}, taking_splits_in);
  RandomSteps random(seed, {.most_cells = 35, .simploids = true, .cones = true});
  std::vector<std::string> states;
  for (int k = 0; k < 25; ++k) {
    states.push_back(dump(engine));
    carry_out(engine, random.next(engine.structure()));
  }
  while (!states.empty()) {
    REQUIRE(engine.undo());
    REQUIRE(dump(engine) == states.back());
    states.pop_back();
  }
  CHECK(engine.undoable() == 0);
  CHECK_FALSE(engine.undo());
}

TEST_CASE("laws hold after undo and in what is built upon it", "[engine][stream]") {
  const unsigned seed = GENERATE(range(50U, 64U));
  CAPTURE(seed);
  Engine engine({}, {}, taking_splits_in);
  RandomSteps random(seed, {.most_cells = 35, .simploids = true, .cones = true});
  for (int round = 0; round < 5; ++round) {
    for (int k = 0; k < 8; ++k) {
      carry_out(engine, random.next(engine.structure()));
    }
    (void)engine.generators(1);
    REQUIRE(engine.undo(static_cast<std::uint64_t>(random.random().in(1, 8))));
    REQUIRE(engine.first_defect().value_or("") == "");
  }
}

TEST_CASE("the same log gives the same answers to the byte, and replays itself", "[engine][stream]") {
  const unsigned seed = GENERATE(range(70U, 74U));
  CAPTURE(seed);
  Engine engine({}, {}, taking_splits_in);
  RandomSteps random(seed, {.most_cells = 40, .simploids = true, .cones = true});
  for (int k = 0; k < 30; ++k) {
    look_around(engine, random.random());
    if (engine.undoable() > 3 && random.random().one_in(6)) {
      REQUIRE(engine.undo(2));
    } else {
      carry_out(engine, random.next(engine.structure()));
    }
  }
  // Through text, undos included.
  Engine again({}, {}, taking_splits_in);
  for (const ops::Operation& op : engine.log()) {
    carry_out(again, ops::to_text(op));
  }
  CHECK(dump(again) == dump(engine));
  CHECK(again.undoable() == engine.undoable());
  CHECK(again.log().size() == engine.log().size());
}

TEST_CASE("a refused operation leaves everything as it was", "[engine]") {
  const unsigned seed = GENERATE(range(80U, 83U));
  CAPTURE(seed);
  Engine engine{sparse::Integers{}, ops::Limits{.cells_of_standard = 63, .cells_per_step = 200, .cells = 4000}};
  RandomSteps random(seed, {.most_cells = 40, .simploids = true, .cones = true});
  int observed = 0;
  engine.observe([&](const ops::Operation&, const engine::StepReport&) { ++observed; });
  build(engine, {R"({"op":"simplex","name":"t","dim":2})", R"({"op":"simploid","name":"q","type":[1,1]})"});
  for (int k = 0; k < 12; ++k) {
    carry_out(engine, random.next(engine.structure()));
  }
  const std::string before = dump(engine);
  const std::size_t steps = engine.log().size();
  const int seen = observed;
  const std::vector<std::pair<std::string, Errc>> wrong{
      {R"({"op":"simplex","name":"t","dim":1})", Errc::bad_input},
      {R"({"op":"simplex","name":"a b","dim":1})", Errc::bad_input},
      {R"({"op":"simplex","name":"large","dim":9})", Errc::refused},
      {R"({"op":"simploid","name":"t.0","type":[1]})", Errc::bad_input},
      {R"({"op":"complex","name":"K","cells":[{"id":"e","faces":["a","b"]}]})", Errc::unknown_name},
      {R"({"op":"complex","name":"K","cells":[{"id":"a"},{"id":"b"},{"id":"e","faces":["a","b"]},{"id":"f","faces":["e","e","e"]}]})",
       Errc::bad_input},
      {R"({"op":"cone","apex":"t"})", Errc::bad_input},
      {R"({"op":"cone","apex":"w","over":"nobody"})", Errc::unknown_name},
      {R"({"op":"cone","apex":"w","over":["t","q","nobody"]})", Errc::unknown_name},
      {R"({"op":"degenerate","cell":"t.0","along":0})", Errc::bad_input},
      {R"({"op":"degenerate","cell":"q","along":[3,0]})", Errc::bad_input},
      {R"({"op":"degenerate","cell":"nobody","along":0})", Errc::unknown_name},
      {R"({"op":"deidentify","split":[{"cell":"t.0","as":"q","moves":[]}]})", Errc::bad_input},
      {R"({"op":"deidentify","split":[{"cell":"t","as":"t2","moves":[["t",0]]}]})", Errc::bad_input},
      {R"({"op":"deidentify","split":[{"cell":"t.0","as":"z","moves":[["nobody",0]]}]})", Errc::unknown_name},
      {R"({"op":"product","name":"t","left":"t","right":"t"})", Errc::bad_input},
      {R"({"op":"product","name":"P","left":"t","right":"nobody"})", Errc::unknown_name},
      {R"({"op":"product","name":"P","left":"q","right":"q","kind":"simplicial"})", Errc::refused},
      {R"({"op":"identify","pairs":[["t.0","t.1"],["t","nobody"]]})", Errc::unknown_name},
      {R"({"op":"identify","pairs":[["t.0","t.1"],["t","q"]]})", Errc::refused},
      {R"({"op":"expect","euler":-77})", Errc::expectation},
      {R"({"op":"expect","betti":[0]})", Errc::expectation},
      {R"({"op":"class","chain":[[1,"nobody"]]})", Errc::unknown_name},
      {R"({"op":"class","chain":[[1,"t.0"],[1,"t"]]})", Errc::bad_input},
      {R"({"op":"undo","steps":1000})", Errc::refused}};
  for (const auto& [line, code] : wrong) {
    CAPTURE(line);
    const auto result = engine.apply(operation(line));
    REQUIRE_FALSE(result);
    CHECK(result.error().code == code);
    CHECK_FALSE(result.error().what.empty());
    CHECK(dump(engine) == before);
    CHECK(engine.log().size() == steps);
    CHECK(engine.undoable() == steps);
    CHECK(observed == seen);
  }
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("with a limit the last steps can be undone, as without one", "[engine][stream]") {
  const unsigned seed = GENERATE(range(100U, 120U));
  const auto limit = GENERATE(as<std::uint64_t>{}, 0, 1, 7);
  const bool takes_splits_in = GENERATE(false, true);
  CAPTURE(seed, limit, takes_splits_in);
  const engine::RebasePolicy rebases = takes_splits_in ? taking_splits_in : engine::RebasePolicy{};
  Engine engine({}, {}, rebases);
  Engine limited({}, {}, rebases, {limit, false});
  RandomSteps random(seed, {.most_cells = 30, .simploids = true, .cones = true, .degeneracies = true, .splits = true});
  std::uint64_t undoable = 0;
  for (int k = 0; k < 40; ++k) {
    REQUIRE(limited.undoable() == undoable);
    if (undoable > 0 && random.random().one_in(4)) {
      const auto steps = static_cast<std::uint64_t>(random.random().in(1, static_cast<int>(undoable)));
      REQUIRE(engine.undo(steps));
      REQUIRE(limited.undo(steps));
      undoable -= steps;
    } else {
      const ops::Operation op = random.next(engine.structure());
      const engine::StepReport report = carry_out(limited, op);
      CHECK(report.step == carry_out(engine, op).step);
      undoable = std::min(limit, undoable + 1);
    }
    REQUIRE(dump(limited) == dump(engine));
    REQUIRE(limited.log().size() == 1);
  }
  const auto beyond = limited.undo(undoable + 1);
  REQUIRE_FALSE(beyond);
  CHECK_THAT(beyond.error().what,
             Catch::Matchers::StartsWith("cannot undo " + std::to_string(undoable + 1) + " steps: only " +
                                         std::to_string(undoable) + " can be undone"));
}

TEST_CASE("there is no barcode of a history that is not kept", "[engine]") {
  Engine engine(ring_named("Z/2"), {}, {}, {2, true});
  build(engine, {R"({"op":"simplex","name":"t","dim":2})", R"({"op":"simplex","name":"u","dim":0})"});
  CHECK(engine.barcode());
  carry_out(engine, R"({"op":"simplex","name":"w","dim":0})");
  const auto barcode = engine.barcode();
  REQUIRE_FALSE(barcode);
  CHECK(barcode.error().code == Errc::refused);
  CHECK(barcode.error().what == "there is no barcode: only the last 2 steps are kept");
  CHECK(engine.log().size() == 3);
}

TEST_CASE("a plan is worked out without doing it", "[engine]") {
  Engine engine({}, {}, taking_splits_in);
  build(engine, {R"({"op":"simplex","name":"t","dim":2})", R"({"op":"simplex","name":"u","dim":2})"});
  const std::string before = dump(engine);
  const auto plan = engine.plan(operation(R"({"op":"identify","pairs":[["t.0-1","u.0-1"]]})"));
  REQUIRE(plan);
  CHECK(plan->merges.size() == 3);
  CHECK(plan->cells.empty());
  CHECK_FALSE(engine.plan(operation(R"({"op":"identify","pairs":[["t","u.0"]]})")));
  CHECK(engine.plan(operation(R"({"op":"note","text":""})"))->changes_nothing());
  CHECK(dump(engine) == before);
  CHECK(engine.log().size() == 2);
}

TEST_CASE("torsion classes that were glued and taken apart can be glued again", "[engine]") {
  const auto [one, other] = GENERATE(values<std::pair<int, int>>({{4, 6}, {6, 4}, {6, 10}, {12, 18}, {9, 4}, {8, 8}}));
  CAPTURE(one, other);
  Engine engine({}, {}, taking_splits_in);
  carry_out(engine, multiples_of_a_loop("a", one, true));
  carry_out(engine, multiples_of_a_loop("b", other, true));
  const std::string apart = dump(engine);
  const std::string glue = R"({"op":"identify","pairs":[["a.e1","b.e1"]]})";
  carry_out(engine, glue);
  const std::string together = dump(engine);
  CHECK(live_groups(engine) == groups_from_scratch(engine.structure(), Integers{}));
  for (int k = 0; k < 3; ++k) {
    REQUIRE(engine.undo());
    REQUIRE(dump(engine) == apart);
    carry_out(engine, glue);
    REQUIRE(dump(engine) == together);
    REQUIRE(engine.first_defect().value_or("") == "");
  }
}

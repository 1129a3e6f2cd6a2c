// The barcode of a history in which cells are split and taken away, beside ranks of all composed relations.
#include "engine/history_zigzag.hpp"

#include <string>
#include <vector>

#include "tests/support/engines.hpp"
#include "tests/support/plain_history.hpp"
#include "tests/support/random_steps.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

std::vector<engine::Bar> bars_of(Engine& engine) {
  const auto barcode = engine.barcode();
  REQUIRE(barcode);
  return barcode->bars;
}

}  // namespace

TEST_CASE("the barcode of a history with splits and removals is that of its maps, by ranks over all intervals",
          "[engine][zigzag]") {
  const std::int64_t p = GENERATE(2, 3);
  const unsigned seed = GENERATE(range(0U, 40U));
  CAPTURE(p, seed);
  Engine engine(ring_named(p == 2 ? "Z/2" : "Z/3"));
  StreamShape shape = everything(25);
  shape.products = shape.pyramids = false;
  shape.replacements = false;  // they are two maps: see replacement_test.cpp
  RandomSteps random(seed, shape);
  PlainHistory plain(p);
  for (int k = 0; k < 24; ++k) {
    const ops::Operation op = random.next(engine.structure());
    CAPTURE(k, ops::to_text(op));
    plain.add(engine, carry_out(engine, op));
    if (random.random().one_in(8)) {
      const std::uint64_t steps = std::min<std::uint64_t>(engine.undoable(), 2);
      REQUIRE(engine.undo(steps));
      plain.take_back(steps);
    }
  }
  CHECK(bars_of(engine) == plain.bars());
}

TEST_CASE("a circle that is cut and glued again is two bars, and a split point one of each", "[engine][zigzag]") {
  Engine engine(ring_named("Q"));
  build(engine, {R"({"op":"simplex","name":"e","dim":1})", R"({"op":"identify","pairs":[["e.0","e.1"]]})",
                 R"({"op":"note","text":"a circle"})",
                 R"({"op":"deidentify","split":[{"cell":"e.0","as":"w","moves":[["e",0]]}]})",
                 R"({"op":"identify","pairs":[["e.0","w"]]})", R"({"op":"remove","cells":["e"]})"});
  // The loop lives until the cut, and another one until the edge goes.
  CHECK(bars_of(engine) == std::vector<engine::Bar>{{0, engine::Time{1U}, engine::never},
                                                    {1, engine::Time{2U}, engine::Time{4U}},
                                                    {1, engine::Time{5U}, engine::Time{6U}}});
}

TEST_CASE("without splits and removals the two ways to a barcode agree", "[engine][zigzag]") {
  const unsigned seed = GENERATE(range(0U, 20U));
  CAPTURE(seed);
  Engine engine(ring_named("Z/3"));
  StreamShape shape = everything(40);
  shape.products = shape.pyramids = shape.splits = shape.removals = false;
  RandomSteps random(seed, shape);
  std::vector<engine::NumberedStep> steps;
  for (std::uint64_t k = 1; k <= 40; ++k) {
    steps.push_back({k, random.next(engine.structure())});
    carry_out(engine, steps.back().operation);
  }
  const auto zigzag = engine::barcode_of_history(engine.ring(), {}, {}, steps);
  REQUIRE(zigzag);
  CHECK(zigzag->bars == bars_of(engine));
}

TEST_CASE("what has no barcode says why, and at which step", "[engine][zigzag]") {
  Engine engine(ring_named("Z/2"));
  build(engine, {R"({"op":"simplex","name":"e","dim":1})", R"({"op":"simplex","name":"f","dim":1})",
                 R"({"op":"remove","cells":["f"]})", R"({"op":"product","name":"P","left":"e","right":"f"})"});
  const auto barcode = engine.barcode();
  REQUIRE(!barcode);
  CHECK(barcode.error().what == "there is no barcode: step 4 is a product, which consumes the bodies before it");
  Engine integral(ring_named("Z"));
  build(integral,
        std::vector<std::string>{R"({"op":"simplex","name":"e","dim":1})", R"({"op":"remove","cells":["e"]})"});
  CHECK(integral.barcode().error().what == "barcodes need a field: compute over Q or Z/p, such as Z/2, instead of Z");
}

#include "tools/bench/surface_count.hpp"

#include "tests/support/catch.hpp"
#include "tools/bench/answer_check.hpp"
#include "tools/bench/constructions.hpp"
#include "tools/bench/mesh_scenario.hpp"

using namespace sesame;
using namespace sesame::tools;

namespace {

/// Compares with the engine after every step; the number of steps at which there was an answer.
std::size_t steps_in_agreement(const Operations& operations) {
  engine::Engine engine;
  SurfaceCount count;
  std::size_t answers = 0;
  for (std::size_t step = 0; step < operations.size(); ++step) {
    CAPTURE(step, ops::to_text(operations[step]));
    REQUIRE(engine.apply(operations[step]));
    count.take(operations[step]);
    if (const auto answer = count.answer()) {
      ++answers;
      REQUIRE(check(engine.homology(), *answer));
    }
  }
  return answers;
}

/// A triangle, which is t0, t1, ...
ops::Operation triangle(int number) { return ops::MakeSimplex{"t" + std::to_string(number), 2, {}}; }

}  // namespace

TEST_CASE("surfaces are counted to what the engine finds, at every step of every assembly", "[bench]") {
  const Order order = GENERATE(Order::inside_out, Order::random, Order::tiles_first);
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Assembly assembly{order, seed};
    for (const Operations& operations :
         {torus(1, assembly), torus(2, assembly), torus(5, assembly), klein_bottle(3, assembly),
          klein_bottle(5, assembly), surface_of_genus(2, 4, assembly)}) {
      CHECK(steps_in_agreement(operations) == operations.size());
    }
  }
  const Operations backwards = replayed_backwards(klein_bottle(4, {order, 4}));
  CHECK(steps_in_agreement(backwards) == backwards.size());
  CHECK(steps_in_agreement(separate_klein_bottles(4)) == 8);
}

TEST_CASE("pieces that touch in corners are counted with the loops that this makes", "[bench]") {
  // Two triangles with two corners in common; a third one pinched at two of its own; a closed surface pinched as well.
  Operations operations{triangle(0),
                        triangle(1),
                        ops::Identify{{{"t0.0", "t1.0"}, {"t0.1", "t1.2"}}},
                        triangle(2),
                        ops::Identify{{{"t2.0", "t2.1"}}},
                        ops::Identify{{{"t2.2", "t0.0"}}}};
  CHECK(steps_in_agreement(operations) == operations.size());
  operations = torus(3);
  operations.emplace_back(ops::Identify{{{"t0.0x0", "t4.1x1"}}});
  CHECK(steps_in_agreement(operations) == operations.size());
}

TEST_CASE("what is no surface is not counted", "[bench]") {
  // A book of three triangles with one side in common.
  Operations book{triangle(0), triangle(1), triangle(2), ops::Identify{{{"t0.0-1", "t1.0-1"}}},
                  ops::Identify{{{"t0.0-1", "t2.0-1"}}}};
  CHECK(steps_in_agreement(book) == 4);
  book.emplace_back(ops::Undo{1});
  CHECK(steps_in_agreement(book) == 4);
  CHECK(steps_in_agreement({triangle(0), ops::MakeSimploid{"q", {1, 1}, {}}}) == 1);
  CHECK(steps_in_agreement({ops::MakeSimplex{"e", 1, {}}}) == 0);
  CHECK(steps_in_agreement({triangle(0), ops::MakeCone{"v", {}, {}}}) == 1);
  CHECK(steps_in_agreement({triangle(0), ops::Undo{1}, triangle(0)}) == 2);
}

TEST_CASE("meshes of surfaces are followed triangle by triangle, others as far as they are surfaces", "[bench]") {
  for (const std::string name : {"torus.off", "moebius.off", "bow_tie.off", "book.off"}) {
    CAPTURE(name);
    const auto scenario = mesh_scenario(std::string{SESAME_TEST_MESHES} + "/" + name);
    REQUIRE(scenario);
    const auto& construction = std::get<Construction>(scenario->input);
    const Operations operations = construction.make(scenario->size);
    CHECK((steps_in_agreement(operations) == operations.size()) == (name != "book.off"));
    const AnswerAfter follow = construction.follow(scenario->size);
    CHECK(follow(0)->betti == std::vector<std::int64_t>{1, 0, 0});
  }
}

// Coefficients and orders far beyond 64 bits: exact, in every answer.
#include <random>

#include "tests/support/engines.hpp"
#include "tests/support/loops.hpp"
#include "tests/support/random_steps.hpp"

using namespace sesame;
using namespace sesame::tests;

namespace {

Integer power(const Integer& base, int exponent) {
  Integer result = 1;
  for (; exponent > 0; --exponent) {
    result *= base;
  }
  return result;
}

/// Asks for the class of a loop times a number.
ClassAnswer class_of(Engine& engine, const Integer& coefficient, const std::string& cell) {
  return carry_out(engine, ops::AskClass{{{coefficient, cell}}}).answer.value();
}

void check_order_of_loop(Engine& engine, const std::string& loop, const Integer& order) {
  const auto generators = engine.generators(1);
  REQUIRE(generators.size() == 1);
  CHECK(generators[0].order == order);
  CHECK(equal_to(engine.maps().boundary(generators[0].bounding), order, generators[0].cycle, engine.ring()));
  const ClassAnswer own = class_of(engine, 1, loop);
  CHECK_FALSE(own.is_zero);
  CHECK(sparse::gcd(own.coefficients.at(0).numerator(), order) == Integer{1});  // it generates
  CHECK_FALSE(class_of(engine, order - Integer{1}, loop).is_zero);
  const ClassAnswer multiple = class_of(engine, order, loop);
  REQUIRE(multiple.is_zero);
  const ops::CellId cell = engine.structure().find(*engine.structure().lookup(loop));
  CHECK(engine.maps().boundary(*multiple.bounds) == CellChain{1, {{order, cell}}});
}

}  // namespace

TEST_CASE("a telescope of fifty maps of degree 3 has torsion of order 3^50, listed either way", "[engine]") {
  const bool is_reversed = GENERATE(false, true);
  Loops telescope("K");
  telescope.add_loop("a");
  telescope.kill(telescope.tower("a", 3, 50));
  Engine engine;
  carry_out(engine, is_reversed ? telescope.reversed() : telescope.take());
  const Integer order = power(3, 50);
  CHECK(order.is_large());
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{group(1), group(0, {order})});
  CHECK(live_groups(engine) == groups_from_scratch(engine.structure(), Integers{}));
  check_order_of_loop(engine, "K.a", order);
  CHECK(engine.first_defect().value_or("") == "");
  // The loop at the far end is 3^50 a, hence 0; the one before is not.
  carry_out(engine, R"({"op":"expect","torsion":[[],["717897987691852588770249"]]})");
}

TEST_CASE("two relations of large coefficients leave their greatest common divisor", "[engine]") {
  Loops telescope("K");
  telescope.add_loop("a");
  telescope.kill(telescope.tower("a", 6, 40));
  telescope.kill(telescope.tower("a", 10, 35));
  Engine engine;
  carry_out(engine, telescope.take());
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{group(1), group(0, {power(2, 35)}), group(1)});
  CHECK(groups_from_scratch(engine.structure(), Integers{})[1] == group(0, {power(2, 35)}));
  check_order_of_loop(engine, "K.a", power(2, 35));
  CHECK(engine.first_defect().value_or("") == "");
}

TEST_CASE("large coprime relations kill the class, with a chain that proves it", "[engine]") {
  Loops telescope("K");
  telescope.add_loop("a");
  telescope.kill(telescope.tower("a", 3, 45));
  telescope.kill(telescope.tower("a", 2, 70));
  Engine engine;
  carry_out(engine, telescope.take());
  // As many triangles as loops, none of which is left over.
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{group(1), group(0), group(1)});
  const ClassAnswer answer = class_of(engine, 1, "K.a");
  REQUIRE(answer.is_zero);
  CHECK(engine.maps().boundary(*answer.bounds) == CellChain{1, {{1, *engine.structure().lookup("K.a")}}});
  CHECK(engine.first_defect().value_or("") == "");
  bool has_large = false;
  const engine::Generator generator = engine.generators(2).at(0);
  for (const auto& term : generator.cycle.terms) {
    has_large = has_large || term.coefficient.numerator().is_large();
  }
  CHECK(has_large);
}

TEST_CASE("gluing telescopes level by level multiplies the orders, and undo divides them again", "[engine]") {
  Engine engine;
  Engine modular(ring_named("Z/2147483647"));
  const auto both = [&](const ops::Operation& op) {
    carry_out(engine, op);
    carry_out(modular, op);
  };
  constexpr int levels = 30;
  both(multiples_of_a_loop("m0", 6, true));  // e6 = 0
  std::vector<std::string> states;
  std::vector<std::uint64_t> steps;
  for (int k = 1; k <= levels; ++k) {
    CAPTURE(k);
    states.push_back(answers(engine));
    steps.push_back(engine.undoable());
    const std::string name = "m" + std::to_string(k);
    both(multiples_of_a_loop(name, 6, false));
    both(ops::Identify{{{name + ".e6", "m" + std::to_string(k - 1) + ".e1"}}});
    const Integer order = power(6, k + 1);
    REQUIRE(live_groups(engine) == std::vector<AbelianGroup>{group(1), group(0, {order})});
    REQUIRE(live_groups(modular) == std::vector<AbelianGroup>{group(1)});
    if (k % 10 == 0) {
      check_order_of_loop(engine, name + ".e1", order);
      REQUIRE(engine.first_defect().value_or("") == "");
      REQUIRE(groups_from_scratch(engine.structure(), Integers{})[1] == group(0, {order}));
    }
  }
  for (; !states.empty(); states.pop_back(), steps.pop_back()) {
    REQUIRE(engine.undo(engine.undoable() - steps.back()));
    REQUIRE(answers(engine) == states.back());
  }
}

TEST_CASE("one suspension further the same orders appear one dimension higher", "[engine]") {
  Loops telescope("K");
  telescope.add_loop("a");
  telescope.kill(telescope.tower("a", 7, 30));
  Engine engine;
  const ops::MakeComplex complex = telescope.take();
  carry_out(engine, complex);
  std::vector<std::string> all;
  for (const auto& cell : complex.cells) {
    all.push_back("K." + cell.id);
  }
  carry_out(engine, ops::MakeCone{"north", all, {}});
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{group(1)});
  carry_out(engine, ops::MakeCone{"south", all, {}});
  CHECK(live_groups(engine) == std::vector<AbelianGroup>{group(1), group(0), group(0, {power(7, 30)})});
  const auto generator = engine.generators(2).at(0);
  CHECK(equal_to(engine.maps().boundary(generator.bounding), power(7, 30), generator.cycle, engine.ring()));
}

TEST_CASE("chains with coefficients of hundreds of digits are classified exactly", "[engine]") {
  Engine engine;
  carry_out(engine, multiples_of_a_loop("m", 5, true));
  carry_out(engine, R"({"op":"simplex","name":"e","dim":1})");
  carry_out(engine, R"({"op":"identify","pairs":[["e.0","e.1"],["e.0","m.v"]]})");
  const Integer large = power(10, 300);
  const ClassAnswer free = class_of(engine, large + Integer{7}, "e");
  CHECK(free.coefficients.back() == large + Integer{7});
  CHECK(class_of(engine, large, "m.e1").is_zero);
  CHECK(class_of(engine, -large - Integer{3}, "m.e1").coefficients == class_of(engine, 2, "m.e1").coefficients);
}

TEST_CASE("a dense core of random relations stays small in its numbers and right in its answers", "[engine]") {
  // One vertex, loops, and squares with random loops as faces: over Z the columns of such a core fill up, and
  // eliminating whatever has a unit would give them coefficients of thousands of digits.
  const unsigned seed = GENERATE(range(1U, 6U));
  CAPTURE(seed);
  constexpr int loops = 70;
  std::mt19937 random(seed);
  ops::MakeComplex complex{"K", {{"v", {}, {}, {}}}};
  for (int k = 0; k < loops; ++k) {
    complex.cells.push_back({"e" + std::to_string(k), {}, {"v", "v"}, {}});
  }
  for (int k = 0; k < loops; ++k) {
    ops::MakeComplex::Cell square{"q" + std::to_string(k), ops::CellType{1, 1}, {}, {}};
    for (int face = 0; face < 4; ++face) {
      square.faces.push_back("e" + std::to_string(random() % loops));
    }
    complex.cells.push_back(square);
  }
  Engine engine;
  carry_out(engine, complex);
  CHECK(live_groups(engine) == groups_from_scratch(engine.structure(), sparse::Integers{}));
  for (int degree = 0; degree <= 2; ++degree) {
    for (const engine::Generator& generator : engine.generators(degree)) {
      CHECK(engine.maps().boundary(generator.cycle).terms.empty());
    }
  }
  // The same with every step taken back and done again, and a relation more.
  carry_out(engine, ops::Identify{{{"K.e0", "K.e1"}, {"K.q2", "K.q3"}}});
  const auto glued = live_groups(engine);
  CHECK(glued == groups_from_scratch(engine.structure(), sparse::Integers{}));
  carry_out(engine, ops::Undo{1});
  CHECK(live_groups(engine) == groups_from_scratch(engine.structure(), sparse::Integers{}));
  carry_out(engine, ops::Identify{{{"K.e0", "K.e1"}, {"K.q2", "K.q3"}}});
  CHECK(live_groups(engine) == glued);
  CHECK(engine.first_defect() == std::nullopt);
}

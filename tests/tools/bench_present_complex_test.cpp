#include "tools/bench/present_complex.hpp"

#include "reductions/defect.hpp"
#include "tests/support/random_steps.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::tests;

TEST_CASE("a face that went to a copy counts with the sign that it has there", "[bench]") {
  Workshop shop;
  shop.build({R"({"op":"simplex","name":"e","dim":1})", R"({"op":"simplex","name":"t","dim":2})",
              R"({"op":"identify","pairs":[["t.1-0","e"]]})",
              R"({"op":"deidentify","split":[{"cell":"e","as":"c","moves":[["t",2]]}]})"});
  const ops::Structure& structure = shop.structure();
  const ops::CellId t = structure.lookup("t").value();
  REQUIRE(structure.faces().sign(t, 2) == -structure.faces().sign_as_created(t, 2));
  tools::PresentComplex complex(structure);
  CHECK_FALSE(reductions::first_defect(complex.matrices(sparse::Integers{})));
}

TEST_CASE("the boundaries of the present object make a complex after every step", "[bench][stream]") {
  const unsigned seed = GENERATE(range(0U, 30U));
  CAPTURE(seed);
  RandomSteps random(seed, everything_and_maps(60));
  Workshop shop;
  tools::PresentComplex complex(shop.structure());
  for (int step = 0; step < 40; ++step) {
    const ops::Operation operation = random.next(shop.structure());
    if (std::holds_alternative<ops::Undo>(operation) || !shop.apply(operation)) {
      continue;
    }
    CAPTURE(step, ops::to_text(operation));
    REQUIRE_FALSE(reductions::first_defect(complex.matrices(sparse::Integers{})));
  }
}

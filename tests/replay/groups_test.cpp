#include "replay/script/groups.hpp"

#include "tests/replay/replay_support.hpp"
#include "tests/support/structures.hpp"

using namespace sesame;
using namespace sesame::tests;
using replay::chain_text;
using sparse::Integer;

namespace {

/// An engine with a tetrahedron "t".
void build(engine::Engine& engine) { REQUIRE(engine.apply(operation(R"({"op":"simplex","name":"t","dim":3})"))); }

engine::CellChain chain(const engine::Engine& engine, const std::vector<std::pair<Integer, std::string>>& terms) {
  const auto made = engine.chain(terms);
  REQUIRE(made);
  return *made;
}

}  // namespace

TEST_CASE("groups are named by rank and invariant factors, spaces by dimension", "[replay]") {
  const engine::Homology homology{{1, 2, 0, 0, 1, 0}, {{}, {2}, {}, {3}, {2, 2, 4}, {}}, {}, {}};
  CHECK(replay::group_names(homology, sparse::Integers{}) ==
        std::vector<std::string>{"Z", "Z^2 + Z/2", "0", "Z/3", "Z + (Z/2)^2 + Z/4", "0"});
  CHECK(replay::homology_line(homology, sparse::Integers{}) ==
        "H0 = Z, H1 = Z^2 + Z/2, H2 = 0, H3 = Z/3, H4 = Z + (Z/2)^2 + Z/4, H5 = 0");

  const auto ring = sparse::parse_ring("Z/7");
  REQUIRE(ring);
  const engine::Homology over_a_field{{1, 3, 0}, {{}, {}, {}}, {}, {}};
  CHECK(replay::homology_line(over_a_field, *ring) == "H0 = Z/7, H1 = (Z/7)^3, H2 = 0");
}

TEST_CASE("the homology of nothing is nothing yet", "[replay]") {
  CHECK(replay::group_names({}, sparse::Integers{}).empty());
  CHECK(replay::homology_line({}, sparse::Integers{}) == "nothing yet");
}

TEST_CASE("a chain is written with signs, and with coefficients other than one", "[replay]") {
  engine::Engine engine;
  build(engine);
  const auto text = [&](const std::vector<std::pair<Integer, std::string>>& terms) {
    return chain_text(chain(engine, terms), engine.structure());
  };
  CHECK(text({}) == "0");
  CHECK(text({{1, "t.0-1"}}) == "t.0-1");
  CHECK(text({{-1, "t.0-1"}}) == "-t.0-1");
  CHECK(text({{-2, "t.0-1"}}) == "-2 t.0-1");
  CHECK(text({{1, "t.0-1"}, {-2, "t.0-2"}, {3, "t.1-2"}, {-1, "t.2-3"}}) == "t.0-1 - 2 t.0-2 + 3 t.1-2 - t.2-3");
  const auto huge = Integer::parse("-100000000000000000000");
  REQUIRE(huge);
  CHECK(text({{1, "t.0"}, {*huge, "t.1"}}) == "t.0 - 100000000000000000000 t.1");
}

TEST_CASE("a chain that is too long is cut, and its terms are counted", "[replay]") {
  engine::Engine engine;
  build(engine);
  const engine::CellChain edges = chain(engine, {{1, "t.0-1"}, {-1, "t.0-2"}, {2, "t.1-2"}});
  CHECK(chain_text(edges, engine.structure(), 3) == "t.0-1 - t.0-2 + 2 t.1-2");
  CHECK(chain_text(edges, engine.structure(), 4) == chain_text(edges, engine.structure()));
  CHECK(chain_text(edges, engine.structure(), 2) == "t.0-1 - t.0-2 + ... (3 terms in all)");
  CHECK(chain_text(edges, engine.structure(), 1) == "t.0-1 + ... (3 terms in all)");
}

TEST_CASE("a merged cell is written by its canonical name", "[replay]") {
  engine::Engine engine;
  build(engine);
  REQUIRE(engine.apply(operation(R"({"op":"identify","pairs":[["t.3","t.1"]]})")));
  CHECK(chain_text(chain(engine, {{1, "t.3"}}), engine.structure()) == "t.1");
}

#include "engine/left/left_maps.hpp"

#include "tests/support/left_side.hpp"

using namespace sesame;
using namespace sesame::tests;
using sparse::Integers;

namespace {

template <sparse::Ring R>
void stream(const R& ring, unsigned seed, const StreamShape& shape) {
  Workshop shop;
  LeftSide<R> side(ring, engine::Window{shop.structure()});
  RandomSteps steps(seed, shape);
  struct State {
    StructureMark structure;
    typename LeftSide<R>::Mark side;
    std::string text;
  };
  std::vector<State> states;
  for (int step = 0; step < 40; ++step) {
    if (!states.empty() && steps.random().one_in(6)) {  // back to any state before
      const auto back = static_cast<std::size_t>(steps.random().in(0, static_cast<int>(states.size()) - 1));
      shop.go_back_to(states[back].structure);
      side.go_back_to(states[back].side);
      REQUIRE(first_difference(dump(side), states[back].text) == "");
      states.resize(back);
    }
    states.push_back({mark_of(shop.structure()), side.mark(), dump(side)});
    const ops::Operation op = steps.next(shop.structure());
    CAPTURE(seed, step, to_text(op));
    REQUIRE(shop.apply(op));
    side.follow();
    REQUIRE(broken_left_law(side) == "");
  }
}

}  // namespace

TEST_CASE("the left reduction of an edge glued to a loop is the one worked out by hand", "[engine][left]") {
  Workshop shop;
  const Integers z;
  LeftSide<Integers> side(z, engine::Window{shop.structure()});
  shop.build({R"({"op": "simplex", "name": "e", "dim": 1})"});
  side.follow();
  shop.build({R"({"op": "identify", "pairs": [["e.0", "e.1"]]})"});
  side.follow();
  // Generators: [e.0] = 0, [e.1] = 1, [e] = 2, d [e] = [e.1] - [e.0]; and <x> = 3 for the vertex x that went.
  REQUIRE(side.big().size() == 4);
  CHECK(side.big().counts() == std::vector<std::uint32_t>{2, 2});
  const auto vertex = shop.cell("e.0");
  const auto edge = shop.cell("e");
  const bool first_stays = shop.structure().is_current(*shop.structure().lookup("e.0"));
  const GeneratorId stays = first_stays ? GeneratorId{0} : GeneratorId{1};
  const GeneratorId went = first_stays ? GeneratorId{1} : GeneratorId{0};
  const Terms<Integers, GeneratorId> difference = sum_of<GeneratorId>(z, {{{stays, 1}}, {{went, -1}}});
  CHECK(side.boundary_of_generator(2) == Terms<Integers, GeneratorId>{{0, -1}, {1, 1}});
  CHECK(side.boundary_of_generator(3) == difference);
  CHECK(side.f(0) == Terms<Integers, CellId>{{vertex, 1}});
  CHECK(side.f(1) == Terms<Integers, CellId>{{vertex, 1}});
  CHECK(side.f(2) == Terms<Integers, CellId>{{edge, 1}});
  CHECK(side.f(3).empty());
  CHECK(side.g(vertex) == Terms<Integers, GeneratorId>{{stays, 1}});
  CHECK(side.g(edge) ==
        Terms<Integers, GeneratorId>{{2, 1}, {3, first_stays ? 1 : -1}});  // the boundary of the loop is 0
  CHECK(side.h(went) == Terms<Integers, GeneratorId>{{3, -1}});
  CHECK(side.h(stays).empty());
  CHECK(side.h(2).empty());
  CHECK(side.h(3).empty());
}

TEST_CASE("f, g and h are a reduction after every step, as they were after undo", "[engine][left]") {
  const auto seed = GENERATE(range(0U, 6U));
  const StreamShape shape{.most_cells = 24, .degeneracies = seed % 2 == 0, .splits = true};
  stream(Integers{}, seed, shape);
  stream(*sparse::Zp::make(3), seed, shape);
}

TEST_CASE("f, g and K tie the object to the big complex after every step when cells are lazy", "[engine][left]") {
  StreamShape shape = everything_and_maps(20);
  stream(Integers{}, GENERATE(range(10U, 16U)), shape);
}

TEST_CASE("the left reduction of what follows a moment has the cells of then as generators", "[engine][left]") {
  const auto seed = GENERATE(range(20U, 24U));
  Workshop shop;
  RandomSteps steps(seed, {.most_cells = 24, .degeneracies = true, .splits = true});
  for (int step = 0; step < 15; ++step) {
    REQUIRE(shop.apply(steps.next(shop.structure())));
  }
  std::vector<ops::CellId> cells = current_cells(shop.structure());
  std::stable_sort(cells.begin(), cells.end(), [&](ops::CellId a, ops::CellId b) {
    return shop.structure().dimension(a) < shop.structure().dimension(b);
  });
  LeftSide<Integers> side(Integers{}, engine::Window{shop.structure(), cells});
  REQUIRE(side.big().size() == cells.size());
  for (GeneratorId x = 0; x < cells.size(); ++x) {  // the identity
    CHECK(side.f(x) == Terms<Integers, CellId>{{cells[x], 1}});
    CHECK(side.g(cells[x]) == Terms<Integers, GeneratorId>{{x, 1}});
    CHECK(side.h(x).empty());
  }
  for (int step = 0; step < 15; ++step) {
    REQUIRE(shop.apply(steps.next(shop.structure())));
    side.follow();
    REQUIRE(broken_left_law(side) == "");
  }
}

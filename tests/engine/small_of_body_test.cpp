#include "engine/left/small_of_body.hpp"

#include "tests/support/left_side.hpp"

using namespace sesame;
using namespace sesame::tests;
using engine::Symbol;
using sparse::Integers;

namespace {

/// What the small generators say themselves.
template <sparse::Ring R>
std::vector<Symbol> small_of_body_by_all(ops::BodyId body, LeftSide<R>& side) {
  std::vector<Symbol> symbols;
  side.rewriter().for_each_small([&](Symbol x) {
    if (side.big().body_of(side.rewriter().generator_in(x)) == body) {
      symbols.push_back(x);
    }
  });
  std::sort(symbols.begin(), symbols.end());
  return symbols;
}

template <sparse::Ring R>
void check(Workshop& shop, LeftSide<R>& side) {
  for (const ops::BodyId body : shop.structure().bodies().current()) {
    REQUIRE(engine::small_of_body(body, shop.structure(), side.big(), side.rewriter()) ==
            small_of_body_by_all(body, side));
  }
}

}  // namespace

TEST_CASE("the small generators of a body are found from its nodes as among all", "[engine][left]") {
  const auto seed = GENERATE(range(0U, 12U));
  const bool begins_late = GENERATE(false, true);
  Workshop shop;
  for (int k = 0; k < 60; ++k) {  // so that there are more small generators than nodes of most bodies
    REQUIRE(shop.apply(ops::MakeSimplex{"point" + std::to_string(k), 0, {}}));
  }
  RandomSteps steps(seed, everything_and_maps(90));
  for (int step = 0; begins_late && step < 10; ++step) {
    REQUIRE(shop.apply(steps.next(shop.structure())));
  }
  const auto window = [&] {
    if (!begins_late) {
      return engine::Window{shop.structure()};
    }
    std::vector<CellId> cells = current_cells(shop.structure());
    std::stable_sort(cells.begin(), cells.end(), [&](CellId a, CellId b) {
      return shop.structure().dimension(a) < shop.structure().dimension(b);
    });
    return engine::Window{shop.structure(), std::move(cells)};
  };
  LeftSide<Integers> side(Integers{}, window());
  struct State {
    StructureMark structure;
    LeftSide<Integers>::Mark side;
  };
  std::vector<State> states;
  for (int step = 0; step < 25; ++step) {
    if (!states.empty() && steps.random().one_in(6)) {
      const auto back = static_cast<std::size_t>(steps.random().in(0, static_cast<int>(states.size()) - 1));
      shop.go_back_to(states[back].structure);
      side.go_back_to(states[back].side);
      states.resize(back);
      check(shop, side);
    }
    states.push_back({mark_of(shop.structure()), side.mark()});
    const ops::Operation op = steps.next(shop.structure());
    CAPTURE(seed, step, to_text(op));
    REQUIRE(shop.apply(op));
    side.follow();
    check(shop, side);
  }
}

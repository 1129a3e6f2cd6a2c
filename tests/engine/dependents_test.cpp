#include "engine/right/dependents.hpp"

#include <algorithm>

#include "tests/support/catch.hpp"
#include "tests/support/random_reduction.hpp"

using namespace sesame;
using namespace sesame::tests;
using engine::Dependents;
using engine::GeneratorId;
using engine::Symbol;

namespace {

constexpr std::uint64_t any_number = UINT64_MAX;

bool contains(const std::vector<Symbol>& symbols, Symbol x) {
  return std::binary_search(symbols.begin(), symbols.end(), x);
}

/// The first small symbol whose lift has a generator without the index knowing it; empty when there is none.
template <Ring R>
std::string missed(RandomReduction<R>& live) {
  live.dependents.catch_up();
  std::map<Symbol, ChainOfB<R>> lifts;
  for (const Symbol x : live.small()) {
    lifts[x] = live.g({{x, live.ring.one()}});
  }
  for (GeneratorId c = 0; c < live.b.size(); ++c) {
    const auto found = live.dependents.lifts_with(std::vector<GeneratorId>{c}, any_number);
    for (const auto& [x, lift] : lifts) {
      if (sparse::find_term<R>(lift, c) != nullptr && !contains(*found, x)) {
        return "generator " + std::to_string(c) + " in the lift of " + std::to_string(x);
      }
    }
  }
  return "";
}

}  // namespace

TEMPLATE_TEST_CASE("Dependents: no lift that has a generator is missed, through undo", "[engine]", Integers, Z2, Zp) {
  using R = TestType;
  RandomReduction<R> live{test_ring<R>(), GENERATE(range(50U, 65U))};
  const GrowingComplex<R> all = in_random_order(live.random, random_complex(live.ring, live.random).complex);
  struct Mark {
    typename engine::Rules<R>::Mark rules;
    GeneratorId generators;
  };
  std::vector<Mark> marks;
  for (int step = 0; step < 60; ++step) {
    const GeneratorId next = live.b.size();
    if (all.size() == 0) {
      break;
    }
    if (next == all.size() || (!marks.empty() && live.random.one_in(4))) {
      const auto back = static_cast<std::size_t>(live.random.in(0, static_cast<int>(marks.size()) - 1));
      live.rules.undo(marks[back].rules);
      live.dependents.undo(marks[back].rules);
      live.b.boundary.truncate(marks[back].generators, marks[back].generators);
      live.b.degrees.resize(marks[back].generators);
      marks.resize(back);
    } else {
      marks.push_back({live.rules.mark(), next});
      live.append(all.degrees[next], all.boundary.column(next));
      if (live.random.one_in(4)) {
        live.change_any_basis(all.degrees[next]);
      }
    }
    if (live.random.one_in(3)) {
      REQUIRE(missed(live).empty());
    }
  }
  CHECK(missed(live).empty());
}

TEST_CASE("Dependents: what has nothing to do with a generator is not found, nor all when that is too much",
          "[engine]") {
  // Two circles of three edges each: vertices 0 to 2 and 6 to 8, edges 3 to 5 and 9 to 11.
  RandomReduction<Z2> live{Z2{}, 0};
  for (const Index base : {0U, 6U}) {
    for (int k = 0; k < 3; ++k) {
      live.append(0, {});
    }
    for (const auto& [one, other] : {std::pair{0U, 1U}, {1U, 2U}, {0U, 2U}}) {
      live.append(1, {{GeneratorId{base + one}, 1}, {GeneratorId{base + other}, 1}});
    }
  }
  CHECK_FALSE(live.dependents.is_kept());
  live.dependents.catch_up();
  CHECK(live.dependents.is_kept());
  CHECK(live.dependents.size_of_backlog() == 0);
  const auto found = [&](GeneratorId generator, std::uint64_t most) {
    return live.dependents.lifts_with(std::vector<GeneratorId>{generator}, most);
  };
  CHECK(found(3, any_number) == std::vector<Symbol>{5});
  CHECK(found(4, any_number) == std::vector<Symbol>{5});
  CHECK(found(5, any_number) == std::vector<Symbol>{5});
  CHECK(found(10, any_number) == std::vector<Symbol>{11});
  CHECK(found(3, 1) == std::nullopt);
}

TEST_CASE("Dependents: what boundaries and values have gained is gone along, once there is an index", "[engine]") {
  // A vertex 0 and a loop 1; then a copy 2 of the vertex, which the loop's end goes to: d 1 = 2 - 0.
  RandomReduction<Integers> live{Integers{}, 0};
  live.append(0, {});
  live.append(1, {});
  live.dependents.gain_boundary(0, 1);  // nobody keeps an index yet
  live.dependents.catch_up();
  CHECK(live.dependents.lifts_with(std::vector<GeneratorId>{1}, any_number) == std::vector<Symbol>{1});
  live.append(0, {});
  live.append(1, {{0, -1}, {2, 1}});  // 3: eliminates one of the two
  live.append(1, {});                 // 4: whose boundary gains 2 - 0
  live.dependents.catch_up();
  CHECK(live.dependents.lifts_with(std::vector<GeneratorId>{3}, any_number) == std::vector<Symbol>{});
  live.dependents.gain_boundary(0, 4);
  live.dependents.gain_boundary(2, 4);
  CHECK(live.dependents.lifts_with(std::vector<GeneratorId>{3}, any_number) == std::vector<Symbol>{4});
}

#include "engine/mark_stack.hpp"

#include <deque>
#include <random>

#include "tests/support/catch.hpp"

using namespace sesame;

TEST_CASE("a stack of marks is a plain list of them, from both ends", "[engine]") {
  std::mt19937_64 random(GENERATE(range(0U, 8U)));
  const auto draw = [&](unsigned below) { return static_cast<unsigned>(random() % below); };
  using Stack = engine::MarkStack<16>;
  Stack stack;
  std::deque<Stack::Mark> plain;
  Stack::Mark mark{};
  for (int step = 0; step < 2000; ++step) {
    const unsigned what = draw(10);
    if (what < 6 || plain.empty()) {
      for (std::uint64_t& number : mark) {
        switch (draw(12)) {
          case 0:
            number += draw(1000);
            break;
          case 1:
            number = random();  // larger or smaller, whatever it was
            break;
          case 2:
            number -= draw(3);
            break;
          default:
            break;
        }
      }
      stack.push(mark);
      plain.push_back(mark);
    } else if (what < 9) {
      REQUIRE(stack.pop() == plain.back());
      plain.pop_back();
    } else {
      stack.forget_oldest();
      plain.pop_front();
    }
    REQUIRE(stack.empty() == plain.empty());
    if (!plain.empty()) {
      REQUIRE(stack.oldest() == plain.front());
      REQUIRE(stack.last() == plain.back());
    }
    if (step % 50 == 0) {
      std::deque<Stack::Mark> all;
      stack.for_each([&](const Stack::Mark& each) { all.push_back(each); });
      REQUIRE(all == plain);
    }
  }
}

TEST_CASE("marks that differ little take few bytes, and none when they are gone", "[engine]") {
  engine::MarkStack<16> stack;
  engine::MarkStack<16>::Mark mark{};
  for (std::uint64_t k = 0; k < 1000; ++k) {
    mark[0] = 1'000'000 + 7 * k;
    mark[3] = 3 * k;
    stack.push(mark);
  }
  CHECK(stack.bytes() <= 1000 * 5 + 4);
  for (int k = 0; k < 500; ++k) {
    (void)stack.pop();
    stack.forget_oldest();
  }
  CHECK(stack.empty());
  CHECK(stack.bytes() == 0);
}

#include "engine/step_numbers.hpp"

#include <random>

#include "tests/support/catch.hpp"

using namespace sesame;

TEST_CASE("step numbers are those of a plain list, through undo and forgetting", "[engine]") {
  std::mt19937 random(GENERATE(range(0U, 8U)));
  engine::StepNumbers numbers;
  std::deque<std::uint64_t> plain;
  std::uint64_t next = 1;
  for (int step = 0; step < 2000; ++step) {
    const auto what = random() % 10;
    if (what < 7) {
      next += random() % 8 == 0 ? 1 + random() % 3 : 0;
      numbers.push_back(next);
      plain.push_back(next++);
    } else if (what < 9) {
      const std::uint64_t count = random() % (std::min<std::uint64_t>(plain.size(), 9) + 1);
      numbers.pop_back(count);
      plain.resize(plain.size() - count);
    } else if (!plain.empty()) {
      numbers.pop_front();
      plain.pop_front();
    }
    REQUIRE(numbers.all() == std::vector<std::uint64_t>(plain.begin(), plain.end()));
  }
}

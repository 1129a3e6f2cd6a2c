#include "sparse/descending_sum.hpp"

#include <map>

#include "tests/sparse/dense.hpp"
#include "tests/support/catch.hpp"

using namespace sesame::sparse;

TEMPLATE_TEST_CASE("DescendingSum: terms leave it as the last ones of a map do", "[sparse][twin]", Integers, Rationals,
                   Z2, Zp) {
  const auto ring = sample_ring<TestType>();
  Random random{GENERATE(range(0u, 10u))};
  DescendingSum<TestType> sum{ring};
  std::map<Index, std::int64_t> twin;
  // What is added may lie above what has been taken, beyond the largest index so far, and in words of any level.
  const auto add = [&] {
    const Index limit = std::vector<Index>{10, 64, 65, 4096, 300'000}[below(random, 5)];
    const Index at = below(random, limit);
    const std::int64_t factor = std::int64_t{below(random, 5)} - 2, coefficient = std::int64_t{below(random, 7)} - 3;
    sum.add_product(at, ring.from(factor), ring.from(coefficient));
    twin[at] += factor * coefficient;
  };
  const auto take_from_twin = [&]() -> std::optional<Term<TestType>> {
    while (!twin.empty()) {
      const auto [index, value] = *twin.rbegin();
      twin.erase(index);
      if (!ring.is_zero(ring.from(value))) {
        return Term<TestType>{index, ring.from(value)};
      }
    }
    return std::nullopt;
  };
  for (int step = 0; step < 400; ++step) {
    if (below(random, 3) != 0) {
      add();
    } else {
      CHECK(sum.take() == take_from_twin());
    }
  }
  while (const auto term = take_from_twin()) {
    CHECK(sum.take() == term);
  }
  CHECK_FALSE(sum.take().has_value());
}

TEST_CASE("DescendingSum: one to which nothing was added has no term", "[sparse]") {
  CHECK_FALSE(DescendingSum<Integers>{Integers{}}.take().has_value());
}

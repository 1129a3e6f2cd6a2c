#include "sparse/accumulator.hpp"

#include <map>

#include "tests/sparse/dense.hpp"
#include "tests/support/catch.hpp"

using namespace sesame::sparse;

TEMPLATE_TEST_CASE("Accumulator: a sum is that of a map, one sum after the other", "[sparse][twin]", Integers,
                   Rationals, Z2, Zp) {
  const auto ring = sample_ring<TestType>();
  Random random{GENERATE(range(0u, 10u))};
  Accumulator<TestType> sum{ring};
  Terms<TestType> terms;
  for (Index round = 0; round < 20; ++round) {
    std::map<Index, std::int64_t> twin;
    for (Index i = 0; i < below(random, 40); ++i) {
      const Index at = below(random, 10 + 10 * round);
      const std::int64_t factor = std::int64_t{below(random, 5)} - 2, coefficient = std::int64_t{below(random, 7)} - 3;
      CHECK(sum.add_product(at, ring.from(factor), ring.from(coefficient)) == !twin.contains(at));
      twin[at] += factor * coefficient;
    }
    if (!twin.empty() && below(random, 2) == 0) {
      std::int64_t& taken = twin.begin()->second;
      CHECK(sum.take(twin.begin()->first) == ring.from(taken));
      taken = 0;
    }
    sum.finish(terms);
    Terms<TestType> expected;
    for (const auto& [index, value] : twin) {
      if (!ring.is_zero(ring.from(value))) {
        expected.push_back({index, ring.from(value)});
      }
    }
    CHECK(terms == expected);
  }
}

TEST_CASE("Accumulator: what cancels leaves no term and does not come back", "[sparse]") {
  Accumulator<Integers> sum{Integers{}};
  Terms<Integers> terms{{1, 1}};
  sum.add_product(7, 2, 3);
  sum.add_product(7, -3, 2);
  sum.finish(terms);
  CHECK(terms.empty());
  CHECK(sum.add_product(7, 1, 1));
  sum.finish(terms);
  CHECK(terms == Terms<Integers>{{7, 1}});
}

TEST_CASE("Accumulator: what was cleared is no part of the next sum", "[sparse]") {
  Accumulator<Integers> sum{Integers{}};
  sum.add_product(7, 2, 3);
  sum.add_product(2, 1, 1);
  sum.clear();
  CHECK(sum.add_product(7, 1, 5));
  Terms<Integers> terms;
  sum.finish(terms);
  CHECK(terms == Terms<Integers>{{7, 5}});
}

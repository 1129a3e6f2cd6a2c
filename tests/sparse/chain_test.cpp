#include "sparse/chain.hpp"

#include <map>
#include <type_traits>

#include "tests/sparse/dense.hpp"
#include "tests/support/catch.hpp"

using namespace sesame::sparse;

TEMPLATE_TEST_CASE("chains add like functions on generators", "[sparse][twin]", Integers, Z2, Zp) {
  const auto ring = sample_ring<TestType>();
  Random random{GENERATE(range(0u, 20u))};
  std::map<Index, std::int64_t> twin;
  RawTerms<TestType> terms;
  for (int i = 0; i < 15; ++i) {
    const Index at = below(random, 10);
    const std::int64_t value = std::int64_t{below(random, 7)} - 3;
    terms.push_back({at, ring.from(value)});
    twin[at] += value;
  }
  Chain<TestType> chain(ring, {2}, terms);
  Chain<TestType> other(ring, {2});
  for (int i = 0; i < 5; ++i) {
    const Index at = below(random, 10);
    other.add(ring.from(i), at);
    twin[at] += 3 * i;
  }
  chain.add(ring.from(3), other);

  for (Index i = 0; i < 10; ++i) {
    CHECK(chain.coefficient(i) == ring.from(twin[i]));
  }
  CHECK(chain.degree() == Degree{2});
  for (std::size_t i = 0; i < chain.terms().size(); ++i) {
    CHECK_FALSE(ring.is_zero(chain.terms()[i].coefficient));
    CHECK((i == 0 || chain.terms()[i - 1].index < chain.terms()[i].index));
  }
  CHECK((chain - chain).is_zero());
  CHECK(chain + other - other == chain);
  Chain<TestType> twice = chain;
  twice.add(ring.one(), twice);
  CHECK(twice == chain + chain);
}

TEST_CASE("chains of different degrees do not add", "[sparse]") {
  Chain<Integers> edge(Integers{}, {1}), triangle(Integers{}, {2});
  CHECK_THROWS_AS(edge.add(1, triangle), ContractViolation);
}

TEST_CASE("chains print for people", "[sparse]") {
  CHECK(Chain<Integers>(Integers{}, {1}).to_string() == "0");
  CHECK(Chain<Integers>(Integers{}, {1}, {{3, -2}, {0, 1}}).to_string() == "e0 - 2 e3");
  CHECK(Chain<Integers>(Integers{}, {1}, {{0, -1}, {1, 5}}).to_string("v") == "-v0 + 5 v1");
  CHECK(Chain<Z2>(Z2{}, {1}, {{0, 1}, {4, 1}}).to_string() == "e0 + e4");
}

TEMPLATE_TEST_CASE("RawTerms: the sum of terms in any order is that of a map, by either way", "[sparse][twin]",
                   Integers, Rationals, Z2, Zp) {
  const auto ring = sample_ring<TestType>();
  Random random{GENERATE(range(0u, 20u))};
  RawTerms<TestType> kept;
  Terms<TestType> sum{{7, ring.one()}};
  for (Index round = 0; round < 4; ++round) {
    std::map<Index, std::int64_t> twin;
    RawTerms<TestType> once;
    for (Index k = 0; k < below(random, 30); ++k) {
      const Index at = below(random, 12);
      const std::int64_t value = std::int64_t{below(random, 5)} - 2;
      once.push_back({at, ring.from(value)});
      kept.push_back({at, ring.from(value)});
      twin[at] += value;
    }
    Terms<TestType> expected;
    for (const auto& [index, value] : twin) {
      if (!ring.is_zero(ring.from(value))) {
        expected.push_back({index, ring.from(value)});
      }
    }
    CHECK(std::move(once).normal(ring) == expected);
    kept.finish(ring, sum);
    CHECK(sum == expected);
    CHECK(kept.empty());
  }
}

static_assert(!std::is_convertible_v<RawTerms<Integers>, Terms<Integers>>);

TEST_CASE("a term is found by its index, or not at all", "[sparse]") {
  const Terms<Integers> terms{{1, 5}, {4, -2}, {9, 3}};
  for (Index index = 0; index < 11; ++index) {
    const Term<Integers>* found = find_term<Integers>(terms, index);
    const auto at = std::find_if(terms.begin(), terms.end(), [index](const auto& term) { return term.index == index; });
    CHECK(found == (at == terms.end() ? nullptr : &*at));
  }
  CHECK(find_term<Integers>(Terms<Integers>{}, 0) == nullptr);
}

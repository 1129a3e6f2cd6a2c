// The span of vectors that come one after another, by Smith's form as the twin: a vector is in a span exactly when the
// invariant factors stay the same with it.
#include "sparse/growing_span.hpp"

#include "sparse/smith.hpp"
#include "tests/sparse/dense.hpp"
#include "tests/support/catch.hpp"

using namespace sesame::sparse;

namespace {

template <Ring R>
std::vector<typename R::Element> factors(const R& ring, const std::vector<std::vector<std::int64_t>>& vectors,
                                         Index length) {
  Dense dense(length, static_cast<Index>(vectors.size()));
  for (Index j = 0; j < dense.columns; ++j) {
    for (Index i = 0; i < length; ++i) {
      dense(i, j) = vectors[j][i];
    }
  }
  return invariant_factors(to_sparse(ring, dense));
}

}  // namespace

TEMPLATE_TEST_CASE("a vector is in a span exactly when it brings nothing new", "[span]", Integers, Z2, Zp, Rationals) {
  using R = TestType;
  const R ring = sample_ring<R>();
  std::mt19937 random(3);
  std::uniform_int_distribution<int> entry(-4, 4);
  int inside = 0, outside = 0;
  for (int round = 0; round < 400; ++round) {
    const Index length = 1 + random() % 4;
    GrowingSpan<R> span(ring, length);
    std::vector<std::vector<std::int64_t>> vectors;
    for (int k = 0; k < 6; ++k) {
      std::vector<std::int64_t> v(length);
      for (std::int64_t& x : v) {
        x = entry(random) * (round % 3 == 0 ? 2 : 1);
      }
      typename GrowingSpan<R>::Vector in_ring;
      for (const std::int64_t x : v) {
        in_ring.push_back(ring.from(x));
      }
      const auto before = factors(ring, vectors, length);
      vectors.push_back(v);
      const bool is_inside = factors(ring, vectors, length) == before;
      CHECK(span.contains(in_ring) == is_inside);
      (is_inside ? inside : outside) += 1;
      span.add(in_ring);
      CHECK(span.contains(in_ring));
    }
  }
  CHECK(inside > 100);
  CHECK(outside > 100);
}

#include "tools/mesh/basis_selection.hpp"

#include <algorithm>
#include <random>

#include "sparse/smith.hpp"
#include "tests/support/catch.hpp"

namespace sesame::tools {

namespace {

using sparse::Index;
using sparse::Integer;
using sparse::Integers;
using sparse::Terms;

Terms<Integers> vector_of(const std::vector<int>& entries) {
  Terms<Integers> terms;
  for (Index i = 0; i < entries.size(); ++i) {
    if (entries[i] != 0) {
      terms.push_back({i, entries[i]});
    }
  }
  return terms;
}

/// Whether vectors can be completed to a basis: their invariant factors are units, as many as vectors.
bool is_saturated(Index rank, const std::vector<Terms<Integers>>& vectors) {
  sparse::Matrix<Integers> matrix{Integers{}, rank, 0};
  for (const auto& vector : vectors) {
    matrix.append_column(vector);
  }
  const auto factors = sparse::invariant_factors(matrix);
  return factors.size() == vectors.size() &&
         std::all_of(factors.begin(), factors.end(), [](const Integer& factor) { return factor == 1; });
}

}  // namespace

TEST_CASE("vectors are taken exactly as long as they can be completed to a basis") {
  std::mt19937 random{7};  // NOLINT(cert-msc51-cpp): the same cases every time
  std::uniform_int_distribution<int> entry{-4, 4};
  for (int round = 0; round < 300; ++round) {
    const Index rank = 1 + static_cast<Index>(round % 6);
    BasisSelection<Integers> selection{Integers{}, rank};
    std::vector<Terms<Integers>> taken;
    for (int tries = 0; tries < 12; ++tries) {
      std::vector<int> entries(rank);
      for (int& x : entries) {
        x = entry(random);
      }
      auto with = taken;
      with.push_back(vector_of(entries));
      const bool fits = is_saturated(rank, with);
      REQUIRE(selection.take(with.back()) == fits);
      if (fits) {
        taken = with;
      }
      REQUIRE(selection.missing() == rank - taken.size());
    }
    for (const auto& vector : selection.completion()) {
      taken.push_back(vector);
    }
    REQUIRE(taken.size() == rank);
    REQUIRE(is_saturated(rank, taken));
  }
}

TEST_CASE("a primitive vector without a unit entry is taken, a multiple is not") {
  BasisSelection<Integers> selection{Integers{}, 2};
  CHECK_FALSE(selection.take(vector_of({2, 0})));
  CHECK_FALSE(selection.take(vector_of({0, 0})));
  CHECK(selection.take(vector_of({2, 3})));
  CHECK_FALSE(selection.take(vector_of({4, 6})));
  CHECK_FALSE(selection.take(vector_of({1, 0})));
  CHECK(selection.take(vector_of({1, 1})));
  CHECK(selection.missing() == 0);
}

TEST_CASE("over a field independence suffices") {
  BasisSelection<sparse::Z2> selection{sparse::Z2{}, 2};
  CHECK(selection.take({{0, 1}, {1, 1}}));
  CHECK_FALSE(selection.take({{0, 1}, {1, 1}}));
  CHECK(selection.take({{1, 1}}));
  CHECK(selection.completion().empty());
}

}  // namespace sesame::tools

#include "ops/simplicial/zigzag_complex.hpp"

#include <map>
#include <numeric>

#include "tests/support/catch.hpp"
#include "tests/support/plain_zigzags.hpp"

namespace sesame {
namespace {

using ops::Label;
using ops::ZigzagComplex;
using tests::PlainSimplices;
using tests::ZigzagStep;
using Cell = ZigzagComplex::Cell;

std::vector<std::uint64_t> counts_of(const PlainSimplices& complex) {
  std::vector<std::uint64_t> counts;
  for (const tests::PlainSimplex& s : complex) {
    counts.resize(std::max(counts.size(), s.size()), 0);
    ++counts[s.size() - 1];
  }
  return counts;
}

TEST_CASE("a zigzag complex has what a plain set of simplices has, and tells of single cells in order", "[zigzag]") {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    const tests::ZigzagShape shape{.steps = 80, .labels = 6, .deletions_in_16 = 4, .contractions_in_16 = 1 + seed % 3};
    ZigzagComplex complex;
    PlainSimplices plain;
    std::map<std::pair<int, std::uint32_t>, std::vector<std::uint32_t>> told;  // facets of each cell that is there
    const auto include = [&](Cell cell, std::span<const std::uint32_t> facets) {
      for (const std::uint32_t facet : facets) {
        REQUIRE(told.contains({cell.dimension - 1, facet}));
      }
      REQUIRE(
          told.emplace(std::pair{cell.dimension, cell.slot}, std::vector<std::uint32_t>(facets.begin(), facets.end()))
              .second);
    };
    const auto exclude = [&](Cell cell) {
      for (const auto& [key, facets] : told) {
        REQUIRE((key.first != cell.dimension + 1 || std::ranges::find(facets, cell.slot) == facets.end()));
      }
      REQUIRE(told.erase({cell.dimension, cell.slot}) == 1);
    };
    for (const ZigzagStep& step : tests::random_zigzag(seed, shape)) {
      CAPTURE(seed, step.kind, step.labels);
      if (step.kind == 'i') {
        const Cell cell = complex.include(step.labels).value();
        include(cell, complex.facets());
      } else if (step.kind == 'd') {
        exclude(complex.exclude(step.labels).value());
      } else {
        REQUIRE(complex.contract(step.labels[0], step.labels[1], {include, exclude}).has_value());
      }
      tests::carry_out(step, plain);
      const std::vector<std::uint64_t> counts(complex.counts().begin(), complex.counts().end());
      REQUIRE(counts == counts_of(plain));
      REQUIRE(told.size() == plain.size());
      for (const tests::PlainSimplex& s : plain) {
        REQUIRE(complex.rules().contains(s));
      }
    }
  }
}

TEST_CASE("what is refused is said, and changes nothing", "[zigzag]") {
  ZigzagComplex complex;
  const auto include = [&](std::vector<Label> labels) { return complex.include(labels).has_value(); };
  const auto refusal = [&](std::vector<Label> labels) {
    const auto excluded = complex.exclude(labels);
    REQUIRE(!excluded.has_value());
    REQUIRE(excluded.error().code == Errc::bad_input);
    return excluded.error().what;
  };
  REQUIRE(include({4}));
  REQUIRE(include({7}));
  REQUIRE(include({7, 4}));
  CHECK(refusal({4}) == "simplex {4} is a face of {4 7}, which should be deleted before it");
  CHECK(refusal({5}) == "simplex {5} is not there; only a simplex of the complex can be deleted");
  CHECK(refusal({4, 5}) == "simplex {4 5} is not there; only a simplex of the complex can be deleted");
  CHECK(refusal({4, 4}) == "simplex {4 4} is not there; only a simplex of the complex can be deleted");
  CHECK(refusal({}) == "simplex {} is not there; only a simplex of the complex can be deleted");
  const ZigzagComplex::Listener nobody{[](Cell, auto) { FAIL(); }, [](Cell) { FAIL(); }};
  CHECK(!complex.contract(4, 4, nobody).has_value());
  CHECK(!complex.contract(4, 5, nobody).has_value());
  CHECK(std::vector<std::uint64_t>(complex.counts().begin(), complex.counts().end()) ==
        std::vector<std::uint64_t>{2, 1});
  CHECK(complex.exclude(std::vector<Label>{4, 7}).has_value());
  CHECK(complex.exclude(std::vector<Label>{4}).has_value());
  CHECK(include({4}));
}

}  // namespace
}  // namespace sesame

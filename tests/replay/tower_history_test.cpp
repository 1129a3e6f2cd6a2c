#include "replay/tower/tower_history.hpp"

#include <algorithm>

#include "engine/towers/barcode_tracker.hpp"
#include "replay/tower/tower_replay.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_towers.hpp"
#include "tests/support/ranks.hpp"

namespace sesame {
namespace {

using engine::BarCycles;
using ops::Label;
using replay::TowerHistory;
using replay::TowerOperation;
using tests::DenseRow;
using tests::PlainComplex;

/// A chain as a row in the numbered simplices of its dimension; all of them have to be there.
DenseRow row_of(const TowerHistory::NamedChain& chain, const std::map<PlainComplex::Simplex, std::size_t>& number) {
  DenseRow row(number.size(), 0);
  for (const auto& [coefficient, name] : chain.terms) {
    const auto at = number.find({name.begin(), name.end()});
    REQUIRE(at != number.end());
    row[at->second] = std::stoll(coefficient.to_string());
  }
  return row;
}

DenseRow combination(const DenseRow& coefficients, const std::vector<DenseRow>& rows, std::size_t columns) {
  DenseRow sum(columns, 0);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < columns; ++c) {
      sum[c] += coefficients[r] * rows[r][c];
    }
  }
  return sum;
}

bool is_zero_modulo(const DenseRow& row, std::int64_t p) {
  return std::ranges::all_of(row, [p](std::int64_t x) { return x % p == 0; });
}

/// Everything that cycles should be, in the complex after one operation.
void check_cycles(BarCycles& cycles, const TowerHistory& history, const PlainComplex& complex, std::uint64_t operation,
                  std::uint32_t p) {
  const std::vector<BarCycles::TracedBar> bars = cycles.bars();
  for (std::size_t d = 0; d < 5; ++d) {
    const auto number = tests::numbered(complex, d);
    const auto boundaries_below = d == 0 ? std::vector<DenseRow>{} : tests::boundary_rows(complex, d);
    std::vector<DenseRow> boundaries = tests::boundary_rows(complex, d + 1);
    const std::size_t rank = tests::rank_modulo(boundaries, p);
    std::size_t alive = 0;
    for (const BarCycles::TracedBar& bar : bars) {
      const bool is_open = bar.bar.death == engine::never;
      if (bar.bar.dimension != static_cast<int>(d) || bar.born_by > operation) {
        continue;
      }
      const DenseRow cycle = row_of(history.image(cycles.cycle(bar), operation, p), number);
      if (d > 0 && !cycle.empty()) {
        CHECK(is_zero_modulo(combination(cycle, boundaries_below, boundaries_below[0].size()), p));
      }
      if (is_open || operation < bar.killed_by) {
        boundaries.push_back(cycle);
        ++alive;
      } else if (operation == bar.killed_by) {
        const auto above = tests::numbered(complex, d + 1);
        const DenseRow chain = row_of(history.image(cycles.bounded_chain(bar), operation, p), above);
        DenseRow difference = combination(chain, tests::boundary_rows(complex, d + 1), number.size());
        std::ranges::transform(difference, cycle, difference.begin(), std::minus<>{});
        CHECK(is_zero_modulo(difference, p));
      }
    }
    // The classes alive are a basis of the homology.
    const std::vector<std::uint64_t> betti = tests::betti_modulo(complex, p);
    REQUIRE(alive == (d < betti.size() ? betti[d] : 0));
    REQUIRE(tests::rank_modulo(boundaries, p) == rank + alive);
  }
}

TEST_CASE("cycles are a basis of the homology at every operation, and bound when their bars end", "[replay][tower]") {
  const std::uint32_t seed = GENERATE(range(0u, 12u));
  const std::uint32_t p = GENERATE(2u, 3u);
  CAPTURE(seed, p);
  const auto tracker = engine::make_barcode_tracker(sparse::parse_ring("Z/" + std::to_string(p)).value(),
                                                    [](const engine::Bar&) {}, {.keeps_cycles = true});
  TowerHistory history;
  replay::TowerReplay replay({tracker.get()}, &history);
  PlainComplex plain;
  std::vector<PlainComplex> complexes;
  for (const tests::TowerStep& step : tests::random_tower(seed, 60, 7, 2 + seed % 3)) {
    const auto kind = step.is_contraction ? TowerOperation::Kind::contract : TowerOperation::Kind::insert;
    const int dimension = step.is_contraction ? 0 : static_cast<int>(step.labels.size()) - 1;
    REQUIRE(replay.apply({kind, static_cast<double>(complexes.size()), dimension, step.labels}).has_value());
    plain.apply(step);
    complexes.push_back(plain);
  }
  for (std::uint64_t operation = 0; operation < complexes.size(); ++operation) {
    check_cycles(*tracker->cycles(), history, complexes[operation], operation, p);
  }
}

/// A chain as a sum, and what its boundary is.
std::map<TowerHistory::Name, sparse::Rational> sum_of(const TowerHistory::NamedChain& chain, bool of_boundary) {
  std::map<TowerHistory::Name, sparse::Rational> sum;
  for (const auto& [coefficient, name] : chain.terms) {
    if (!of_boundary) {
      sum[name] += coefficient;
    }
    for (std::size_t k = 0; of_boundary && name.size() > 1 && k < name.size(); ++k) {
      TowerHistory::Name facet = name;
      facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(k));
      sum[facet] += k % 2 == 0 ? coefficient : -coefficient;
    }
  }
  std::erase_if(sum, [](const auto& term) { return term.second.is_zero(); });
  return sum;
}

TEST_CASE("over Q cycles are cycles, and bound exactly what is said", "[replay][tower]") {
  const std::uint32_t seed = GENERATE(range(0u, 12u));
  CAPTURE(seed);
  const auto tracker =
      engine::make_barcode_tracker(sparse::Rationals{}, [](const engine::Bar&) {}, {.keeps_cycles = true});
  TowerHistory history;
  replay::TowerReplay replay({tracker.get()}, &history);
  double time = 0;
  for (const tests::TowerStep& step : tests::random_tower(seed, 150, 8, 2 + seed % 3)) {
    const auto kind = step.is_contraction ? TowerOperation::Kind::contract : TowerOperation::Kind::insert;
    const int dimension = step.is_contraction ? 0 : static_cast<int>(step.labels.size()) - 1;
    REQUIRE(replay.apply({kind, time++, dimension, step.labels}).has_value());
  }
  std::size_t ended = 0;
  for (const auto& bar : tracker->cycles()->bars()) {
    const auto cycle = tracker->cycles()->cycle(bar);
    REQUIRE(!cycle.terms.empty());
    CHECK(cycle.degree == bar.bar.dimension);
    CHECK(sum_of(history.image(cycle, bar.born_by, 0), true).empty());
    if (bar.bar.death != engine::never) {
      ++ended;
      const auto bounded = history.image(tracker->cycles()->bounded_chain(bar), bar.killed_by, 0);
      CHECK(bounded.degree == bar.bar.dimension + 1);
      CHECK(sum_of(bounded, true) == sum_of(history.image(cycle, bar.killed_by, 0), false));
    }
  }
  CHECK(ended > 10);
}

}  // namespace
}  // namespace sesame

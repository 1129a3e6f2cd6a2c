#include "tools/bench/statistics.hpp"

#include <cmath>
#include <random>

#include "sparse/contract.hpp"
#include "tests/support/catch.hpp"

using namespace sesame;
using namespace sesame::tools;

TEST_CASE("a median is the middle value, or the mean of the two in the middle", "[bench]") {
  CHECK(median({7}) == 7);
  CHECK(median({3, 1, 2}) == 2);
  CHECK(median({4, 1, 3, 2}) == 2.5);
  CHECK(median({5, 5, 1, 5}) == 5);
  CHECK_THROWS_AS(median({}), sparse::ContractViolation);
}

TEST_CASE("a percentile is a value that so many do not exceed", "[bench]") {
  std::vector<double> values;
  for (int k = 100; k >= 1; --k) {
    values.push_back(k);
  }
  CHECK(percentile(values, 0.5) == 50);
  CHECK(percentile(values, 0.99) == 99);
  CHECK(percentile(values, 0.991) == 100);
  CHECK(percentile(values, 1) == 100);
  CHECK(percentile(values, 0.001) == 1);
  std::vector<double> one{8};
  CHECK(percentile(one, 0.5) == 8);
  CHECK(percentile(one, 0.99) == 8);
  CHECK_THROWS_AS(percentile(one, 0), sparse::ContractViolation);
}

TEST_CASE("a spread is not moved by one run that went wrong", "[bench]") {
  const Spread spread = spread_of({10, 11, 9, 10, 500});
  CHECK(spread.median == 10);
  CHECK(spread.min == 9);
  CHECK(spread.max == 500);
  CHECK(spread.deviation == 1);
  CHECK(spread.runs == 5);
}

TEST_CASE("the exponent of an exact power law is found", "[bench]") {
  const double exponent = GENERATE(-1.5, 0.0, 1.0, 2.25);
  std::vector<Sighting> points;
  for (const double x : {10.0, 100.0, 3000.0, 1e6}) {
    points.push_back({x, 7 * std::pow(x, exponent)});
  }
  const PowerLaw law = fit_power_law(points);
  CHECK(law.exponent == Approx(exponent).margin(1e-9));
  CHECK(law.factor == Approx(7));
  CHECK(law.error < 1e-6);
}

TEST_CASE("the error of an exponent grows with the noise, and covers it", "[bench]") {
  const double noise = GENERATE(0.05, 0.5);
  std::mt19937_64 engine(1);
  int covered = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Sighting> points;
    for (int k = 1; k <= 20; ++k) {
      const double error = noise * (static_cast<double>(engine() >> 11) * 0x1p-53 - 0.5);
      points.push_back({std::pow(2, k), std::pow(2, k) * std::exp(error)});
    }
    const PowerLaw law = fit_power_law(points);
    covered += std::abs(law.exponent - 1) < 2 * law.error ? 1 : 0;
  }
  CHECK(covered > 170);
  CHECK(covered < 200);
}

TEST_CASE("two points make a law without an error, and one makes none", "[bench]") {
  const std::vector<Sighting> two{{1, 3}, {10, 30}};
  CHECK(fit_power_law(two).exponent == Approx(1));
  CHECK(fit_power_law(two).error == 0);
  const std::vector<Sighting> one{{5, 1}, {5, 2}}, negative{{1, 1}, {2, 0}};
  CHECK_THROWS_AS(fit_power_law(one), sparse::ContractViolation);
  CHECK_THROWS_AS(fit_power_law(negative), sparse::ContractViolation);
}

/// \file
/// Numbers that sum up many measurements.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace sesame::tools {

/// The smallest value that at least the part `part` of the values does not exceed: 0.5 for p50, 0.99 for p99.
/// Requires: some values; 0 < part <= 1. Cost: linear; reorders the values.
[[nodiscard]] double percentile(std::span<double> values, double part);

/// The middle value, or the mean of the two in the middle. Requires: some values.
[[nodiscard]] double median(std::vector<double> values);

/// What repeated measurements of one thing were.
struct Spread {
  double median = 0, min = 0, max = 0;
  double deviation = 0;  ///< the median of the distances from the median (MAD)
  std::size_t runs = 0;

  friend bool operator==(const Spread&, const Spread&) = default;
};
/// Requires: some values.
[[nodiscard]] Spread spread_of(const std::vector<double>& values);

/// How long each of many things took: what they cost together, what is usual, and the tail. Where most are quick and a
/// few are slow, p50 hides what the mean shows.
struct Latency {
  double mean = 0, p50 = 0, p99 = 0, max = 0;
  friend bool operator==(const Latency&, const Latency&) = default;
};
/// Requires: some values. Cost: linear; reorders the values.
[[nodiscard]] Latency latency_of(std::span<double> values);

struct Sighting {
  double x, y;
};
/// y = factor * x^exponent, by least squares on the logarithms. `error` is the standard error of the exponent; 0 for
/// two points.
struct PowerLaw {
  double exponent = 0, factor = 0, error = 0;
};
/// Requires: two different x at least, all x and y positive.
[[nodiscard]] PowerLaw fit_power_law(std::span<const Sighting> points);

}  // namespace sesame::tools

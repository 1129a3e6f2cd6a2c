#include "tools/bench/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sparse/contract.hpp"

namespace sesame::tools {

double percentile(std::span<double> values, double part) {
  sparse::expects(!values.empty() && part > 0 && part <= 1, "a percentile is of some values, and of a part of them");
  const auto count = static_cast<double>(values.size());
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(part * count - 1e-9)) - 1;
  const auto place = values.begin() + std::max(rank, std::ptrdiff_t{0});
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

double median(std::vector<double> values) {
  sparse::expects(!values.empty(), "a median is of some values");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return values.size() % 2 == 1 ? *middle : (*middle + *std::max_element(values.begin(), middle)) / 2;
}

Latency latency_of(std::span<double> values) {
  sparse::expects(!values.empty(), "a latency is of some values");
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  return {sum / static_cast<double>(values.size()), percentile(values, 0.5), percentile(values, 0.99),
          std::ranges::max(values)};
}

Spread spread_of(const std::vector<double>& values) {
  Spread spread;
  spread.median = median(values);
  std::vector<double> distances;
  distances.reserve(values.size());
  for (const double x : values) {
    distances.push_back(std::abs(x - spread.median));
  }
  spread.deviation = median(std::move(distances));
  const auto [min, max] = std::ranges::minmax(values);
  spread.min = min;
  spread.max = max;
  spread.runs = values.size();
  return spread;
}

PowerLaw fit_power_law(std::span<const Sighting> points) {
  double mean_x = 0, mean_y = 0;
  for (const auto& [x, y] : points) {
    sparse::expects(x > 0 && y > 0, "a power law is fitted to positive numbers");
    mean_x += std::log(x) / static_cast<double>(points.size());
    mean_y += std::log(y) / static_cast<double>(points.size());
  }
  double xx = 0, xy = 0, yy = 0;
  for (const auto& [x, y] : points) {
    const double dx = std::log(x) - mean_x, dy = std::log(y) - mean_y;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
  sparse::expects(xx > 0, "a power law is fitted to two different x at least");
  PowerLaw law;
  law.exponent = xy / xx;
  law.factor = std::exp(mean_y - law.exponent * mean_x);
  if (points.size() > 2) {
    const double residual = std::max(0.0, yy - law.exponent * xy);
    law.error = std::sqrt(residual / (static_cast<double>(points.size() - 2) * xx));
  }
  return law;
}

}  // namespace sesame::tools

#include "replay/distance/diagram_distance.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "tests/support/catch.hpp"

using namespace sesame;
using engine::Bar;
using engine::never;
using engine::Time;
using replay::bottleneck_distance;
using replay::DiagramDistance;
using replay::GroundMetric;
using replay::Match;
using replay::wasserstein_distance;

namespace {

using Bars = std::vector<Bar>;

double cost_of_pair(const Bar& x, const Bar& y, GroundMetric ground) {
  const double across = std::abs((x.birth - y.birth).nearest());
  if (x.death == never || y.death == never) {
    return x.death == y.death ? across : never.nearest();
  }
  const double up = std::abs((x.death - y.death).nearest());
  return ground == GroundMetric::maximum ? std::max(across, up) : std::sqrt(across * across + up * up);
}

double cost_of_diagonal(const Bar& x, GroundMetric ground) {
  return (x.death - x.birth).nearest() / (ground == GroundMetric::maximum ? 2 : std::sqrt(2));
}

/// The least value over all matchings, each tried; `join` puts the cost of one more match to the others.
double least_over_all(const Bars& left, const Bars& right, GroundMetric ground,
                      const std::function<double(double, double)>& join) {
  std::vector<bool> is_used(right.size());
  const std::function<double(std::size_t, double)> best = [&](std::size_t i, double so_far) {
    if (i == left.size()) {
      for (std::size_t j = 0; j < right.size(); ++j) {
        so_far = is_used[j] ? so_far : join(so_far, cost_of_diagonal(right[j], ground));
      }
      return so_far;
    }
    double least = best(i + 1, join(so_far, cost_of_diagonal(left[i], ground)));
    for (std::size_t j = 0; j < right.size(); ++j) {
      if (!is_used[j]) {
        is_used[j] = true;
        least = std::min(least, best(i + 1, join(so_far, cost_of_pair(left[i], right[j], ground))));
        is_used[j] = false;
      }
    }
    return least;
  };
  return best(0, 0);
}

class RandomBars {
 public:
  explicit RandomBars(unsigned seed) : random_{seed} {}

  /// Up to `most` bars with ends in a small grid, where many distances are equal, or anywhere; some essential.
  Bars operator()(std::size_t most, bool in_grid) {
    Bars bars(below(most + 1));
    for (Bar& bar : bars) {
      const double x = number(in_grid), y = number(in_grid);
      bar = {0, std::min(x, y), below(5) == 0 ? never : std::max(x, y)};
    }
    return bars;
  }

  std::size_t below(std::size_t bound) { return random_() % bound; }
  double number(bool in_grid) {
    return in_grid ? static_cast<double>(below(9)) : static_cast<double>(below(1'000'003)) / 1'000'003;
  }

 private:
  std::mt19937 random_;
};

/// Every bar once, at the cost of its pair.
void check_matching(const DiagramDistance& found, const Bars& left, const Bars& right, GroundMetric ground) {
  std::vector<int> of_left(left.size()), of_right(right.size());
  for (const Match& match : found.matching) {
    REQUIRE((match.left || match.right));
    if (match.left) {
      ++of_left.at(*match.left);
    }
    if (match.right) {
      ++of_right.at(*match.right);
    }
    const double cost = match.left && match.right
                            ? cost_of_pair(left[*match.left], right[*match.right], ground)
                            : cost_of_diagonal(match.left ? left[*match.left] : right[*match.right], ground);
    CHECK((match.cost == cost || match.cost.nearest() == Approx(cost)));
  }
  CHECK(std::all_of(of_left.begin(), of_left.end(), [](int n) { return n == 1; }));
  CHECK(std::all_of(of_right.begin(), of_right.end(), [](int n) { return n == 1; }));
}

double largest(double x, double y) { return std::max(x, y); }

}  // namespace

TEST_CASE("the bottleneck distance is the least over all matchings", "[replay][law]") {
  const unsigned seed = GENERATE(range(0U, 300U));
  CAPTURE(seed);
  RandomBars random(seed);
  const bool in_grid = seed % 2 == 0;
  const Bars left = random(5, in_grid), right = random(5, in_grid);
  const DiagramDistance found = bottleneck_distance(left, right);
  CHECK(found.value == least_over_all(left, right, GroundMetric::maximum, largest));
  check_matching(found, left, right, GroundMetric::maximum);
}

TEST_CASE("the Wasserstein distance is the least over all matchings", "[replay][law]") {
  const unsigned seed = GENERATE(range(0U, 300U));
  CAPTURE(seed);
  RandomBars random(seed + 1000);
  const bool in_grid = seed % 2 == 0;
  const Bars left = random(5, in_grid), right = random(5, in_grid);
  const double q = std::vector<double>{1, 2, 3.5}[seed % 3];
  const auto ground = seed % 5 < 3 ? GroundMetric::maximum : GroundMetric::euclidean;
  const double sum = least_over_all(left, right, ground, [q](double x, double y) { return x + std::pow(y, q); });
  const DiagramDistance found = wasserstein_distance(left, right, q, ground);
  if (sum == never) {
    CHECK(found.value == never);
  } else {
    CHECK(found.value.nearest() == Approx(std::pow(sum, 1 / q)).epsilon(1e-12).margin(1e-12));
  }
  check_matching(found, left, right, ground);
}

TEST_CASE("diagrams of a few hundred points are matched within the bounds that simpler matchings give",
          "[replay][law]") {
  const unsigned seed = GENERATE(range(0U, 6U));
  CAPTURE(seed);
  RandomBars random(seed + 2000);
  Bars left;
  for (int i = 0; i < 300; ++i) {
    const double x = random.number(false), y = random.number(false);
    left.push_back({0, std::min(x, y), std::max(x, y)});
  }
  Bars right = left;
  const double step = 0.001 * (seed + 1);
  double moved = 0;
  for (Bar& bar : right) {
    const double up = step * random.number(false);
    bar.death = bar.death.nearest() + up;
    moved += up;
  }
  std::shuffle(right.begin(), right.end(), std::mt19937{seed});
  const DiagramDistance bottleneck = bottleneck_distance(left, right);
  CHECK(bottleneck.value <= step);
  CHECK(bottleneck.value > 0);
  check_matching(bottleneck, left, right, GroundMetric::maximum);
  const DiagramDistance wasserstein = wasserstein_distance(left, right);
  CHECK(wasserstein.value <= moved * (1 + 1e-12));
  CHECK(wasserstein.value >= bottleneck.value);
  check_matching(wasserstein, left, right, GroundMetric::maximum);
  // Powers of larger and larger exponents see only the longest match.
  CHECK(wasserstein_distance(left, right, 400).value.nearest() == Approx(bottleneck.value.nearest()).epsilon(0.05));
  CHECK(bottleneck_distance(right, left).value == bottleneck.value);
  CHECK(wasserstein_distance(right, left).value.nearest() == Approx(wasserstein.value.nearest()).epsilon(1e-12));
}

TEST_CASE("a diagram has distance 0 from itself, in any order", "[replay]") {
  RandomBars random(7);
  const Bars bars = random(200, true);
  Bars shuffled = bars;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937{1});
  CHECK(bottleneck_distance(bars, shuffled).value == 0);
  CHECK(wasserstein_distance(bars, shuffled).value == 0);
  CHECK(wasserstein_distance(bars, shuffled, 2, GroundMetric::euclidean).value == 0);
  CHECK(bottleneck_distance({}, {}).value == 0);
  CHECK(wasserstein_distance({}, {}).value == 0);
  CHECK(bottleneck_distance({}, {}).matching.empty());
}

TEST_CASE("different numbers of essential bars are infinitely far apart", "[replay]") {
  const Bars one{{0, 0, never}}, two{{0, 3, never}, {0, 1, never}}, none{{0, 0, 1}};
  CHECK(bottleneck_distance(one, two).value == never);
  CHECK(bottleneck_distance(one, none).value == never);
  CHECK(wasserstein_distance(none, two, 2).value == never);
  CHECK(wasserstein_distance(two, one).value == never);
  CHECK(bottleneck_distance(two, two).value == 0);
}

TEST_CASE("essential bars are matched by birth, apart from the others", "[replay]") {
  const Bars left{{0, 5, never}, {0, 0, never}, {0, 0, 8}}, right{{0, 1, never}, {0, 7, never}};
  const DiagramDistance found = bottleneck_distance(left, right);
  CHECK(found.value == 4);  // the bar that ends goes to the diagonal
  REQUIRE(found.matching.size() == 3);
  CHECK(found.matching[0].right == std::size_t{1});
  CHECK(found.matching[1].right == std::size_t{0});
  CHECK_FALSE(found.matching[2].right);
  CHECK(wasserstein_distance(left, right).value == 2 + 1 + 4);
  CHECK(wasserstein_distance(left, right, 2).value.nearest() == Approx(std::sqrt(4 + 1 + 16)));
}

TEST_CASE("the diagonal is half the length away in the maximum metric, by the root of two in the Euclidean",
          "[replay]") {
  const Bars bars{{0, 1, 5}};
  CHECK(bottleneck_distance(bars, {}).value == 2);
  CHECK(bottleneck_distance({}, bars).value == 2);
  CHECK(wasserstein_distance(bars, {}).value == 2);
  CHECK(wasserstein_distance(bars, {}, 1, GroundMetric::euclidean).value.nearest() == Approx(4 / std::sqrt(2)));
  const Bars longer{{0, 0, 8}};  // across 1, up 3
  CHECK(wasserstein_distance(bars, longer).value == 3);
  CHECK(wasserstein_distance(bars, longer, 1, GroundMetric::euclidean).value.nearest() == Approx(std::sqrt(10)));
}

TEST_CASE("far points of both sides get partners at once", "[replay]") {
  // Each side by itself could take the same partner: the long bars have to be matched so that both matchings agree.
  const Bars left{{0, 0, 10}, {0, 1, 5}}, right{{0, 0.5, 10.5}, {0, 0, 9.5}};
  const DiagramDistance found = bottleneck_distance(left, right);
  CHECK(found.value == 4.5);
  check_matching(found, left, right, GroundMetric::maximum);
}

TEST_CASE("numbers of any size are compared without overflow", "[replay]") {
  const Bars far{{0, -1e308, 1e308}}, near{{0, 1, 2}}, tiny{{0, 0, 1e-300}};
  CHECK(bottleneck_distance(far, near).value == 1e308);
  CHECK(wasserstein_distance(far, near, 3).value.nearest() == Approx(1e308));
  CHECK(bottleneck_distance(tiny, {}).value == 5e-301);
  CHECK(wasserstein_distance(tiny, {}, 3).value.nearest() == Approx(5e-301));
}

TEST_CASE("whole numbers beyond 2^53 are compared exactly", "[replay][time]") {
  constexpr std::int64_t now = 1732800000000000001;
  const Bars left{{0, now, now + 10}, {0, now + 1, never}}, right{{0, now + 3, now + 10}, {0, now, never}};
  const DiagramDistance found = bottleneck_distance(left, right);
  CHECK(found.value == 3);
  CHECK(found.matching[0].cost == 3);
  CHECK(found.matching[1].cost == 1);
  CHECK(wasserstein_distance(left, right).value == 4);
  CHECK(wasserstein_distance(left, right, 2, GroundMetric::euclidean).value.nearest() == Approx(std::sqrt(10)));
  // The distance itself may be no double.
  const Bars zero{{0, 0, never}}, far{{0, now, never}}, from_0{{0, 0, now}}, one_longer{{0, 0, now + 1}};
  CHECK(bottleneck_distance(zero, far).value == now);
  CHECK(bottleneck_distance(from_0, one_longer).value == 1);
  CHECK(bottleneck_distance(one_longer, {}).value == (now + 1) / 2);
}

TEST_CASE("the bottleneck distance of whole numbers beyond 2^53 is the least over all matchings",
          "[replay][law][time]") {
  const unsigned seed = GENERATE(range(0U, 60U));
  CAPTURE(seed);
  std::mt19937_64 random(seed);
  // Distances are differences of few numbers that are near to multiples of 2^60, even ones, so that half of them are
  // whole: no double tells them apart.
  const auto number = [&] { return Time{(random() % 15 << 60) + random() % 5 * 2}; };
  const auto bars = [&] {
    Bars drawn(random() % 5);
    for (Bar& bar : drawn) {
      const Time x = number(), y = number();
      bar = {0, std::min(x, y), std::max(x, y)};
    }
    return drawn;
  };
  const Bars left = bars(), right = bars();
  const auto apart = [](Time x, Time y) { return x < y ? y - x : x - y; };
  std::vector<bool> is_used(right.size());
  const std::function<Time(std::size_t, Time)> best = [&](std::size_t i, Time so_far) {
    if (i == left.size()) {
      for (std::size_t j = 0; j < right.size(); ++j) {
        so_far = is_used[j] ? so_far : std::max(so_far, (right[j].death - right[j].birth).half());
      }
      return so_far;
    }
    Time least = best(i + 1, std::max(so_far, (left[i].death - left[i].birth).half()));
    for (std::size_t j = 0; j < right.size(); ++j) {
      if (!is_used[j]) {
        is_used[j] = true;
        const Time cost = std::max(apart(left[i].birth, right[j].birth), apart(left[i].death, right[j].death));
        least = std::min(least, best(i + 1, std::max(so_far, cost)));
        is_used[j] = false;
      }
    }
    return least;
  };
  CHECK(bottleneck_distance(left, right).value == best(0, 0));
}

TEST_CASE("bars of length 0 are on the diagonal", "[replay]") {
  const Bars zero{{0, 3, 3}, {0, 4, 4}};
  CHECK(bottleneck_distance(zero, {}).value == 0);
  CHECK(wasserstein_distance(zero, {{{0, 0, 2}}}).value == 1);
}

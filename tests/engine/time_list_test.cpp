#include "engine/towers/time_list.hpp"

#include <random>
#include <vector>

#include "tests/support/catch.hpp"

namespace sesame {
namespace {

using engine::Time;
using engine::TimeList;

void check_same(const TimeList& list, const std::vector<Time>& twin) {
  REQUIRE(list.size() == twin.size());
  for (std::size_t at = 0; at < twin.size(); ++at) {
    REQUIRE(list[at] == twin[at]);
  }
  if (!twin.empty()) {
    CHECK(list.back() == twin.back());
  }
}

TEST_CASE("a list of times is a vector of them, with whole numbers beyond 2^53 and without", "[engine][time]") {
  const std::uint32_t seed = GENERATE(range(0u, 20u));
  const bool has_large = GENERATE(false, true);
  CAPTURE(seed, has_large);
  std::mt19937_64 random{seed};
  TimeList list;
  std::vector<Time> twin;
  for (int step = 0; step < 200; ++step) {
    const std::uint64_t what = random() % 8;
    if (what < 6 || twin.empty()) {
      const Time time = has_large && random() % 10 == 0 ? Time{random()} : Time{static_cast<double>(random() % 99) / 2};
      list.push_back(time);
      twin.push_back(time);
    } else if (what == 6) {
      const std::size_t from = random() % twin.size(), to = random() % twin.size();
      list.copy(from, to);
      twin[to] = twin[from];
    } else {
      const std::size_t size = twin.size() - random() % std::min<std::size_t>(twin.size(), 3);
      list.truncate(size);
      twin.resize(size);
    }
    check_same(list, twin);
  }
}

TEST_CASE("the last place with the same time is found in a list that does not decrease", "[engine][time]") {
  const std::uint32_t seed = GENERATE(range(0u, 10u));
  const bool is_large = GENERATE(false, true);
  CAPTURE(seed, is_large);
  std::mt19937 random{seed};
  TimeList list;
  std::uint64_t time = is_large ? std::uint64_t{1} << 60 : 0;
  for (int k = 0; k < 100; ++k) {
    time += random() % 3 == 0 ? 1 : 0;
    list.push_back(Time{time});
  }
  for (std::size_t at = 0; at < list.size(); ++at) {
    std::size_t last = at;
    while (last + 1 < list.size() && list[last + 1] == list[at]) {
      ++last;
    }
    CHECK(list.last_equal(at) == last);
  }
}

}  // namespace
}  // namespace sesame

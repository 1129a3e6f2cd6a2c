#include "engine/towers/time.hpp"

#include <limits>
#include <random>
#include <vector>

#include "engine/towers/barcode.hpp"
#include "engine/towers/time_list.hpp"
#include "tests/support/catch.hpp"

namespace sesame {
namespace {

using engine::Time;
using engine::TimeList;

__extension__ using Wide = __int128;

constexpr std::int64_t two_to_53 = std::int64_t{1} << 53;
constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();
constexpr std::uint64_t latest = std::numeric_limits<std::uint64_t>::max();

Time time_of(Wide x) { return x < 0 ? Time{static_cast<std::int64_t>(x)} : Time{static_cast<std::uint64_t>(x)}; }

/// Whole numbers of 64 bits around powers of two, and anywhere.
std::vector<Wide> whole_numbers() {
  std::vector<Wide> numbers{Wide{latest}, Wide{least}};
  for (int bits = 0; bits < 64; ++bits) {
    for (int more = -3; more <= 3; ++more) {
      for (const Wide sign : {-1, 1}) {
        numbers.push_back(sign * (Wide{std::uint64_t{1} << bits} + more));
      }
    }
  }
  std::mt19937_64 random{1};
  for (int i = 0; i < 50; ++i) {
    numbers.push_back(Wide{random()});
    numbers.push_back(Wide{static_cast<std::int64_t>(random())});
  }
  std::erase_if(numbers, [](Wide x) { return x < least || x > latest; });
  return numbers;
}

TEST_CASE("whole numbers of 64 bits are ordered, told apart and subtracted exactly", "[engine][time]") {
  const std::vector<Wide> numbers = whole_numbers();
  std::size_t wrong = 0;
  for (const Wide x : numbers) {
    for (const Wide y : numbers) {
      const Time s = time_of(x), t = time_of(y);
      wrong += (s == t) == (x == y) && (s < t) == (x < y) && (s > t) == (x > y) ? 0U : 1U;
      const Time difference = s - t;
      const bool fits = x - y >= least && x - y <= latest;
      wrong += fits ? (difference == time_of(x - y) ? 0U : 1U)
                    : (difference == static_cast<double>(x - y) && !difference.is_large() ? 0U : 1U);
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("a whole number comes out as it went in", "[engine][time]") {
  for (const Wide x : whole_numbers()) {
    const Time t = time_of(x);
    CHECK(t.is_whole());
    CHECK(t.is_large() == (x > two_to_53 || x < -two_to_53));
    CHECK(t.modulo_2_64() == static_cast<std::uint64_t>(x));
    CHECK(t.nearest() == static_cast<double>(x));
  }
}

TEST_CASE("doubles lie among whole numbers where their values do", "[engine][time]") {
  CHECK(Time{9007199254740993} > 9007199254740992.0);
  CHECK(Time{9007199254740993} < 9007199254740994.0);
  CHECK(Time{9007199254740994} == 9007199254740994.0);
  CHECK(Time{latest} < 18446744073709551616.0);
  CHECK(Time{0.5} > 0);
  CHECK(Time{-0.0} == 0);
  CHECK(Time{latest} < engine::never);
  CHECK((engine::never - Time{latest}) == engine::never);
  CHECK_FALSE(Time{9007199254740994.0}.is_whole());  // it may have been rounded
  CHECK(Time{9007199254740992.0}.is_whole());
  CHECK_FALSE(Time{1.5}.is_whole());
}

TEST_CASE("half of a time is exact where a time is that", "[engine][time]") {
  CHECK(Time{7}.half() == 3.5);
  CHECK(Time{two_to_53 + 1}.half() == 4503599627370496.5);
  CHECK(Time{two_to_53 * 4 + 2}.half() == Time{two_to_53 * 2 + 1});
  CHECK(Time{latest}.half() == 9223372036854775808.0);
  CHECK(Time{least}.half() == Time{least / 2});
  CHECK(Time{1e308}.half() == 5e307);
}

TEST_CASE("a list of times has what was put in, before and after the first one that is no double", "[engine][time]") {
  const std::vector<Time> times{0.5, 3, -1e300, Time{two_to_53 + 1}, Time{latest}, 2};
  for (std::size_t first = 0; first < times.size(); ++first) {
    TimeList list;
    for (std::size_t k = first; k < times.size(); ++k) {
      list.push_back(times[k]);
      REQUIRE(list.size() == k - first + 1);
      CHECK(list.back() == times[k]);
      for (std::size_t at = 0; at < list.size(); ++at) {
        CHECK(list[at] == times[first + at]);
      }
    }
    list.copy(list.size() - 1, 0);
    list.truncate(1);
    CHECK(list.size() == 1);
    CHECK(list.back() == 2);
  }
}

}  // namespace
}  // namespace sesame

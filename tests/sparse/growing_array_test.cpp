#include "sparse/growing_array.hpp"

#include <memory>
#include <utility>
#include <vector>

#include "sparse/integer.hpp"
#include "tests/sparse/dense.hpp"
#include "tests/support/catch.hpp"

using namespace sesame::sparse;

namespace {

struct Marked {
  std::uint32_t mark = 7;
};

}  // namespace

TEST_CASE("GrowingArray: does what a vector does", "[sparse][twin]") {
  Random random{GENERATE(range(0u, 8u))};
  const Integer large = Integer{INT64_MAX} * Integer{INT64_MAX};  // owns memory
  GrowingArray<Integer> array;
  std::vector<Integer> twin;
  for (int step = 0; step < 2000; ++step) {
    switch (below(random, 12)) {
      case 0:
        if (!twin.empty()) {
          array.pop_back();
          twin.pop_back();
        }
        break;
      case 1: {
        const std::size_t size = below(random, static_cast<Index>(twin.size()) + 1);
        if (below(random, 20) == 0) {
          array.truncate(size);
          twin.resize(size);
        }
        break;
      }
      case 2: {
        const std::size_t size = twin.size() + below(random, 5);
        array.resize(size);
        twin.resize(size);
        break;
      }
      case 3:
        below(random, 2) == 0 ? array.reserve(below(random, 300)) : array.shrink_to_fit();
        break;
      case 4: {
        GrowingArray<Integer> moved{std::move(array)};
        array = std::move(moved);
        break;
      }
      default: {
        const Integer element = below(random, 3) == 0 ? large + Integer{step} : Integer{step};
        array.push_back(element);
        twin.push_back(element);
        if (array.size() > 1) {
          array.push_back(array[0]);  // its own element, while it grows
          twin.push_back(Integer{twin[0]});
        }
      }
    }
    REQUIRE(array.size() == twin.size());
    REQUIRE(array.empty() == twin.empty());
    REQUIRE(array.capacity() >= array.size());
    REQUIRE(std::equal(twin.begin(), twin.end(), array.begin(), array.end()));
    if (!twin.empty()) {
      REQUIRE(array.back() == twin.back());
    }
  }
}

TEST_CASE("GrowingArray: new elements are as their type has them by default", "[sparse]") {
  GrowingArray<Marked> array{{1}, {2}};
  array.resize(4);
  CHECK(array[1].mark == 2);
  CHECK(array[3].mark == 7);
  array.shrink_to_fit();
  CHECK(array.capacity() == 4);
  array.truncate(0);
  array.shrink_to_fit();
  CHECK(array.capacity() == 0);
  CHECK(array.begin() == array.end());
}

TEST_CASE("GrowingArray: large blocks keep what is in them as they grow and shrink", "[sparse]") {
  constexpr std::size_t of_pages = least_bytes_of_pages / sizeof(std::uint64_t);
  GrowingArray<std::uint64_t> array;
  const auto check = [&array] {
    for (std::size_t k = 0; k < array.size(); ++k) {
      if (array[k] != k * k) {
        FAIL("element " << k << " of " << array.size() << " is " << array[k]);
      }
    }
  };
  for (std::uint64_t k = 0; k < 5 * of_pages; ++k) {  // by doubling, across the limit
    array.push_back(k * k);
  }
  check();
  for (const std::size_t size : {3 * of_pages, of_pages + 1, of_pages, of_pages - 1, std::size_t{10}}) {
    array.truncate(size);
    array.shrink_to_fit();
    CHECK(array.capacity() == size);
    check();
  }
  array.reserve(2 * of_pages);
  check();
  GrowingArray<std::uint64_t> other{std::move(array)};
  other.reserve(4 * of_pages);
  array = std::move(other);
  CHECK(array.size() == 10);
  check();
}

TEST_CASE("GrowingArray: more than there can be is no memory, and nothing is lost", "[sparse]") {
  GrowingArray<std::uint64_t> array{5};
  CHECK_THROWS_AS(array.reserve(SIZE_MAX / 2), std::bad_alloc);
  CHECK(array.size() == 1);
  CHECK(array[0] == 5);
  array.reserve(least_bytes_of_pages);
  CHECK_THROWS_AS(array.reserve(SIZE_MAX / 32), std::bad_alloc);
  CHECK(array[0] == 5);
}

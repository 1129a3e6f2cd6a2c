#include "sparse/entry_pool.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "tests/sparse/dense.hpp"
#include "tests/support/catch.hpp"

using namespace sesame::sparse;

namespace {

/// A run of entries, and what it should hold.
template <class Entry>
struct Run {
  std::uint32_t position;
  const Entry* address;
  std::vector<Entry> entries;
};

template <class Entry>
bool holds(const EntryPool<Entry>& pool, const Run<Entry>& run) {
  return pool.at(run.position) == run.address && std::equal(run.entries.begin(), run.entries.end(), run.address);
}

std::uint32_t random_length(Random& random) {
  return below(random, 20) == 0 ? 1 + below(random, 10'000) : 1 + below(random, 40);
}

}  // namespace

TEMPLATE_TEST_CASE("EntryPool: a run keeps its place and its entries until it is released", "[sparse][twin]",
                   std::uint64_t, std::string) {
  Random random{GENERATE(range(0u, 10u))};
  const auto entry = [&] {
    if constexpr (std::is_same_v<TestType, std::string>) {
      return "an entry that owns memory: " + std::to_string(random());
    } else {
      return TestType{random()};
    }
  };
  EntryPool<TestType> pool;
  std::vector<Run<TestType>> runs;
  for (int step = 0; step < 300; ++step) {
    if (runs.empty() || below(random, 5) < 3) {
      Run<TestType> run;
      const std::uint32_t length = random_length(random);
      run.position = pool.allocate(length);
      run.address = pool.at(run.position);
      for (std::uint32_t k = 0; k < length; ++k) {
        run.entries.push_back(entry());
        pool.at(run.position)[k] = run.entries.back();
      }
      runs.push_back(std::move(run));
    } else {
      const bool youngest = below(random, 2) == 0;
      const auto at = youngest ? runs.end() - 1 : runs.begin() + below(random, static_cast<Index>(runs.size()));
      REQUIRE(holds(pool, *at));
      pool.release(at->position, static_cast<std::uint32_t>(at->entries.size()));
      runs.erase(at);
    }
  }
  for (const Run<TestType>& run : runs) {
    CHECK(holds(pool, run));
  }
  EntryPool<TestType> other;
  other.swap(pool);
  for (const Run<TestType>& run : runs) {
    CHECK(holds(other, run));
  }
}

TEST_CASE("EntryPool: the room of the youngest run is used again, that of others is wasted", "[sparse]") {
  EntryPool<int> pool;
  const auto first = pool.allocate(5), second = pool.allocate(5);
  pool.release(second, 5);
  CHECK(pool.allocate(5) == second);
  CHECK(pool.wasted() == 0);
  pool.release(first, 5);
  CHECK(pool.wasted() == 5);
  CHECK(pool.allocate(5) != first);
}

TEST_CASE("EntryPool: the end of a run is released like a run", "[sparse]") {
  EntryPool<int> pool;
  const auto run = pool.allocate(10);
  pool.at(run)[3] = 7;
  pool.release(run + 4, 6);
  CHECK(pool.wasted() == 0);
  CHECK(pool.allocate(3) == run + 4);
  CHECK(pool.at(run)[3] == 7);
}

#include "sparse/hash_index.hpp"

#include <map>
#include <vector>

#include "tests/sparse/dense.hpp"
#include "tests/support/catch.hpp"

using namespace sesame::sparse;

TEST_CASE("HashIndex: finds what a map from keys finds, whatever was erased", "[sparse][twin]") {
  Random random{GENERATE(range(0u, 10u))};
  // Few different hashes let runs of entries meet and share one hash; all of them make the table grow.
  const Index hashes = GENERATE(1u, 7u, 1000u);
  const auto hash_of = [&](std::uint64_t key) { return spread_bits(key % hashes); };
  HashIndex index;
  std::vector<std::uint64_t> keys;              // per number
  std::map<std::uint64_t, std::uint32_t> twin;  // key to number
  const auto find = [&](std::uint64_t key) {
    return index.find(hash_of(key), [&](std::uint32_t number) { return keys[number] == key; });
  };
  for (int step = 0; step < 600; ++step) {
    const std::uint64_t key = below(random, 300);
    const auto found = twin.find(key);
    REQUIRE(find(key) == (found == twin.end() ? HashIndex::nothing : found->second));
    const auto insert_new = [&] {
      return index.insert_new(hash_of(key), static_cast<std::uint32_t>(keys.size() - 1),
                              [&](std::uint32_t number) { return keys[number] == key; });
    };
    if (found == twin.end()) {
      keys.push_back(key);
      const auto number = static_cast<std::uint32_t>(keys.size() - 1);
      if (below(random, 2) == 0) {
        index.insert(hash_of(key), number);
      } else {
        REQUIRE(insert_new());
      }
      twin.emplace(key, number);
    } else if (below(random, 4) == 0) {
      REQUIRE(!insert_new());
    } else if (below(random, 3) != 0) {
      index.erase(hash_of(key), found->second);
      twin.erase(found);
    }
    REQUIRE(index.size() == twin.size());
  }
  for (std::uint64_t key = 0; key < 300; ++key) {
    const auto found = twin.find(key);
    CHECK(find(key) == (found == twin.end() ? HashIndex::nothing : found->second));
  }
}

TEST_CASE("HashIndex: many numbers are in many tables, also under hashes that are hardly spread", "[sparse][twin]") {
  constexpr std::uint32_t numbers = 150'000;
  const std::uint64_t hashes = GENERATE(UINT64_MAX, std::uint64_t{20'000});
  const auto hash_of = [&](std::uint32_t number) {
    return spread_bits(number % hashes) >> (hashes == UINT64_MAX ? 0 : 9);
  };
  const bool is_reserved = GENERATE(false, true);
  HashIndex index;
  if (is_reserved) {
    index.reserve(numbers);
  }
  const auto is_there = [&](std::uint32_t number) {
    return index.find(hash_of(number), [&](std::uint32_t each) { return each == number; }) == number;
  };
  for (std::uint32_t number = 0; number < numbers; ++number) {
    index.insert(hash_of(number), number);
  }
  REQUIRE(index.size() == numbers);
  std::uint32_t found = 0;
  for (std::uint32_t number = 0; number < numbers; ++number) {
    found += is_there(number) ? 1 : 0;
  }
  CHECK(found == numbers);
  for (std::uint32_t number = 0; number < numbers; number += 2) {
    index.erase(hash_of(number), number);
  }
  CHECK(index.size() == numbers / 2);
  found = 0;
  for (std::uint32_t number = 0; number < numbers; ++number) {
    found += is_there(number) == (number % 2 == 1) ? 1 : 0;
  }
  CHECK(found == numbers);
}

TEST_CASE("HashIndex: an empty one holds nothing, and holds nothing again when all is erased", "[sparse]") {
  HashIndex index;
  const auto any = [](std::uint32_t) { return true; };
  CHECK(index.find(0, any) == HashIndex::nothing);
  index.insert(0, 5);
  CHECK(index.find(0, any) == 5);
  index.erase(0, 5);
  CHECK(index.find(0, any) == HashIndex::nothing);
  CHECK(index.size() == 0);
}

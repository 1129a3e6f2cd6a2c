#include "ops/vocabulary/cell_list.hpp"

#include <string>
#include <vector>

#include "ops/vocabulary/name_lists.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/cell_lists.hpp"
#include "tests/support/random_complexes.hpp"

namespace sesame::ops {
namespace {

using tests::Random;
using PlainList = std::vector<std::string>;

PlainList random_names(Random& random) {
  PlainList names;
  const int count = random.one_in(50) ? random.in(0, 3000) : random.in(0, 5);
  for (int k = 0; k < count; ++k) {
    // Lengths on both sides of what one byte says, and now and then of a page.
    const int length = random.one_in(400) ? random.in(100'000, 400'000) : random.in(0, random.one_in(8) ? 300 : 12);
    names.emplace_back(static_cast<std::size_t>(length), static_cast<char>(random.in(-128, 127)));
  }
  return names;
}

PlainList plain_list(NameLists::List list) { return {list.begin(), list.end()}; }

TEST_CASE("lists of names are those that were given, whatever their lengths", "[ops]") {
  for (unsigned seed = 0; seed < 6; ++seed) {
    Random random(seed);
    NameLists lists;
    std::vector<PlainList> plain;
    for (int k = 0; k < 1000; ++k) {
      plain.push_back(random_names(random));
      lists.push_back(plain.back());
    }
    const NameLists copy = lists;
    lists.add("more");  // to the last one
    REQUIRE(lists.size() == plain.size());
    REQUIRE(copy.size() == plain.size());
    for (std::size_t k = 0; k < plain.size(); ++k) {
      REQUIRE(plain_list(copy[k]) == plain[k]);
      REQUIRE(copy[k].size() == plain[k].size());
      REQUIRE(copy[k].empty() == plain[k].empty());
      if (!plain[k].empty()) {
        REQUIRE(copy[k].front() == plain[k].front());
        REQUIRE(plain_list(copy[k].without_first()) == PlainList(plain[k].begin() + 1, plain[k].end()));
      }
    }
    plain.back().emplace_back("more");
    CHECK(plain_list(lists[lists.size() - 1]) == plain.back());
    lists.clear();
    CHECK(lists.empty());
    lists.push_back({"a", "b"});
    CHECK(plain_list(lists[0]) == PlainList{"a", "b"});
  }
}

TEST_CASE("a list of cells says of each what was said", "[ops]") {
  Random random(7);
  std::vector<ListedCell> plain;
  for (int k = 0; k < 2000; ++k) {
    ListedCell& cell = plain.emplace_back(ListedCell{"c" + std::to_string(k), {}, random_names(random), {}});
    if (random.one_in(3)) {
      cell.type.emplace();
      for (int n = random.in(0, 3); n > 0; --n) {
        cell.type->push_back(random.in(1, 3));
      }
    }
    if (random.one_in(5)) {
      cell.at = Point{0.5 * k, -1, 1e300};
    }
  }
  const auto check = [](const ListedCell& one, const ListedCell& other) {
    REQUIRE(one.id == other.id);
    REQUIRE(one.type == other.type);
    REQUIRE(one.faces == other.faces);
    REQUIRE(one.at == other.at);
  };
  const CellList cells(plain);
  const CellList backwards = reversed(cells);
  REQUIRE(cells.size() == plain.size());
  REQUIRE(backwards.size() == plain.size());
  std::size_t k = 0;
  for (const ListedCell& cell : cells) {
    check(cell, plain[k]);
    check(backwards[plain.size() - 1 - k], plain[k]);
    CHECK(cells.id(k) == plain[k].id);
    CHECK((cells.type(k) != nullptr) == plain[k].type.has_value());
    CHECK((cells.at(k) != nullptr) == plain[k].at.has_value());
    CHECK(plain_list(cells.faces(k)) == plain[k].faces);
    ++k;
  }
  CHECK(k == plain.size());
  CHECK(CellList{}.empty());
}

}  // namespace
}  // namespace sesame::ops

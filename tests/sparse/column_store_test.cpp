#include "sparse/column_store.hpp"

#include <map>

#include "tests/sparse/dense.hpp"
#include "tests/support/catch.hpp"

using namespace sesame::sparse;

namespace {

/// Columns as maps from rows to integers: the plainest twin.
struct Twin {
  Index rows = 0, columns = 0;
  std::map<Index, std::map<Index, std::int64_t>> stored;

  /// The rows from `from` on of a random column.
  std::map<Index, std::int64_t> random_column(Random& random, Index from = 0) const {
    std::map<Index, std::int64_t> column;
    for (Index i = from; i < rows; ++i) {
      if (below(random, 3) == 0) {
        column[i] = 1 + below(random, 2);
      }
    }
    return column;
  }
  /// The first row below all entries of a column.
  Index below_column(Index j) const {
    const auto column = stored.find(j);
    return column == stored.end() || column->second.empty() ? 0 : column->second.rbegin()->first + 1;
  }
};

template <Ring R>
Terms<R> terms_of(const R& ring, const std::map<Index, std::int64_t>& column) {
  Terms<R> terms;
  for (const auto& [row, value] : column) {
    if (!ring.is_zero(ring.from(value))) {
      terms.push_back({row, ring.from(value)});
    }
  }
  return terms;
}

template <Ring R>
void check_equal(const ColumnStore<R>& store, const Twin& twin) {
  REQUIRE(store.rows() == twin.rows);
  REQUIRE(store.columns() == twin.columns);
  std::vector<Index> stored, visited;
  std::size_t entries = 0;
  for (Index j = 0; j < twin.columns; ++j) {
    const auto column = twin.stored.find(j);
    const bool is_stored = column != twin.stored.end();
    const Terms<R> expected = is_stored ? terms_of(store.ring(), column->second) : Terms<R>{};
    Terms<R> seen;
    REQUIRE(store.is_stored(j) == is_stored);
    REQUIRE(store.for_each_in_column(j, [&](const Term<R>& entry) { seen.push_back(entry); }) == is_stored);
    REQUIRE(seen == expected);
    REQUIRE(store.column(j) == expected);
    for (const Term<R>& entry : expected) {
      REQUIRE(store.entry(entry.index, j) == entry.coefficient);
    }
    entries += expected.size();
    if (is_stored) {
      stored.push_back(j);
    }
  }
  REQUIRE(store.stored() == stored);
  store.for_each_stored([&](Index j) { visited.push_back(j); });
  std::sort(visited.begin(), visited.end());
  REQUIRE(visited == stored);
  REQUIRE(store.stored_columns() == stored.size());
  REQUIRE(store.stored_entries() == entries);
}

}  // namespace

TEMPLATE_TEST_CASE("ColumnStore: equals maps of maps through any history", "[sparse][stream]", Integers, Z2, Zp) {
  const auto ring = sample_ring<TestType>();
  Random random{GENERATE(range(0u, 10u))};
  Twin twin{8, below(random, 40), {}};
  ColumnStore<TestType> store(ring, twin.rows, twin.columns);
  const auto terms = [&](const auto& column) { return terms_of(ring, column); };
  for (int step = 0; step < 400; ++step) {
    const Index j = twin.columns == 0 ? 0 : below(random, twin.columns);
    const auto column = twin.random_column(random);
    switch (twin.columns == 0 ? 6u : below(random, 10)) {
      case 0:
      case 1:
        store.set_column(j, terms(column));
        twin.stored[j] = column;
        break;
      case 2:
        store.forget_column(j);
        twin.stored.erase(j);
        break;
      case 3:
        store.add_to_column(j, ring.from(3), terms(column));
        for (const auto& [row, value] : column) {
          twin.stored[j][row] += 3 * value;
        }
        twin.stored.try_emplace(j);
        break;
      case 4:
      case 5:
        store.append_rows(1);
        twin.rows += 1;
        if (const auto more = twin.random_column(random, twin.below_column(j)); !terms(more).empty()) {
          store.extend_column(j, terms(more));
          twin.stored[j].insert(more.begin(), more.end());
        }
        break;
      case 6:
      case 7:
        store.append_column(terms(column));
        twin.stored[twin.columns++] = column;
        break;
      case 8:
        store.append_columns(1);
        twin.columns += 1;
        break;
      default:
        if (below(random, 5) == 0) {
          twin.columns -= below(random, twin.columns);
          twin.stored.erase(twin.stored.lower_bound(twin.columns), twin.stored.end());
          twin.rows = 8;
          for (const auto& [k, kept] : twin.stored) {
            twin.rows = std::max(twin.rows, twin.below_column(k));
          }
          store.truncate(twin.rows, twin.columns);
        }
    }
    check_equal(store, twin);
  }
  const ColumnStore<TestType> copy = store;
  check_equal(copy, twin);
  ColumnStore<TestType> moved = std::move(store);
  check_equal(moved, twin);
  check_equal(store, Twin{});  // NOLINT(bugprone-use-after-move): promised to be empty
  moved.scale(ring.from(-1));
  for (auto& [j, column] : twin.stored) {
    for (auto& [row, value] : column) {
      value = -value;
    }
  }
  check_equal(moved, twin);
}

TEST_CASE("ColumnStore: columns grow without a move of what is there", "[sparse]") {
  ColumnStore<Integers> store(Integers{}, 0, 0);
  std::vector<const void*> places;
  for (Index j = 0; j < 2000; ++j) {
    store.append_rows(1);
    store.append_column(Terms<Integers>{{j, 1}});
    store.for_each_in_column(j, [&](const Term<Integers>& entry) { places.push_back(&entry); });
  }
  for (Index j = 0; j < 2000; ++j) {
    store.append_rows(1);
    store.extend_column(j, Terms<Integers>{{2000 + j, 5}});
    std::vector<const void*> now;
    store.for_each_in_column(j, [&](const Term<Integers>& entry) { now.push_back(&entry); });
    REQUIRE(now.size() == 2);
    REQUIRE(now.front() == places[j]);
  }
}

TEST_CASE("ColumnStore: places that are not there are contract breaches", "[sparse]") {
  ColumnStore<Integers> store({}, 2, 3);
  const Terms<Integers> low{{2, 1}};
  CHECK_THROWS_AS(store.set_column(3, {}), ContractViolation);
  CHECK_THROWS_AS(store.set_column(0, low), ContractViolation);
  CHECK_THROWS_AS(store.extend_column(0, low), ContractViolation);
  CHECK_THROWS_AS(store.extend_column(0, {}), ContractViolation);
  CHECK_THROWS_AS(store.append_column(low), ContractViolation);
  CHECK_THROWS_AS(store.truncate(3, 3), ContractViolation);
}

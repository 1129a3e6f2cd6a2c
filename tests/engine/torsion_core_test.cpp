#include "engine/right/torsion_core.hpp"

#include <set>

#include "tests/support/catch.hpp"
#include "tests/support/random_complexes.hpp"

using namespace sesame;
using namespace sesame::tests;
using engine::no_symbol;
using engine::Symbol;
using engine::TorsionCore;

namespace {

/// The same as two maps, copied whole where the core would be undone.
template <Ring R>
struct PlainCore {
  std::map<Symbol, Terms<R, Symbol>> columns;
  std::map<Symbol, Symbol> owners;  ///< by row

  [[nodiscard]] bool owns(Symbol x) const {
    const auto column = columns.find(x);
    const auto owner = column == columns.end() ? owners.end() : owners.find(column->second.back().index);
    return owner != owners.end() && owner->second == x;
  }
  void set(Symbol x, const Terms<R, Symbol>& column) {
    if (owns(x) && (column.empty() || column.back().index != columns[x].back().index)) {
      owners.erase(columns[x].back().index);
    }
    columns.erase(x);
    if (!column.empty()) {
      columns.emplace(x, column);
    }
  }
};

constexpr int symbols = 8;

template <Ring R>
void require_same(const TorsionCore<R>& core, const PlainCore<R>& plain) {
  REQUIRE(core.columns() == plain.columns);
  for (Symbol x = 0; x < symbols; ++x) {
    CAPTURE(x);
    const auto column = plain.columns.find(x);
    REQUIRE((core.find(x) == nullptr) == (column == plain.columns.end()));
    std::vector<Symbol> with_row;
    for (const auto& [z, terms] : plain.columns) {
      if (std::any_of(terms.begin(), terms.end(), [x](const auto& term) { return term.index == x; })) {
        with_row.push_back(z);
      }
    }
    REQUIRE(core.columns_with_row(x) == with_row);
    const auto owner = plain.owners.find(x);
    REQUIRE(core.pivot_owner(x) == (owner == plain.owners.end() ? no_symbol : owner->second));
  }
}

}  // namespace

TEMPLATE_TEST_CASE("TorsionCore: columns, rows and pivots are what two maps say, through undo", "[engine][twin]",
                   Integers, Zp) {
  using R = TestType;
  const R ring = test_ring<R>();
  Random random{GENERATE(range(0U, 10U))};
  TorsionCore<R> core;
  PlainCore<R> plain;
  std::vector<std::pair<std::size_t, PlainCore<R>>> marks;
  for (int step = 0; step < 300; ++step) {
    const auto x = Symbol{static_cast<unsigned>(random.in(0, symbols - 1))};
    switch (random.in(0, 5)) {
      case 0:
      case 1:
      case 2: {
        std::vector<Entry> entries;
        for (int k = random.in(0, 3); k > 0; --k) {
          entries.emplace_back(random.in(0, symbols - 1), random.in(-3, 3));
        }
        const Terms<R, Symbol> column = terms_of<Symbol>(ring, entries);
        const bool is_same = plain.columns.contains(x) ? plain.columns[x] == column : column.empty();
        const std::uint64_t version = core.version();
        core.set(x, column);
        plain.set(x, column);
        REQUIRE((core.version() == version) == is_same);
        break;
      }
      case 3: {
        if (plain.columns.contains(x)) {
          const Symbol row = plain.columns[x].back().index;
          if (const Symbol owner = core.pivot_owner(row); owner != no_symbol && owner != x) {
            core.release_pivot(owner);
          }
          core.own_pivot(x);
          plain.owners[row] = x;
        }
        break;
      }
      case 4: {
        marks.emplace_back(core.mark(), plain);
        break;
      }
      default: {
        if (!marks.empty()) {
          core.undo(marks.back().first);
          plain = marks.back().second;
          marks.pop_back();
        }
      }
    }
    require_same(core, plain);
  }
}

TEST_CASE("TorsionCore: a column keeps its pivot while its last row stays, and a pivot that is released is free",
          "[engine]") {
  TorsionCore<Integers> core;
  core.set(9, {{1, 2}, {4, 6}});
  core.own_pivot(9);
  core.set(9, {{4, 5}});
  CHECK(core.pivot_owner(4) == 9);
  core.set(9, {{1, 2}});
  CHECK(core.pivot_owner(4) == no_symbol);
  CHECK(core.pivot_owner(1) == no_symbol);
  core.own_pivot(9);
  core.release_pivot(9);
  CHECK(core.pivot_owner(1) == no_symbol);
  core.undo(0);
  CHECK(core.columns().empty());
}

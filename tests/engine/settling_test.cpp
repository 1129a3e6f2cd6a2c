#include "engine/right/settling.hpp"

#include "sparse/smith.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/rewriting.hpp"

using namespace sesame;
using namespace sesame::tests;
using engine::Effort;
using engine::Rules;
using engine::Settling;
using engine::Symbol;

namespace {

/// Columns of degree 1 over rows of degree 0, and the matrix of all of them as they were given.
template <Ring R>
struct Presentation {
  explicit Presentation(const R& k, Index rows) : ring{k}, given(k, rows, 0) {
    for (Index r = 0; r < rows; ++r) {
      rules.append_generator(0);
    }
  }

  R ring;
  Matrix<R> given;
  Rules<R> rules{ring};
  Effort effort;
  Settling<R> settling{ring, rules, effort};

  Symbol add(const std::vector<Entry>& entries) {
    const ChainOfS<R> column = terms_of<Symbol>(ring, entries);
    given.append_column(terms_of(ring, entries));
    const Symbol x = rules.append_generator(1);
    if (const ChainOfS<R> image = rewritten(ring, rules, column); !image.empty()) {
      settling.place(x, image);
      settling.settle();
    }
    return x;
  }
  [[nodiscard]] Matrix<R> core() const {
    Matrix<R> matrix(ring, rules.next_symbol(), 0);
    for (const auto& [x, column] : settling.core().columns()) {
      Terms<R> on_rows;
      for (const auto& [row, coefficient] : column) {
        on_rows.push_back({row, coefficient});
      }
      matrix.append_column(on_rows);
    }
    return matrix;
  }
  [[nodiscard]] std::size_t eliminations() const {
    std::size_t count = 0;
    for (engine::RuleId rule = 0; rule < rules.size(); ++rule) {
      count += rules[rule].b != engine::no_symbol ? 1 : 0;
    }
    return count;
  }
};

std::vector<Integer> factors_above_one(const Matrix<Integers>& matrix) {
  std::vector<Integer> factors = sparse::invariant_factors(matrix);
  std::erase_if(factors, [](const Integer& factor) { return factor == 1; });
  return factors;
}

/// What a column of the core may look like when it is settled: a unit in it is not mild.
bool has_mild_unit(const ChainOfS<Integers>& column) {
  const bool has_unit =
      std::any_of(column.begin(), column.end(), [](const auto& t) { return t.coefficient.is_unit(); });
  const bool is_small =
      std::all_of(column.begin(), column.end(), [](const auto& t) { return sparse::abs(t.coefficient) <= Integer{3}; });
  return has_unit && (column.size() <= 2 || is_small);
}

void require_lawful(const Presentation<Integers>& live) {
  const Matrix<Integers> core = live.core();
  REQUIRE(factors_above_one(core) == factors_above_one(live.given));
  const std::size_t rank = sparse::invariant_factors(live.given).size();
  REQUIRE(sparse::invariant_factors(core).size() + live.eliminations() == rank);
  REQUIRE(live.rules.small(0).size() + live.eliminations() == live.given.rows());
  REQUIRE(live.rules.small(1).size() + live.eliminations() == live.given.columns());
  for (const auto& [x, column] : live.settling.core().columns()) {
    REQUIRE(live.rules.removed_by(x) == engine::no_rule);
    REQUIRE_FALSE(has_mild_unit(column));
    for (const auto& term : column) {
      REQUIRE(live.rules.removed_by(term.index) == engine::no_rule);
    }
  }
}

std::vector<Entry> any_column(Random& random, Index rows) {
  std::vector<Entry> entries;
  for (int k = random.in(1, 4); k > 0; --k) {
    entries.emplace_back(random.in(0, static_cast<int>(rows) - 1), random.in(-6, 6));
  }
  return entries;
}

}  // namespace

TEST_CASE("Settling: over Z the core and the eliminations keep rank and torsion of what was given, through undo",
          "[engine][law]") {
  Random random{GENERATE(range(0U, 20U))};
  constexpr Index rows = 8;
  Presentation<Integers> live{Integers{}, rows};
  struct Moment {
    Rules<Integers>::Mark rules;
    std::size_t journal;
    Matrix<Integers> given;
    std::map<Symbol, ChainOfS<Integers>> columns;
  };
  std::vector<Moment> moments;
  for (int step = 0; step < 40; ++step) {
    if (random.one_in(5)) {
      const auto& core = live.settling.core();
      moments.push_back({live.rules.mark(), live.settling.mark(), live.given, core.columns()});
    } else if (!moments.empty() && random.one_in(5)) {
      live.settling.undo(moments.back().journal);
      live.rules.undo(moments.back().rules);
      live.given = moments.back().given;
      REQUIRE(live.settling.core().columns() == moments.back().columns);
      moments.pop_back();
    } else {
      live.add(any_column(random, rows));
    }
    require_lawful(live);
  }
}

TEST_CASE("Settling: over a field each boundary goes with its youngest symbol, and no core is left", "[engine][law]") {
  Random random{GENERATE(range(0U, 5U))};
  constexpr Index rows = 8;
  Presentation<Zp> live{test_ring<Zp>(), rows};
  for (int step = 0; step < 12; ++step) {
    const std::vector<Entry> entries = any_column(random, rows);
    const ChainOfS<Zp> image = rewritten(live.ring, live.rules, terms_of<Symbol>(live.ring, entries));
    const Symbol x = live.add(entries);
    REQUIRE((live.rules.removed_by(x) == engine::no_rule) == image.empty());
    if (!image.empty()) {
      REQUIRE(live.rules[live.rules.removed_by(x)].a == image.back().index);
    }
    REQUIRE(live.settling.core().columns().empty());
  }
  CHECK(live.eliminations() == sparse::invariant_factors(live.given).size());
}

TEST_CASE("Settling: 2 and 3 in one row or in one column become a unit, 4 and 6 become 2", "[engine]") {
  Presentation<Integers> row{Integers{}, 1};
  row.add({{0, 2}});
  CHECK(row.settling.core().columns().size() == 1);
  row.add({{0, 3}});
  CHECK(row.settling.core().columns().empty());
  CHECK(row.rules.small(0).empty());
  CHECK(row.rules.small(1).size() == 1);

  Presentation<Integers> column{Integers{}, 2};
  column.add({{0, 2}, {1, 3}});
  CHECK(column.settling.core().columns().empty());
  CHECK(column.rules.small(0).size() == 1);

  Presentation<Integers> even{Integers{}, 1};
  even.add({{0, 4}});
  even.add({{0, 6}});
  REQUIRE(even.settling.core().columns().size() == 1);
  const ChainOfS<Integers>& left = even.settling.core().columns().begin()->second;
  REQUIRE(left.size() == 1);
  CHECK(sparse::abs(left.front().coefficient) == 2);
}

TEST_CASE("Settling: a unit among large entries stays, next to one other it goes", "[engine]") {
  Presentation<Integers> live{Integers{}, 3};
  const Symbol x = live.add({{0, 1}, {1, 50}, {2, 70}});
  REQUIRE(live.settling.core().find(x) != nullptr);
  Presentation<Integers> other{Integers{}, 2};
  const Symbol y = other.add({{0, 1}, {1, 50}});
  CHECK(other.settling.core().find(y) == nullptr);
  CHECK(rewritten(Integers{}, other.rules, {{0, 1}}) == ChainOfS<Integers>{{1, -50}});
}

TEST_CASE("Settling: a boundary that is extended adds up, and can lose its torsion", "[engine]") {
  Presentation<Integers> live{Integers{}, 2};
  const Symbol x = live.add({{0, 4}});
  live.settling.extend(x, {{0, 2}, {1, 6}});
  CHECK(*live.settling.core().find(x) == ChainOfS<Integers>{{0, 6}, {1, 6}});
  live.settling.extend(x, {{0, -6}, {1, -5}});
  live.settling.settle();
  CHECK(live.settling.core().columns().empty());
  CHECK(live.rules.small(0) == std::vector<Symbol>{0});
}

TEST_CASE("Settling: the partner of a unit leaves the columns of the degree above", "[engine]") {
  Rules<Integers> rules{Integers{}};
  Effort effort;
  Settling<Integers> settling{Integers{}, rules, effort};
  const Symbol x = rules.append_generator(1), y = rules.append_generator(1), z = rules.append_generator(2);
  settling.place(z, {{x, 2}, {y, -2}});
  settling.settle();
  const Symbol e = rules.append_generator(0);
  settling.extend(x, {{e, 1}});
  settling.extend(y, {{e, 1}});
  settling.settle();
  CHECK(rules.small(0).empty());
  CHECK(rules.small(1) == std::vector<Symbol>{y});
  CHECK(settling.core().columns() == std::map<Symbol, ChainOfS<Integers>>{{z, {{y, -2}}}});
}

TEST_CASE("Settling: what is consumed has no boundary any more, and undo gives it back", "[engine]") {
  Presentation<Integers> live{Integers{}, 2};
  const Symbol x = live.add({{0, 4}, {1, 6}});
  const auto mark = live.rules.mark();
  const std::size_t journal = live.settling.mark();
  const auto before = live.settling.core().columns();
  live.settling.consume(x);
  CHECK(live.settling.core().columns().empty());
  CHECK(live.rules.small(1).empty());
  CHECK(rewritten(Integers{}, live.rules, {{x, 1}}) == ChainOfS<Integers>{{x, 1}});
  live.settling.undo(journal);
  live.rules.undo(mark);
  CHECK(live.settling.core().columns() == before);
  CHECK(live.rules.small(1) == std::vector<Symbol>{x});
}

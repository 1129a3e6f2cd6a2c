#include "engine/right/rules.hpp"

#include <optional>

#include "tests/support/catch.hpp"
#include "tests/support/rewriting.hpp"

using namespace sesame;
using namespace sesame::tests;
using engine::GeneratorId;
using engine::no_rule;
using engine::no_symbol;
using engine::RuleId;
using engine::Rules;
using engine::Symbol;

namespace {

/// The same as plain lists, copied whole where Rules would be marked.
template <Ring R>
struct PlainRules {
  struct Row {
    int degree = 0;
    RuleId removed_by = no_rule, born = 0;
    GeneratorId generator = 0;
    bool is_small = true, is_combination = false, is_rewritten = false;
  };
  struct Rule {
    Symbol a, b;
    ChainOfS<R> value;
  };
  std::vector<Row> symbols;
  std::vector<Rule> rules;
  std::vector<Symbol> generators;
  std::vector<ChainOfS<R>> columns;

  void remove(Symbol x) {
    symbols[x].removed_by = static_cast<RuleId>(rules.size());
    symbols[x].is_small = false;
  }
  void eliminate(const R& ring, Symbol a, Symbol b, const ChainOfS<R>& column) {
    ChainOfS<R> value;
    for (const auto& [x, coefficient] : column) {
      if (x == a) {
        const auto factor = ring.negate(ring.inverse(coefficient));
        for (const auto& [y, other] : column) {
          if (y != a) {
            value.push_back({y, ring.multiply(factor, other)});
          }
        }
      }
    }
    remove(a);
    remove(b);
    symbols[a].is_rewritten = true;
    rules.push_back({a, b, value});
  }
  [[nodiscard]] std::vector<Symbol> small(int degree) const {
    std::vector<Symbol> small;
    for (Symbol x = 0; x < symbols.size(); ++x) {
      if (symbols[x].is_small && symbols[x].degree == degree) {
        small.push_back(x);
      }
    }
    return small;
  }
};

constexpr int degrees = 3;

template <Ring R>
void require_same(const Rules<R>& rules, const PlainRules<R>& plain) {
  REQUIRE(rules.size() == plain.rules.size());
  REQUIRE(rules.next_symbol() == plain.symbols.size());
  for (Symbol x = 0; x < plain.symbols.size(); ++x) {
    const auto& row = plain.symbols[x];
    CAPTURE(x);
    REQUIRE(rules.degree(x) == row.degree);
    REQUIRE(rules.removed_by(x) == row.removed_by);
    REQUIRE(rules.is_rewritten(x) == row.is_rewritten);
    REQUIRE(rules.born(x) == row.born);
    REQUIRE(rules.generator_in(x) == row.generator);
    REQUIRE((rules.combination(x) != nullptr) == row.is_combination);
  }
  for (RuleId id = 0; id < plain.rules.size(); ++id) {
    const auto value = rules.value(id);
    REQUIRE(rules[id].a == plain.rules[id].a);
    REQUIRE(rules[id].b == plain.rules[id].b);
    REQUIRE(ChainOfS<R>(value.begin(), value.end()) == plain.rules[id].value);
  }
  for (GeneratorId g = 0; g < plain.generators.size(); ++g) {
    REQUIRE(rules.symbol_of(g) == plain.generators[g]);
  }
  REQUIRE(rules.combinations().size() == plain.columns.size());
  for (std::size_t k = 0; k < plain.columns.size(); ++k) {
    REQUIRE(rules.combinations()[k].column == plain.columns[k]);
  }
  for (int p = 0; p < degrees; ++p) {
    const std::vector<Symbol> small = plain.small(p);
    REQUIRE(rules.small(p) == small);
    REQUIRE((static_cast<std::size_t>(p) < rules.small_counts().size()
                 ? rules.small_counts()[static_cast<std::size_t>(p)]
                 : 0) == small.size());
  }
}

/// Two different small symbols of a degree, or nothing.
std::optional<std::pair<Symbol, Symbol>> two_of(Random& random, const std::vector<Symbol>& small) {
  if (small.size() < 2) {
    return std::nullopt;
  }
  const int i = random.in(0, static_cast<int>(small.size()) - 1);
  const int j = random.in(0, static_cast<int>(small.size()) - 2);
  return std::pair{small[static_cast<std::size_t>(i)], small[static_cast<std::size_t>(j < i ? j : j + 1)]};
}

}  // namespace

TEMPLATE_TEST_CASE("Rules: symbols, rules and small lists are what plain lists say, through undo", "[engine][twin]",
                   Integers, Z2, Zp) {
  using R = TestType;
  const R ring = test_ring<R>();
  Random random{GENERATE(range(0U, 10U))};
  Rules<R> rules{ring};
  PlainRules<R> plain;
  std::vector<std::pair<typename Rules<R>::Mark, PlainRules<R>>> marks;
  for (int step = 0; step < 150; ++step) {
    const int p = random.in(0, degrees - 1);
    const std::vector<Symbol> small = rules.small(p);
    const std::uint64_t version = rules.version(), made = rules.terms_made();
    const auto now = static_cast<RuleId>(plain.rules.size());
    switch (random.in(0, 8)) {
      case 0:
      case 1:
      case 2: {
        plain.generators.push_back(rules.append_generator(p));
        plain.symbols.push_back({p, no_rule, now, GeneratorId{plain.generators.size() - 1}, true, false, false});
        break;
      }
      case 3:
      case 4: {
        const std::vector<Symbol> above = rules.small(p + 1);
        if (small.empty() || above.empty()) {
          break;
        }
        std::vector<Entry> entries;
        for (const Symbol x : small) {
          entries.emplace_back(x, random.in(-2, 2));
        }
        const Symbol a = small[static_cast<std::size_t>(random.in(0, static_cast<int>(small.size()) - 1))];
        std::erase_if(entries, [a](const Entry& entry) { return entry.first == a; });
        entries.emplace_back(a, -1);
        const ChainOfS<R> column = terms_of<Symbol>(ring, entries);
        REQUIRE(rules.eliminate(a, above.front(), column) == now);
        plain.eliminate(ring, a, above.front(), column);
        REQUIRE(rules.version() > version);
        REQUIRE(rules.terms_made() == made + column.size() - 1);
        break;
      }
      case 5: {
        if (const auto pair = two_of(random, small)) {
          const auto [x, y] = *pair;
          const ChainOfS<R> column = terms_of<Symbol>(ring, {{0, random.in(0, 2)}});
          const auto q = ring.from(std::int64_t{random.in(1, 4)});
          const Symbol z = rules.next_symbol();
          REQUIRE(rules.change_basis(x, q, y, column) == now);
          auto row = plain.symbols[x];
          row.is_combination = true;
          row.born = now;
          plain.symbols.push_back(row);
          plain.columns.push_back(column);
          plain.remove(x);
          plain.symbols[x].is_rewritten = true;
          plain.rules.push_back({x, no_symbol, {{y, q}, {z, ring.one()}}});
          REQUIRE(rules.combination(z)->made == z);
          REQUIRE(rules.combination(z)->x == x);
          REQUIRE(rules.combination(z)->y == y);
        }
        break;
      }
      case 6: {
        if (!small.empty()) {
          rules.consume(small.front());
          plain.symbols[small.front()].is_small = false;
          plain.rules.push_back({small.front(), no_symbol, {}});
        }
        break;
      }
      case 7: {
        marks.emplace_back(rules.mark(), plain);
        break;
      }
      default: {
        if (!marks.empty()) {
          rules.undo(marks.back().first);
          plain = marks.back().second;
          marks.pop_back();
          REQUIRE(rules.version() > version);
          REQUIRE(rules.terms_made() == made);
        }
      }
    }
    require_same(rules, plain);
  }
}

TEST_CASE("Rules: an elimination divides the rest of its column by minus the unit", "[engine]") {
  const Zp ring = Zp::make(7).value();
  Rules<Zp> rules{ring};
  const Symbol u = rules.append_generator(0), v = rules.append_generator(0), w = rules.append_generator(0);
  const Symbol e = rules.append_generator(1);
  const engine::RuleId rule = rules.eliminate(v, e, {{u, 2}, {v, 3}, {w, 6}});  // 3^-1 = 5
  const auto value = rules.value(rule);
  CHECK(rules[rule].inverse == 5);
  CHECK(ChainOfS<Zp>(value.begin(), value.end()) == ChainOfS<Zp>{{u, 4}, {w, 5}});
  std::vector<std::pair<GeneratorId, GeneratorId>> pairs;
  rules.for_each_pair([&pairs](GeneratorId a, GeneratorId b) { pairs.emplace_back(a, b); });
  const GeneratorId eliminated{1}, by{3};  // clang 14 fails on literals of ids in a list that a template takes
  CHECK(pairs == std::vector{std::pair{eliminated, by}});
}

TEST_CASE("Rules: the generator in a combination is the one that it replaces, however often", "[engine]") {
  Rules<Integers> rules{Integers{}};
  const Symbol x = rules.append_generator(1), y = rules.append_generator(1);
  rules.change_basis(x, 2, y, {});
  rules.change_basis(2, -1, y, {});
  CHECK(rules.small(1) == std::vector<Symbol>{y, 3});
  CHECK(rules.generator_in(3) == 0);
  // x = x' + 2 y, x' = x'' - y
  CHECK(rewritten(Integers{}, rules, {{x, 1}}) == ChainOfS<Integers>{{y, 1}, {3, 1}});
}

TEST_CASE("Rules: columns of combinations gain terms and lose them from a symbol on", "[engine]") {
  Rules<Integers> rules{Integers{}};
  const Symbol x = rules.append_generator(1), y = rules.append_generator(1);
  rules.change_basis(x, 1, y, {{y, 3}});
  rules.extend_column(0, {{10, 4}, {12, 5}});
  CHECK(rules.combinations()[0].column == ChainOfS<Integers>{{y, 3}, {10, 4}, {12, 5}});
  rules.cut_column(0, 11);
  CHECK(rules.combinations()[0].column == ChainOfS<Integers>{{y, 3}, {10, 4}});
}

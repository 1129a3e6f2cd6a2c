#include "engine/right/memos.hpp"

#include "tests/support/catch.hpp"
#include "tests/support/rewriting.hpp"

using namespace sesame;
using namespace sesame::tests;
using engine::Effort;
using engine::Lifts;
using engine::Memos;
using engine::Perturbations;
using engine::Rules;
using engine::Symbol;

namespace {

/// Memos of rules that no perturbation touches.
template <Ring R>
struct Rewriting {
  explicit Rewriting(const R& k) : ring{k} {}

  R ring;
  sparse::ColumnStore<R, engine::GeneratorId> boundary{ring, 0, 0};
  Rules<R> rules{ring};
  Perturbations<R> perturbations{ring, rules};
  engine::Dependents<R> dependents{boundary, rules, perturbations};
  Effort effort;
  Lifts<R> lifts{ring, boundary, rules, perturbations, dependents, effort};
  Memos<R> memos{ring, rules, perturbations, lifts, effort};

  ChainOfS<R> rewrite(const ChainOfS<R>& symbols) {
    ChainOfS<R> image;
    memos.rewrite(
        [&](auto visit) {
          for (const auto& [x, coefficient] : symbols) {
            visit(x, coefficient);
          }
        },
        image);
    return image;
  }
  struct Mark {
    typename Rules<R>::Mark rules;
    std::size_t memos;
  };
  Mark mark() {
    memos.begin_epoch();
    return {rules.mark(), memos.size()};
  }
  void undo(const Mark& mark) {
    rules.undo(mark.rules);
    memos.undo(mark.memos);
  }

  /// Eliminates a random pair, when there is one, by a random column.
  void eliminate_any(Random& random) {
    const std::vector<Symbol> small = rules.small(0), above = rules.small(1);
    if (small.empty() || above.empty()) {
      return;
    }
    const Symbol a = small[static_cast<std::size_t>(random.in(0, static_cast<int>(small.size()) - 1))];
    std::vector<Entry> entries{{a, 1}};
    for (int k = 0; k < 3; ++k) {
      const Symbol x = small[static_cast<std::size_t>(random.in(0, static_cast<int>(small.size()) - 1))];
      if (x != a) {
        entries.emplace_back(x, random.in(-2, 2));
      }
    }
    rules.eliminate(a, above.front(), terms_of<Symbol>(ring, entries));
  }
  [[nodiscard]] ChainOfS<R> any_chain(Random& random) const {
    std::vector<Entry> entries;
    for (int k = 0; k < 4 && rules.next_symbol() > 0; ++k) {
      entries.emplace_back(random.in(0, static_cast<int>(rules.next_symbol()) - 1), random.in(-3, 3));
    }
    return terms_of<Symbol>(ring, entries);
  }
};

/// A chain of `length` rules, each of which leads to the next: x0 -> x1 -> ... -> the last.
void make_chain(Rewriting<Integers>& live, Symbol length) {
  for (Symbol k = 0; k <= length; ++k) {
    live.rules.append_generator(0);
  }
  for (Symbol k = 0; k < length; ++k) {
    const Symbol b = live.rules.append_generator(1);
    live.rules.eliminate(k, b, {{k, 1}, {k + 1, -1}});
  }
}

}  // namespace

TEMPLATE_TEST_CASE("Memos: what chains are rewritten to is what rule after rule makes of them, through undo",
                   "[engine][twin]", Integers, Z2, Zp) {
  using R = TestType;
  Random random{GENERATE(range(0U, 10U))};
  Rewriting<R> live{test_ring<R>()};
  std::vector<typename Rewriting<R>::Mark> marks;
  for (int step = 0; step < 250; ++step) {
    switch (random.in(0, 7)) {
      case 0:
      case 1:
        live.rules.append_generator(random.in(0, 1));
        break;
      case 2:
      case 3:
        live.eliminate_any(random);
        break;
      case 4:
        marks.push_back(live.mark());
        break;
      case 5:
        if (!marks.empty()) {
          live.undo(marks.back());
          marks.pop_back();
        }
        break;
      default:
        const ChainOfS<R> chain = live.any_chain(random);
        REQUIRE(live.rewrite(chain) == rewritten(live.ring, live.rules, chain));
    }
  }
  for (Symbol x = 0; x < live.rules.next_symbol(); ++x) {
    const ChainOfS<R> unit{{x, live.ring.one()}};
    REQUIRE(live.rewrite(unit) == rewritten(live.ring, live.rules, unit));
  }
}

TEST_CASE("Memos: a long chain of rules is followed once, and its first memo is the answer from then on", "[engine]") {
  constexpr Symbol length = 20000;
  Rewriting<Integers> live{Integers{}};
  make_chain(live, length);
  CHECK(live.rewrite({{0, 5}}) == ChainOfS<Integers>{{length, 5}});
  CHECK(live.effort.terms_read() < 10 * length);
  const std::uint64_t before = live.effort.terms_read();
  CHECK(live.rewrite({{0, 1}}) == ChainOfS<Integers>{{length, 1}});
  CHECK(live.effort.terms_read() == before + 2);  // the symbol, and the term of its memo
}

TEST_CASE("Memos: those written since a moment are as they were then, and only they were kept for it", "[engine]") {
  Rewriting<Integers> live{Integers{}};
  make_chain(live, 10);
  (void)live.rewrite({{3, 1}});
  const auto mark = live.mark();
  const std::size_t kept = live.memos.size();
  (void)live.rewrite({{3, 1}});
  CHECK(live.memos.size() == kept);  // nothing had to be written
  const Symbol b = live.rules.append_generator(1);
  live.rules.append_generator(0);
  live.rules.eliminate(10, b, {{10, 1}, {live.rules.next_symbol() - 1, 2}});
  CHECK(live.rewrite({{3, 1}}) == ChainOfS<Integers>{{live.rules.next_symbol() - 1, -2}});
  CHECK(live.memos.size() > kept);
  live.undo(mark);
  CHECK(live.memos.size() == kept);
  CHECK(live.rewrite({{3, 1}}) == ChainOfS<Integers>{{10, 1}});
}

TEST_CASE("Memos: work that a budget cuts off is forgotten, and what comes after is right", "[engine]") {
  Rewriting<Integers> live{Integers{}};
  make_chain(live, 100);
  const auto mark = live.mark();
  live.effort.set_budget(GENERATE(0U, 1U, 50U, 150U, 250U));
  CHECK_THROWS_AS(live.rewrite({{0, 1}, {50, 1}}), engine::OverBudget);
  live.memos.drop_work();
  live.effort.set_budget(UINT64_MAX);
  live.undo(mark);
  CHECK(live.rewrite({{0, 1}, {7, 1}}) == ChainOfS<Integers>{{100, 2}});
}

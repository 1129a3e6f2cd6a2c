#include "engine/right/symbol.hpp"

#include <concepts>
#include <map>
#include <type_traits>

#include "engine/homology_tracker.hpp"
#include "engine/left/left_maps.hpp"
#include "engine/right/rewriter.hpp"
#include "engine/towers/bar_cycles.hpp"
#include "sparse/accumulator.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_complexes.hpp"

using namespace sesame;
using namespace sesame::tests;
using engine::GeneratorId;
using engine::InclusionId;
using engine::RuleId;
using engine::SmallId;
using engine::Symbol;
using ops::CellId;

namespace {

// ---- what is no mistake at run time, because it does not compile

template <class A, class B>
concept Comparable = requires(A a, B b) {
  a == b;
};
template <class A, class B>
concept Ordered = requires(A a, B b) {
  a < b;
};
template <class A, class B>
concept MixedUp = std::convertible_to<A, B> || std::convertible_to<B, A> || Comparable<A, B> || Ordered<A, B>;
/// No two of them.
template <class... Others>
constexpr bool are_kept_apart = true;
template <class A, class... Others>
constexpr bool are_kept_apart<A, Others...> = !(MixedUp<A, Others> || ...) && are_kept_apart<Others...>;

static_assert(are_kept_apart<CellId, ops::LinkId, GeneratorId, Symbol, RuleId, SmallId, InclusionId>);
static_assert(Comparable<Symbol, Symbol> && Ordered<Symbol, Symbol>);
static_assert(!are_kept_apart<CellId, Symbol, GeneratorId, Symbol>);  // so it can fail

template <class Id>
using Chain = Terms<Integers, Id>;
template <class Id>
using Sum = sparse::RawTerms<Integers, Id>;

static_assert(are_kept_apart<Chain<Index>, Chain<CellId>, Chain<GeneratorId>, Chain<Symbol>>);
static_assert(are_kept_apart<Sum<Index>, Sum<CellId>, Sum<GeneratorId>, Sum<Symbol>>);
static_assert(std::is_convertible_v<Chain<Symbol>, Sum<Symbol>> && !std::is_convertible_v<Chain<CellId>, Sum<Symbol>>);
static_assert(are_kept_apart<engine::CellChain, engine::SmallChain, engine::InclusionChain>);

template <class Id>
concept RewrittenToS = requires(engine::Rewriter<Integers>& right, Chain<Id> chain) {
  { right.rewrite(chain) } -> std::same_as<Chain<Symbol>>;
};
template <class Id>
concept LiftedToB = requires(engine::Rewriter<Integers>& right, Chain<Id> chain) {
  { right.lift(chain) } -> std::same_as<Chain<GeneratorId>>;
};
template <class Id>
concept MappedToCells = requires(const engine::LeftMaps<Integers>& left, Chain<Id> chain) {
  { left.f(chain) } -> std::same_as<Chain<CellId>>;
};

static_assert(RewrittenToS<GeneratorId> && !RewrittenToS<Symbol> && !RewrittenToS<CellId> && !RewrittenToS<Index>);
static_assert(LiftedToB<Symbol> && !LiftedToB<GeneratorId> && !LiftedToB<CellId> && !LiftedToB<Index>);
static_assert(MappedToCells<GeneratorId> && !MappedToCells<Symbol> && !MappedToCells<CellId> && !MappedToCells<Index>);

}  // namespace

// ---- chains in ids

TEMPLATE_TEST_CASE("symbol: chains in ids add up as a map of numbers does, term by term or all at once",
                   "[engine][twin]", CellId, GeneratorId, Symbol) {
  using Id = TestType;
  const Zp ring = test_ring<Zp>();
  Random random{GENERATE(range(0U, 10U))};
  sparse::RawTerms<Zp, Id> raw;
  sparse::Accumulator<Zp, Id> accumulator{ring};
  Terms<Zp, Id> one_by_one;
  std::map<std::uint32_t, std::uint32_t> plain;
  for (int k = 0; k < 40; ++k) {
    const auto number = static_cast<std::uint32_t>(random.in(0, 20));
    const auto coefficient = ring.from(std::int64_t{random.in(-3, 3)});
    raw.push_back({Id{number}, coefficient});
    accumulator.add_product(Id{number}, coefficient, ring.one());
    sparse::add_multiple<Zp>(ring, one_by_one, coefficient, Terms<Zp, Id>{{Id{number}, ring.one()}});
    plain[number] = ring.add(plain[number], coefficient);
  }
  Terms<Zp, Id> expected;
  for (const auto& [number, coefficient] : plain) {
    if (!ring.is_zero(coefficient)) {
      expected.push_back({Id{number}, coefficient});
    }
  }
  Terms<Zp, Id> accumulated;
  accumulator.finish(accumulated);
  CHECK(accumulated == expected);
  CHECK(one_by_one == expected);
  CHECK(std::move(raw).normal(ring) == expected);
  for (std::uint32_t number = 0; number <= 21; ++number) {
    const sparse::Term<Zp, Id>* term = sparse::find_term<Zp>(expected, Id{number});
    CHECK((term == nullptr ? ring.zero() : term->coefficient) == plain[number]);
  }
}

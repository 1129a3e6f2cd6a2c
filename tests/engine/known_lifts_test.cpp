// Lifts that are known as versions of one another, and by the generators in them, beside plain maps and sets.
#include "engine/right/known_lifts.hpp"

#include <map>
#include <set>
#include <vector>

#include "engine/right/lift_index.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_complexes.hpp"

using namespace sesame;
using namespace sesame::tests;
using engine::GeneratorId;
using engine::KnownLifts;
using engine::Symbol;

namespace {

template <sparse::Ring R>
using Plain = std::map<GeneratorId, typename R::Element>;

template <sparse::Ring R>
sparse::Terms<R, GeneratorId> terms_of(const R& ring, const Plain<R>& plain) {
  sparse::RawTerms<R, GeneratorId> terms;
  for (const auto& [generator, coefficient] : plain) {
    terms.push_back({generator, coefficient});
  }
  return std::move(terms).normal(ring);
}

template <sparse::Ring R>
void add(const R& ring, Plain<R>& to, const typename R::Element& factor, const Plain<R>& from) {
  for (const auto& [generator, coefficient] : from) {
    ring.add_product(to.try_emplace(generator, ring.zero()).first->second, factor, coefficient);
  }
}

template <sparse::Ring R>
Plain<R> random_chain(const R& ring, Random& random, int size) {
  Plain<R> chain;
  for (int k = 0; k < size; ++k) {
    chain[GeneratorId{static_cast<std::uint32_t>(random.in(0, 299))}] = ring.from(random.one_in(2) ? 1 : -1);
  }
  return chain;
}

}  // namespace

TEMPLATE_TEST_CASE("lifts that are versions of one another have the coefficients that they were kept with", "[engine]",
                   Integers, Z2, Zp) {
  const auto ring = test_ring<TestType>();
  for (unsigned seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    KnownLifts<TestType> known(ring);
    std::map<Symbol, Plain<TestType>> plain;
    std::uint32_t next = 0;
    const auto any = [&] {
      auto at = plain.begin();
      std::advance(at, random.in(0, static_cast<int>(plain.size()) - 1));
      return at->first;
    };
    for (int k = 0; k < 120; ++k) {
      // What has become short by cancellation need not be kept.
      std::erase_if(plain, [&](const auto& entry) {
        const bool is_short = terms_of(ring, entry.second).size() <= 64;
        REQUIRE((is_short || known.is_known(entry.first)));
        if (is_short) {
          known.forget(entry.first);
        }
        return is_short;
      });
      const auto factor = ring.from(random.one_in(4) ? 2 : random.one_in(2) ? 1 : -1);
      const int kind = plain.empty() ? 0 : random.in(0, 9);
      if (kind == 0) {
        const Symbol x{next++};
        plain[x] = random_chain(ring, random, 200);
        known.keep(x, terms_of(ring, plain[x]));
      } else if (kind < 4 && !ring.is_zero(factor)) {
        const Symbol x{next++}, base = any();
        Plain<TestType> chain = random_chain(ring, random, 5);
        known.keep(x, base, factor, terms_of(ring, chain));
        add(ring, chain, factor, plain.at(base));
        plain[x] = std::move(chain);
      } else if (kind < 6) {
        const Symbol x = any(), y = any();
        if (x != y && !ring.is_zero(factor)) {
          known.add(x, factor, y);
          const Plain<TestType> other = plain.at(y);
          add(ring, plain.at(x), factor, other);
        }
      } else if (kind == 6) {
        const Symbol x = any();
        known.forget(x);
        plain.erase(x);
        CHECK_FALSE(known.is_known(x));
      } else {
        const Symbol x = any();
        REQUIRE(known.is_known(x));
        for (int asked = 0; asked < 20; ++asked) {
          const GeneratorId generator{static_cast<std::uint32_t>(random.in(0, 299))};
          const auto at = plain.at(x).find(generator);
          REQUIRE(known.coefficient(x, generator) == (at == plain.at(x).end() ? ring.zero() : at->second));
        }
        REQUIRE(known.written_out(x) == terms_of(ring, plain.at(x)));
      }
    }
  }
}

TEST_CASE("short lifts are not kept", "[engine]") {
  const Integers ring;
  KnownLifts<Integers> known(ring);
  known.keep(Symbol{3}, {{GeneratorId{0}, Integer{1}}});
  CHECK_FALSE(known.is_known(Symbol{3}));
  CHECK(known.empty());
}

TEST_CASE("a lift that has become part of another one is found as that one", "[engine]") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    engine::LiftIndex index;
    std::map<Symbol, std::set<GeneratorId>> plain;
    std::uint32_t next = 0;
    const auto any = [&] {
      auto at = plain.begin();
      std::advance(at, random.in(0, static_cast<int>(plain.size()) - 1));
      return at->first;
    };
    const Integers ring;
    for (int k = 0; k < 300; ++k) {
      const int kind = plain.empty() ? 0 : random.in(0, 5);
      if (kind <= 1) {
        const Symbol x = kind == 0 ? Symbol{next++} : any();
        for (const auto& [generator, coefficient] : random_chain(ring, random, 6)) {
          plain[x].insert(generator);
          index.add(x, std::vector<sparse::Term<Integers, GeneratorId>>{{generator, coefficient}});
        }
        CHECK(index.has(x));
      } else if (kind <= 4) {
        const Symbol z = any(), x = random.one_in(4) ? Symbol{next++} : any();
        CHECK_FALSE(index.inherit(z, z));
        if (x != z) {
          REQUIRE(index.inherit(x, z));
          CHECK_FALSE(index.inherit(x, z));  // it has gone
          const std::set<GeneratorId> of_z = plain.at(z);
          plain[x].insert(of_z.begin(), of_z.end());
          plain.erase(z);
        }
      }
      const GeneratorId generator{static_cast<std::uint32_t>(random.in(0, 299))};
      std::set<Symbol> found, expected;
      index.for_each_with(generator, [&](Symbol x) { found.insert(x); });
      for (const auto& [x, generators] : plain) {
        if (generators.contains(generator)) {
          expected.insert(x);
        }
      }
      REQUIRE(found == expected);
    }
  }
}

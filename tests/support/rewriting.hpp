/// \file
/// Complexes that grow, and plain twins of rewriting, for the tests of the right reduction.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/right/rules.hpp"
#include "sparse/column_store.hpp"
#include "tests/support/random_complexes.hpp"

namespace sesame::tests {

/// Chains of the big complex, and of the small one.
template <Ring R>
using ChainOfB = Terms<R, engine::GeneratorId>;
template <Ring R>
using ChainOfS = Terms<R, engine::Symbol>;

/// A complex, all degrees in one column store: each generator comes after those of its boundary.
template <Ring R>
struct GrowingComplex {
  sparse::ColumnStore<R, engine::GeneratorId> boundary;
  std::vector<int> degrees;

  explicit GrowingComplex(const R& ring) : boundary(ring, 0, 0) {}
  [[nodiscard]] ChainOfB<R> d(const ChainOfB<R>& chain) const {
    ChainOfB<R> image;
    for (const auto& [x, coefficient] : chain) {
      sparse::add_multiple<R>(boundary.ring(), image, coefficient, boundary.column(x));
    }
    return image;
  }
  [[nodiscard]] engine::GeneratorId size() const { return engine::GeneratorId{boundary.columns()}; }
  engine::GeneratorId append(int degree, const ChainOfB<R>& column) {
    boundary.append_rows(1);
    boundary.append_column(column);
    degrees.push_back(degree);
    return size() - 1;
  }
};

/// The generators of a complex in a random order in which each comes after those of its boundary.
template <Ring R>
GrowingComplex<R> in_random_order(Random& random, const ChainComplex<R>& complex) {
  GrowingComplex<R> growing(complex.ring());
  std::map<std::pair<int, Index>, engine::GeneratorId> place;
  std::vector<std::pair<int, Index>> waiting;
  for (int p = 0; p <= complex.top(); ++p) {
    for (Index x = 0; x < complex.size(p); ++x) {
      waiting.emplace_back(p, x);
    }
  }
  while (!waiting.empty()) {
    const auto at = waiting.begin() + random.in(0, static_cast<int>(waiting.size()) - 1);
    const auto [p, x] = *at;
    sparse::RawTerms<R, engine::GeneratorId> column;
    bool is_ready = true;
    for (const auto& term : complex.boundary(p).column(x)) {
      const auto row = place.find({p - 1, term.index});
      is_ready = is_ready && row != place.end();
      column.push_back({is_ready ? row->second : ops::none, term.coefficient});
    }
    if (is_ready) {
      place[{p, x}] = growing.append(p, std::move(column).normal(complex.ring()));
      waiting.erase(at);
    }
  }
  return growing;
}

/// A chain of symbols rewritten by all rules as they were made, one after the other.
template <Ring R>
ChainOfS<R> rewritten(const R& ring, const engine::Rules<R>& rules, const ChainOfS<R>& symbols) {
  std::map<engine::Symbol, typename R::Element> sum;
  const auto add = [&](engine::Symbol x, const typename R::Element& factor, const typename R::Element& coefficient) {
    ring.add_product(sum.try_emplace(x, ring.zero()).first->second, factor, coefficient);
  };
  for (const auto& [x, coefficient] : symbols) {
    add(x, coefficient, ring.one());
  }
  for (engine::RuleId id = 0; id < rules.size(); ++id) {
    const auto& rule = rules[id];
    if (rules.removed_by(rule.a) != id) {
      continue;  // it was consumed
    }
    sum.erase(rule.b);
    if (const auto node = sum.extract(rule.a)) {
      for (const auto& [y, factor] : rules.value(id)) {
        add(y, node.mapped(), factor);
      }
    }
  }
  sparse::RawTerms<R, engine::Symbol> image;
  for (const auto& [x, coefficient] : sum) {
    image.push_back({x, coefficient});
  }
  return std::move(image).normal(ring);
}

/// A chain of generators of B in symbols.
template <Ring R>
ChainOfS<R> in_symbols(const R& ring, const engine::Rules<R>& rules, const ChainOfB<R>& chain) {
  sparse::RawTerms<R, engine::Symbol> symbols;
  for (const auto& term : chain) {
    symbols.push_back({rules.symbol_of(term.index), term.coefficient});
  }
  return std::move(symbols).normal(ring);
}

template <Ring R, class Id>
Terms<R, Id> sum_of(const R& ring, Terms<R, Id> a, const typename R::Element& factor, const Terms<R, Id>& b) {
  sparse::add_multiple<R>(ring, a, factor, b);
  return a;
}

/// The laws of a reduction B => S, on generators of B and on the `small` symbols: f g = 1, d g = g dS,
/// g f + d h + h d = 1, f h = 0, h g = 0, h h = 0. Chains of B are in generators. Returns the first that fails.
template <Ring R, class F, class G, class H, class SmallBoundary>
std::string broken_law(const GrowingComplex<R>& complex, const std::vector<engine::Symbol>& small, F f, G g, H h,
                       SmallBoundary ds) {
  const R& ring = complex.boundary.ring();
  const auto minus_one = ring.negate(ring.one());
  for (const engine::Symbol x : small) {
    const ChainOfS<R> unit{{x, ring.one()}};
    const ChainOfB<R> lift = g(unit);
    const std::string where = " at the symbol " + std::to_string(x);
    if (f(lift) != unit) {
      return "f g = 1" + where;
    }
    if (complex.d(lift) != g(ds(x))) {
      return "d g = g d" + where;
    }
    if (!h(lift).empty()) {
      return "h g = 0" + where;
    }
  }
  for (engine::GeneratorId b = 0; b < complex.size(); ++b) {
    const ChainOfB<R> unit{{b, ring.one()}};
    const ChainOfB<R> homotopy = h(unit);
    const std::string where = " at the generator " + std::to_string(b);
    ChainOfB<R> sum = sum_of(ring, g(f(unit)), ring.one(), complex.d(homotopy));
    sum = sum_of(ring, std::move(sum), ring.one(), h(complex.boundary.column(b)));
    if (!sum_of(ring, std::move(sum), minus_one, unit).empty()) {
      return "g f + d h + h d = 1" + where;
    }
    if (!f(homotopy).empty()) {
      return "f h = 0" + where;
    }
    if (!h(homotopy).empty()) {
      return "h h = 0" + where;
    }
  }
  return "";
}

}  // namespace sesame::tests

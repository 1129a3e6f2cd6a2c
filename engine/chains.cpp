#include "engine/chains.hpp"

#include <algorithm>

#include "ops/cells/cell_order.hpp"
#include "sparse/contract.hpp"

namespace sesame::engine {

using sparse::expects;
using sparse::Term;

template <Ring R>
Terms<R, GeneratorId> Chains<R>::g(const CellChain& chain) const {
  RawTerms<R, GeneratorId> out;
  for (const auto& [coefficient, cell] : chain.terms) {
    expects(structure_.is_current(cell) && !structure_.lazy().is_consumed(cell) &&
                structure_.dimension(cell) == chain.degree,
            "a chain is made of current cells of its degree");
    left_.add_g(cell, in_own_orientation(cell, coefficient), out);
  }
  return std::move(out).normal(ring_);
}

template <Ring R>
CellChain Chains<R>::bounding(const CellChain& z, const Terms<R, GeneratorId>& g_of_z, const Terms<R, Symbol>& y) {
  RawTerms<R, CellId> cells = left_.f(rewriter_.lift(y, rewriter_.trace(g_of_z)));
  for (const auto& [coefficient, cell] : z.terms) {
    left_.add_K_of_lazy_part(cell, in_own_orientation(cell, coefficient), cells);
  }
  return to_chain(z.degree + 1, std::move(cells).normal(ring_));
}

// ------------------------------------------------------------------------------------------------------- boundaries

template <Ring R>
CellChain Chains<R>::boundary(const CellChain& chain) const {
  RawTerms<R, CellId> out;
  for (const auto& [coefficient, cell] : chain.terms) {
    const auto element = in_own_orientation(cell, coefficient);
    structure_.faces().for_each_now(cell, [&](CellId face, int sign) {
      out.push_back({face, ring_.multiply(element, ring_.from(sign))});
    });
  }
  return to_chain(chain.degree - 1, std::move(out).normal(ring_));
}

template <Ring R>
Terms<R, Symbol> Chains<R>::boundary(std::span<const Term<R, Symbol>> symbols) const {
  Terms<R, Symbol> out;
  for (const Term<R, Symbol>& term : symbols) {
    if (const Terms<R, Symbol>* column = rewriter_.core().find(term.index)) {
      sparse::add_multiple<R>(ring_, out, term.coefficient, *column);
    }
  }
  return out;
}

// ------------------------------------------------------------------------------------------------------ translation

/// The coefficient of a current cell as it is oriented itself, where it is given as its canonical name says.
template <Ring R>
typename R::Element Chains<R>::in_own_orientation(CellId cell, const Rational& coefficient) const {
  return from_rational(ring_, structure_.directory().sign_of_name(cell) > 0 ? coefficient : -coefficient);
}

template <Ring R>
CellChain Chains<R>::to_chain(int degree, const Terms<R, CellId>& cells) const {
  CellChain chain{degree, {}};
  chain.terms.reserve(cells.size());
  for (const auto& [cell, coefficient] : cells) {
    const bool agrees = structure_.directory().sign_of_name(cell) > 0;
    chain.terms.push_back({to_rational(ring_, agrees ? coefficient : ring_.negate(coefficient)), cell});
  }
  ops::sort_by_age(structure_, chain.terms, [](const CellChain::Term& term) { return term.generator; });
  return chain;
}

template <Ring R>
SmallChain Chains<R>::to_small(int degree, const Terms<R, Symbol>& symbols) const {
  SmallChain out{degree, {}};
  if (symbols.empty()) {
    return out;
  }
  const std::vector<Symbol> small = rewriter_.small(degree);  // oldest first: increasing
  for (const Term<R, Symbol>& term : symbols) {
    const auto at = std::lower_bound(small.begin(), small.end(), term.index);
    out.terms.push_back({to_rational(ring_, term.coefficient), SmallId{at - small.begin()}});
  }
  return out;
}

template <Ring R>
Terms<R, Symbol> Chains<R>::to_symbols(const SmallChain& chain) const {
  const std::vector<Symbol> small = rewriter_.small(chain.degree);
  RawTerms<R, Symbol> out;
  for (const auto& [coefficient, generator] : chain.terms) {
    expects(generator < small.size(), "a chain of the small complex is made of its generators");
    out.push_back({small[generator], from_rational(ring_, coefficient)});
  }
  return std::move(out).normal(ring_);
}

#define SESAME_INSTANTIATE(R) template class Chains<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::engine

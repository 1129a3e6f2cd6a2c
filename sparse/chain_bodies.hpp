/// \file
/// The bodies of chain.hpp that depend on the ids of generators, for chain.cpp and for whoever brings ids of their own.
#pragma once

#include <algorithm>
#include <iterator>
#include <utility>

#include "sparse/chain.hpp"

namespace sesame::sparse {

template <Ring R, class Id>
void RawTerms<R, Id>::normalize(const R& ring) {
  const auto by_index = [](const TermType& a, const TermType& b) { return a.index < b.index; };
  if (!std::is_sorted(terms_.begin(), terms_.end(), by_index)) {
    std::sort(terms_.begin(), terms_.end(), by_index);  // equal indices get added: their order does not matter
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < terms_.size();) {
    TermType sum = std::move(terms_[i]);
    for (++i; i < terms_.size() && terms_[i].index == sum.index; ++i) {
      sum.coefficient = ring.add(sum.coefficient, terms_[i].coefficient);
    }
    if (!ring.is_zero(sum.coefficient)) {
      terms_[kept++] = std::move(sum);
    }
  }
  terms_.resize(kept);
}

template <Ring R, class Id>
void add_multiple(const R& ring, Terms<R, Id>& into, const typename R::Element& factor,
                  std::type_identity_t<std::span<const Term<R, Id>>> terms) {
  if (ring.is_zero(factor) || terms.empty()) {
    return;
  }
  Terms<R, Id> sum;
  sum.reserve(into.size() + terms.size());
  auto a = into.begin();
  for (const Term<R, Id>& b : terms) {
    while (a != into.end() && a->index < b.index) {
      sum.push_back(std::move(*a++));
    }
    Term<R, Id> term{b.index, ring.zero()};
    if (a != into.end() && a->index == b.index) {
      term.coefficient = std::move((a++)->coefficient);
    }
    ring.add_product(term.coefficient, factor, b.coefficient);
    if (!ring.is_zero(term.coefficient)) {
      sum.push_back(std::move(term));
    }
  }
  std::move(a, into.end(), std::back_inserter(sum));
  into = std::move(sum);
}

}  // namespace sesame::sparse

/// What a library instantiates, in namespace sesame::sparse, for chains whose generators have ids of a kind.
#define SESAME_INSTANTIATE_CHAINS(R, Id) \
  template class RawTerms<R, Id>;        \
  template void add_multiple<R, Id>(const R&, Terms<R, Id>&, const R::Element&, std::span<const Term<R, Id>>);

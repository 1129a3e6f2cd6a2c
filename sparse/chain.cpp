#include "sparse/chain.hpp"

#include <algorithm>

namespace sesame::sparse {

template <Ring R>
void RawTerms<R>::normalize(const R& ring) {
  const auto by_index = [](const Term<R>& a, const Term<R>& b) { return a.index < b.index; };
  if (!std::is_sorted(terms_.begin(), terms_.end(), by_index)) {
    std::sort(terms_.begin(), terms_.end(), by_index);  // equal indices get added: their order does not matter
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < terms_.size();) {
    Term<R> sum = std::move(terms_[i]);
    for (++i; i < terms_.size() && terms_[i].index == sum.index; ++i) {
      sum.coefficient = ring.add(sum.coefficient, terms_[i].coefficient);
    }
    if (!ring.is_zero(sum.coefficient)) {
      terms_[kept++] = std::move(sum);
    }
  }
  terms_.resize(kept);
}

template <Ring R>
void add_multiple(const R& ring, Terms<R>& into, const typename R::Element& factor, std::span<const Term<R>> terms) {
  if (ring.is_zero(factor) || terms.empty()) {
    return;
  }
  Terms<R> sum;
  sum.reserve(into.size() + terms.size());
  auto a = into.begin();
  for (const Term<R>& b : terms) {
    while (a != into.end() && a->index < b.index) {
      sum.push_back(std::move(*a++));
    }
    Term<R> term{b.index, ring.zero()};
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

template <Ring R>
std::string to_string(const R& ring, std::span<const Term<R>> terms, std::string_view letter) {
  std::string text;
  for (const Term<R>& term : terms) {
    const Rational value = to_rational(ring, term.coefficient);
    const Rational size = abs(value);
    if (text.empty()) {
      text += value.sign() < 0 ? "-" : "";
    } else {
      text += value.sign() < 0 ? " - " : " + ";
    }
    if (size != Rational{1}) {
      text += size.to_string() + " ";
    }
    text += std::string{letter} + std::to_string(term.index);
  }
  return text.empty() ? "0" : text;
}

template <Ring R>
typename R::Element Chain<R>::coefficient(Index generator) const {
  const Term<R>* term = find_term<R>(terms_, generator);
  return term != nullptr ? term->coefficient : ring_.zero();
}

template <Ring R>
void Chain<R>::add(const Element& a, Index generator) {
  const Term<R> term{generator, ring_.one()};
  add_multiple(ring_, terms_, a, std::span{&term, 1});
}

template <Ring R>
void Chain<R>::add(const Element& a, const Chain& other) {
  expects(degree_ == other.degree_, "Chain::add: the degrees must be equal");
  expects(ring_ == other.ring_, "Chain::add: the rings must be equal");
  if (this == &other) {
    add_multiple<R>(ring_, terms_, a, Terms<R>{terms_});
  } else {
    add_multiple<R>(ring_, terms_, a, other.terms_);
  }
}

template <Ring R>
std::string Chain<R>::to_string(std::string_view letter) const {
  return sparse::to_string<R>(ring_, terms_, letter);
}

#define SESAME_INSTANTIATE(R)                                                                      \
  template class RawTerms<R>;                                                                      \
  template void add_multiple<R>(const R&, Terms<R>&, const R::Element&, std::span<const Term<R>>); \
  template std::string to_string<R>(const R&, std::span<const Term<R>>, std::string_view);         \
  template class Chain<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::sparse

#include "sparse/chain_bodies.hpp"

namespace sesame::sparse {

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

#define SESAME_INSTANTIATE(R)                                                              \
  SESAME_INSTANTIATE_CHAINS(R, Index)                                                      \
  template std::string to_string<R>(const R&, std::span<const Term<R>>, std::string_view); \
  template class Chain<R>;
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::sparse

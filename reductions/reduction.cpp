#include "reductions/reduction.hpp"

namespace sesame::reductions {

template <Ring R>
Reduction<R> identity_reduction(const ChainComplex<R>& complex) {
  const GradedMap<R> one = identity_of(complex);
  return {complex, complex, one, one, GradedMap<R>::zero(complex.ring(), 1, complex.sizes(), complex.sizes())};
}

template <Ring R>
Reduction<R> compose(const Reduction<R>& first, const Reduction<R>& second) {
  return {first.big, second.small, second.f * first.f, first.g * second.g, first.h + first.g * second.h * first.f};
}

template <Ring R>
Reduction<R> isomorphism(const ChainComplex<R>& complex, GradedMap<R> u, GradedMap<R> v) {
  ChainComplex<R> image = complex_with(u * differential(complex) * v);
  return {complex, std::move(image), std::move(u), std::move(v),
          GradedMap<R>::zero(complex.ring(), 1, complex.sizes(), complex.sizes())};
}

#define SESAME_INSTANTIATE(R)                                              \
  template Reduction<R> identity_reduction(const ChainComplex<R>&);        \
  template Reduction<R> compose(const Reduction<R>&, const Reduction<R>&); \
  template Reduction<R> isomorphism(const ChainComplex<R>&, GradedMap<R>, GradedMap<R>);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::reductions

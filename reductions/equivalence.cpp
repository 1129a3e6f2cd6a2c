#include "reductions/equivalence.hpp"

namespace sesame::reductions {

template <Ring R>
Equivalence<R> trivial_equivalence(const ChainComplex<R>& complex) {
  return {identity_reduction(complex), identity_reduction(complex)};
}

template <Ring R>
Equivalence<R> equivalence_of(const Reduction<R>& right) {
  return {identity_reduction(right.big), right};
}

template <Ring R>
Equivalence<R> shrink(const Equivalence<R>& equivalence, const Reduction<R>& further) {
  return {equivalence.left, compose(equivalence.right, further)};
}

#define SESAME_INSTANTIATE(R)                                          \
  template Equivalence<R> trivial_equivalence(const ChainComplex<R>&); \
  template Equivalence<R> equivalence_of(const Reduction<R>&);         \
  template Equivalence<R> shrink(const Equivalence<R>&, const Reduction<R>&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::reductions

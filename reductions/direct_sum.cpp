#include "reductions/direct_sum.hpp"

namespace sesame::reductions {

template <Ring R>
ChainComplex<R> direct_sum(const ChainComplex<R>& a, const ChainComplex<R>& b) {
  return complex_with(diagonal(differential(a), differential(b)));
}

template <Ring R>
GradedMap<R> direct_sum(const GradedMap<R>& a, const GradedMap<R>& b) {
  return diagonal(a, b);
}

template <Ring R>
Reduction<R> direct_sum(const Reduction<R>& a, const Reduction<R>& b) {
  return {direct_sum(a.big, b.big), direct_sum(a.small, b.small), diagonal(a.f, b.f), diagonal(a.g, b.g),
          diagonal(a.h, b.h)};
}

template <Ring R>
Equivalence<R> direct_sum(const Equivalence<R>& a, const Equivalence<R>& b) {
  return {direct_sum(a.left, b.left), direct_sum(a.right, b.right)};
}

#define SESAME_INSTANTIATE(R)                                                          \
  template ChainComplex<R> direct_sum(const ChainComplex<R>&, const ChainComplex<R>&); \
  template GradedMap<R> direct_sum(const GradedMap<R>&, const GradedMap<R>&);          \
  template Reduction<R> direct_sum(const Reduction<R>&, const Reduction<R>&);          \
  template Equivalence<R> direct_sum(const Equivalence<R>&, const Equivalence<R>&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::reductions

#include "reductions/exact_sequence.hpp"

#include "reductions/cone.hpp"
#include "reductions/direct_sum.hpp"
#include "reductions/perturbation.hpp"

namespace sesame::reductions {

template <Ring R>
GradedMap<R> ExactSequence<R>::chi() const {
  return r * differential(c1) * s;
}

template <Ring R>
Equivalence<R> forward(const ExactSequence<R>& sequence, const Equivalence<R>& eq0, const Equivalence<R>& eq1) {
  const auto& [big0, object0, f0, g0, h0] = eq0.left;
  const auto& [big1, object1, f1, g1, h1] = eq1.left;
  const GradedMap<R> big_i = g1 * sequence.i * f0;
  Reduction<R> right = cone_reduction(big_i, eq0.right, eq1.right);

  // In the cone, generators of B0 sit one degree higher: every map from or to B0 is raised.
  const R& ring = sequence.c2.ring();
  GradedMap<R> f2 =
      beside(GradedMap<R>::zero(ring, 1, big0.sizes(), sequence.c2.sizes()).raised(1, 0), sequence.j * f1);
  GradedMap<R> g2 = stacked((-(g0 * sequence.chi())).raised(0, 1), g1 * sequence.s);
  GradedMap<R> h2 = block_map((-h0).raised(1, 1), (g0 * sequence.r * f1).raised(0, 1),
                              GradedMap<R>::zero(ring, 2, big0.sizes(), big1.sizes()).raised(1, 0), h1);
  Reduction<R> left{right.big, sequence.c2, std::move(f2), std::move(g2), std::move(h2)};
  return {std::move(left), std::move(right)};
}

namespace {

/// The map C0 + C2 -> D0 + D2 of degree -1 that is delta: C2 -> D0 and zero elsewhere.
template <Ring R>
GradedMap<R> from_second_to_first(const GradedMap<R>& delta, const Sizes& first, const Sizes& second) {
  const R& ring = delta.ring();
  return block_map(GradedMap<R>::zero(ring, -1, first, first), delta, GradedMap<R>::zero(ring, -1, first, second),
                   GradedMap<R>::zero(ring, -1, second, second));
}

}  // namespace

template <Ring R>
Result<Equivalence<R>> backward(const ExactSequence<R>& sequence, const Equivalence<R>& eq0,
                                const Equivalence<R>& eq2) {
  const GradedMap<R> chi = sequence.chi();
  auto left = easy_perturbation(direct_sum(eq0.left, eq2.left),
                                from_second_to_first(chi, sequence.c0.sizes(), sequence.c2.sizes()));
  if (!left) {
    return left.error();
  }
  const GradedMap<R> delta = eq0.left.g * chi * eq2.left.f;
  auto right = basic_perturbation(direct_sum(eq0.right, eq2.right),
                                  from_second_to_first(delta, eq0.big().sizes(), eq2.big().sizes()));
  if (!right) {
    return right.error();
  }
  const Reduction<R> to_object =
      isomorphism(left->small, beside(sequence.i, sequence.s), stacked(sequence.r, sequence.j));
  return Equivalence<R>{compose(*left, to_object), std::move(*right)};
}

template <Ring R>
Equivalence<R> kernel(const ExactSequence<R>& sequence, const Equivalence<R>& eq1, const Equivalence<R>& eq2) {
  const auto& [big1, object1, f1, g1, h1] = eq1.left;
  const auto& [big2, object2, f2, g2, h2] = eq2.left;
  Reduction<R> right = cone_reduction(g2 * sequence.j * f1, eq1.right, eq2.right);

  // In the cone, generators of B1 sit one degree higher, as those of C0 do in what is returned.
  const R& ring = sequence.c0.ring();
  GradedMap<R> f = beside((sequence.r * f1).raised(1, 1), (sequence.chi() * f2).raised(0, 1));
  GradedMap<R> g = stacked((g1 * sequence.i).raised(1, 1),
                           GradedMap<R>::zero(ring, 1, sequence.c0.sizes(), big2.sizes()).raised(1, 0));
  GradedMap<R> h = block_map((-h1).raised(1, 1), (g1 * sequence.s * f2).raised(0, 1),
                             GradedMap<R>::zero(ring, 2, big1.sizes(), big2.sizes()).raised(1, 0), h2);
  Reduction<R> left{right.big, complex_with((-differential(sequence.c0)).raised(1, 1)), std::move(f), std::move(g),
                    std::move(h)};
  return {std::move(left), std::move(right)};
}

#define SESAME_INSTANTIATE(R)                                                                             \
  template struct ExactSequence<R>;                                                                       \
  template Equivalence<R> forward(const ExactSequence<R>&, const Equivalence<R>&, const Equivalence<R>&); \
  template Equivalence<R> kernel(const ExactSequence<R>&, const Equivalence<R>&, const Equivalence<R>&);  \
  template Result<Equivalence<R>> backward(const ExactSequence<R>&, const Equivalence<R>&, const Equivalence<R>&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::reductions

#include "reductions/exact_sequence.hpp"

#include "reductions/cone.hpp"
#include "reductions/defect.hpp"

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

/// [[a, b], [0, d]].
template <Ring R>
GradedMap<R> upper_triangle(const GradedMap<R>& a, const GradedMap<R>& b, const GradedMap<R>& d) {
  return block_map(a, b, GradedMap<R>::zero(a.ring(), a.degree(), a.source(), d.target()), d);
}

/// The right reduction of `backward`: the sum of two reductions, perturbed by delta from the second summand to the
/// first.
template <Ring R>
Reduction<R> perturbed_sum(const ChainComplex<R>& big, const GradedMap<R>& delta, const Reduction<R>& first,
                           const Reduction<R>& second) {
  const auto& [big0, small0, f0, g0, h0] = first;
  const auto& [big2, small2, f2, g2, h2] = second;
  const GradedMap<R> delta_g = delta * g2;
  const GradedMap<R> delta_h = delta * h2;
  return {big, complex_with(upper_triangle(differential(small0), f0 * delta_g, differential(small2))),
          upper_triangle(f0, -(f0 * delta_h), f2), upper_triangle(g0, -(h0 * delta_g), g2),
          upper_triangle(h0, -(h0 * delta_h), h2)};
}

}  // namespace

template <Ring R>
Result<Equivalence<R>> backward(const ExactSequence<R>& sequence, const Equivalence<R>& eq0,
                                const Equivalence<R>& eq2) {
  const auto& [big0, object0, f0, g0, h0] = eq0.left;
  const auto& [big2, object2, f2, g2, h2] = eq2.left;
  const GradedMap<R> chi = sequence.chi();
  const GradedMap<R> residual = differential(sequence.c0) * chi + chi * differential(sequence.c2);
  if (const auto defect = first_nonzero("d0 chi + chi d2 = 0", residual)) {
    return Error{Errc::law_broken, "exact sequence: " + defect->to_string()};
  }
  const GradedMap<R> delta = g0 * chi * f2;
  const ChainComplex<R> big = complex_with(upper_triangle(differential(big0), delta, differential(big2)));
  Reduction<R> left{big, sequence.c1, beside(sequence.i * f0, sequence.s * f2),
                    stacked(g0 * sequence.r, g2 * sequence.j), diagonal(h0, h2)};
  return Equivalence<R>{std::move(left), perturbed_sum(big, delta, eq0.right, eq2.right)};
}

#define SESAME_INSTANTIATE(R)                                                                             \
  template struct ExactSequence<R>;                                                                       \
  template Equivalence<R> forward(const ExactSequence<R>&, const Equivalence<R>&, const Equivalence<R>&); \
  template Result<Equivalence<R>> backward(const ExactSequence<R>&, const Equivalence<R>&, const Equivalence<R>&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::reductions

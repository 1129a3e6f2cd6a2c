#include "reductions/cone.hpp"

namespace sesame::reductions {

namespace {

/// [[a, 0], [c, d]].
template <Ring R>
GradedMap<R> lower_triangle(const GradedMap<R>& a, const GradedMap<R>& c, const GradedMap<R>& d) {
  return block_map(a, GradedMap<R>::zero(a.ring(), a.degree(), d.source(), a.target()), c, d);
}

}  // namespace

template <Ring R>
ChainComplex<R> cone(const GradedMap<R>& phi, const ChainComplex<R>& c0, const ChainComplex<R>& c1) {
  return complex_with(lower_triangle((-differential(c0)).raised(1, 1), phi.raised(1, 0), differential(c1)));
}

template <Ring R>
Reduction<R> cone_reduction(const GradedMap<R>& phi, const Reduction<R>& rho0, const Reduction<R>& rho1) {
  const auto& [big0, small0, f0, g0, h0] = rho0;
  const auto& [big1, small1, f1, g1, h1] = rho1;
  const GradedMap<R> phi_g = phi * g0;
  const GradedMap<R> phi_h = phi * h0;
  const GradedMap<R> h1_phi_h = h1 * phi_h;
  return {cone(phi, big0, big1), cone(f1 * phi_g, small0, small1),
          lower_triangle(f0.raised(1, 1), (f1 * phi_h).raised(1, 0), f1),
          lower_triangle(g0.raised(1, 1), (-(h1 * phi_g)).raised(1, 0), g1),
          lower_triangle((-h0).raised(1, 1), h1_phi_h.raised(1, 0), h1)};
}

#define SESAME_INSTANTIATE(R)                                                                         \
  template ChainComplex<R> cone(const GradedMap<R>&, const ChainComplex<R>&, const ChainComplex<R>&); \
  template Reduction<R> cone_reduction(const GradedMap<R>&, const Reduction<R>&, const Reduction<R>&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::reductions

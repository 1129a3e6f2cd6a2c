#include "reductions/elimination.hpp"

#include <string>

#include "reductions/unit_elimination.hpp"

namespace sesame::reductions {

namespace {

/// (n-1) x n: forgets generator x, keeps the others in order.
template <Ring R>
Matrix<R> forgetting(const R& ring, Index n, Index x) {
  Matrix<R> result(ring, n - 1, n);
  for (Index i = 0; i < n; ++i) {
    if (i != x) {
      result.set_column(i, Terms<R>{{i < x ? i : i - 1, ring.one()}});
    }
  }
  return result;
}

}  // namespace

template <Ring R>
Result<Reduction<R>> eliminate_pair(const ChainComplex<R>& complex, int p, Index a, Index b) {
  sparse::expects(a < complex.size(p) && b < complex.size(p + 1), "eliminate_pair: no such generators");
  const R& ring = complex.ring();
  const Matrix<R>& boundary = complex.boundary(p + 1);
  const typename R::Element unit = boundary.entry(a, b);
  if (!ring.is_unit(unit)) {
    return Error{Errc::not_a_unit, "elimination: the coefficient of generator " + std::to_string(a) + " of degree " +
                                       std::to_string(p) + " in the boundary of generator " + std::to_string(b) +
                                       " is " + sparse::to_rational(ring, unit).to_string() + ", not a unit of " +
                                       ring.name()};
  }
  const typename R::Element factor = ring.negate(ring.inverse(unit));
  Sizes small = complex.sizes();
  --small[static_cast<std::size_t>(p)];
  --small[static_cast<std::size_t>(p) + 1];
  // Built by columns as f: C -> C' and g: C' -> C around the identity of the degrees that keep all their generators.
  std::vector<Matrix<R>> f;
  std::vector<Matrix<R>> g;
  for (int q = 0; q <= complex.top(); ++q) {
    const bool shrinks = q == p || q == p + 1;
    const Index gone = q == p ? a : b;
    f.push_back(shrinks ? forgetting(ring, complex.size(q), gone) : Matrix<R>::identity(ring, complex.size(q)));
    g.push_back(f.back().transposed());
  }
  Matrix<R>& f_p = f[static_cast<std::size_t>(p)];
  Terms<R> image;
  sparse::add_multiple<R>(ring, image, factor, f_p.apply(boundary.column(b)));
  f_p.set_column(a, image);
  for (Index c = 0; c < complex.size(p + 1); ++c) {
    const typename R::Element weight = ring.multiply(factor, boundary.entry(a, c));
    if (c != b && !ring.is_zero(weight)) {
      g[static_cast<std::size_t>(p) + 1].add_to_column(c < b ? c : c - 1, weight, Terms<R>{{b, ring.one()}});
    }
  }
  GradedMap<R> h = GradedMap<R>::zero(ring, 1, complex.sizes(), complex.sizes());
  Matrix<R> h_p = h.at(p);
  h_p.set_column(a, Terms<R>{{b, ring.inverse(unit)}});
  h.set(p, std::move(h_p));
  GradedMap<R> f_map(ring, 0, complex.sizes(), small, std::move(f));
  GradedMap<R> g_map(ring, 0, small, complex.sizes(), std::move(g));
  ChainComplex<R> small_complex = complex_with(f_map * differential(complex) * g_map);
  return Reduction<R>{complex, std::move(small_complex), std::move(f_map), std::move(g_map), std::move(h)};
}

template <Ring R>
Result<Reduction<R>> eliminate_pair(const Reduction<R>& reduction, int p, Index a, Index b) {
  const auto further = eliminate_pair(reduction.small, p, a, b);
  if (!further) {
    return further.error();
  }
  return compose(reduction, *further);
}

template <Ring R>
Reduction<R> reduce(const ChainComplex<R>& complex) {
  const UnitElimination<R> elimination(complex, UnitElimination<R>::Keep::traces);
  return {complex, elimination.small(), elimination.f(), elimination.g(), elimination.h()};
}

template <Ring R>
Reduction<R> eliminate_all_units(const Reduction<R>& reduction) {
  return compose(reduction, reduce(reduction.small));
}

template <Ring R>
SmallModel<R> small_model(const ChainComplex<R>& complex) {
  const UnitElimination<R> elimination(complex, UnitElimination<R>::Keep::traces);
  return {elimination.small(), elimination.g()};
}

template <Ring R>
ChainComplex<R> small_complex(const ChainComplex<R>& complex) {
  return UnitElimination<R>(complex, UnitElimination<R>::Keep::boundaries).small();
}

#define SESAME_INSTANTIATE(R)                                                              \
  template Result<Reduction<R>> eliminate_pair(const ChainComplex<R>&, int, Index, Index); \
  template Result<Reduction<R>> eliminate_pair(const Reduction<R>&, int, Index, Index);    \
  template Reduction<R> reduce(const ChainComplex<R>&);                                    \
  template Reduction<R> eliminate_all_units(const Reduction<R>&);                          \
  template SmallModel<R> small_model(const ChainComplex<R>&);                              \
  template ChainComplex<R> small_complex(const ChainComplex<R>&);
SESAME_FOR_EACH_RING(SESAME_INSTANTIATE)
#undef SESAME_INSTANTIATE

}  // namespace sesame::reductions

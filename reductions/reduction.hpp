/// \file
/// Reductions: a big complex that splits into a small one and a contractible rest.
#pragma once

#include "reductions/graded_map.hpp"

namespace sesame::reductions {

/// A reduction (f, g, h) : big => small.
///
///     f: big -> small, g: small -> big chain maps; h: big -> big of degree +1;
///     f g = 1,  g f + d h + h d = 1,  f h = 0,  h g = 0,  h h = 0.
///
/// A plain value: nothing is checked when one is put together. `first_defect` (defect.hpp) checks every law.
template <Ring R>
struct Reduction {
  ChainComplex<R> big;
  ChainComplex<R> small;
  GradedMap<R> f;
  GradedMap<R> g;
  GradedMap<R> h;

  friend bool operator==(const Reduction&, const Reduction&) = default;
};

/// C => C by identities.
template <Ring R>
[[nodiscard]] Reduction<R> identity_reduction(const ChainComplex<R>& complex);

/// A => C from A => B and B => C: (f2 f1, g1 g2, h1 + g1 h2 f1). Requires: the two complexes B have equal sizes.
template <Ring R>
[[nodiscard]] Reduction<R> compose(const Reduction<R>& first, const Reduction<R>& second);

/// The reduction (u, v, 0) from C to the complex that an isomorphism u with inverse v makes of it: d' = u d v.
/// Requires: u v = 1 and v u = 1.
template <Ring R>
[[nodiscard]] Reduction<R> isomorphism(const ChainComplex<R>& complex, GradedMap<R> u, GradedMap<R> v);

}  // namespace sesame::reductions

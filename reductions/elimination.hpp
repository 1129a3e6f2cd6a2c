/// \file
/// Elimination of unit pairs: generators a, b with d b = (unit) a + rest cancel each other (algebraic Morse theory).
#pragma once

#include "reductions/reduction.hpp"
#include "sparse/result.hpp"

namespace sesame::reductions {

/// C => C without the pair (a, b), a of degree p and b of degree p + 1. With d b = e a + rest:
/// f: a -> -rest / e, b -> 0;  g: c -> c - ([d c : a] / e) b;  h: a -> b / e. The other generators keep their order.
/// Errors: not_a_unit when the coefficient e of a in d b has no inverse. Requires: indices in range.
template <Ring R>
[[nodiscard]] Result<Reduction<R>> eliminate_pair(const ChainComplex<R>& complex, int p, Index a, Index b);

/// The reduction followed by the elimination of a pair of its small complex. Errors as above.
template <Ring R>
[[nodiscard]] Result<Reduction<R>> eliminate_pair(const Reduction<R>& reduction, int p, Index a, Index b);

/// C => S where no boundary of S has a unit entry left: over a field, d_S = 0 and S is the homology.
///
/// Cost: each boundary is rewritten once (again only when, over Z, it kept non-unit entries and later pairs met them);
/// the maps have as many terms as they have.
template <Ring R>
[[nodiscard]] Reduction<R> reduce(const ChainComplex<R>& complex);

/// The reduction followed by `reduce` of its small complex.
template <Ring R>
[[nodiscard]] Reduction<R> eliminate_all_units(const Reduction<R>& reduction);

/// The S of `reduce`, and its g: the cycles of S as cycles of C. Neither f nor h is computed.
template <Ring R>
struct SmallModel {
  ChainComplex<R> small;
  GradedMap<R> g;
};
template <Ring R>
[[nodiscard]] SmallModel<R> small_model(const ChainComplex<R>& complex);

/// The S of `reduce`, without any map.
template <Ring R>
[[nodiscard]] ChainComplex<R> small_complex(const ChainComplex<R>& complex);

}  // namespace sesame::reductions

/// \file
/// The two perturbation lemmas: what becomes of a reduction when a differential changes.
#pragma once

#include "reductions/reduction.hpp"
#include "sparse/result.hpp"

namespace sesame::reductions {

/// Carries a perturbation of the small differential over to the big one: (f, g, h) stays,
/// (big, d + g delta f) => (small, d' + delta).
///
/// Shapes    delta: small -> small, degree -1.
/// Errors    law_broken when (d' + delta)^2 != 0, saying where.
/// Source    J. Rubio, F. Sergeraert, Constructive homological algebra (2006), easy perturbation lemma.
template <Ring R>
[[nodiscard]] Result<Reduction<R>> easy_perturbation(const Reduction<R>& reduction, const GradedMap<R>& delta);

/// Carries a perturbation of the big differential over to the small one. With phi = sum of (-h delta)^n and
/// psi = sum of (-delta h)^n:  d' + f delta phi g,  f psi,  phi g,  phi h.
///
/// Shapes    delta: big -> big, degree -1.
/// Requires  the laws of the reduction.
/// Errors    law_broken when (d + delta)^2 != 0, saying where; not_nilpotent when the series does not stop, naming a
///           generator of the big complex on which it does not.
/// Cost      phi is computed column by column, generators that need others after those; O(terms written) when the graph
///           of h delta has no cycle. Only a strongly connected part of size s is tried for up to s rounds: over a
///           domain, a nilpotent s x s matrix vanishes by then, so no run is endless.
/// Source    as above, basic perturbation lemma (R. Brown, W. Shih).
template <Ring R>
[[nodiscard]] Result<Reduction<R>> basic_perturbation(const Reduction<R>& reduction, const GradedMap<R>& delta);

}  // namespace sesame::reductions

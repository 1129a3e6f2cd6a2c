/// \file
/// The cone of a chain map, and the reduction of a cone.
#pragma once

#include "reductions/reduction.hpp"

namespace sesame::reductions {

/// Cone of phi: C0 -> C1. Its generators of degree n are those of C0 of degree n-1, then those of C1 of degree n, and
/// D = [[-d0, 0], [phi, d1]]. Requires: phi a chain map (checked by `first_defect` of the result: D D = 0).
template <Ring R>
[[nodiscard]] ChainComplex<R> cone(const GradedMap<R>& phi, const ChainComplex<R>& c0, const ChainComplex<R>& c1);

/// Cone(phi) => Cone(f1 phi g0), from rho0: C0 => C0' and rho1: C1 => C1' and a chain map phi: C0 -> C1.
/// Source: J. Rubio, F. Sergeraert, Constructive homological algebra (2006), the cone reduction theorem.
template <Ring R>
[[nodiscard]] Reduction<R> cone_reduction(const GradedMap<R>& phi, const Reduction<R>& rho0, const Reduction<R>& rho1);

}  // namespace sesame::reductions

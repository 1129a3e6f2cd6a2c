/// \file
/// Direct sums: first the generators of the first summand, then those of the second, degree by degree.
#pragma once

#include "reductions/equivalence.hpp"

namespace sesame::reductions {

template <Ring R>
[[nodiscard]] ChainComplex<R> direct_sum(const ChainComplex<R>& a, const ChainComplex<R>& b);
template <Ring R>
[[nodiscard]] GradedMap<R> direct_sum(const GradedMap<R>& a, const GradedMap<R>& b);
template <Ring R>
[[nodiscard]] Reduction<R> direct_sum(const Reduction<R>& a, const Reduction<R>& b);
template <Ring R>
[[nodiscard]] Equivalence<R> direct_sum(const Equivalence<R>& a, const Equivalence<R>& b);

}  // namespace sesame::reductions

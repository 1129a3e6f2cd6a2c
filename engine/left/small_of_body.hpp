/// \file
/// The small generators of one body.
#pragma once

#include <vector>

#include "engine/left/big_complex.hpp"
#include "engine/right/rewriter.hpp"

namespace sesame::engine {

/// The small generators of a body, sorted. Cost: those of the object, or the nodes ever made in the body, whichever are
/// fewer; times a logarithm.
template <Ring R>
[[nodiscard]] std::vector<Symbol> small_of_body(ops::BodyId body, const Structure& structure, const BigComplex<R>& big,
                                                const Rewriter<R>& rewriter);

}  // namespace sesame::engine

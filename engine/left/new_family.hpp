/// \file
/// How a lazy family becomes a part of the equivalence.
#pragma once

#include "engine/left/frozen_maps.hpp"

namespace sesame::engine {

/// Takes in the next family of a structure: the small generators of the bodies that it is made of leave S; of a product
/// one for each pair of them is appended to B and announced to the right reduction, with the boundary of the tensor
/// product; its maps are those of TensorMaps or ConeMaps. Cost: see small_of_body, and the number of those pairs.
template <Ring R>
void append_family(ops::FamilyId id, const Structure& structure, FrozenMaps<R>& frozen, BigComplex<R>& big,
                   Rewriter<R>& rewriter);

}  // namespace sesame::engine

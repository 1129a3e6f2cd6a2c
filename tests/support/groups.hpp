/// \file
/// The groups of an object, as an engine has them and as they are worked out anew.
#pragma once

#include <vector>

#include "engine/engine.hpp"
#include "ops/plan/step_sequence.hpp"
#include "reductions/homology.hpp"

namespace sesame::tests {

using engine::Engine;
using reductions::AbelianGroup;

/// H_0, H_1, ... as the engine says, without trivial groups at the top.
inline std::vector<AbelianGroup> live_groups(Engine& engine) {
  const engine::Homology homology = engine.homology();
  std::vector<AbelianGroup> groups;
  for (std::size_t p = 0; p < homology.betti.size(); ++p) {
    groups.push_back({static_cast<sparse::Index>(homology.betti[p]), homology.torsion[p]});
  }
  while (!groups.empty() && groups.back().is_trivial()) {
    groups.pop_back();
  }
  return groups;
}

/// The same by a Smith form of the cells' boundaries, over the ring given.
template <sparse::Ring R>
std::vector<AbelianGroup> groups_from_scratch(const ops::Structure& structure, const R& ring) {
  const ops::CellBasis basis = ops::cells_at(structure, ops::now(structure));
  std::vector<AbelianGroup> groups =
      reductions::homology_groups(ops::chain_complex(structure, basis, ops::now(structure), ring));
  while (!groups.empty() && groups.back().is_trivial()) {
    groups.pop_back();
  }
  return groups;
}

}  // namespace sesame::tests

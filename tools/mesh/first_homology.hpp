/// \file
/// Coordinates of the first homology group, for edges and for cycles.
#pragma once

#include <vector>

#include "engine/engine.hpp"
#include "tools/mesh/short_loops.hpp"

namespace sesame::tools {

/// H_1 = R^rank + Z/orders[0] + Z/orders[1] + ..., with the coordinates of every edge: the sum of those of the edges of
/// a cycle are the coordinates of its class.
struct FirstHomology {
  Annotation free;
  Annotation torsion;                           ///< over Z; coordinate k counts modulo orders[k]
  std::vector<sparse::Integer> orders;          ///< each divides the next
  std::vector<engine::SmallChain> free_cycles;  ///< cycles of the small complex with a unit vector as coordinates
  std::vector<engine::SmallChain> torsion_cycles;
};

/// `edges` are cells of the engine; its complex has no cells whose boundary is not a sum of others, so all of H_1 is
/// met. Cost: F of each edge, plus a Smith form of what is left of d_2 in the small complex.
[[nodiscard]] FirstHomology first_homology(engine::Engine& engine, const std::vector<ops::CellId>& edges);

/// A chain of degree 1 of the small complex, from its terms in normal form.
[[nodiscard]] engine::SmallChain small_chain(const sparse::Terms<sparse::Integers>& terms);

}  // namespace sesame::tools

/// \file
/// Generators of the homology of a mesh: components, short loops, closed surfaces.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/engine.hpp"
#include "tools/mesh/loop_sorting.hpp"
#include "tools/mesh/mesh_cells.hpp"
#include "tools/mesh/mesh_generator.hpp"
#include "tools/mesh/validity.hpp"

namespace sesame::tools {

/// Those of one degree, in the order of MeshHomology::generators.
struct FoundGenerators {
  std::vector<MeshGenerator> generators;
  std::uint64_t loops_tried = 0;     ///< compared when short ones were chosen
  std::vector<PartSorting> sorting;  ///< of H_1, per connected part: whether its loops have sides
  std::vector<std::string> remarks;  ///< on that
};

/// H_0: the lowest vertex of each component. Cost: the edges.
[[nodiscard]] FoundGenerators components_of(const MeshCells& cells);
/// H_1: short loops, and the engine's cycles where these do not suffice; finite orders first, then by length. Of closed
/// surfaces in space as many loops bound inside as outside (see loop_sorting.hpp). `ring`: that of the answer; the
/// engine's is Z when it is Q. `known`: of the mesh. Cost: see sort_loops and short_half; short_loops and
/// first_homology for all parts when there are some that have no inside.
[[nodiscard]] FoundGenerators loops_of(const MeshCells& cells, engine::Engine& engine, const sparse::AnyRing& ring,
                                       const KnownOfMesh& known);
/// H_2: the engine's cycles, oriented as the file orients the first of their triangles. `with_faces`: with the polygons
/// that these are parts of. Cost: their triangles.
[[nodiscard]] FoundGenerators surfaces_of(const MeshCells& cells, engine::Engine& engine, const sparse::AnyRing& ring,
                                          bool with_faces);

}  // namespace sesame::tools

/// \file
/// One number for what an object's homology is, to be compared with that of another time or program.
#pragma once

#include <cstdint>
#include <span>

#include "engine/homology_tracker.hpp"

namespace sesame::engine {

/// A hash of the number of cells of each dimension, the Betti numbers and the torsion: XXH3 of
/// `{"cells":[1,2,1],"betti":[1,2,1],"torsion":[[],[],[]]}`. It does not depend on names, representatives or sizes of
/// complexes, nor on how the object came about.
[[nodiscard]] std::uint64_t answer_hash(std::span<const std::uint64_t> cells, const Homology& homology);

}  // namespace sesame::engine

/// \file
/// Homology, groups and chains as people write them.
#pragma once

#include <string>
#include <vector>

#include "engine/engine.hpp"

namespace sesame::replay {

/// H_0, H_1, ... written "Z", "Z^2 + Z/2", "0"; over a field "(Z/2)^3".
[[nodiscard]] std::vector<std::string> group_names(const engine::Homology& homology, const sparse::AnyRing& ring);

/// "H0 = Z, H1 = Z^2, H2 = Z".
[[nodiscard]] std::string homology_line(const engine::Homology& homology, const sparse::AnyRing& ring);

/// "t.0-1 - 2 t.1-2", "0".
[[nodiscard]] std::string chain_text(const engine::CellChain& chain, const ops::Structure& structure);

/// The same, with all but the first terms counted instead of written when there are more than `most`.
[[nodiscard]] std::string chain_text(const engine::CellChain& chain, const ops::Structure& structure, std::size_t most);

}  // namespace sesame::replay

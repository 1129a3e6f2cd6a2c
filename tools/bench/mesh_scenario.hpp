/// \file
/// A mesh from a file as a scenario.
#pragma once

#include <string>

#include "sparse/result.hpp"
#include "tools/bench/scenarios.hpp"

namespace sesame::tools {

/// The mesh is assembled triangle by triangle, breadth first. When every component is a surface, its homology is known
/// from counting: the Euler characteristic, the boundary, whether it is orientable. Errors: those of read_mesh.
[[nodiscard]] Result<Scenario> mesh_scenario(const std::string& path);

}  // namespace sesame::tools

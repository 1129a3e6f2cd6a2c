/// \file
/// Scenarios whose groups have torsion.
#pragma once

#include <vector>

#include "tools/bench/scenarios.hpp"

namespace sesame::tools {

/// Adds them to a list of scenarios.
void add_torsion(std::vector<Scenario>& list);

}  // namespace sesame::tools

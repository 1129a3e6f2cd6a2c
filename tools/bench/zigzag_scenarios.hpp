/// \file
/// Scenarios in which simplices come and go.
#pragma once

#include <vector>

#include "tools/bench/scenarios.hpp"

namespace sesame::tools {

/// Adds them to a list of scenarios.
void add_zigzags(std::vector<Scenario>& list);

}  // namespace sesame::tools

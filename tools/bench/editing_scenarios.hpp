/// \file
/// Scenarios in which something is edited for as long as one likes.
#pragma once

#include <vector>

#include "tools/bench/scenarios.hpp"

namespace sesame::tools {

/// Adds them to a list of scenarios.
void add_editing(std::vector<Scenario>& list);

}  // namespace sesame::tools

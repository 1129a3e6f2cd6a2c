/// \file
/// Scenarios in which everything is made in one step.
#pragma once

#include <vector>

#include "tools/bench/scenarios.hpp"

namespace sesame::tools {

/// Adds them to a list of scenarios.
void add_batches(std::vector<Scenario>& list);

}  // namespace sesame::tools

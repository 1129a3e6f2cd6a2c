/// \file
/// Measuring a method on a scenario: runs in processes of their own, and what they come to together.
#pragma once

#include <cstdint>
#include <string>

#include "tools/bench/measurement.hpp"
#include "tools/bench/scenarios.hpp"

namespace sesame::tools {

struct RunnerOptions {
  unsigned repeats = 5;      ///< runs that are timed; 0: counts only
  double most_seconds = 60;  ///< of a run
};

/// One run that warms up, and gives memory and counts; one that checks the answers along the way; then `repeats` that
/// are timed, unless one fails. A method that is cut off by the time limit is timed only once.
/// Requires: the method is one of the scenario's; one thread.
[[nodiscard]] Measurement measure(const Scenario& scenario, std::uint64_t size, const std::string& method,
                                  const RunnerOptions& options);

/// What samples come to: `first` gives memory and counts, `timed` the times. The verdict is the worst of them.
[[nodiscard]] Measurement sum_up(const Sample& first, const std::vector<Sample>& timed);

}  // namespace sesame::tools

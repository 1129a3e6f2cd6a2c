/// \file
/// Running the steps of a scenario and measuring each.
#pragma once

#include <cstddef>
#include <functional>

#include "sparse/result.hpp"
#include "tools/bench/measurement.hpp"

namespace sesame::tools {

struct RunOptions {
  double most_seconds = 60;  ///< a run ends with the first step after that
  bool counts_heap = false;  ///< which makes it slower
};

/// Calls step(k) for k = 0, 1, ... and measures each call, until all are done, one says that it cannot, or the time is
/// up. Everything but the counts of the method is in the sample then; the answer is yet to be checked.
[[nodiscard]] Sample measure_steps(std::size_t steps, const RunOptions& options,
                                   const std::function<Status(std::size_t)>& step);

}  // namespace sesame::tools

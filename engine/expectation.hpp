/// \file
/// Whether the state is as an `expect` says.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "engine/homology_tracker.hpp"
#include "ops/vocabulary/operation.hpp"
#include "sparse/result.hpp"

namespace sesame::engine {

/// Compares what is expected with the number of cells of each dimension, the Euler characteristic, and the homology,
/// which is asked for only when it is needed. Errors: expectation, with all that differs.
Status check_expectation(const ops::Expect& expected, std::span<const std::uint64_t> cells, std::int64_t euler,
                         const std::function<Homology()>& homology);

}  // namespace sesame::engine

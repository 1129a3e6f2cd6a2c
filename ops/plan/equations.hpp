/// \file
/// What an identification and a degeneracy demand, before all that it entails.
#pragma once

#include <vector>

#include "ops/plan/congruence.hpp"
#include "ops/vocabulary/operation.hpp"

namespace sesame::ops {

/// Each pair, the second cell with its vertices as they are glued to those of the first. Errors: unknown_name; refused
/// for cells of two types; bad_input for what is no vertex map.
[[nodiscard]] Result<std::vector<Equation>> equations_of(const Identify& operation, const Structure& structure);
/// The cell and the degeneracy of its face. Errors: unknown_name; bad_input for a direction that it does not have.
[[nodiscard]] Result<std::vector<Equation>> equations_of(const Degenerate& operation, const Structure& structure);

}  // namespace sesame::ops

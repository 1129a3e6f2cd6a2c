/// \file
/// Taking the sewing of maps by simplices back, in any dimension.
#pragma once

#include "ops/cells/structure.hpp"
#include "ops/plan/limits.hpp"
#include "ops/vocabulary/operation.hpp"

namespace sesame::ops {

/// Whether the first dart of an operation is one of a map by simplices.
[[nodiscard]] bool unsews_simplices(const Unsew& operation, const Structure& structure);

/// The plan for such darts. Of the parts of an orbit that falls apart that which has the dart that the simplex is
/// called by keeps it; each other one gets a copy, called after its least dart, and the incidences that its darts see.
/// Errors    unknown_name; bad_input: a dimension, a name that is in use; refused, naming a dart or a simplex: what is
///           free, or was split, squashed, removed, or glued and not by sewing; the limits.
/// Cost      2^n times the darts of the orbits that fall apart, and of those that have them as faces.
Status plan_unsewn_simplices(const Unsew& operation, const Structure& structure, const Limits& limits, Plan& plan);

}  // namespace sesame::ops

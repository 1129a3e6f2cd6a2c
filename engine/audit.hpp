/// \file
/// The laws of a live equivalence, checked on the whole of it, and the equivalence written out as matrices. Slow.
#pragma once

#include <optional>
#include <string>

#include "engine/live_equivalence.hpp"
#include "reductions/equivalence.hpp"

namespace sesame::engine {

/// The whole equivalence as matrices. C's basis is that of ops::cells_at; B's and S's are their generators of each
/// degree, oldest first. Cost: the size of all maps written out. Requires: there are no lazy families.
template <Ring R>
[[nodiscard]] reductions::Equivalence<R> matrices_of(LiveEquivalence<R>& live);

/// Checks every law of the present state: the exact sequence of the last step, the face laws, the equivalence, the
/// groups against a Smith form from scratch, the generators. Returns the first that fails and where.
template <Ring R>
[[nodiscard]] std::optional<std::string> first_defect(LiveEquivalence<R>& live, ops::StepKind last_step,
                                                      const ops::Moment& before_it);

}  // namespace sesame::engine

/// \file
/// The method of this project: the engine.
#pragma once

#include <memory>

#include "tools/bench/method.hpp"

namespace sesame::tools {

/// Keeps the live form. Takes every operation.
///
/// Counts    `boundary_entries` appended to the boundary of the big complex, `rewritten_terms` read,
///           `rule_terms` of the rules made (the fill-in), `path_links` followed to what a face has become.
[[nodiscard]] std::unique_ptr<Method> make_live_method(const sparse::AnyRing& ring);

}  // namespace sesame::tools

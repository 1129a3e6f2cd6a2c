/// \file
/// Ctrl-C: the work at hand is finished and reported, instead of lost.
#pragma once

#include <atomic>

namespace sesame::tools {

/// Set by Ctrl-C once `catch_interrupt` has been called.
[[nodiscard]] std::atomic<bool>& stop_requested();

/// From now on the first Ctrl-C sets `stop_requested`, and ends a read that waits for input; a second one ends the
/// program at once.
void catch_interrupt();

}  // namespace sesame::tools

/// \file
/// What the library says of its work, by spdlog: who says it, and what the levels mean. (The log of operations is the
/// engine's state, and another thing.)
#pragma once

#include <memory>

namespace spdlog {
class logger;
}

namespace sesame::engine {

/// A logger as spdlog's registry has it. When there is none of that name, it is made and registered: with the sinks
/// that the default logger has now, silent below `warn`.
///
/// Levels, the same for all loggers here and in the folders to the right:
///   warn    what somebody should look at, although everything that was asked for has been done
///   info    milestones: an input with its format, an equivalence begun afresh, a result written
///   debug   what each step did and what it took, steps that were refused and why, what was computed anew
///   trace   what is finer than a step
/// `spdlog::get("sesame.rebase")->set_level(...)` changes one, `spdlog::set_level` all that have been made, with those
/// of whoever uses the library. What no level asks for costs the look at the level.
[[nodiscard]] std::shared_ptr<spdlog::logger> registered_logger(const char* name);

// Each is made by its first call, for as long as the program runs; the constructor of an Engine calls all three.
spdlog::logger& step_log();     ///< "sesame.engine": steps, and what is computed to answer questions
spdlog::logger& rebase_log();   ///< "sesame.rebase": equivalences that are begun afresh, resumed, given up
spdlog::logger& refusal_log();  ///< "sesame.refusals": steps that did not happen

}  // namespace sesame::engine

/// \file
/// A soak: very many random steps on an object that keeps its size, with undo limited. What it takes must not grow.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sparse/result.hpp"
#include "sparse/ring.hpp"
#include "tools/bench/soak_steps.hpp"

namespace sesame::tools {

struct SoakPlan {
  std::uint64_t steps = 100'000;      ///< that are accepted
  std::uint64_t cells = 10'000;       ///< of the object, about
  std::uint64_t undo_limit = 10'000;  ///< steps
  std::uint64_t seed = 1;
  std::uint64_t samples = 20;  ///< how often laws and groups are checked
  sparse::AnyRing ring = sparse::Integers{};
  bool forgets_cells = true;  ///< see engine::HistoryPolicy
};

/// A tenth of a soak.
struct SoakTenth {
  std::uint64_t steps = 0;           ///< from the beginning
  double seconds = 0;                ///< of the processor, for this tenth without the checks
  double engine_seconds = 0;         ///< of these, in the engine: the rest is what drawing steps takes
  double check_seconds = 0;          ///< for the checks
  std::uint64_t checks = 0;          ///< in this tenth
  std::uint64_t cells = 0;           ///< of the object in the end
  std::uint64_t nodes = 0;           ///< cells that the engine knows, those that are gone among them
  std::uint64_t renewals = 0;        ///< since the beginning
  std::uint64_t rebases = 0;         ///< since the beginning
  std::uint64_t resident_bytes = 0;  ///< memory of the process
  std::uint64_t heap_bytes = 0;      ///< given out by malloc, and of large blocks beside it the pages in use
  std::vector<std::int64_t> betti;   ///< in the end
};

struct SoakOutcome {
  std::vector<SoakTenth> tenths;
  std::map<std::string, SoakSteps::Count, std::less<>> counts;  ///< by operation
};

/// Does it. `visit` sees each tenth as it ends.
/// Errors: law_broken when a check fails or an answer is wrong. Cost: the steps, and for each check that of the laws as
/// matrices.
[[nodiscard]] Result<SoakOutcome> soak(const SoakPlan& plan, const std::function<void(const SoakTenth&)>& visit);

/// What malloc has given out and not got back, and the pages of large blocks (sparse/block_memory.hpp) that are in use.
[[nodiscard]] std::uint64_t heap_in_use();

}  // namespace sesame::tools

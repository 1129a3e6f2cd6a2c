/// \file
/// Where and from what a measurement comes.
#pragma once

#include <cstdint>
#include <string>

namespace sesame::tools {

struct Machine {
  std::string cpu = "unknown", system = "unknown";
  unsigned cores = 0;
  std::uint64_t memory_bytes = 0;
};
[[nodiscard]] Machine this_machine();

struct Build {
  std::string version, commit, compiler, flags;
};
/// The commit is that of the source when the build was configured, with "+" when files differed from it, "unknown"
/// outside of git.
[[nodiscard]] Build this_build();

/// Now, as in 2026-01-31T12:00:00Z.
[[nodiscard]] std::string time_stamp();

}  // namespace sesame::tools

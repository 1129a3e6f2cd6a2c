/// \file
/// Single runs of a method on a scenario, in this process or by another program.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/homology_tracker.hpp"
#include "tools/bench/measurement.hpp"
#include "tools/bench/processes.hpp"
#include "tools/bench/scenarios.hpp"
#include "tools/bench/step_times.hpp"

namespace sesame::tools {

/// What differs from the answer, or an empty text.
[[nodiscard]] std::string difference(const engine::Homology& found, const Answer& answer);

/// Runs in this process, whose memory is counted. Requires: a method of the scenario that is no program.
[[nodiscard]] Sample run_construction(const Scenario& scenario, std::uint64_t size, const std::string& method,
                                      const RunOptions& options);
[[nodiscard]] Sample run_filtration(const Scenario& scenario, std::uint64_t size, const std::string& method,
                                    const RunOptions& options);
[[nodiscard]] Sample run_tower(const Scenario& scenario, std::uint64_t size, const std::string& method,
                               const RunOptions& options);

/// The methods that are trackers of this process, and those that are programs.
[[nodiscard]] std::span<const std::string> tracker_methods();
[[nodiscard]] std::span<const std::string> program_methods();

/// A program on a filtration: it reads a file and writes the pairs or bars to another one, and what is measured is all
/// of that.
class FiltrationProgram {
 public:
  /// Writes the file that the program reads, in a process of its own. Requires: a method among program_methods().
  FiltrationProgram(const Scenario& scenario, std::uint64_t size, std::string method);
  /// Runs the program and checks what it wrote. The first run finds the quickest options.
  [[nodiscard]] Sample run(unsigned most_seconds);

 private:
  [[nodiscard]] Sample run_with(const std::string& options, unsigned most_seconds);
  [[nodiscard]] std::vector<std::string> command(const std::string& options) const;
  [[nodiscard]] std::string wrong_answer(const std::string& printed) const;

  const Scenario& scenario_;
  std::uint64_t size_;
  std::string method_;
  ScratchDirectory directory_;
  Sample trouble_;  ///< what every run comes to, unless its verdict is right
  std::string program_;
  std::vector<std::string> options_;  ///< sets of options yet to be compared; the chosen one when there is but one
  std::uint64_t cells_ = 0;
};

}  // namespace sesame::tools

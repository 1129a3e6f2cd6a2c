/// \file
/// Single runs of a method on a scenario, in this process or by another program.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/towers/barcode.hpp"
#include "tools/bench/measurement.hpp"
#include "tools/bench/processes.hpp"
#include "tools/bench/scenarios.hpp"
#include "tools/bench/step_times.hpp"

namespace sesame::tools {

/// Runs in this process, whose memory is counted. Only the last answer is looked at.
/// Requires: a method of the scenario that is no program; a construction, or a filtration or a tower, or a zigzag. Of
/// a zigzag the last step has what is found when all operations are known.
[[nodiscard]] Sample run_construction(const Scenario& scenario, std::uint64_t size, const std::string& method,
                                      const RunOptions& options, StepTimes& times);
[[nodiscard]] Sample run_tracker(const Scenario& scenario, std::uint64_t size, const std::string& method,
                                 const RunOptions& options, StepTimes& times);
[[nodiscard]] Sample run_zigzag(const Scenario& scenario, std::uint64_t size, const std::string& method,
                                const RunOptions& options, StepTimes& times);

/// Carries the first steps out once more and checks the answer after each of them: those of constructions as
/// AnswerCheck says; in filtrations and towers the Euler characteristic, and with another tracker the Betti numbers and
/// the bars so far; in zigzags the Euler characteristic, and after the last of the steps the bars, which are found in
/// both ways. Nothing but verdict, remark, steps and `checked` has a meaning. Requires: as above.
[[nodiscard]] Sample check_construction(const Scenario& scenario, std::uint64_t size, const std::string& method,
                                        std::uint64_t steps, double most_seconds, StepTimes& times);
[[nodiscard]] Sample check_tracker(const Scenario& scenario, std::uint64_t size, const std::string& method,
                                   std::uint64_t steps, double most_seconds, StepTimes& times);
[[nodiscard]] Sample check_zigzag(const Scenario& scenario, std::uint64_t size, const std::string& method,
                                  std::uint64_t steps, double most_seconds, StepTimes& times);

/// Bars in any order: how many, and a number that other bars are most unlikely to have.
struct BarSet {
  std::uint64_t size = 0, digest = 0;
  std::vector<std::int64_t> betti;  ///< how many do not end, by dimension
  void add(const engine::Bar& bar);
  friend bool operator==(const BarSet& one, const BarSet& other) {
    return one.size == other.size && one.digest == other.digest;
  }
};
/// All bars of a filtration, those that do not end too; times are the places of its cells.
[[nodiscard]] BarSet bars_of(const Scenario& scenario, std::uint64_t size);

/// The methods that are trackers of this process, those that are ways of finding the bars of a zigzag, and those that
/// are programs.
[[nodiscard]] std::span<const std::string> tracker_methods();
[[nodiscard]] std::span<const std::string> zigzag_methods();
[[nodiscard]] std::span<const std::string> program_methods();

/// A program on a filtration: it reads a file and writes the pairs or bars to another one, and what is measured is all
/// of that.
class FiltrationProgram {
 public:
  /// Writes the file that the program reads, in a process of its own. Requires: a method among program_methods().
  FiltrationProgram(const Scenario& scenario, std::uint64_t size, std::string method);
  /// Runs the program and compares its bars with those of this one, and the Betti numbers with the answer; of
  /// GUDHI these only. The first run finds the quickest options.
  [[nodiscard]] Sample run(unsigned most_seconds);

 private:
  [[nodiscard]] Sample run_with(const std::string& options, unsigned most_seconds);
  [[nodiscard]] std::vector<std::string> command(const std::string& options) const;
  /// Errors: expectation, what is wrong with the answer; others, why what the program wrote cannot be read.
  [[nodiscard]] Status check_answer(const std::string& printed) const;

  const Scenario& scenario_;
  std::uint64_t size_;
  std::string method_;
  ScratchDirectory directory_;
  Sample trouble_;  ///< what every run comes to, unless its verdict is right
  std::string program_;
  std::vector<std::string> options_;  ///< sets of options yet to be compared; the chosen one when there is but one
  std::uint64_t cells_ = 0;
  BarSet bars_;  ///< what the program should find
};

}  // namespace sesame::tools

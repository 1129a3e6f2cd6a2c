/// \file
/// Running the steps of a scenario and measuring each.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "sparse/result.hpp"
#include "tools/bench/measurement.hpp"

namespace sesame::tools {

/// Measures what comes one after another, each until the next begins. What other processes took of a processor in the
/// meantime is left out: on a busy machine the longest steps would be theirs. The processor's own clock is only read
/// after what took longer than such an interruption may be short, since reading it takes as long as a short step.
class StepClock {
 public:
  StepClock() { begin(); }
  /// Begins anew; what happened since the last `lap` does not count.
  void begin();
  /// Microseconds since the last `lap` or `begin`.
  double lap();

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_, compared_;  ///< when the two clocks were compared last
  double processor_ = 0;               ///< microseconds, then
};

/// The times of the steps of a run, in memory that is shared with the processes that are started later: when one of
/// them had to be ended in the middle of a step, the steps before are known.
class StepTimes {
 public:
  static constexpr std::size_t capacity = std::size_t{1} << 26;

  /// Takes up address space only; memory is taken as steps are written.
  StepTimes();
  StepTimes(const StepTimes&) = delete;
  StepTimes& operator=(const StepTimes&) = delete;
  ~StepTimes();

  /// Forgets all, and takes the memory of so many steps at once. Requires: no more than `capacity`.
  void begin(std::size_t steps);
  void add(double microseconds);
  [[nodiscard]] std::size_t steps() const;
  [[nodiscard]] double total() const;
  /// Sets the seconds, steps, latencies and timeline of a sample. Reorders the times.
  void sum_up(Sample& sample);

 private:
  struct Shared;
  Shared* shared_;
};

struct RunOptions {
  double most_seconds = 60;  ///< a run ends with the first step after that
  bool counts_heap = false;  ///< which makes it slower
};

/// Calls step(k) for k = 0, 1, ... and measures each call, until all are done, one says that it cannot or that an
/// answer is wrong (Errc::expectation), or the time is up. When a step does not come back a quarter later, this process
/// is ended by SIGPROF. Everything but the counts of the method is in the sample then.
[[nodiscard]] Sample measure_steps(std::size_t steps, const RunOptions& options, StepTimes& times,
                                   const std::function<Status(std::size_t)>& step);

}  // namespace sesame::tools

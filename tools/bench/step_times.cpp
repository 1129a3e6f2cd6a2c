#include "tools/bench/step_times.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <span>
#include <vector>

#include "tools/bench/heap_count.hpp"
#include "tools/bench/processes.hpp"

namespace sesame::tools {
namespace {

using Clock = std::chrono::steady_clock;
using Microseconds = std::chrono::duration<double, std::micro>;

/// Latencies and timeline. Reorders the times.
void sum_up(std::span<double> times, Sample& sample) {
  constexpr std::size_t parts = 240;  // a few pixels each in a picture
  if (times.empty()) {
    return;
  }
  for (std::size_t k = 0, begin = 0; k < parts; ++k) {
    const std::size_t end = times.size() * (k + 1) / parts;
    if (end > begin) {
      const std::span<double> part = times.subspan(begin, end - begin);
      sample.timeline.push_back({end, percentile(part, 0.5), std::ranges::max(part)});
      begin = end;
    }
  }
  sample.step = {percentile(times, 0.5), percentile(times, 0.99), std::ranges::max(times)};
}

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

Sample measure_steps(std::size_t steps, const RunOptions& options, const std::function<Status(std::size_t)>& step) {
  Sample sample;
  std::vector<double> times(steps);  // written once before, so that its memory is not that of the run
  forget_peak_memory();
  const std::uint64_t resident = resident_memory().now;
  if (options.counts_heap) {
    begin_heap_count();
  }
  const double processor = processor_seconds();
  double total = 0;
  std::size_t done = 0;
  for (Clock::time_point last = Clock::now(); done < steps; ++done) {
    if (total > options.most_seconds * 1e6) {
      sample.verdict = Verdict::cut;
      sample.remark = "the time was up";
      break;
    }
    if (const Status status = step(done); !status) {
      sample.verdict = Verdict::refused;
      sample.remark = status.error().what;
      break;
    }
    const Clock::time_point now = Clock::now();
    times[done] = Microseconds{now - last}.count();
    total += times[done];
    last = now;
  }
  sample.processor_seconds = processor_seconds() - processor;
  if (options.counts_heap) {
    const HeapUse heap = end_heap_count();
    sample.allocations = heap.allocations;
    sample.memory.heap = heap.peak_bytes;
  }
  const std::uint64_t peak = resident_memory().peak;
  sample.memory.resident = peak > resident ? peak - resident : 0;
  sample.steps = done;
  sample.seconds = total / 1e6;
  sum_up({times.data(), done}, sample);
  return sample;
}

}  // namespace sesame::tools

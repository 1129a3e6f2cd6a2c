#include "tools/bench/step_times.hpp"

#include <sys/mman.h>
#include <sys/time.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <ctime>
#include <new>
#include <numeric>
#include <span>

#include "sparse/contract.hpp"
#include "tools/bench/heap_count.hpp"
#include "tools/bench/processes.hpp"

namespace sesame::tools {
namespace {

using Microseconds = std::chrono::duration<double, std::micro>;

double processor_microseconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return 1e6 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_nsec);
}

/// Has this process ended by SIGPROF after so many seconds on a processor while it lives.
class ProcessorLimit {
 public:
  explicit ProcessorLimit(double seconds) {
    std::signal(SIGPROF, SIG_DFL);
    set(std::min(seconds, 1e8));
  }
  ProcessorLimit(const ProcessorLimit&) = delete;
  ProcessorLimit& operator=(const ProcessorLimit&) = delete;
  ~ProcessorLimit() { set(0); }

 private:
  static void set(double seconds) {
    itimerval timer{};
    timer.it_value.tv_sec = static_cast<time_t>(seconds);
    timer.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (seconds - std::floor(seconds)));
    setitimer(ITIMER_PROF, &timer, nullptr);
  }
};

}  // namespace

// ---- the clock

void StepClock::begin() {
  processor_ = processor_microseconds(CLOCK_THREAD_CPUTIME_ID);
  last_ = compared_ = Clock::now();
}

double StepClock::lap() {
  constexpr double longest_without_interruption = 20;
  const Clock::time_point now = Clock::now();
  const double passed = Microseconds{now - last_}.count();
  if (passed < longest_without_interruption) {
    last_ = now;
    return passed;
  }
  const double since = Microseconds{now - compared_}.count(), before = processor_;
  begin();
  const double taken_by_others = since - (processor_ - before);
  return std::max(passed - std::max(taken_by_others, 0.0), 0.0);
}

// ---- the times

struct StepTimes::Shared {
  std::atomic<std::size_t> steps;
  double microseconds[1];  // and on
};

namespace {

constexpr std::size_t shared_bytes = (StepTimes::capacity + 8) * sizeof(double);

}  // namespace

StepTimes::StepTimes() {
  void* const memory =
      mmap(nullptr, shared_bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) {
    throw std::bad_alloc{};
  }
  shared_ = new (memory) Shared{};
}

StepTimes::~StepTimes() { munmap(shared_, shared_bytes); }

void StepTimes::begin(std::size_t steps) {
  sparse::expects(steps <= capacity, "a run has no more steps than there is room for their times");
  std::fill_n(shared_->microseconds, steps, 0.0);
  shared_->steps = 0;
}

void StepTimes::add(double microseconds) {
  const std::size_t k = shared_->steps.load(std::memory_order_relaxed);
  shared_->microseconds[k] = microseconds;
  shared_->steps.store(k + 1, std::memory_order_release);
}

std::size_t StepTimes::steps() const { return shared_->steps; }

double StepTimes::total() const { return std::accumulate(shared_->microseconds, shared_->microseconds + steps(), 0.0); }

void StepTimes::sum_up(Sample& sample) {
  constexpr std::size_t parts = 240;  // a few pixels each in a picture
  const std::span<double> times{shared_->microseconds, steps()};
  sample.steps = times.size();
  if (times.empty()) {
    return;
  }
  for (std::size_t k = 0, begin = 0; k < parts; ++k) {
    const std::size_t end = times.size() * (k + 1) / parts;
    if (end > begin) {
      const Latency part = latency_of(times.subspan(begin, end - begin));
      sample.timeline.push_back({end, part.mean, part.p50, part.max});
      begin = end;
    }
  }
  sample.step = latency_of(times);
  sample.seconds = 1e-6 * sample.step.mean * static_cast<double>(sample.steps);
}

// ---- a run

Sample measure_steps(std::size_t steps, const RunOptions& options, StepTimes& times,
                     const std::function<Status(std::size_t)>& step) {
  Sample sample;
  times.begin(steps);  // written once before, so that its memory is not that of the run
  forget_peak_memory();
  const std::uint64_t resident = resident_memory().now;
  const ProcessorLimit limit(1.25 * options.most_seconds + 1);
  if (options.counts_heap) {
    begin_heap_count();
  }
  const double processor = processor_microseconds(CLOCK_PROCESS_CPUTIME_ID);
  const auto begin = std::chrono::steady_clock::now();
  StepClock clock;
  double total = 0;
  while (times.steps() < steps) {
    if (total > options.most_seconds * 1e6) {
      sample.verdict = Verdict::cut;
      sample.remark = "the time was up";
      break;
    }
    if (const Status status = step(times.steps()); !status) {
      sample.verdict = status.error().code == Errc::expectation ? Verdict::wrong : Verdict::refused;
      sample.remark = status.error().what;
      break;
    }
    const double taken = clock.lap();
    times.add(taken);
    total += taken;
  }
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
  sample.busy = 1e-6 * (processor_microseconds(CLOCK_PROCESS_CPUTIME_ID) - processor) / passed.count();
  if (options.counts_heap) {
    const HeapUse heap = end_heap_count();
    sample.allocations = heap.allocations;
    sample.memory.heap = heap.peak_bytes;
  }
  const std::uint64_t peak = resident_memory().peak;
  sample.memory.resident = peak > resident ? peak - resident : 0;
  times.sum_up(sample);
  return sample;
}

}  // namespace sesame::tools

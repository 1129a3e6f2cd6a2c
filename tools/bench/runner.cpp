#include "tools/bench/runner.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "tools/bench/processes.hpp"
#include "tools/bench/runs.hpp"

namespace sesame::tools {
namespace {

using Json = nlohmann::ordered_json;

Sample failed(const std::string& why) {
  Sample sample;
  sample.verdict = Verdict::failed;
  sample.remark = why;
  return sample;
}

/// The runs of a method on a scenario, each in a process of its own.
struct Runs {
  std::function<Sample(bool is_first)> run;          ///< the first one gives memory and counts
  std::function<Sample(std::uint64_t steps)> check;  ///< of so many steps; null: every run is checked
};

/// What a run comes to that had to be ended in the middle of a step, which is among the latencies with the time it had.
Sample ended_in_step(StepTimes& times, double most_seconds) {
  Sample sample;
  times.add(std::max(1e6 * most_seconds - times.total(), 0.0));
  times.sum_up(sample);
  sample.verdict = Verdict::cut;
  sample.remark = "the time was up in the middle of step " + std::to_string(sample.steps--);
  return sample;
}

Runs runs_of(const Scenario& scenario, std::uint64_t size, const std::string& method, double most_seconds) {
  if (std::ranges::find(program_methods(), method) != program_methods().end()) {
    const auto limit = static_cast<unsigned>(std::clamp(std::ceil(most_seconds), 1.0, 1e6));
    const auto program = std::make_shared<FiltrationProgram>(scenario, size, method);
    return {[program, limit](bool) { return program->run(limit); }, nullptr};
  }
  const auto times = std::make_shared<StepTimes>();
  // Making the input is not under the limit of the run.
  const auto process_limit = static_cast<unsigned>(std::min(std::ceil(4 * most_seconds) + 60, 1e6));
  const auto sample_of = [times, most_seconds, process_limit](const std::function<Sample()>& work) {
    const Result<std::string> text = in_child([&] { return Json(work()).dump(); }, process_limit,
                                              [&] { return Json(ended_in_step(*times, most_seconds)).dump(); });
    return text ? Json::parse(*text).get<Sample>() : failed(text.error().what);
  };
  const bool is_construction = std::holds_alternative<Construction>(scenario.input);
  const bool is_zigzag = std::holds_alternative<Zigzag>(scenario.input);
  const auto run = is_construction ? run_construction : is_zigzag ? run_zigzag : run_tracker;
  const auto check = is_construction ? check_construction : is_zigzag ? check_zigzag : check_tracker;
  return {[=, &scenario](bool is_first) {
            return sample_of([&] { return run(scenario, size, method, {most_seconds, is_first}, *times); });
          },
          [=, &scenario](std::uint64_t steps) {
            return sample_of([&] { return check(scenario, size, method, steps, most_seconds, *times); });
          }};
}

}  // namespace

Measurement sum_up(const Sample& first, const std::vector<Sample>& timed) {
  Measurement m;
  m.verdict = first.verdict;
  m.remark = first.remark;
  m.steps = first.steps;
  m.memory = first.memory;
  m.counts = first.counts;
  if (first.allocations > 0) {
    m.counts.emplace_back("allocations", first.allocations);
  }
  std::vector<double> seconds, busy, mean, p50, p99, max;
  for (const Sample& sample : timed) {
    if (sample.verdict != Verdict::right) {
      m.verdict = sample.verdict;
      m.remark = sample.remark;
      m.steps = sample.steps;
    }
    seconds.push_back(sample.seconds);
    busy.push_back(sample.busy);
    mean.push_back(sample.step.mean);
    p50.push_back(sample.step.p50);
    p99.push_back(sample.step.p99);
    max.push_back(sample.step.max);
  }
  if (!timed.empty()) {
    m.seconds = spread_of(seconds);
    m.busy = median(busy);
    m.step = {median(mean), median(p50), median(p99), median(max)};
    m.timeline = timed.front().timeline;
  }
  return m;
}

Measurement measure(const Scenario& scenario, std::uint64_t size, const std::string& method,
                    const RunnerOptions& options) {
  const Runs runs = runs_of(scenario, size, method, options.most_seconds);
  const auto goes_on = [](const Sample& sample) {
    return sample.verdict == Verdict::right || sample.verdict == Verdict::cut;
  };
  const Sample first = runs.run(true);
  const Sample checked = runs.check && goes_on(first) ? runs.check(first.steps) : first;
  std::vector<Sample> timed;
  while (goes_on(first) && goes_on(checked) && timed.size() < options.repeats &&
         (timed.empty() || timed.back().verdict == Verdict::right)) {
    timed.push_back(runs.run(false));
  }
  Measurement m = sum_up(goes_on(checked) ? first : checked, timed);
  m.checked = checked.checked;
  m.scenario = scenario.name;
  m.family = scenario.family;
  m.size = size;
  m.method = method;
  m.ring = std::holds_alternative<Construction>(scenario.input) ? scenario.ring : "Z/2";
  return m;
}

}  // namespace sesame::tools

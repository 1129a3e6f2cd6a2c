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

Sample run_here(const Scenario& scenario, std::uint64_t size, const std::string& method, const RunOptions& options) {
  if (std::holds_alternative<Construction>(scenario.input)) {
    return run_construction(scenario, size, method, options);
  }
  return std::holds_alternative<CellFiltration>(scenario.input) ? run_filtration(scenario, size, method, options)
                                                                : run_tower(scenario, size, method, options);
}

/// One run of a method on a scenario, wherever it runs; `is_first` when it is to give memory and counts.
std::function<Sample(bool is_first)> runs_of(const Scenario& scenario, std::uint64_t size, const std::string& method,
                                             double most_seconds) {
  // Making the input, and a step that takes very long, are not under the limit of the run.
  const auto process_limit = static_cast<unsigned>(std::min(std::ceil(4 * most_seconds) + 60, 1e6));
  if (std::ranges::find(program_methods(), method) != program_methods().end()) {
    const auto limit = static_cast<unsigned>(std::clamp(std::ceil(most_seconds), 1.0, 1e6));
    const auto program = std::make_shared<FiltrationProgram>(scenario, size, method);
    return [program, limit](bool) { return program->run(limit); };
  }
  return [&scenario, size, method, most_seconds, process_limit](bool is_first) {
    const auto work = [&] { return Json(run_here(scenario, size, method, {most_seconds, is_first})).dump(); };
    const Result<std::string> text = in_child(work, process_limit);
    return text ? Json::parse(*text).get<Sample>() : failed(text.error().what);
  };
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
  std::vector<double> seconds, busy, p50, p99, max;
  for (const Sample& sample : timed) {
    if (sample.verdict != Verdict::right) {
      m.verdict = sample.verdict;
      m.remark = sample.remark;
      m.steps = sample.steps;
    }
    seconds.push_back(sample.seconds);
    busy.push_back(sample.seconds > 0 ? sample.processor_seconds / sample.seconds : 0);
    p50.push_back(sample.step.p50);
    p99.push_back(sample.step.p99);
    max.push_back(sample.step.max);
  }
  if (!timed.empty()) {
    m.seconds = spread_of(seconds);
    m.busy = median(busy);
    m.step = {median(p50), median(p99), median(max)};
    m.timeline = timed.front().timeline;
  }
  return m;
}

Measurement measure(const Scenario& scenario, std::uint64_t size, const std::string& method,
                    const RunnerOptions& options) {
  const std::function<Sample(bool)> run = runs_of(scenario, size, method, options.most_seconds);
  const Sample first = run(true);
  std::vector<Sample> timed;
  const auto goes_on = [&](const Sample& sample) {
    return timed.size() < options.repeats && (sample.verdict == Verdict::right || sample.verdict == Verdict::cut);
  };
  while (goes_on(timed.empty() ? first : timed.back()) && (timed.empty() || timed.back().verdict != Verdict::cut)) {
    timed.push_back(run(false));
  }
  Measurement m = sum_up(first, timed);
  m.scenario = scenario.name;
  m.family = scenario.family;
  m.size = size;
  m.method = method;
  m.ring = std::holds_alternative<Construction>(scenario.input) ? scenario.ring : "Z/2";
  return m;
}

}  // namespace sesame::tools

#include "tools/bench/scaling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "sparse/contract.hpp"
#include "tools/bench/answer_check.hpp"
#include "tools/bench/method.hpp"
#include "tools/bench/processes.hpp"
#include "tools/bench/step_times.hpp"

namespace sesame::tools {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

/// The sum of all that a method counts, but for what it holds.
std::uint64_t touched(const Method& method) {
  std::uint64_t sum = 0;
  for (const auto& [name, count] : method.counts()) {
    sum += name.ends_with("_held") ? 0 : count;
  }
  return sum;
}

/// Errors: why a step cannot be taken; expectation, for a wrong answer.
Result<ScalingPoint> measure_point(const Experiment& experiment, Method& method, std::uint64_t x) {
  const ScalingWorkload workload = experiment.make(x);
  for (const ops::Operation& operation : workload.before) {
    if (Status status = method.apply(operation); !status) {
      return status.error();
    }
    method.homology();
  }
  std::vector<double> microseconds;
  double count = 0;
  std::vector<engine::Homology> found;
  StepClock clock;
  for (std::size_t number = 0; number < workload.rounds.size(); ++number) {
    const std::vector<ops::Operation>& round = workload.rounds[number];
    const std::uint64_t before = touched(method);
    std::uint64_t terms = 0;
    found.clear();
    clock.begin();
    for (const ops::Operation& operation : round) {
      if (Status status = method.apply(operation); !status) {
        return status.error();
      }
      found.push_back(method.homology());
      terms += experiment.with_generators ? method.generators() : 0;
    }
    const auto steps = static_cast<double>(round.size());
    microseconds.push_back(clock.lap() / steps);
    count += static_cast<double>(touched(method) - before + terms) / steps;
    for (std::size_t step = 0; step < found.size(); ++step) {
      if (const Status right = check(found[step], workload.answer(number, step)); !right) {
        return Error{Errc::expectation,
                     fmt::format("step {} of round {}: {}", step + 1, number + 1, right.error().what)};
      }
    }
  }
  return ScalingPoint{workload.x, latency_of(microseconds), count / static_cast<double>(workload.rounds.size())};
}

std::vector<std::uint64_t> sizes_of(const Experiment& experiment, Extent extent) {
  const std::uint64_t largest = extent == Extent::quick   ? experiment.quick_largest
                                : extent == Extent::large ? experiment.large_largest
                                                          : experiment.largest;
  std::vector<std::uint64_t> sizes;
  for (std::uint64_t power = experiment.smallest; power <= largest; power *= 10) {
    sizes.push_back(power);
    if (const std::uint64_t between = power * 316 / 100; between <= largest) {
      sizes.push_back(between);
    }
  }
  return sizes;
}

template <class Value>
std::optional<PowerLaw> fit(const Scaling& scaling, Value value) {
  std::vector<Sighting> points;
  for (const ScalingPoint& point : scaling.points) {
    const double y = value(point);
    if (y <= 0) {
      return std::nullopt;
    }
    points.push_back({static_cast<double>(point.x), y});
  }
  return points.size() < 2 ? std::nullopt : std::optional{fit_power_law(points)};
}

}  // namespace

Scaling run_experiment(const Experiment& experiment, const std::string& method_name, Extent extent,
                       double most_seconds) {
  const auto entry = std::ranges::find(methods(), method_name, &MethodEntry::name);
  const Result<sparse::AnyRing> ring = sparse::parse_ring(experiment.ring);
  sparse::expects(entry != methods().end() && ring.has_value(), "method and ring of an experiment exist");
  Scaling scaling{experiment.name, experiment.what, method_name, experiment.x_name, experiment.expected, {}, {}, false};
  for (const std::uint64_t x : sizes_of(experiment, extent)) {
    const auto work = [&] {
      const std::unique_ptr<Method> method = entry->make(*ring);
      const Result<ScalingPoint> point = measure_point(experiment, *method, x);
      const Json json = point ? Json(*point) : Json{{"error", point.error().what}, {"code", point.error().code}};
      return json.dump();
    };
    const Clock::time_point begin = Clock::now();
    const Result<std::string> text = in_child(work, static_cast<unsigned>(std::clamp(4 * most_seconds, 1.0, 1e6)));
    const Json json = text ? Json::parse(*text) : Json{{"error", text.error().what}, {"code", text.error().code}};
    if (json.contains("error")) {
      scaling.remark = "at " + std::to_string(x) + ": " + json.at("error").get<std::string>();
      scaling.is_wrong = json.at("code").get<Errc>() == Errc::expectation;
      break;
    }
    scaling.points.push_back(json.get<ScalingPoint>());
    if (std::chrono::duration<double>(Clock::now() - begin).count() > most_seconds) {
      scaling.remark = "ends where the time was up";
      break;
    }
  }
  return scaling;
}

std::optional<PowerLaw> fit_times(const Scaling& scaling, double Latency::*part) {
  return fit(scaling, [part](const ScalingPoint& point) { return point.step.*part; });
}

std::optional<PowerLaw> fit_counts(const Scaling& scaling) {
  return fit(scaling, [](const ScalingPoint& point) { return point.touched; });
}

}  // namespace sesame::tools

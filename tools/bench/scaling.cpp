#include "tools/bench/scaling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sparse/contract.hpp"
#include "tools/bench/answer_check.hpp"
#include "tools/bench/constructions.hpp"
#include "tools/bench/method.hpp"
#include "tools/bench/processes.hpp"
#include "tools/bench/step_times.hpp"

namespace sesame::tools {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;
using Rounds = std::vector<std::vector<ops::Operation>>;

constexpr std::uint64_t rounds_measured = 25;

/// The answers after the steps of a round when they are the same in every round.
std::function<Answer(std::size_t, std::size_t)> in_every_round(std::vector<Answer> answers) {
  return [answers = std::move(answers)](std::size_t, std::size_t step) { return answers.at(step); };
}

std::string place(const std::string& kind, std::uint64_t i, std::uint64_t j) {
  return kind + std::to_string(i) + "_" + std::to_string(j);
}

/// The torus of n x n squares as one complex K of 4 n^2 cells: vertices v, edges h and u, squares s.
ops::MakeComplex given_torus(std::uint64_t n) {
  ops::MakeComplex complex{"K", {}};
  for (std::uint64_t i = 0; i < n; ++i) {
    for (std::uint64_t j = 0; j < n; ++j) {
      const std::uint64_t right = (i + 1) % n, up = (j + 1) % n;
      const std::string v = place("v", i, j), h = place("h", i, j), u = place("u", i, j);
      complex.cells.push_back({v, {}, {}, {}});
      complex.cells.push_back({h, {}, {place("v", right, j), v}, {}});
      complex.cells.push_back({u, {}, {place("v", i, up), v}, {}});
      complex.cells.push_back(
          {place("s", i, j), ops::CellType{1, 1}, {place("u", right, j), u, place("h", i, up), h}, {}});
    }
  }
  return complex;
}

/// Steps of different kinds at places all over the torus: a triangle is glued to it along an edge, two of its edges are
/// coned, and a square is glued onto a square.
Rounds work_on_torus(std::uint64_t n) {
  Rounds rounds;
  for (std::uint64_t round = 0; round < rounds_measured; ++round) {
    const std::uint64_t at = round * (n * n / rounds_measured);
    const std::string k = std::to_string(round);
    const auto here = [i = at / n, j = at % n](const char* kind) { return place(kind, i, j); };
    rounds.push_back({ops::MakeSimplex{"a" + k, 2, {}}, ops::Identify{{{"a" + k + ".0-1", here("K.h")}}},
                      ops::MakeCone{"c" + k, std::vector<std::string>{here("K.u"), "a" + k + ".1-2"}, {}},
                      ops::MakeSimploid{"q" + k, {1, 1}, {}}, ops::Identify{{{"q" + k, here("K.s")}}}});
  }
  return rounds;
}

ScalingWorkload on_objects(std::uint64_t x) {
  const auto n = std::max<std::uint64_t>(5, static_cast<std::uint64_t>(std::sqrt(static_cast<double>(x) / 4)));
  const auto answer = [](std::size_t round, std::size_t step) {
    const std::int64_t pieces = step == 0 || step == 3 ? 2 : 1;  // what is new is not glued yet
    const std::int64_t loops = step < 2 ? 0 : 1;                 // the cone over two edges that are apart adds one
    return Answer{{pieces, 2 + static_cast<std::int64_t>(round) + loops, 1}};
  };
  return {4 * n * n, {given_torus(n)}, work_on_torus(n), answer};
}

/// Squares that are made and glued onto the first one, which is all that there is after every other step.
ScalingWorkload after_gluings(std::uint64_t x) {
  const auto glue_on = [](std::vector<ops::Operation>& operations, std::uint64_t number) {
    const std::string name = "q" + std::to_string(number);
    operations.emplace_back(ops::MakeSimploid{name, {1, 1}, {}});
    operations.emplace_back(ops::Identify{{{"q", name}}});
  };
  ScalingWorkload workload{1 + 2 * (x / 2), {ops::MakeSimploid{"q", {1, 1}, {}}}, {}, in_every_round({{{2}}, {{1}}})};
  for (std::uint64_t k = 0; k < x / 2; ++k) {
    glue_on(workload.before, k);
  }
  for (std::uint64_t k = 0; k < rounds_measured; ++k) {
    glue_on(workload.rounds.emplace_back(), x / 2 + k);
  }
  return workload;
}

/// Four places that are glued and split in turn, x steps in all.
ScalingWorkload after_splits(std::uint64_t x) {
  constexpr std::uint64_t rounds = 200;  // as few of them do most of the work
  Operations operations = glued_and_split(4, x / 2 + rounds);
  ScalingWorkload workload{0, {}, {}, in_every_round({{{4, 1}}, {{4}}})};
  const auto measured = operations.end() - static_cast<std::ptrdiff_t>(2 * rounds);
  for (auto at = measured; at != operations.end(); at += 2) {
    workload.rounds.emplace_back(at, at + 2);
  }
  workload.before.assign(std::move_iterator{operations.begin()}, std::move_iterator{measured});
  workload.x = workload.before.size();
  return workload;
}

/// As many circles as loops, each an edge and a vertex. One vertex is split, which opens its loop, and that is undone.
ScalingWorkload among_loops(std::uint64_t x) {
  ops::MakeComplex circles{"K", {}};
  const auto v = [](std::uint64_t k) { return "v" + std::to_string(k); };
  for (std::uint64_t k = 0; k < x; ++k) {
    circles.cells.push_back({v(k), {}, {}, {}});
    circles.cells.push_back({"e" + std::to_string(k), {}, {v(k), v(k)}, {}});
  }
  const auto loops = static_cast<std::int64_t>(x);
  ScalingWorkload workload{x, {std::move(circles)}, {}, in_every_round({{{loops, loops - 1}}, {{loops, loops}}})};
  for (std::uint64_t round = 0; round < rounds_measured; ++round) {
    const std::string k = std::to_string(round * (x / rounds_measured));
    workload.rounds.push_back(
        {ops::Deidentify{{{"K.v" + k, "w" + std::to_string(round), {{"K.e" + k, 0}}}}}, ops::Undo{1}});
  }
  return workload;
}

/// A strip of triangles (k, k+1, k+2): 4 triangles + 3 cells.
ops::MakeComplex strip(const std::string& name, std::uint64_t triangles) {
  ops::MakeComplex complex{name, {}};
  const auto v = [](std::uint64_t k) { return "v" + std::to_string(k); };
  const auto side = [](std::uint64_t k) { return "e" + std::to_string(k); };
  const auto rim = [](std::uint64_t k) { return "f" + std::to_string(k); };
  for (std::uint64_t k = 0; k < triangles + 2; ++k) {
    complex.cells.push_back({v(k), {}, {}, {}});
  }
  for (std::uint64_t k = 0; k < triangles + 1; ++k) {
    complex.cells.push_back({side(k), {}, {v(k + 1), v(k)}, {}});
  }
  for (std::uint64_t k = 0; k < triangles; ++k) {
    complex.cells.push_back({rim(k), {}, {v(k + 2), v(k)}, {}});
    complex.cells.push_back({"t" + std::to_string(k), {}, {side(k + 1), rim(k), side(k)}, {}});
  }
  return complex;
}

/// Strips that are glued onto the first one, each as a whole in one step.
ScalingWorkload on_parts(std::uint64_t x) {
  constexpr std::uint64_t most_strips = 15;
  const std::uint64_t triangles = std::max<std::uint64_t>(1, x / 4), strips = x > 10'000 ? 5 : most_strips;
  const auto answer = [strips](std::size_t round, std::size_t) {  // each round makes two pieces one
    return Answer{{static_cast<std::int64_t>(strips - round)}};
  };
  ScalingWorkload workload{4 * triangles + 3, {strip("s0", triangles)}, {}, answer};
  for (std::uint64_t k = 1; k <= strips; ++k) {
    const std::string name = "s" + std::to_string(k);
    workload.before.emplace_back(strip(name, triangles));
    ops::Identify glue;
    for (std::uint64_t t = 0; t < triangles; ++t) {
      glue.pairs.emplace_back("s0.t" + std::to_string(t), name + ".t" + std::to_string(t));
    }
    workload.rounds.push_back({std::move(glue)});
  }
  return workload;
}

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

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> all{
      {"object size",
       "a triangle, a cone and a square are glued to a torus that was given at once",
       "cells",
       0,
       "Z",
       {"live"},
       false,
       100,
       1'000'000,
       10'000,
       10'000'000,
       on_objects},
      {"history length",
       "a square is made and glued onto the first one",
       "steps before",
       0,
       "Z",
       {"live"},
       false,
       100,
       1'000'000,
       10'000,
       10'000'000,
       after_gluings},
      {"history of splits",
       "four places are glued and split in turn",
       "steps before",
       0,
       "Z",
       {"live", "eager", "recompute"},
       false,
       100,
       10'000,
       1'000,
       100'000,
       after_splits},
      {"homology",
       "in one of many circles a vertex is split, and that is undone",
       "loops",
       0,
       "Z",
       {"live"},
       false,
       100,
       100'000,
       1'000,
       1'000'000,
       among_loops},
      {"touched part",
       "a strip of triangles is glued onto another one in one step",
       "cells glued",
       1,
       "Z",
       {"live"},
       false,
       10,
       100'000,
       1'000,
       1'000'000,
       on_parts},
      {"claim: small complex",
       "work on a torus as above; homology after every step",
       "cells",
       0,
       "Z",
       {"live", "eager-small"},
       false,
       1'000,
       100'000,
       3'200,
       1'000'000,
       on_objects},
      {"claim: generators",
       "the same, and all generators are mapped back after every step",
       "cells",
       1,
       "Z",
       {"live", "eager"},
       true,
       1'000,
       100'000,
       3'200,
       1'000'000,
       on_objects},
  };
  return all;
}

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

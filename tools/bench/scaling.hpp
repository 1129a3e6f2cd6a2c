/// \file
/// How the cost of a step grows: with the size of the object, the length of the history, the part that is touched.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ops/vocabulary/operation.hpp"
#include "tools/bench/measurement.hpp"
#include "tools/bench/scenarios.hpp"

namespace sesame::tools {

/// What is measured at one x.
struct ScalingWorkload {
  std::uint64_t x = 0;                 ///< as near to what was asked for as there is
  std::vector<ops::Operation> before;  ///< not measured
  /// Measured, each round alike but for what it touches: see ScalingPoint.
  std::vector<std::vector<ops::Operation>> rounds;
  std::function<Answer(std::size_t round, std::size_t step)> answer;  ///< the homology after a step of a round
};

struct Experiment {
  std::string name, what, x_name;
  double expected;  ///< exponent of the cost per step
  std::string ring;
  std::vector<std::string> methods;
  bool with_generators;  ///< all generators are asked for after every step
  std::uint64_t smallest, largest, quick_largest, large_largest;
  std::function<ScalingWorkload(std::uint64_t x)> make;
};

[[nodiscard]] const std::vector<Experiment>& experiments();

enum class Extent { quick, normal, large };

/// Runs an experiment with one of its methods: two sizes for each power of ten, each in a process of its own, up to the
/// largest or until a point takes more than `most_seconds`. Every answer in the rounds is checked.
[[nodiscard]] Scaling run_experiment(const Experiment& experiment, const std::string& method, Extent extent,
                                     double most_seconds);

/// The fit of a part of the latency, or of the counts; nothing when there are too few points, or values of 0.
[[nodiscard]] std::optional<PowerLaw> fit_times(const Scaling& scaling, double Latency::*part);
[[nodiscard]] std::optional<PowerLaw> fit_counts(const Scaling& scaling);

}  // namespace sesame::tools

/// \file
/// What is measured: one run, the runs of a method on a scenario, a scaling experiment, a whole report; and their JSON.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "sparse/result.hpp"
#include "tools/bench/machine.hpp"
#include "tools/bench/statistics.hpp"

namespace sesame::tools {

/// Numbers that are the same in every run, by name, in the order in which they are shown.
using Counts = std::vector<std::pair<std::string, std::uint64_t>>;

/// The steps of a part of a run, in microseconds a step.
struct TimelinePoint {
  std::uint64_t last_step = 0;
  double mean = 0, median = 0, max = 0;
  friend bool operator==(const TimelinePoint&, const TimelinePoint&) = default;
};

/// Memory in bytes; 0 where it is not known.
struct Memory {
  std::uint64_t resident = 0;  ///< the most, beyond what there was before the first step
  std::uint64_t heap = 0;      ///< the same of what operator new gave
  friend bool operator==(const Memory&, const Memory&) = default;
};

enum class Verdict {
  right,    ///< all answers that were checked are right
  wrong,    ///< one is not
  cut,      ///< the time was up before the end; what was measured until then stands
  absent,   ///< the program is not installed
  refused,  ///< the method cannot do this
  failed,   ///< the run broke off
};

/// One run, in a process of its own.
struct Sample {
  Verdict verdict = Verdict::right;
  std::string remark;  ///< what is wrong, or which options a program was run with
  std::uint64_t steps = 0;
  std::uint64_t checked = 0;  ///< after so many of them the groups, or the bars, were compared with others
  double seconds = 0;
  double busy = 0;  ///< the part of the time, others' included, that was spent on a processor
  Latency step;     ///< in microseconds; 0 when a run has no steps that can be seen from here
  Memory memory;
  std::uint64_t allocations = 0;
  Counts counts;
  std::vector<TimelinePoint> timeline;
};

/// A method on a scenario: the first run, which warms up, gives memory and counts; the second one is for checking the
/// answers; the others give the times.
struct Measurement {
  std::string scenario, family, method, ring;
  std::uint64_t size = 0;
  Verdict verdict = Verdict::right;
  std::string remark;
  std::uint64_t steps = 0;
  std::uint64_t checked = 0;  ///< as of the run that checked
  Spread seconds;             ///< of whole runs
  double busy = 0;            ///< as of runs: much less than 1 when others wanted the machine too
  Latency step;               ///< medians over the runs
  Memory memory;
  Counts counts;  ///< those of the method, and allocations
  std::vector<TimelinePoint> timeline;

  [[nodiscard]] bool has_times() const { return seconds.runs > 0 && seconds.median > 0; }
};

struct ScalingPoint {
  std::uint64_t x = 0;
  Latency step;        ///< microseconds that a step takes, over the rounds
  double touched = 0;  ///< by a step, as the method counts: the mean
  friend bool operator==(const ScalingPoint&, const ScalingPoint&) = default;
};

/// Cost per step against something that grows.
struct Scaling {
  std::string experiment, what, method, x_name;
  double expected = 0;  ///< the exponent that theory says
  std::vector<ScalingPoint> points;
  std::string remark;     ///< why it ends before the largest x
  bool is_wrong = false;  ///< it ends with a wrong answer
};

struct Report {
  Machine machine;
  Build build;
  std::string date;
  std::vector<Measurement> measurements;
  std::vector<Scaling> scalings;
};

[[nodiscard]] std::string_view verdict_name(Verdict verdict);

void to_json(nlohmann::ordered_json& json, const Sample& sample);
void from_json(const nlohmann::ordered_json& json, Sample& sample);
void to_json(nlohmann::ordered_json& json, const ScalingPoint& point);
void from_json(const nlohmann::ordered_json& json, ScalingPoint& point);

/// One JSON object; a measurement a line. Version 1 had no means: they are 0 when it is read.
[[nodiscard]] std::string to_text(const Report& report);
/// Errors: bad_input, when it is no such object.
Result<Report> parse_report(const std::string& text);
/// Errors: as parse_report, and io; with the name of the file.
Result<Report> read_report(const std::string& path);

}  // namespace sesame::tools

#include "tools/bench/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/bench/scaling.hpp"

namespace sesame::tools {
namespace {

constexpr std::string_view allocations_name = "allocations";

template <std::size_t N>
std::string with_unit(double value, double base, const std::array<const char*, N>& units) {
  std::size_t unit = 0;
  while (unit + 1 < N && value >= 0.9995 * base) {
    value /= base;
    ++unit;
  }
  const int decimals = value >= 99.95 || value == 0 ? 0 : value >= 9.995 ? 1 : 2;
  return fmt::format("{:.{}f}{}", value, decimals, units[unit]);
}

std::string dash_or(double value, std::string (*text)(double)) { return value > 0 ? text(value) : "-"; }

std::string microseconds(double us) { return short_time(us / 1e6); }

}  // namespace

std::string short_time(double seconds) {
  constexpr std::array<const char*, 4> units{" ns", " us", " ms", " s"};
  return seconds >= 0.9995 ? fmt::format("{:.{}f} s", seconds,
                                         seconds >= 99.95   ? 0
                                         : seconds >= 9.995 ? 1
                                                            : 2)
                           : with_unit(seconds * 1e9, 1e3, units);
}

std::string short_count(double count) {
  constexpr std::array<const char*, 4> units{"", " k", " M", " G"};
  return count < 1000 && count == std::floor(count) ? fmt::format("{:.0f}", count) : with_unit(count, 1e3, units);
}

std::string short_bytes(std::uint64_t bytes) {
  constexpr std::array<const char*, 4> units{" B", " KiB", " MiB", " GiB"};
  return with_unit(static_cast<double>(bytes), 1024, units);
}

std::string exponent_text(const std::optional<PowerLaw>& law) {
  // Numbers that vanish in rounding are not negative.
  const auto rounded = [](double x) { return std::round(x * 100) / 100 + 0.0; };
  return law ? fmt::format("{:.2f} \u00b1 {:.2f}", rounded(law->exponent), law->error) : "not fitted";
}

std::string disturbance(const Measurement& m) {
  constexpr double usual = 0.85, least_seconds = 0.01;
  return m.busy < usual && m.seconds.median > least_seconds
             ? fmt::format("disturbed: {:.0f} % of the time on a processor", 100 * m.busy)
             : "";
}

std::string per_step(const Measurement& m, bool allocations) {
  std::uint64_t sum = 0;
  bool is_known = false;
  for (const auto& [name, count] : m.counts) {
    const bool is_of_allocations = name == allocations_name;
    if (is_of_allocations == allocations && !name.ends_with("_held")) {
      sum += count;
      is_known = true;
    }
  }
  return is_known && m.steps > 0 ? short_count(static_cast<double>(sum) / static_cast<double>(m.steps)) : "-";
}

std::string checked_text(const Measurement& m) {
  return m.checked == 0 ? "-" : m.checked == m.steps ? "all" : short_count(static_cast<double>(m.checked));
}

void write_facts(std::ostream& out, const Report& report) {
  out << fmt::format("sesame {} at {}, {} {}\n{}, {} cores, {}, {}\n{}\n\n", report.build.version, report.build.commit,
                     report.build.compiler, report.build.flags, report.machine.cpu, report.machine.cores,
                     short_bytes(report.machine.memory_bytes), report.machine.system, report.date);
}

void write_measurement_head(std::ostream& out) {
  out << fmt::format("{:<28} {:>8} {:<14} {:>8} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8} {:>8}\n",
                     "scenario", "size", "method", "steps", "median", "spread", "mean", "p50", "p99", "max", "resident",
                     "heap", "alloc.", "touched", "checked")
      << std::string(169, '-') << '\n';
}

void write_measurement(std::ostream& out, const Measurement& m) {
  out << fmt::format("{:<28} {:>8} {:<14} ", m.scenario, m.size, m.method);
  if (m.verdict == Verdict::absent || m.verdict == Verdict::refused || m.verdict == Verdict::failed) {
    out << verdict_name(m.verdict) << ": " << m.remark << '\n' << std::flush;
    return;
  }
  const auto bytes = [](std::uint64_t n) { return n > 0 ? short_bytes(n) : "-"; };
  out << fmt::format("{:>8} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8} {:>8}",
                     short_count(static_cast<double>(m.steps)), dash_or(m.seconds.median, short_time),
                     dash_or(m.seconds.max - m.seconds.min, short_time), dash_or(m.step.mean, microseconds),
                     dash_or(m.step.p50, microseconds), dash_or(m.step.p99, microseconds),
                     dash_or(m.step.max, microseconds), bytes(m.memory.resident), bytes(m.memory.heap),
                     per_step(m, true), per_step(m, false), checked_text(m));
  if (m.verdict != Verdict::right) {
    out << "  " << verdict_name(m.verdict) << ": " << m.remark;
  } else if (!m.remark.empty()) {
    out << "  " << m.remark;
  }
  if (const std::string text = disturbance(m); !text.empty()) {
    out << "  " << text;
  }
  out << '\n' << std::flush;
}

void write_scaling(std::ostream& out, const Scaling& scaling) {
  out << fmt::format("\n{}, {}: {}\n{:>14} {:>12} {:>12} {:>12} {:>12} {:>16}\n", scaling.experiment, scaling.method,
                     scaling.what, scaling.x_name, "mean, us", "p50", "p99", "max", "touched a step");
  for (const auto& [x, step, touched] : scaling.points) {
    out << fmt::format("{:>14} {:>12.2f} {:>12.2f} {:>12.2f} {:>12.2f} {:>16.1f}\n", x, step.mean, step.p50, step.p99,
                       step.max, touched);
  }
  out << fmt::format("exponent of the mean {}, of p50 {}, of what is touched {}; theory expects {}\n",
                     exponent_text(fit_times(scaling, &Latency::mean)),
                     exponent_text(fit_times(scaling, &Latency::p50)), exponent_text(fit_counts(scaling)),
                     scaling.expected);
  if (!scaling.remark.empty()) {
    out << scaling.remark << '\n';
  }
  out << std::flush;
}

void write_time_changes(std::ostream& out, const std::vector<TimeChange>& changes) {
  out << fmt::format("\n{:<28} {:>8} {:<14} {:>9} {:>9} {:>8}\n", "new / old", "size", "method", "old", "new", "ratio");
  std::array<int, 4> tally{};
  for (const TimeChange& change : changes) {
    ++tally.at(static_cast<std::size_t>(change.change));
    out << fmt::format("{:<28} {:>8} {:<14} {:>9} {:>9} {:>8.3f}  {}\n", change.scenario, change.size, change.method,
                       short_time(change.old_seconds), short_time(change.new_seconds), change.ratio(),
                       change_name(change.change));
  }
  out << fmt::format("{} compared: {} faster, {} slower, {} the same, {} unclear\n", changes.size(), tally[0], tally[1],
                     tally[2], tally[3]);
}

void write_count_comparison(std::ostream& out, const CountComparison& comparison) {
  const auto write = [&out](const std::vector<CountChange>& changes) {
    for (const CountChange& change : changes) {
      out << fmt::format("  {:<28} {:<14} {:<20} {:>12} -> {:>12}  {:+.1f} %\n", change.scenario, change.method,
                         change.count, change.old_count, change.new_count,
                         100 * (static_cast<double>(change.new_count) /
                                    static_cast<double>(std::max(change.old_count, std::uint64_t{1})) -
                                1));
    }
  };
  if (!comparison.grown.empty()) {
    out << "counts that grew:\n";
    write(comparison.grown);
  }
  if (!comparison.incomparable.empty()) {
    out << "what cannot be compared:\n";
    for (const std::string& sentence : comparison.incomparable) {
      out << "  " << sentence << '\n';
    }
  }
  if (!comparison.shrunk.empty()) {
    out << "counts that became smaller; if that is meant to stay, renew the file (tools/bench_gate --renew):\n";
    write(comparison.shrunk);
  }
}

}  // namespace sesame::tools

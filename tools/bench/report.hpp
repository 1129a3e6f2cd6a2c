/// \file
/// Reports for people: tables, and a page with pictures.
#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "tools/bench/comparison.hpp"
#include "tools/bench/measurement.hpp"

namespace sesame::tools {

/// Machine, compiler, commit, date.
void write_facts(std::ostream& out, const Report& report);
/// The head of the table and its rows: a line per measurement.
void write_measurement_head(std::ostream& out);
void write_measurement(std::ostream& out, const Measurement& measurement);
/// The points of an experiment, and the fitted exponents beside the expected one.
void write_scaling(std::ostream& out, const Scaling& scaling);
void write_time_changes(std::ostream& out, const std::vector<TimeChange>& changes);
/// What grew, what cannot be compared, what shrank.
void write_count_comparison(std::ostream& out, const CountComparison& comparison);

/// A page that needs nothing else: all of the above, log-log plots with fits, latency over time.
void write_page(std::ostream& out, const Report& report);
/// Its scaling plots alone, as an SVG file.
void write_figure(std::ostream& out, const Report& report);

/// "12.3 us", "4.56 s".
[[nodiscard]] std::string short_time(double seconds);
/// "1.23 M".
[[nodiscard]] std::string short_count(double count);
/// "1.2 MiB".
[[nodiscard]] std::string short_bytes(std::uint64_t bytes);
/// "0.02 +- 0.01 (expected 0)", or that it could not be fitted.
[[nodiscard]] std::string exponent_text(const std::optional<PowerLaw>& law);
/// How little of a processor the runs had, when that was much less than one; else an empty text.
[[nodiscard]] std::string disturbance(const Measurement& measurement);
/// After how many of the steps the groups were compared: "all", or a number; a dash when it was only the last.
[[nodiscard]] std::string checked_text(const Measurement& measurement);
/// Allocations or terms by the step; a dash when there are none.
[[nodiscard]] std::string per_step(const Measurement& measurement, bool allocations);

}  // namespace sesame::tools

/// \file
/// A report beside an older one: times with their noise, counts to the letter.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/bench/measurement.hpp"

namespace sesame::tools {

// ---- times

enum class Change {
  faster,
  slower,
  same,     ///< the intervals meet, and the medians differ by less than a tenth
  unclear,  ///< too noisy to tell, or fewer than three runs
};
[[nodiscard]] std::string_view change_name(Change change);

/// The interval of a spread is its median plus and minus three standard deviations, as estimated from the median of the
/// deviations, but a part of 0.03 at least: the machine itself is not the same every day. Only when two intervals have
/// nothing in common is one of them faster.
[[nodiscard]] Change compare(const Spread& old, const Spread& now);

struct TimeChange {
  std::string scenario, method;
  std::uint64_t size = 0;
  double old_seconds = 0, new_seconds = 0;
  Change change = Change::same;
  [[nodiscard]] double ratio() const { return new_seconds / old_seconds; }
};
/// Of what was measured to its end in both reports, in the order of the new one.
[[nodiscard]] std::vector<TimeChange> compare_times(const Report& old, const Report& now);

// ---- counts

/// The counts of a method on a scenario: what the gate compares.
struct CountRow {
  std::string scenario, method;
  std::uint64_t size = 0, steps = 0;
  Counts counts;
  friend bool operator==(const CountRow&, const CountRow&) = default;
};
[[nodiscard]] std::vector<CountRow> count_rows(const Report& report);
/// One JSON object, a row a line.
[[nodiscard]] std::string to_text(const std::vector<CountRow>& rows);
/// Errors: io, bad_input.
Result<std::vector<CountRow>> read_counts(const std::string& path);

struct CountChange {
  std::string scenario, method, count;
  std::uint64_t old_count = 0, new_count = 0;
  friend bool operator==(const CountChange&, const CountChange&) = default;
};
struct CountComparison {
  std::vector<CountChange> grown;         ///< by more than 2 and more than 2 %
  std::vector<CountChange> shrunk;        ///< by as much
  std::vector<std::string> incomparable;  ///< sentences: rows and counts that only one has, steps that differ
};
/// Rows of `golden` for which there is none in `now` are incomparable when `is_whole`, else left out.
[[nodiscard]] CountComparison compare_counts(const std::vector<CountRow>& golden, const std::vector<CountRow>& now,
                                             bool is_whole);

}  // namespace sesame::tools

#include "tools/bench/comparison.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "replay/text/byte_source.hpp"

namespace sesame::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr int counts_version = 1;

struct Interval {
  double low, high;
};

Interval interval_of(const Spread& spread) {
  constexpr double deviations = 3 * 1.4826;  // 1.4826: from the median of the deviations to a standard deviation
  constexpr double least = 0.03;
  const double half = std::max(deviations * spread.deviation, least * spread.median);
  return {spread.median - half, spread.median + half};
}

template <class Row>
auto same_place_as(const Row& row) {
  return [&row](const Row& other) {
    return other.scenario == row.scenario && other.size == row.size && other.method == row.method;
  };
}

std::string place(const CountRow& row) {
  return row.scenario + " of size " + std::to_string(row.size) + ", " + row.method;
}

void compare_rows(const CountRow& golden, const CountRow& now, CountComparison& into) {
  if (golden.steps != now.steps) {
    into.incomparable.push_back(place(now) + ": " + std::to_string(now.steps) + " steps instead of " +
                                std::to_string(golden.steps));
    return;
  }
  for (const auto& [name, count] : now.counts) {
    const auto old = std::ranges::find(golden.counts, name, &Counts::value_type::first);
    if (old == golden.counts.end()) {
      into.incomparable.push_back(place(now) + ": \"" + name + "\" is new");
      continue;
    }
    const auto grew = [](std::uint64_t from, std::uint64_t to) {
      return to > from && to - from > std::max(from / 50, std::uint64_t{2});
    };
    const CountChange change{now.scenario, now.method, name, old->second, count};
    if (grew(old->second, count)) {
      into.grown.push_back(change);
    } else if (grew(count, old->second)) {
      into.shrunk.push_back(change);
    }
  }
  for (const auto& [name, count] : golden.counts) {
    if (std::ranges::find(now.counts, name, &Counts::value_type::first) == now.counts.end()) {
      into.incomparable.push_back(place(now) + ": \"" + name + "\" is counted no more");
    }
  }
}

Result<std::vector<CountRow>> parse_counts(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    if (json.at("sesame_bench_counts") != counts_version) {
      return Error{Errc::bad_input, "\"sesame_bench_counts\" should be " + std::to_string(counts_version)};
    }
    std::vector<CountRow> rows;
    for (const Json& row : json.at("rows")) {
      rows.push_back({row.at("scenario").get<std::string>(),
                      row.at("method").get<std::string>(),
                      row.at("size").get<std::uint64_t>(),
                      row.at("steps").get<std::uint64_t>(),
                      {}});
      for (const auto& [name, count] : row.at("counts").items()) {
        rows.back().counts.emplace_back(name, count.get<std::uint64_t>());
      }
    }
    return rows;
  } catch (const std::exception& e) {  // of the JSON library, which has no other way to say it
    return Error{Errc::bad_input, std::string{"no counts of sesame bench: "} + e.what()};
  }
}

}  // namespace

std::string_view change_name(Change change) {
  constexpr std::array<std::string_view, 4> names{"faster", "slower", "same", "unclear"};
  return names.at(static_cast<std::size_t>(change));
}

Change compare(const Spread& old, const Spread& now) {
  if (old.runs < 3 || now.runs < 3) {
    return Change::unclear;
  }
  const Interval before = interval_of(old), after = interval_of(now);
  if (after.high < before.low) {
    return Change::faster;
  }
  if (after.low > before.high) {
    return Change::slower;
  }
  const double ratio = now.median / old.median;
  return ratio > 0.9 && ratio < 1 / 0.9 ? Change::same : Change::unclear;
}

std::vector<TimeChange> compare_times(const Report& old, const Report& now) {
  std::vector<TimeChange> changes;
  for (const Measurement& m : now.measurements) {
    const auto before = std::ranges::find_if(old.measurements, same_place_as(m));
    if (before == old.measurements.end() || m.verdict != Verdict::right || before->verdict != Verdict::right ||
        !m.has_times() || !before->has_times()) {
      continue;
    }
    changes.push_back(
        {m.scenario, m.method, m.size, before->seconds.median, m.seconds.median, compare(before->seconds, m.seconds)});
  }
  return changes;
}

std::vector<CountRow> count_rows(const Report& report) {
  std::vector<CountRow> rows;
  for (const Measurement& m : report.measurements) {
    if (m.verdict == Verdict::right && !m.counts.empty()) {
      rows.push_back({m.scenario, m.method, m.size, m.steps, m.counts});
    }
  }
  return rows;
}

std::string to_text(const std::vector<CountRow>& rows) {
  std::string text = "{\"sesame_bench_counts\":" + std::to_string(counts_version) + ",\"rows\":[";
  for (const CountRow& row : rows) {
    Json counts = Json::object();
    for (const auto& [name, count] : row.counts) {
      counts[name] = count;
    }
    const Json json{{"scenario", row.scenario},
                    {"size", row.size},
                    {"method", row.method},
                    {"steps", row.steps},
                    {"counts", counts}};
    text += (text.back() == '[' ? "\n" : ",\n") + json.dump();
  }
  return text + "]}\n";
}

Result<std::vector<CountRow>> read_counts(const std::string& path) {
  const Result<std::string> text = replay::read_file(path);
  if (!text) {
    return text.error();
  }
  Result<std::vector<CountRow>> rows = parse_counts(*text);
  if (!rows) {
    return Error{rows.error().code, path + ": " + rows.error().what};
  }
  return rows;
}

CountComparison compare_counts(const std::vector<CountRow>& golden, const std::vector<CountRow>& now, bool is_whole) {
  CountComparison comparison;
  for (const CountRow& row : now) {
    const auto old = std::ranges::find_if(golden, same_place_as(row));
    if (old == golden.end()) {
      comparison.incomparable.push_back(place(row) + ": not in the golden file");
    } else {
      compare_rows(*old, row, comparison);
    }
  }
  for (const CountRow& row : golden) {
    if (is_whole && std::ranges::find_if(now, same_place_as(row)) == now.end()) {
      comparison.incomparable.push_back(place(row) + ": in the golden file, and was not measured");
    }
  }
  return comparison;
}

}  // namespace sesame::tools

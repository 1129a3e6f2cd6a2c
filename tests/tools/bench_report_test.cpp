#include "tools/bench/report.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "replay/picture/svg.hpp"
#include "tests/support/catch.hpp"
#include "tools/bench/comparison.hpp"
#include "tools/bench/runner.hpp"
#include "tools/bench/scaling.hpp"

using namespace sesame;
using namespace sesame::tools;
using Catch::Matchers::Contains;

namespace {

Measurement measurement(const std::string& scenario, const Spread& seconds) {
  Measurement m;
  m.scenario = scenario;
  m.family = "surfaces";
  m.method = "live";
  m.ring = "Z";
  m.size = 5;
  m.steps = 100;
  m.seconds = seconds;
  m.step = {2.5, 1.5, 20.25, 300};
  m.checked = 40;
  m.memory = {1 << 20, 12345};
  m.counts = {{"rewritten_terms", 1000}, {"terms_held", 7}, {"allocations", 50}};
  m.timeline = {{50, 3.5, 1.5, 300}, {100, 1.75, 1.25, 20}};
  return m;
}

Report report() {
  Report report;
  report.machine = {"a \"fine\" cpu", "Linux", 2, 1ULL << 34};
  report.build = {"0.1.0", "abc+", "g++ 12", "-O2"};
  report.date = "2026-01-31T12:00:00Z";
  report.measurements = {measurement("torus", {2, 1.5, 3, 0.25, 5}), measurement("sphere", {1, 1, 1, 0, 5})};
  report.measurements[1].verdict = Verdict::wrong;
  report.measurements[1].remark = "found <nothing> & \xff";
  report.scalings = {
      {"object size", "work", "live", "cells", 0, {{100, {2.5, 2, 4, 5}, 10}, {1000, {2.5, 2, 4, 5}, 10}}, "", false},
      {"touched part",
       "work",
       "live",
       "cells",
       1,
       {{10, {3, 2, 4, 5}, 10}, {100, {30, 2, 4, 5}, 100}},
       "ends here",
       true}};
  return report;
}

Spread spread(double median, double deviation, std::size_t runs = 5) {
  return {median, median - 2 * deviation, median + 2 * deviation, deviation, runs};
}

/// A file with a text, gone in the end.
class TextFile {
 public:
  explicit TextFile(const std::string& text)
      : path_{std::filesystem::temp_directory_path() / ("sesame-bench-report-" + std::to_string(getpid()))} {
    std::ofstream{path_} << text;
  }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  ~TextFile() { std::filesystem::remove(path_); }
  [[nodiscard]] std::string path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::vector<CountRow> rows(std::uint64_t terms, std::uint64_t steps = 10) {
  return {{"torus", "live", 5, steps, {{"terms", terms}, {"allocations", 40}}}};
}

std::string compared(const std::vector<CountRow>& golden, const std::vector<CountRow>& now) {
  std::ostringstream out;
  write_count_comparison(out, compare_counts(golden, now, true));
  return out.str();
}

}  // namespace

TEST_CASE("a report is the same after it was written and read", "[bench]") {
  const std::string text = to_text(report());
  const auto read = parse_report(text);
  REQUIRE(read);
  CHECK(read->machine.cpu == "a \"fine\" cpu");
  CHECK(read->machine.memory_bytes == 1ULL << 34);
  CHECK(read->measurements[0].seconds == report().measurements[0].seconds);
  CHECK(read->measurements[0].counts == report().measurements[0].counts);
  CHECK(read->measurements[0].timeline == report().measurements[0].timeline);
  CHECK(read->measurements[0].step == report().measurements[0].step);
  CHECK(read->measurements[0].checked == 40);
  CHECK(read->measurements[1].verdict == Verdict::wrong);
  CHECK(read->scalings[1].is_wrong);
  CHECK(read->scalings[1].points == report().scalings[1].points);
  CHECK(to_text(*read) == text);
  CHECK_FALSE(parse_report(text.substr(0, text.size() / 2)));
  CHECK_FALSE(parse_report("{}"));
  CHECK_THAT(parse_report(R"({"sesame_bench":3})").error().what, Contains("\"sesame_bench\" should be 1 or 2"));
  CHECK_THAT(read_report("/nowhere/report.json").error().what, Contains("cannot read /nowhere/report.json"));
}

TEST_CASE("a report of version 1, which had no means, can still be read", "[bench]") {
  const auto read = parse_report(R"({"sesame_bench":1,"date":"2026-01-31T12:00:00Z",
    "build":{"version":"0.1.0","commit":"abc","compiler":"g++ 12","flags":"-O2"},
    "machine":{"cpu":"c","cores":2,"memory_bytes":1024,"system":"s"},
    "measurements":[{"scenario":"torus","family":"surfaces","size":5,"ring":"Z","method":"live","verdict":"right",
      "remark":"","steps":100,"seconds":{"median":2,"min":1,"max":3,"deviation":0.5,"runs":3},"busy":1,
      "step_us":{"p50":1.5,"p99":20,"max":300},"memory":{"resident":1,"heap":2},"counts":{"terms":7},
      "timeline":[[100,1.5,300]]}],
    "scalings":[{"experiment":"size","what":"w","method":"live","x":"cells","expected_exponent":0,"remark":"",
      "points":[[100,2.5,10]]}]})");
  REQUIRE(read);
  const Measurement& m = read->measurements.at(0);
  CHECK(m.step == Latency{0, 1.5, 20, 300});
  CHECK(m.timeline == std::vector<TimelinePoint>{{100, 0, 1.5, 300}});
  CHECK(m.checked == 0);
  CHECK(read->scalings.at(0).points == std::vector<ScalingPoint>{{100, {0, 2.5, 0, 0}, 10}});
}

TEST_CASE("means and tails stand side by side in the table and on the page", "[bench]") {
  std::ostringstream table, page;
  write_measurement_head(table);
  write_measurement(table, report().measurements[0]);
  write_scaling(table, report().scalings[0]);
  write_page(page, report());
  CHECK_THAT(table.str(), Contains("2.50 us   1.50 us   20.2 us    300 us") && Contains("mean       p50       p99"));
  CHECK_THAT(table.str(), Contains("2.50         2.00         4.00         5.00"));
  CHECK_THAT(page.str(), Contains("<th>mean</th><th>p50</th><th>p99</th><th>max</th>") &&
                             Contains("<td>2.50 us</td><td>1.50 us</td><td>20.2 us</td><td>300 us</td>"));
  CHECK(checked_text(report().measurements[0]) == "40");
}

TEST_CASE("only times whose intervals have nothing in common are faster or slower", "[bench]") {
  CHECK(compare(spread(10, 0.1), spread(5, 0.1)) == Change::faster);
  CHECK(compare(spread(5, 0.1), spread(10, 0.1)) == Change::slower);
  CHECK(compare(spread(10, 0.1), spread(10.2, 0.1)) == Change::same);
  CHECK(compare(spread(10, 1), spread(8, 1)) == Change::unclear);
  CHECK(compare(spread(10, 0), spread(10.5, 0)) == Change::same);  // a machine is not the same every day
  CHECK(compare(spread(10, 0), spread(10.7, 0)) == Change::slower);
  CHECK(compare(spread(10, 0.1, 2), spread(5, 0.1)) == Change::unclear);
}

TEST_CASE("times are compared of what was measured to its end in both reports", "[bench]") {
  Report old = report(), now = report();
  now.measurements[0].seconds = spread(4, 0.1);
  now.measurements.push_back(measurement("new", spread(1, 0)));
  const std::vector<TimeChange> changes = compare_times(old, now);
  REQUIRE(changes.size() == 1);  // the sphere is wrong, and the new one was not there
  CHECK(changes[0].ratio() == 2);
  CHECK(changes[0].change == Change::slower);
  std::ostringstream out;
  write_time_changes(out, changes);
  CHECK_THAT(out.str(), Contains("2.000  slower") && Contains("1 compared: 0 faster, 1 slower, 0 the same"));
  now.measurements[0].size = 6;
  CHECK(compare_times(old, now).empty());
}

TEST_CASE("a count that grows by more than two and two in a hundred is told, and so is one that shrinks", "[bench]") {
  CHECK(compared(rows(1000), rows(1020)).empty());
  CHECK_THAT(compared(rows(1000), rows(1021)), Contains("grew") && Contains("1000 ->         1021  +2.1 %"));
  CHECK(compared(rows(10), rows(12)).empty());
  CHECK_THAT(compared(rows(10), rows(13)), Contains("grew"));
  CHECK_THAT(compared(rows(0), rows(3)), Contains("grew"));
  CHECK_THAT(compared(rows(1000), rows(900)), Contains("became smaller") && Contains("--renew"));
  CHECK(compare_counts(rows(1000), rows(900), true).grown.empty());
}

TEST_CASE("counts that cannot be compared are told", "[bench]") {
  CHECK_THAT(compared(rows(5), rows(5, 11)), Contains("11 steps instead of 10"));
  CHECK_THAT(compared({}, rows(5)), Contains("not in the golden file"));
  CHECK_THAT(compared(rows(5), {}), Contains("was not measured"));
  CHECK(compare_counts(rows(5), {}, false).incomparable.empty());
  std::vector<CountRow> less = rows(5);
  less[0].counts.pop_back();
  CHECK_THAT(compared(less, rows(5)), Contains("\"allocations\" is new"));
  CHECK_THAT(compared(rows(5), less), Contains("\"allocations\" is counted no more"));
}

TEST_CASE("counts are the same after they were written and read", "[bench]") {
  const std::vector<CountRow> counted = count_rows(report());
  REQUIRE(counted.size() == 1);  // the sphere is wrong
  const TextFile file(to_text(counted));
  CHECK(*read_counts(file.path()) == counted);
  const TextFile broken("{\"sesame_bench_counts\":1,");
  CHECK_THAT(read_counts(broken.path()).error().what, Contains("no counts of sesame bench"));
  CHECK_FALSE(read_counts("/nowhere/counts.json"));
}

TEST_CASE("the table and the page show what was measured, and the page needs nothing from outside", "[bench]") {
  std::ostringstream table, page;
  write_facts(table, report());
  for (const Measurement& m : report().measurements) {
    write_measurement(table, m);
  }
  for (const Scaling& scaling : report().scalings) {
    write_scaling(table, scaling);
  }
  CHECK_THAT(table.str(), Contains("sesame 0.1.0 at abc+") && Contains("16.0 GiB") && Contains("2.00 s") &&
                              Contains("wrong: found <nothing>") && Contains("exponent of the mean 1.00") &&
                              Contains("of p50 0.00") && Contains("theory expects 1"));
  write_page(page, report());
  CHECK_THAT(page.str(), Contains("&lt;") || Contains("wrong"));
  CHECK_THAT(page.str(), Contains("<svg") && Contains("object size (theory: exponent 0)") &&
                             Contains("torus, size 5") && Contains("exponent 1.00"));
  CHECK_THAT(page.str(), !Contains("<script") && !Contains("src=") && !Contains("href=") && !Contains("@import"));
}

TEST_CASE("titles of plots lie in their pictures, however long they are", "[bench]") {
  Report wordy = report();
  wordy.scalings[0].experiment = std::string(150, 'w');
  wordy.measurements[0].scenario = std::string(150, 's');
  std::ostringstream page;
  write_page(page, wordy);
  const std::string text = page.str();
  const std::regex plot(R"re(<svg class="sesame"[^>]* width="([\d.]+)"[^>]* viewBox="(-?[\d.]+) 0)re");
  const std::regex title(R"re(<text class="panel" x="0" y="14">([^<]*)</text>)re");
  std::size_t titles = 0;
  for (std::sregex_iterator at(text.begin(), text.end(), plot), end; at != end; ++at) {
    std::smatch found;
    REQUIRE(std::regex_search(at->suffix().first, text.end(), found, title));
    CAPTURE(found[1].str());
    CHECK(std::stod((*at)[2]) < 0);  // a bold letter begins a little before its place
    CHECK(replay::text_width(found[1].str(), replay::panel_title) < std::stod((*at)[1]));
    ++titles;
  }
  CHECK(titles == 4);
}

TEST_CASE("the figure has the plots of all experiments beside each other, with a margin around", "[bench]") {
  std::ostringstream figure, page;
  write_figure(figure, report());
  write_page(page, report());
  CHECK_THAT(figure.str(), Catch::StartsWith("<?xml") && Contains("sesame 0.1.0 at abc+") &&
                               Contains("object size (theory: exponent 0)") &&
                               Contains("touched part (theory: exponent 1)"));
  const std::regex place(R"re(<g transform="translate\(([\d.]+) ([\d.]+)\)">\n<line)re");
  std::set<std::string> across, down;
  const std::string text = figure.str();
  for (std::sregex_iterator at(text.begin(), text.end(), place), end; at != end; ++at) {
    across.insert((*at)[1]);
    down.insert((*at)[2]);
    CHECK(std::stod((*at)[1]) >= 20);
  }
  CHECK(across.size() == 2);
  CHECK(down.size() == 1);
}

TEST_CASE("numbers are short", "[bench]") {
  CHECK(short_time(0.0000000604) == "60.4 ns");
  CHECK(short_time(0.00123) == "1.23 ms");
  CHECK(short_time(0.9999) == "1.00 s");
  CHECK(short_time(123.4) == "123 s");
  CHECK(short_count(0) == "0");
  CHECK(short_count(999) == "999");
  CHECK(short_count(1234567) == "1.23 M");
  CHECK(short_bytes(1536) == "1.50 KiB");
  CHECK(exponent_text(std::nullopt) == "not fitted");
  CHECK(exponent_text(PowerLaw{-0.001, 1, 0}) == "0.00 \u00b1 0.00");
  CHECK(per_step(report().measurements[0], false) == "10");  // what is held is not touched
  CHECK(per_step(report().measurements[0], true) == "0.50");
}

TEST_CASE("samples are summed up by their medians, and the worst verdict stands", "[bench]") {
  Sample first, slow, quick;
  first.allocations = 9;
  first.counts = {{"terms", 4}};
  first.memory = {100, 50};
  slow.seconds = 3;
  slow.step = {9, 1, 2, 30};
  quick.seconds = 1;
  quick.step = {3, 1, 4, 10};
  const Measurement m = sum_up(first, {slow, quick, quick});
  CHECK(m.seconds.median == 1);
  CHECK(m.seconds.runs == 3);
  CHECK(m.step == Latency{3, 1, 4, 10});
  CHECK(m.memory == Memory{100, 50});
  CHECK(m.counts == Counts{{"terms", 4}, {"allocations", 9}});
  CHECK(m.verdict == Verdict::right);
  quick.verdict = Verdict::wrong;
  quick.remark = "no";
  CHECK(sum_up(first, {slow, quick}).verdict == Verdict::wrong);
  CHECK_FALSE(sum_up(first, {}).has_times());
}

TEST_CASE("runs that had little of a processor are told", "[bench]") {
  Sample sample;
  sample.seconds = 2;
  sample.busy = 0.95;
  CHECK(disturbance(sum_up({}, {sample})).empty());
  sample.busy = 0.25;
  CHECK(disturbance(sum_up({}, {sample})) == "disturbed: 25 % of the time on a processor");
}

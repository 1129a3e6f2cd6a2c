// What the page of a tower is given: bars as lists of numbers, classes, the complex with its points; and their limits.
#include "replay/page/tower_page.hpp"

#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <sstream>

#include "replay/page/page_bars.hpp"
#include "replay/tower/tower_replay.hpp"
#include "replay/tower/tower_trace.hpp"
#include "tests/support/catch.hpp"

using namespace sesame;
using Catch::Contains;
using engine::Bar;
using engine::Barcode;
using engine::never;
using nlohmann::json;

namespace {

const replay::Provenance provenance{"Z/2", 12, "a.tower"};

json data_of(const Barcode& barcode, const replay::DrawingOptions& options = {}) {
  return json::parse(replay::tower_page_data({barcode, provenance, options}));
}

/// The bars of a list as the page reads them.
std::vector<Bar> bars_of(const json& lists) {
  std::vector<Bar> bars;
  for (const json& list : lists) {
    const bool is_whole = list.contains("lengths");
    const auto read = [&](const char* births, auto&& death_of) {
      double before = 0;
      for (std::size_t k = 0; k < list[births].size(); ++k) {
        before = list[births][k].get<double>() + (is_whole ? before : 0);
        bars.push_back({list["dim"].get<int>(), before, death_of(k, before)});
      }
    };
    read("births", [&](std::size_t k, double birth) -> engine::Time {
      return is_whole ? birth + list["lengths"][k].get<double>() : list["deaths"][k].get<double>();
    });
    read("open", [](std::size_t, double) { return never; });
  }
  return bars;
}

/// A tower as text, with the page of its bars.
struct Traced {
  explicit Traced(const std::string& text, replay::TraceLimits limits = {})
      : trace{sparse::Z2{}, {}, limits}, tower{{&trace}, &history} {
    auto opened = replay::TowerReader::from(replay::ByteSource::of_text(text, "t"), replay::TowerFormat::tower);
    const std::unique_ptr<replay::TowerReader> reader = std::move(*opened);
    replay::TowerOperation operation;
    while (*reader->next(operation)) {
      REQUIRE(tower.apply(operation));
      operations.add(operation, reader->line());
    }
  }

  [[nodiscard]] json page(const std::optional<replay::GeneratorOptions>& wanted = {},
                          const replay::TowerPageLimits& limits = {}, const replay::PointList* points = nullptr,
                          const replay::DrawingOptions& options = {}) {
    Barcode barcode;
    const replay::BarChainNamer chains(*trace.tracker(), history, tower.operations());
    for (const auto& traced : chains.cycles().bars()) {
      if (traced.bar.birth != traced.bar.death) {
        barcode.bars.push_back(traced.bar);
      }
    }
    const replay::TowerClasses classes{chains, operations, wanted};
    return json::parse(
        replay::tower_page_data({barcode, provenance, options, &classes, "", points, &operations}, limits));
  }

  replay::TowerTrace trace;
  replay::TowerHistory history;
  replay::TowerReplay tower;
  replay::OperationList operations;
};

const std::string circle = "i 0\ni 1\ni 2\ni 0 1\ni 1 2\ni 0 2\nc 0 1\nc 2 1\n";

}  // namespace

TEST_CASE("the bars of a page are those of the barcode, whole numbers or not", "[replay][page]") {
  std::mt19937 random(7);
  const auto below = [&](unsigned n) { return static_cast<double>(random() % n); };
  for (const double unit : {1.0, 0.1, -3.0, 1e-9, 1e300}) {
    Barcode barcode;
    for (int k = 0; k < 300; ++k) {
      const double birth = unit * below(50);
      barcode.bars.push_back({static_cast<int>(random() % 3) * 2, birth,
                              random() % 9 == 0 ? never : birth + std::abs(unit) * (1 + below(9))});
    }
    std::ranges::sort(barcode.bars);
    std::vector<Bar> found = bars_of(data_of(barcode)["bars"]);
    replay::PageBarNumbers numbers(barcode.bars);
    for (const Bar& bar : barcode.bars) {
      const auto number = numbers.next(bar);
      REQUIRE(number);
      CHECK(found[*number] == bar);
    }
    CHECK_FALSE(numbers.next(barcode.bars[0]));
    CHECK_FALSE(numbers.next({1, 0, 1}));
    std::ranges::sort(found);
    CHECK(found == barcode.bars);
  }
}

TEST_CASE("times beyond 2^53 are counted from an origin, exactly", "[replay][page][time]") {
  const std::int64_t now = 1732800000000000003;
  const json data = data_of({{{0, now, never}, {0, now + 1, now + 3}}, 0});
  CHECK(data["origin"] == "1732800000000000000");
  CHECK(data["bars"][0]["births"] == json({4}));
  CHECK(data["bars"][0]["lengths"] == json({2}));
  CHECK(data["bars"][0]["open"] == json({3}));
  CHECK(data["notes"].empty());
  const json far = data_of({{{0, -9223372036854775807, 9223372036854775807}}, 0});
  CHECK(far["origin"] == "0");
  CHECK_THAT(far["notes"].dump(), Contains("nearest doubles"));
}

TEST_CASE("bars that are left out of the lists are there for the curves, and the facts say how many",
          "[replay][page]") {
  const Barcode barcode{{{0, 0, never}, {0, 1, 2}, {0, 1, 9}}, 3};
  const json data = data_of(barcode, {"", "time", {3, true}});
  CHECK(bars_of(data["bars"]) == std::vector<Bar>{{0, 1, 9}});
  CHECK(bars_of(data["left_out"]) == std::vector<Bar>{{0, 1, 2}, {0, 0, never}});
  CHECK_THAT(data["facts"].dump(), Contains("1 bar shorter than 3 left out") &&
                                       Contains("1 bar that never end left out") &&
                                       Contains("3 bars of length 0 left out") && Contains("12 operations"));
  CHECK(data["title"] == "a.tower");
  CHECK(data["time_name"] == "time");
}

TEST_CASE("a page has for each bar who made it and who killed it, its cycle and what that bounds", "[replay][page]") {
  const json data = Traced(circle).page();
  CHECK(bars_of(data["bars"]) == std::vector<Bar>{{0, 1, 3}, {0, 2, 4}, {0, 0, never}, {1, 5, 6}});
  json loop;
  for (const json& each : data["classes"]) {
    loop = each["bar"] == 3 ? each : loop;
  }
  CHECK(loop["born"] == json({{"line", 6}, {"text", "i 0 2"}, {"after", 6}}));
  CHECK(loop["killed"] == json({{"line", 7}, {"text", "c 0 1"}, {"after", 7}}));
  CHECK(loop["cycle"] == json::parse("[[1,[0,1]],[1,[0,2]],[1,[1,2]]]"));
  CHECK(loop["bounds"] == json::array());
  CHECK(data["classes"].size() == 4);
  CHECK(data["notes"].empty());
  CHECK(data["complex"].is_null());
}

TEST_CASE("within limits the longest bars of each dimension have their class, and a note says so", "[replay][page]") {
  std::string text;
  for (int k = 0; k < 8; ++k) {
    text += "i " + std::to_string(k) + "\n";
  }
  for (int k = 1; k < 8; ++k) {
    text += "i " + std::to_string(k - 1) + " " + std::to_string(k) + "\n";
  }
  text += "i 0 7\ni 0 2\n";
  Traced traced(text);
  const json some = traced.page({}, {4});
  CHECK(some["classes"].size() == 4);
  std::vector<int> bars;
  for (const json& each : some["classes"]) {
    bars.push_back(each["bar"]);
  }
  CHECK(bars == std::vector<int>{7, 8, 0, 9});  // H0 open, H1, the first of equal length, the other of H1
  CHECK_THAT(some["notes"].dump(), Contains("4 of the 10 bars have their class on this page, the longest of each"));
  CHECK(traced.page({}, {100, 3})["classes"].size() == 2);  // a term of H0, then eight
  const json cut = traced.page({}, {100, 1000, 5});
  CHECK(cut["classes"][1]["cycle_terms"] == 8);
  CHECK_FALSE(cut["classes"][1].contains("cycle"));
  const json wanted = traced.page(replay::GeneratorOptions{{{1, 1}}}, {1});
  CHECK(wanted["classes"].size() == 2);
  CHECK_THAT(wanted["notes"].dump(), Contains("2 of the 10 bars have their class on this page, as --generators says."));
  CHECK(traced.page(replay::GeneratorOptions{}, {1})["classes"].size() == 10);
  CHECK(traced.page(replay::GeneratorOptions{{}, 2})["classes"][8]["cycle_terms"] == 8);
}

TEST_CASE("with points a page has what happened, moment by moment", "[replay][page]") {
  const replay::PointList points{"p", 4, {{0, 0, 0}, {1, 0, 0}, {0, 1e-3, 12345.678}, {9, 9, 9}}};
  Traced traced("0 i 0\n0 i 1\n0.5 i 2\n0.5 i 0 1\n2 c 0 1\n");
  const json data = traced.page({}, {}, &points);
  CHECK(data["complex"]["dims"] == json({0, 0, 0, 1, -1}));
  CHECK(data["complex"]["labels"] == json({0, 1, 2, 0, 1, 0, 1}));
  CHECK(data["complex"]["ends"] == json({2, 4, 5}));
  CHECK(data["complex"]["times"] == json({0.0, 0.5, 2.0}));
  CHECK(data["complex"]["points"] == json({0, 0, 0, 1, 0, 0, 0, 0.001, 12345.678}));
  CHECK_THAT(data["notes"].dump(), Contains("4 coordinates: the first three are drawn"));
  const json large = traced.page({}, {100, 100, 100, 4}, &points);
  CHECK(large["complex"].is_null());
  CHECK_THAT(large["notes"].dump(), Contains("not drawn: it has more than 4 operations"));
}

TEST_CASE("labels that are no doubles are texts on a page", "[replay][page]") {
  const json data = Traced("i 18446744073709551615\n").page();
  CHECK(data["classes"][0]["cycle"] == json::parse(R"([[1,["18446744073709551615"]]])"));
}

TEST_CASE("a trace forgets what it kept once a tower is too large, and goes on without", "[replay][page]") {
  CHECK(Traced(circle, {8}).trace.tracker() != nullptr);
  CHECK(Traced(circle, {7}).trace.tracker() == nullptr);
  CHECK(Traced(circle, {8, 0}).trace.tracker() == nullptr);
}

TEST_CASE("operations are shown as they were read", "[replay][page]") {
  const Traced traced("i 4\n\ni 7\ni 4 7\nc 4 7\n");
  CHECK(traced.operations.text(2) == "i 4 7");
  CHECK(traced.operations.line(2) == 4);
  CHECK(traced.operations.text(3) == "c 4 7");
  replay::OperationList columns;
  const std::vector<std::uint64_t> rows{0, 1};
  columns.add({replay::TowerOperation::Kind::column, 0, 0, {}}, 1);
  columns.add({replay::TowerOperation::Kind::column, 1, 1, rows}, 2);
  CHECK(columns.text(0) == "column 0");
  CHECK(columns.text(1) == "column 1: 0 1");
}

TEST_CASE("the page of a tower is one file, and what its texts say cannot end the element that they stand in",
          "[replay][page]") {
  std::ostringstream out;
  replay::DrawingOptions options;
  options.title = "</script><script>alert(1)</script>\x01\xFF";
  const Barcode barcode{{{0, 0, never}}, 0};
  const replay::Provenance provenance{"Z/2", 1, "folder/source"};
  replay::write_tower_page(out, {barcode, provenance, options});
  const std::string page = out.str();
  const std::string data = page.substr(page.find("id=\"data\">"));
  CHECK_THAT(data.substr(0, data.find("</script>")), Contains("alert(1)"));
  CHECK(std::regex_search(page, std::regex("</html>\\s*$")));
  CHECK_THAT(page, !Contains("src=\"http") && !Contains("@import"));
  CHECK(page.size() < 2'000'000);
  std::ostringstream named;
  replay::write_tower_page(named, {barcode, provenance, {}});
  CHECK_THAT(named.str(), Contains(R"("title":"source")") && !Contains("folder"));
}

#include "replay/barcode/barcode_files.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "replay/barcode/betti_curves.hpp"
#include "replay/text/text_buffer.hpp"
#include "sesame/version.hpp"
#include "tests/replay/replay_support.hpp"

using namespace sesame;
using namespace sesame::tests;
using engine::Bar;
using engine::Barcode;
using engine::never;
using replay::Provenance;

namespace {

const Barcode small{{{0, 0, never}, {0, 1, 2.5}, {1, 3, 4}}, 7};
const Provenance provenance{"Z/2", 12, "towers/a.tower"};
const std::string from_where = "# sesame " SESAME_VERSION ", coefficients Z/2, from towers/a.tower\n";
const std::string first_line =
    "# sesame " SESAME_VERSION ", coefficients Z/2, 12 operations, 7 bars of length 0 left out, from towers/a.tower\n";

template <class Write>
std::string written(Write write) {
  std::ostringstream out;
  write(out);
  return out.str();
}

std::string pers(const Barcode& barcode) {
  return written([&](std::ostream& out) { write_pers(out, barcode, provenance); });
}

std::string csv(const Barcode& barcode) {
  return written([&](std::ostream& out) { replay::write_betti_csv(out, barcode); });
}

/// The fields as an object.
std::string json(const Barcode& barcode, const Provenance& where) {
  return "{" + written([&](std::ostream& out) {
           replay::TextBuffer text(out);
           add_barcode_fields(text, barcode, where);
         }) +
         "}";
}

Result<replay::PersFile> read(const std::string& text) {
  replay::TimeReader times;
  return replay::read_pers(replay::ByteSource::of_text(text, "b.pers"), times);
}

std::vector<Bar> bars_in(const std::string& text) {
  const auto file = read(text);
  if (!file) {
    FAIL(file.error().what);
  }
  return file->barcode.bars;
}

std::string error_in(const std::string& text) {
  const auto file = read(text);
  REQUIRE_FALSE(file);
  CHECK(file.error().code == Errc::bad_input);
  return file.error().what;
}

Barcode random_barcode(unsigned seed, bool in_grid) {
  std::mt19937 random(seed);
  const auto number = [&] {
    return in_grid ? static_cast<double>(random() % 8)
                   : std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 100) - 60);
  };
  Barcode barcode;
  for (int i = 0; i < 60; ++i) {
    const double x = number(), y = number();
    if (x != y) {
      barcode.bars.push_back(
          {static_cast<int>(random() % 4), std::min(x, y), random() % 6 == 0 ? never : std::max(x, y)});
    }
  }
  std::sort(barcode.bars.begin(), barcode.bars.end());
  return barcode;
}

}  // namespace

TEST_CASE("a .pers file has the provenance and a line for each bar", "[replay]") {
  CHECK(pers(small) == from_where + "0 0 inf\n0 1 2.5\n1 3 4\n# 12 operations, 7 bars of length 0 left out\n");
  CHECK(pers({}) == from_where + "# 12 operations, 0 bars of length 0 left out\n");
}

TEST_CASE("what is written as .pers is read back to the last bit", "[replay][law]") {
  const unsigned seed = GENERATE(range(0U, 30U));
  CAPTURE(seed);
  const Barcode barcode = random_barcode(seed, false);
  const auto file = read(pers(barcode));
  REQUIRE(file);
  CHECK(file->barcode.bars == barcode.bars);
  CHECK(file->has_dimensions);
}

TEST_CASE("whole numbers beyond 2^53 keep all their digits in every file", "[replay][time]") {
  constexpr std::int64_t now = 1732800000000000001;
  const Barcode barcode{{{0, now, never}, {0, now + 1, now + 3}}, 0};
  const std::string text = pers(barcode);
  CHECK_THAT(text, Catch::Contains("0 1732800000000000001 inf\n0 1732800000000000002 1732800000000000004\n"));
  CHECK(bars_in(text) == barcode.bars);
  CHECK_THAT(json(barcode, provenance), Catch::Contains(R"([[0,"1732800000000000001",null],)"
                                                        R"([0,"1732800000000000002","1732800000000000004"]])"));
  CHECK_THAT(csv(barcode), Catch::EndsWith("\n1732800000000000001,1\n1732800000000000002,2\n1732800000000000004,1\n"));
}

TEST_CASE("files that are compared have whole numbers beyond 2^53, or fractions, but not both", "[replay][time]") {
  replay::TimeReader times;
  REQUIRE(read_pers(replay::ByteSource::of_text("0 0.5 1\n", "a.pers"), times));
  const auto file = read_pers(replay::ByteSource::of_text("0 0 1\n0 1 9007199254740993\n", "b.pers"), times);
  REQUIRE_FALSE(file);
  CHECK_THAT(file.error().what, Catch::StartsWith("b.pers:2: 9007199254740993, but a.pers:1 has 0.5: "));
}

TEST_CASE("the JSON of a barcode says all of it", "[replay]") {
  CHECK(json(small, provenance) ==
        "{\"ring\":\"Z/2\",\"ops\":12,\"bars\":[[0,0,null],[0,1,2.5],[1,3,4]],\"hidden\":7,"
        "\"source\":\"towers/a.tower\",\"version\":\"" SESAME_VERSION "\"}");
  const auto object = nlohmann::json::parse(json({}, {"Z/3", 0, "a \"b\"\n\xFF"}));
  CHECK(object["bars"] == nlohmann::json::array());
  CHECK(object["source"] == "a \"b\"\n\xEF\xBF\xBD");
}

TEST_CASE("the CSV of Betti numbers has a row for each time at which one changes", "[replay]") {
  CHECK(csv(small) == "time,b0,b1\n0,1,0\n1,2,0\n2.5,1,0\n3,1,1\n4,1,0\n");
  CHECK(csv({{{2, 1, never}}, 7}) == "time,b0,b1,b2\n1,0,0,1\n");
  CHECK(csv({{}, 7}) == "time\n");
  // One class dies as another one is born: no change.
  CHECK(csv({{{0, 0, 1}, {0, 1, 2}}, 7}) == "time,b0\n0,1\n2,0\n");
}

TEST_CASE("Betti numbers are those of the bars that are alive", "[replay][law]") {
  const unsigned seed = GENERATE(range(0U, 30U));
  CAPTURE(seed);
  const Barcode barcode = random_barcode(seed, true);
  std::map<engine::Time, std::vector<std::uint64_t>> rows{
      {-1, std::vector<std::uint64_t>(replay::dimensions(barcode))}};
  replay::for_each_betti_change(barcode, [&](engine::Time time, std::span<const std::uint64_t> betti) {
    CHECK(time > rows.rbegin()->first);
    CHECK(std::vector<std::uint64_t>(betti.begin(), betti.end()) != rows.rbegin()->second);
    rows[time].assign(betti.begin(), betti.end());
  });
  for (double time = -0.5; time < 10; time += 0.5) {
    std::vector<std::uint64_t> alive(replay::dimensions(barcode));
    for (const Bar& bar : barcode.bars) {
      alive[static_cast<std::size_t>(bar.dimension)] += bar.birth <= time && time < bar.death ? 1U : 0U;
    }
    CHECK(std::prev(rows.upper_bound(time))->second == alive);
  }
}

TEST_CASE("names with line ends stay in the comment line", "[replay]") {
  const std::string line = replay::provenance_line({}, {"Z/5", 1, "a\n0 1 2\r\xFF"});
  CHECK(line.find_first_of("\r\n") == std::string::npos);
  CHECK_THAT(line, Catch::EndsWith(", 1 operation, 0 bars of length 0 left out, from a?0 1 2?\xEF\xBF\xBD"));
  CHECK(replay::provenance_line({{}, 1}, {"Z/5", 2, ""}) ==
        "sesame " SESAME_VERSION ", coefficients Z/5, 2 operations, 1 bar of length 0 left out");
}

TEST_CASE("numbers are short, and whole numbers have no point", "[replay]") {
  using replay::number_text;
  CHECK(number_text(0.1) == "0.1");
  CHECK(number_text(-0.0) == "0");
  CHECK(number_text(2'000'000) == "2000000");
  CHECK(number_text(-123456789012) == "-123456789012");
  CHECK(number_text(1e22) == "1e+22");
  CHECK(number_text(0.00013) == "0.00013");
  CHECK(number_text(never) == "inf");
}

TEST_CASE("files of 2, 3 and 4 numbers a line are read", "[replay]") {
  CHECK(bars_in("1 2\n0 inf\n") == std::vector<Bar>{{0, 0, never}, {0, 1, 2}});
  CHECK(bars_in("1 0 2\n0 1 inf\n") == std::vector<Bar>{{0, 1, never}, {1, 0, 2}});
  CHECK(bars_in("2  0 0.5 inf\n2  1 3 4e1\n") == std::vector<Bar>{{0, 0.5, never}, {1, 3, 40}});
  const auto without = read("1 2");
  REQUIRE(without);
  CHECK_FALSE(without->has_dimensions);
}

TEST_CASE("comments, blank lines, CRLF, signs and all spellings of infinity are read", "[replay]") {
  const std::vector<Bar> expected{{0, -1, never}, {0, 2, never}, {0, 3, never}, {0, 4, never}, {1, 0.5, 1}};
  CHECK(bars_in("\xEF\xBB\xBF# c\r\n\r\n0 -1 inf\r\n  0\t2 Inf # why\r\n#0 9 9\n0 3 +infinity\n0 4 INF\n+1 .5 +1") ==
        expected);
  CHECK(bars_in("").empty());
  CHECK(bars_in("# nothing\n").empty());
}

TEST_CASE("bars of length 0 in a file are counted", "[replay]") {
  const auto file = read("0 1 1\n0 1 2\n1 3 3\n");
  REQUIRE(file);
  CHECK(file->barcode.bars.size() == 1);
  CHECK(file->barcode.hidden == 2);
}

TEST_CASE("a malformed line is named, with what would be right", "[replay]") {
  CHECK(error_in("0 1 2\n\n0 1\n") == "b.pers:3: 2 numbers, but line 1 has 3; all lines should have the same");
  CHECK(error_in("7\n") == "b.pers:1: a line should have 2, 3 or 4 numbers, [[field] dimension] birth death, not 1");
  CHECK_THAT(error_in("1 2 3 4 5 6\n"), Catch::EndsWith("not more"));
  CHECK(error_in("0 1 2\n0.5 1 2\n") == "b.pers:2: \"0.5\" should be a dimension, a whole number from 0 to 1000");
  CHECK_THAT(error_in("-1 1 2\n"), Catch::Contains("\"-1\" should be a dimension"));
  CHECK_THAT(error_in("1001 1 2\n"), Catch::Contains("should be a dimension"));
  CHECK(error_in("0 x 2\n") == "b.pers:1: \"x\" should be a birth, a finite number");
  CHECK(error_in("0 inf inf\n") == "b.pers:1: \"inf\" should be a birth, a finite number");
  CHECK(error_in("0 1 2y\n") == "b.pers:1: \"2y\" should be a death, a number or inf");
  CHECK(error_in("0 1 nan\n") == "b.pers:1: \"nan\" should be a death, a number or inf");
  CHECK(error_in("0 1 1e999\n") == "b.pers:1: \"1e999\" should be a death, a number or inf");
  CHECK(error_in("0 2 1\n") == "b.pers:1: the death \"1\" should not be before the birth \"2\"");
  CHECK(error_in("0 2 -inf\n") == "b.pers:1: the death \"-inf\" should not be before the birth \"2\"");
  CHECK(error_in("# c\n2 0 0 1\n3 0 0 1\n") ==
        "b.pers:3: field 3, but line 2 has 2; a file should have the bars over one field");
  CHECK_THAT(error_in("Z 0 0 1\n"), Catch::Contains("\"Z\" should be the characteristic of the field"));
  CHECK_THAT(error_in("0 \x01\xFF 1\n"), Catch::Contains("\"??\""));
}

TEST_CASE("a file cut at any byte is read, or refused in a sentence", "[replay][damage]") {
  const std::string text = pers(random_barcode(3, false));
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    const auto file = read(text.substr(0, cut));
    if (!file) {
      CHECK_THAT(file.error().what, Catch::StartsWith("b.pers:"));
    }
  }
}

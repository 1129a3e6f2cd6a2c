#include "replay/picture/barcode_drawing.hpp"

#include <random>
#include <regex>
#include <sstream>

#include "replay/barcode/bars.hpp"
#include "replay/picture/axis.hpp"
#include "replay/picture/bar_wall.hpp"
#include "replay/picture/barcode_panels.hpp"
#include "replay/picture/svg.hpp"
#include "replay/text/text_buffer.hpp"
#include "tests/support/catch.hpp"

using namespace sesame;
using Catch::Contains;
using engine::Bar;
using engine::Barcode;
using engine::never;
using replay::Provenance;
using replay::Range;

namespace {

const Barcode small{{{0, 0, never}, {0, 1, 4}, {1, 3, 8}, {1, 5, never}, {2, 11, 12}}, 3};

using Write = void (*)(std::ostream&, const Barcode&, const Provenance&, const replay::DrawingOptions&);
const std::vector<Write> all_pictures{replay::write_svg, replay::write_barcode_svg, replay::write_diagram_svg,
                                      replay::write_betti_svg};

std::string picture(Write write, const Barcode& barcode, const replay::DrawingOptions& options = {},
                    const std::string& source = "a.tower") {
  std::ostringstream out;
  write(out, barcode, {"Z/2", 12, source}, options);
  return out.str();
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

/// Every tag that is opened is closed, in order.
void check_tags(const std::string& text) {
  static const std::regex tag(R"(<(/?)([a-zA-Z0-9]+)((?:[^<>"]|"[^"]*")*?)(/?)>)");
  std::vector<std::string> open;
  for (auto found = std::sregex_iterator(text.begin(), text.end(), tag); found != std::sregex_iterator{}; ++found) {
    const std::string name = (*found)[2];
    if ((*found)[1].length() > 0) {
      REQUIRE_FALSE(open.empty());
      REQUIRE(open.back() == name);
      open.pop_back();
    } else if ((*found)[4].length() == 0) {
      open.push_back(name);
    }
  }
  CHECK(open.empty());
}

Barcode random_barcode(std::size_t bars, int dimensions) {
  std::mt19937 random(5);
  Barcode barcode;
  for (std::size_t i = 0; i < bars; ++i) {
    const double birth = static_cast<double>(random() % 1'000'000) / 1000;
    const double length = 1 + static_cast<double>(random() % 1'000'000) / 1000;
    barcode.bars.push_back({static_cast<int>(random() % static_cast<unsigned>(dimensions)), birth,
                            random() % 1000 == 0 ? never : birth + length});
  }
  std::sort(barcode.bars.begin(), barcode.bars.end());
  return barcode;
}

const std::vector<Barcode>& odd_barcodes() {
  static const std::vector<Barcode> all{
      {},
      {{}, 12},
      {{{0, 0, never}}, 0},
      {{{0, 0.00017, never}}, 0},
      {{{0, -1e308, 1e308}, {0, 0, 1}}, 0},
      {{{0, 1.7e308, never}}, 0},
      {{{3, 0, 5e-324}}, 0},
      {{{0, 1e16, 1e16 + 2}}, 0},
      {{{0, -2, -1}, {40, -1.5, never}}, 0},
  };
  return all;
}

std::vector<std::string> labels(const std::vector<replay::Tick>& ticks) {
  std::vector<std::string> labels;
  for (const replay::Tick& tick : ticks) {
    labels.push_back(tick.label);
  }
  return labels;
}

}  // namespace

TEST_CASE("pictures are well formed and have finite coordinates, whatever the barcode", "[replay]") {
  for (const Barcode& barcode : odd_barcodes()) {
    CAPTURE(&barcode - odd_barcodes().data());
    for (const Write write : all_pictures) {
      const std::string text = picture(write, barcode);
      check_tags(text);
      static const std::regex not_a_number("[\" MHVl-](?:nan|inf)");
      CHECK_FALSE(std::regex_search(text, not_a_number));
    }
  }
}

TEST_CASE("pictures say where they come from", "[replay]") {
  for (const Write write : all_pictures) {
    const std::string text = picture(write, small);
    CHECK_THAT(text, Contains("a.tower") && Contains("coefficients Z/2") && Contains("12 operations") &&
                         Contains("5 bars, of which 2 never end") && Contains("3 bars of length 0 left out"));
    CHECK_THAT(picture(write, small, {"A title", "time"}),
               Contains("A title") && Contains("from a.tower") && Contains("time"));
  }
}

TEST_CASE("the same barcode gives the same bytes", "[replay]") {
  const Barcode barcode = random_barcode(500, 3);
  for (const Write write : all_pictures) {
    CHECK(picture(write, barcode) == picture(write, barcode));
  }
}

TEST_CASE("names in titles are escaped", "[replay]") {
  const std::string source = "<script>&\"'\x01\xFF.tower";
  for (const Write write : all_pictures) {
    const std::string text = picture(write, small, {}, source);
    CHECK_THAT(text, Contains("&lt;script&gt;&amp;&quot;&#39;\uFFFD\uFFFD.tower"));
    CHECK_THAT(text, !Contains("<script"));
    check_tags(text);
  }
}

TEST_CASE("every bar is a line with its interval to rest on", "[replay]") {
  const std::string bars = picture(replay::write_barcode_svg, small);
  for (const char* title : {"H0 [0, \u221E)", "H0 [1, 4)", "H1 [3, 8)", "H1 [5, \u221E)", "H2 [11, 12)"}) {
    CHECK_THAT(bars, Contains("<title>" + std::string{title} + "</title>"));
    CHECK_THAT(picture(replay::write_diagram_svg, small), Contains("<title>" + std::string{title} + "</title>"));
  }
  CHECK_THAT(bars, !Contains("left out</text>") || !Contains("the longest of"));
}

TEST_CASE("of too many bars the longest are drawn, and the picture says how many are not", "[replay]") {
  const std::string bars = picture(replay::write_barcode_svg, random_barcode(5000, 2));
  CHECK_THAT(bars, Contains("the longest of each dimension: 2,000 of 5,000 bars; 3,000 are left out"));
  CHECK(count(bars, "<title>") == 2000);
}

TEST_CASE("a wall of bars of one length is thin, and says how many there are", "[replay]") {
  Barcode assembly{{{0, 0, never}}, 0};
  for (int k = 1; k < 1000; ++k) {  // each piece is apart for a step
    assembly.bars.push_back({0, 2.0 * k, 2.0 * k + 1});
  }
  assembly.bars.push_back({1, 500, 1500});
  const replay::DrawingOptions whole{"", "step", {}, replay::Walls::whole};
  const std::string thin_text = picture(replay::write_barcode_svg, assembly),
                    whole_text = picture(replay::write_barcode_svg, assembly, whole);
  CHECK_THAT(thin_text, Contains("999 bars of length 1, drawn thin") && !Contains("left out</text>"));
  CHECK_THAT(whole_text, !Contains("drawn thin"));
  CHECK(replay::barcode_panel(assembly, "step", 960, replay::Walls::thin).height < 200);
  CHECK(replay::barcode_panel(assembly, "step", 960, replay::Walls::whole).height > 1000);
  CHECK(count(thin_text, "<title>H0") == 1);
  CHECK(count(whole_text, "<title>H0") == 1000);
  check_tags(thin_text);
  for (Bar& bar : assembly.bars) {  // now some are shorter
    bar.death = bar.death - (bar.dimension == 0 && bar.death < 100 ? 0.5 : 0);
  }
  CHECK_THAT(picture(replay::write_barcode_svg, assembly), Contains("999 bars of length up to 1, drawn thin"));
}

TEST_CASE("only short bars that are many and alike make a wall", "[replay]") {
  const auto wall_of = [](std::size_t bars, double length, double step, double longest) {
    std::vector<Bar> row;
    for (std::size_t k = 0; k < bars; ++k) {
      row.push_back({0, step * static_cast<double>(k), step * static_cast<double>(k) + length});
    }
    row.push_back({0, 1, never});
    const replay::BarWall wall = replay::take_wall(row, longest, 4);
    CHECK(wall.bars + row.size() == bars + 1);
    return wall;
  };
  CHECK(wall_of(20, 1, 2, 1).bars == 20);
  CHECK(wall_of(20, 1, 2, 1).lanes.size() == 1);
  CHECK(wall_of(20, 3, 1, 3).lanes.size() == 3);
  CHECK(wall_of(20, 9, 1, 9).lanes.size() == 4);  // as many as there may be
  CHECK(wall_of(20, 9, 1, 9).bars == 20);
  CHECK(wall_of(19, 1, 2, 1).bars == 0);
  CHECK(wall_of(20, 2, 2, 1).bars == 0);
  std::vector<Bar> uneven;
  for (int k = 0; k < 50; ++k) {
    uneven.push_back({0, 0, 1.0 + k});
  }
  CHECK(replay::take_wall(uneven, 100, 4).bars == 0);
}

TEST_CASE("a picture has its legend once", "[replay]") {
  CHECK(count(picture(replay::write_svg, small), ">H0: 2 bars") == 1);
}

TEST_CASE("numbers in pictures are short", "[replay]") {
  const Barcode fractions{{{0, 0.1 + 0.2, never}, {0, 1.0 / 3, 2.0 / 3}, {1, 1e-9 / 3, 3}, {1, 1e15 / 3, 1e15}}, 0};
  const std::regex long_number(R"([0-9]\.[0-9]{8})");
  for (const Write write : all_pictures) {
    CHECK_FALSE(std::regex_search(picture(write, fractions), long_number));
  }
  CHECK_THAT(picture(replay::write_svg, fractions), Contains("[0.333333, 0.666667)"));
  CHECK(replay::short_number_text(12345678) == "12345678");
  CHECK(replay::short_number_text(1e-9 / 3) == "3.33333e-10");
  for (const replay::Tick& tick : replay::round_ticks({1e-9, 7e-9, false}, 8)) {
    CHECK(tick.label.size() < 6);
  }
}

TEST_CASE("each dimension keeps its share of the bars that are chosen, and the longest of it", "[replay]") {
  Barcode barcode;
  for (int i = 0; i < 100; ++i) {
    barcode.bars.push_back({0, static_cast<double>(i), 1000.0 + 2 * i});
  }
  barcode.bars.push_back({1, 0, 2});
  barcode.bars.push_back({1, 5, 6});
  for (int i = 0; i < 10; ++i) {
    barcode.bars.push_back({2, static_cast<double>(i), i + 3 + static_cast<double>(i) / 10});
  }
  const std::vector<Bar> chosen = replay::longest_bars(barcode, 12);
  REQUIRE(chosen.size() == 12);
  CHECK(std::is_sorted(chosen.begin(), chosen.end()));
  const auto of = [&](int p) {
    return std::count_if(chosen.begin(), chosen.end(), [p](const Bar& bar) { return bar.dimension == p; });
  };
  CHECK(of(0) == 6);  // its four, and the two that dimension 1 leaves
  CHECK(of(1) == 2);
  CHECK(of(2) == 4);
  CHECK(chosen.front() == Bar{0, 94, 1188});
  CHECK(chosen[8] == Bar{2, 6, 9.6});
  CHECK(replay::longest_bars(barcode, 1000) == barcode.bars);
}

TEST_CASE("bars that end keep room beside many that do not", "[replay]") {
  Barcode barcode;
  for (int i = 0; i < 100; ++i) {
    barcode.bars.push_back({0, static_cast<double>(i), i % 4 == 0 ? i + 1.0 + i : engine::never});
  }
  const auto ended = [](const std::vector<Bar>& bars) {
    return std::count_if(bars.begin(), bars.end(), [](const Bar& bar) { return bar.death != engine::never; });
  };
  CHECK(ended(replay::longest_bars(barcode, 20)) == 10);
  CHECK(ended(replay::longest_bars(barcode, 80)) == 25);  // all of them
  CHECK(replay::longest_bars(barcode, 80).size() == 80);
}

TEST_CASE("shorter bars are left out of the pictures of bars, which say so, and not of the Betti curves", "[replay]") {
  const Barcode barcode{{{0, 0, engine::never}, {0, 1, 2}, {0, 1, 9}}, 0};
  const replay::DrawingOptions options{"", "time", {3}};
  const std::string bars = picture(replay::write_barcode_svg, barcode, options);
  CHECK(count(bars, "<title>") == 2);
  CHECK_THAT(bars, Contains("1 bar shorter than 3 left out"));
  CHECK(count(picture(replay::write_diagram_svg, barcode, options), "<title>") == 2);
  CHECK(picture(replay::write_betti_svg, barcode, options) == picture(replay::write_betti_svg, barcode, {"", "time"}));
}

TEST_CASE("a diagram of 100,000 points is a picture of bounded size", "[replay]") {
  const Barcode barcode = random_barcode(100'000, 3);
  const std::string diagram = picture(replay::write_diagram_svg, barcode);
  CHECK(diagram.size() < 4'000'000);
  CHECK(picture(replay::write_betti_svg, barcode).size() < 500'000);
}

TEST_CASE("points at one place are one larger symbol that says how many they are", "[replay]") {
  const std::string one = picture(replay::write_diagram_svg, {{{0, 1, 5}}, 0});
  const std::string many = picture(replay::write_diagram_svg, {std::vector<Bar>(16, Bar{0, 1, 5}), 0});
  CHECK_THAT(one, Contains("r=\"4\"><title>H0 [1, 5)</title>"));
  CHECK_THAT(many, Contains("r=\"8\"><title>H0, 16 bars: [1, 5) and such</title>"));
}

TEST_CASE("a Betti curve that would be too flat makes the axis logarithmic", "[replay]") {
  Barcode barcode{std::vector<Bar>(1000, Bar{0, 0, 2}), 0};
  CHECK_THAT(picture(replay::write_betti_svg, barcode), !Contains("logarithmic"));
  barcode.bars.push_back({1, 1, 2});
  CHECK_THAT(picture(replay::write_betti_svg, barcode), Contains("Betti number (logarithmic)"));
}

TEST_CASE("whole numbers beyond 2^53 are drawn as near to each other as they are, from where the axis says",
          "[replay][time]") {
  const auto from = [](std::int64_t now) {
    return Barcode{{{0, now, never}, {0, now + 1, now + 3}, {1, now + 4, now + 40}}, 0};
  };
  const std::regex times("operation(, counted from [0-9]+)?|<title>[^<]*</title>");
  for (const Write write : all_pictures) {
    const std::string near = picture(write, from(3)), far = picture(write, from(1732800000000000003));
    CHECK_THAT(far, Contains("operation, counted from 1732800000000000000"));
    CHECK(std::regex_replace(far, times, "") == std::regex_replace(near, times, ""));
  }
  const std::string bars = picture(replay::write_barcode_svg, from(1732800000000000003));
  CHECK_THAT(bars, Contains("<title>H0 [1732800000000000004, 1732800000000000006)</title>"));
  const Range before_0 = replay::time_range(from(-1732800000000000097));
  CHECK(before_0.origin == -1732800000000000000);
  CHECK(before_0.low == -97);
  CHECK(before_0.high == -57);
  CHECK(replay::time_range({{{0, -9223372036854775807, 9223372036854775807}}, 0}).origin == 0);
}

TEST_CASE("dimensions differ in colour or shape", "[replay]") {
  std::vector<std::string> symbols;
  for (int p = 0; p < 32; ++p) {
    symbols.push_back(replay::Svg().symbol(0, 0, 4, p, "").markup());
  }
  std::sort(symbols.begin(), symbols.end());
  CHECK(std::adjacent_find(symbols.begin(), symbols.end()) == symbols.end());
}

TEST_CASE("ticks stand at round numbers with the decimals that they need", "[replay]") {
  using Labels = std::vector<std::string>;
  CHECK(labels(replay::round_ticks({0, 11, true}, 6)) == Labels{"0", "2", "4", "6", "8", "10"});
  CHECK(labels(replay::round_ticks({0.00013, 0.00017, false}, 5)) ==
        Labels{"0.00013", "0.00014", "0.00015", "0.00016", "0.00017"});
  CHECK(labels(replay::round_ticks({0, 2'000'000, true}, 5)) ==
        Labels{"0", "500,000", "1,000,000", "1,500,000", "2,000,000"});
  CHECK(labels(replay::round_ticks({0, 2, true}, 10)) == Labels{"0", "1", "2"});
  CHECK(labels(replay::round_ticks({-0.25, 0.3, false}, 6)) == Labels{"-0.2", "-0.1", "0.0", "0.1", "0.2", "0.3"});
  CHECK(labels(replay::round_ticks({0, 3e-9, false}, 3)) == Labels{"0", "1e-09", "2e-09", "3e-09"});
}

TEST_CASE("ticks lie in their range, in order, without labels that touch", "[replay][law]") {
  const unsigned seed = GENERATE(range(0U, 200U));
  CAPTURE(seed);
  std::mt19937 random(seed);
  const auto number = [&] {
    return std::ldexp(static_cast<double>(random()) - 2e9, static_cast<int>(random() % 80) - 60);
  };
  const double x = number(), y = seed % 3 == 0 ? x * (1 + 1e-6) : number();
  const Range range{std::min(x, y), std::max(x, y), false};
  const auto ticks = replay::ticks_across(range, 400);
  CHECK_FALSE(ticks.empty());
  const replay::Scale scale(range, 0, 400);
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    CHECK(scale(ticks[i].value) > -1);
    CHECK(scale(ticks[i].value) < 401);
    if (i > 0) {
      CHECK(ticks[i].label != ticks[i - 1].label);
      CHECK(scale(ticks[i].value) - scale(ticks[i - 1].value) > replay::label_width(ticks));
    }
    CHECK(std::stod(std::regex_replace(ticks[i].label, std::regex(","), "")) ==
          Approx(ticks[i].value).epsilon(1e-9).margin(1e-300));
  }
}

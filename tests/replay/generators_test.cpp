#include "replay/script/generators.hpp"

#include <atomic>
#include <nlohmann/json.hpp>

#include "tests/replay/replay_support.hpp"

using namespace sesame;
using namespace sesame::tests;
using Catch::Contains;
using Json = nlohmann::json;

namespace {

replay::ReplayOptions choosing(replay::GeneratorOptions generators) {
  replay::ReplayOptions options;
  options.every = 0;
  options.generators = std::move(generators);
  return options;
}

Json generators_of(const std::string& text, replay::GeneratorOptions generators) {
  const std::string out = report_on(text, replay::json_reporter, choosing(std::move(generators)));
  return Json::parse(lines_of(out).back()).at("generators");
}

std::string table_of(const std::string& text, replay::GeneratorOptions generators) {
  const auto plain = [](std::ostream& out) { return replay::table_reporter(out, false); };
  return report_on(text, plain, choosing(std::move(generators)));
}

}  // namespace

TEST_CASE("dimensions are written as numbers and ranges", "[replay]") {
  using Ranges = std::vector<std::pair<int, int>>;
  CHECK(*replay::parse_degrees("1") == Ranges{{1, 1}});
  CHECK(*replay::parse_degrees("0-2") == Ranges{{0, 2}});
  CHECK(*replay::parse_degrees("0,2-4,7") == Ranges{{0, 0}, {2, 4}, {7, 7}});
  for (const char* wrong : {"", ",", "1,", ",1", "-1", "1-", "2-1", "a", "1 ", "1--2", "1.5", "99999999999"}) {
    CAPTURE(wrong);
    const auto parsed = replay::parse_degrees(wrong);
    REQUIRE_FALSE(parsed);
    CHECK_THAT(parsed.error().what, Contains("should be dimensions"));
  }
  const replay::GeneratorOptions some{{{0, 0}, {2, 4}}};
  CHECK((some.wants(0) && some.wants(2) && some.wants(4)));
  CHECK_FALSE((some.wants(1) || some.wants(5)));
  CHECK(replay::GeneratorOptions{}.wants(9));
}

TEST_CASE("only the generators of the dimensions that are asked for are written", "[replay]") {
  const std::string torus = example("torus");
  CHECK(generators_of(torus, {}).size() == 4);
  const Json some = generators_of(torus, {{{1, 1}}});
  REQUIRE(some.size() == 2);
  CHECK(some[0].at("dim") == 1);
  CHECK(generators_of(torus, {{{7, 9}}}).empty());
  const std::string table = table_of(torus, {{{0, 0}, {2, 2}}});
  CHECK_THAT(table, Contains("H1 = Z^2\nH2 = Z\n    free"));
}

TEST_CASE("a chain that is too long is given by its length", "[replay]") {
  const std::string text = header_line + "\n" + polygon(50) + "\n";
  CHECK(generators_of(text, {{{1, 1}}, 50})[0].at("chain").size() == 50);
  CHECK(generators_of(text, {{{1, 1}}, 49}).dump() == R"([{"dim":1,"order":0,"terms":50}])");
  CHECK_THAT(table_of(text, {{}, 49}), Contains("    free      a chain of 50 terms\n"));
  CHECK(generators_of(text, {{{0, 0}}, 0}).dump() == R"([{"dim":0,"order":0,"terms":1}])");
  const Json plane = generators_of(example("projective_plane"), {{{1, 1}}, 1});
  CHECK(plane.dump() == R"([{"bounds_terms":2,"chain":[[1,"a.0-1"]],"dim":1,"order":2}])");
  CHECK_THAT(table_of(example("projective_plane"), {{}, 1}), Contains("2 times it bounds a chain of 2 terms"));
}

TEST_CASE("what would be too much to add up is only bounded", "[replay]") {
  std::string text = header_line + "\n" + polygon(4) + "\n";
  std::string last = "P";
  for (const std::string name : {"P2", "P4", "P8", "P16"}) {
    text += R"({"op":"product","name":")" + name + R"(","left":")" + last + R"(","right":")" + last + "\"}\n";
    last = name;
  }
  const Json top = generators_of(text, {{{16, 16}}, 100});
  CHECK(top.dump() == R"([{"dim":16,"order":0,"terms_at_most":4294967296}])");
  CHECK_THAT(table_of(text, {{{16, 16}}, 100}), Contains("a chain of at most 4294967296 terms"));
}

TEST_CASE("a stop ends the list of generators after the one at hand", "[replay]") {
  std::atomic<bool> stop = false;
  engine::Engine engine;
  REQUIRE(engine.apply(ops::MakeSimplex{"t", 2, {}}));
  const replay::GeneratorOptions all;
  replay::Summary summary;
  summary.generators = &all;
  summary.stop = &stop;
  const auto written = [&](auto make) {
    std::ostringstream out;
    make(out)->summary(engine, summary);
    return out.str();
  };
  const auto plain = [](std::ostream& out) { return replay::table_reporter(out, false); };
  CHECK_FALSE(Json::parse(written(replay::json_reporter)).contains("interrupted"));
  CHECK_THAT(written(plain), !Contains("interrupted"));
  stop = true;
  const Json stopped = Json::parse(written(replay::json_reporter));
  CHECK(stopped.at("interrupted") == true);
  CHECK(stopped.at("generators").empty());
  CHECK_THAT(written(plain), Contains("interrupted: these are not all generators"));
}

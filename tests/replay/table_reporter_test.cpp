#include <regex>

#include "tests/replay/replay_support.hpp"

using namespace sesame;
using namespace sesame::tests;
using Catch::Contains;

namespace {

std::string plain_table(const std::string& text, const replay::ReplayOptions& options = {}) {
  return report_on(
      text, [](std::ostream& out) { return replay::table_reporter(out, false); }, options);
}

std::string coloured_table(const std::string& text) {
  return report_on(text, [](std::ostream& out) { return replay::table_reporter(out, true); });
}

/// With TIME in place of each time, as wide as in a column, and RATE for the number of steps a second.
std::string masked(const std::string& table) {
  const std::regex column(R"( (?:[ \d.]{7} [mu]s|[ \d.]{8} s)  )");
  const std::string columns = std::regex_replace(table, column, "       TIME  ");
  const std::string times = std::regex_replace(columns, std::regex(R"(in [\d.]+ [mu]?s)"), "in TIME");
  return std::regex_replace(times, std::regex(R"(\(\d+ a second)"), "(RATE a second");
}

std::string without_colours(const std::string& text) {
  return std::regex_replace(text, std::regex("\033\\[[0-9]+m"), "");
}

/// Equal to the file in tests/golden/, or else the test says what it was instead.
void check_golden(const std::string& name, const std::string& table) {
  CHECK(table == text_of_file(std::string{SESAME_TEST_GOLDEN} + "/" + name));
}

replay::ReplayOptions with_generators() {
  replay::ReplayOptions options;
  options.generators.emplace();
  return options;
}

}  // namespace

TEST_CASE("the tables of the torus and of the projective plane are the golden ones", "[replay]") {
  check_golden("torus.txt", masked(plain_table(example("torus"), with_generators())));
  check_golden("projective_plane.txt", masked(plain_table(example("projective_plane"), with_generators())));
}

TEST_CASE("colours are written only when they are asked for, and change no word", "[replay]") {
  const std::string plain = plain_table(example("projective_plane"));
  const std::string coloured = coloured_table(example("projective_plane"));
  CHECK(plain.find('\033') == std::string::npos);
  CHECK(coloured.find('\033') != std::string::npos);
  CHECK(masked(without_colours(coloured)) == masked(plain));
}

TEST_CASE("only homology that has changed is coloured", "[replay]") {
  const auto lines = lines_of(coloured_table(header_line + "\n" + R"({"op":"simplex","name":"a","dim":0})" + "\n" +
                                             R"({"op":"note","text":"nothing"})" + "\n" +
                                             R"({"op":"simplex","name":"b","dim":0})" + "\n"));
  REQUIRE(lines.size() > 3);
  CHECK_THAT(lines[1], Contains("\033[32mH0 = Z\033[0m"));
  CHECK(lines[2].find('\033') == std::string::npos);
  CHECK_THAT(lines[2], Contains("H0 = Z"));
  CHECK_THAT(lines[3], Contains("\033[32mH0 = Z^2\033[0m"));
}

TEST_CASE("long chains are cut in the table", "[replay]") {
  const std::string text = header_line + "\n" + polygon(50) + "\n";
  CHECK_THAT(plain_table(text, with_generators()), Contains("+ ... (50 terms in all)"));
  CHECK_THAT(plain_table(header_line + "\n" + polygon(40) + "\n", with_generators()), !Contains("terms in all"));
}

TEST_CASE("a class is answered in a line of its own", "[replay]") {
  const std::string text = header_line + "\n" + R"({"op":"simplex","name":"t","dim":2})" + "\n";
  const auto answer = [&](const std::string& chain) {
    return lines_of(plain_table(text + R"({"op":"class","chain":)" + chain + "}\n")).at(3);
  };
  CHECK(answer(R"([[1,"t.0-1"]])") == "        not a cycle: it has no class");
  CHECK(answer(R"([[2,"t.0-1"],[2,"t.1-2"],[-2,"t.0-2"]])") == "        bounds 2 t");
  CHECK_THAT(answer(R"([[3,"t.2"]])"), Contains("a cycle of class (3) on the generators"));
}

TEST_CASE("simplices that were there already are told, by step and in all", "[replay]") {
  const std::string text = header_line + "\n" + R"({"op":"insert","simplices":[[1,2],[2,1]]})" + "\n" +
                           R"({"op":"insert","simplices":[[1,2],[2,3],[1]]})" + "\n";
  const auto lines = lines_of(plain_table(text));
  CHECK(lines.at(2) == "        1 simplex to be inserted was there already");
  CHECK(lines.at(4) == "        2 simplices to be inserted were there already");
  CHECK(std::find(lines.begin() + 5, lines.end(), "3 simplices to be inserted were there already") != lines.end());
}

TEST_CASE("a summary without reported steps stands alone, and names no cells when there are none", "[replay]") {
  replay::ReplayOptions options;
  options.every = 0;
  CHECK(masked(plain_table(header_line + "\n" + R"({"op":"note","text":""})" + "\n", options)) ==
        "1 steps in TIME (RATE a second)\ncells none, Euler characteristic 0\n");
}

TEST_CASE("the summary of an interrupted replay begins with that word", "[replay]") {
  std::ostringstream out;
  const auto reporter = replay::table_reporter(out, false);
  engine::Engine engine;
  replay::Summary summary;
  summary.steps = 7;
  summary.interrupted = true;
  reporter->summary(engine, summary);
  CHECK_THAT(out.str(), Catch::StartsWith("interrupted: 7 steps in"));
}

TEST_CASE("groups are written over the ring that was asked for", "[replay]") {
  replay::ReplayOptions options;
  const auto ring = sparse::parse_ring("Z/2");
  REQUIRE(ring);
  options.ring = *ring;
  options.until = 3;
  const std::string table = plain_table(example("projective_plane"), options);
  CHECK_THAT(lines_of(table).at(0), Contains("homology over Z/2"));
  CHECK_THAT(table, Contains("H0 = Z/2\n"));
}

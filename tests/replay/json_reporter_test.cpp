#include <nlohmann/json.hpp>

#include <filesystem>

#include "tests/replay/replay_support.hpp"

using namespace sesame;
using namespace sesame::tests;
using Json = nlohmann::ordered_json;

namespace {

std::vector<Json> json_report(const std::string& text, const replay::ReplayOptions& options = {}) {
  const std::string out = report_on(text, replay::json_reporter, options);
  CHECK((out.empty() || out.back() == '\n'));
  std::vector<Json> objects;
  for (const std::string& line : lines_of(out)) {
    objects.push_back(Json::parse(line));
  }
  return objects;
}

/// The text without the time, which must be a number that is not negative.
std::string without(const char* time, Json object) {
  CHECK(object.at(time).is_number());
  CHECK(object.at(time).get<double>() >= 0);
  object.erase(time);
  return object.dump();
}

replay::ReplayOptions with_generators() {
  replay::ReplayOptions options;
  options.generators.emplace();
  return options;
}

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> names;
  for (const auto& [name, value] : object.items()) {
    names.push_back(name);
  }
  return names;
}

/// Numbers as JSON readers can hold them exactly, else strings of digits.
bool is_exact(const Json& number) {
  return number.is_number_integer() || (number.is_string() && number.get<std::string>().size() > 18);
}

void check_chain(const Json& chain) {
  REQUIRE(chain.is_array());
  for (const Json& term : chain) {
    REQUIRE(term.size() == 2);
    CHECK(is_exact(term[0]));
    CHECK(term[1].is_string());
  }
}

/// Of an object with cells that are no balls, whose parts are no cells.
bool has_parts = false;

/// The fields that steps and the summary have in common.
void check_state(const Json& object) {
  const std::size_t dimensions = object.at("cells").size();
  CHECK(object.at("betti").size() >= dimensions);
  CHECK(object.at("torsion").size() == object.at("betti").size());
  std::int64_t from_cells = 0;
  std::int64_t from_betti = 0;
  for (std::size_t p = 0; p < object.at("betti").size(); ++p) {
    const std::int64_t sign = p % 2 == 0 ? 1 : -1;
    from_cells += p < dimensions ? sign * object.at("cells")[p].get<std::int64_t>() : 0;
    from_betti += sign * object.at("betti")[p].get<std::int64_t>();
  }
  CHECK((has_parts || object.at("euler") == from_cells));
  CHECK(object.at("euler") == from_betti);
}

void check_step(const Json& object, std::size_t number) {
  CHECK(object.at("step") == number);
  const bool asks = object.at("op") == "class";
  const std::vector<std::string> expected = {"step", "op", "cells", "euler", "betti", "torsion", "small", "big"};
  std::vector<std::string> found = keys(object);
  REQUIRE(found.size() == expected.size() + (asks ? 2 : 1));
  CHECK(found.back() == "us");
  found.pop_back();
  if (asks) {
    CHECK(found.back() == "class");
    found.pop_back();
    const Json& answer = object.at("class");
    CHECK(keys(answer) == std::vector<std::string>{"cycle", "zero", "coefficients", "bounds"});
    CHECK(answer.at("coefficients").is_array() == answer.at("cycle").get<bool>());
    CHECK(answer.at("bounds").is_array() == answer.at("zero").get<bool>());
  }
  CHECK(found == expected);
  CHECK(object.at("small").size() == object.at("betti").size());
  CHECK(object.at("big").size() >= object.at("cells").size());
  check_state(object);
}

void check_summary(const Json& object, std::size_t steps) {
  CHECK(keys(object) == std::vector<std::string>{"summary", "ring", "steps", "cells", "euler", "betti", "torsion",
                                                 "seconds", "generators"});
  CHECK(object.at("summary") == true);
  CHECK(object.at("steps") == steps);
  check_state(object);
  std::vector<std::int64_t> free(object.at("betti").size());
  std::vector<Json> finite(object.at("betti").size(), Json::array());
  for (const Json& generator : object.at("generators")) {
    const auto p = generator.at("dim").get<std::size_t>();
    REQUIRE(p < free.size());
    const bool is_free = generator.at("order") == 0;
    CHECK(keys(generator) == (is_free ? std::vector<std::string>{"dim", "order", "chain"}
                                      : std::vector<std::string>{"dim", "order", "chain", "bounds"}));
    check_chain(generator.at("chain"));
    if (is_free) {
      ++free[p];
    } else {
      check_chain(generator.at("bounds"));
      finite[p].push_back(generator.at("order"));
    }
  }
  CHECK(Json(free) == object.at("betti"));
  CHECK(Json(finite) == object.at("torsion"));
}

}  // namespace

TEST_CASE("a step and the summary are the objects that the format describes", "[replay]") {
  const auto objects = json_report(header_line + "\n" + R"({"op":"simplex","name":"t","dim":1})" + "\n" +
                                       R"({"op":"identify","pairs":[["t.0","t.1"]]})" + "\n",
                                   with_generators());
  REQUIRE(objects.size() == 3);
  CHECK(
      without("us", objects[0]) ==
      R"({"step":1,"op":"simplex","cells":[2,1],"euler":1,"betti":[1,0],"torsion":[[],[]],"small":[1,0],"big":[2,1]})");
  CHECK(
      without("us", objects[1]) ==
      R"({"step":2,"op":"identify","cells":[1,1],"euler":0,"betti":[1,1],"torsion":[[],[]],"small":[1,1],"big":[2,2]})");
  CHECK(without("seconds", objects[2]) ==
        R"({"summary":true,"ring":"Z","steps":2,"cells":[1,1],"euler":0,"betti":[1,1],"torsion":[[],[]],)"
        R"("generators":[{"dim":0,"order":0,"chain":[[1,"t.0"]]},{"dim":1,"order":0,"chain":[[1,"t"]]}]})");
}

TEST_CASE("before there is a cell every list is empty", "[replay]") {
  const auto objects = json_report(header_line + "\n" + R"({"op":"note","text":"hello"})" + "\n", with_generators());
  REQUIRE(objects.size() == 2);
  CHECK(without("us", objects[0]) ==
        R"({"step":1,"op":"note","cells":[],"euler":0,"betti":[],"torsion":[],"small":[],"big":[]})");
  CHECK(without("seconds", objects[1]) ==
        R"({"summary":true,"ring":"Z","steps":1,"cells":[],"euler":0,"betti":[],"torsion":[],"generators":[]})");
}

TEST_CASE("simplices that were there already are counted where there are some", "[replay]") {
  const auto objects = json_report(header_line + "\n" + R"({"op":"insert","simplices":[[1,2],[2,1],[1,2]]})" + "\n" +
                                   R"({"op":"insert","simplex":[2],"exist_ok":true})" + "\n" +
                                   R"({"op":"insert","simplex":[3]})" + "\n");
  REQUIRE(objects.size() == 4);
  CHECK(objects[0].at("already") == 2);
  CHECK(objects[1].at("already") == 1);
  CHECK_FALSE(objects[2].contains("already"));
  CHECK(objects[3].at("already") == 3);
}

TEST_CASE("generators are listed only when they are asked for", "[replay]") {
  const auto objects = json_report(header_line + "\n" + R"({"op":"simplex","name":"t","dim":1})" + "\n");
  CHECK_FALSE(objects.back().contains("generators"));
  CHECK_FALSE(objects.back().contains("interrupted"));
}

TEST_CASE("an interrupted replay says so", "[replay]") {
  std::ostringstream out;
  const auto reporter = replay::json_reporter(out);
  engine::Engine engine;
  replay::Summary summary;
  summary.interrupted = true;
  reporter->summary(engine, summary);
  CHECK(Json::parse(out.str()).at("interrupted") == true);
}

TEST_CASE("the answers to class: no cycle, a class, a boundary and what it bounds", "[replay]") {
  const std::string plane = header_line + "\n" + R"({"op":"simplex","name":"a","dim":2})" + "\n" +
                            R"({"op":"simplex","name":"b","dim":2})" + "\n" +
                            R"({"op":"identify","pairs":[["a.0-1","b.0-1"],["a.1-2","b.0-2"]]})" + "\n";
  const std::string glue = R"({"op":"identify","pairs":[["a.0-2","b.1-2"]]})"
                           "\n";
  const auto answer = [&](const std::string& text, const std::string& chain) {
    const auto objects = json_report(text + R"({"op":"class","chain":)" + chain + "}\n");
    return objects[objects.size() - 2].at("class").dump();
  };
  CHECK(answer(plane, R"([[1,"a"]])") == R"({"cycle":false,"zero":false,"coefficients":null,"bounds":null})");
  CHECK(answer(plane + glue, R"([[1,"a.0-1"]])") == R"({"cycle":true,"zero":false,"coefficients":[1],"bounds":null})");
  // H_2 = 0, so there is one chain only that has this boundary.
  CHECK(answer(plane + glue, R"([[2,"a.0-1"]])") ==
        R"({"cycle":true,"zero":true,"coefficients":[0],"bounds":[[1,"a"],[1,"b"]]})");
  CHECK(answer(plane + glue, R"([[-2,"a.0-1"]])") ==
        R"({"cycle":true,"zero":true,"coefficients":[0],"bounds":[[-1,"a"],[-1,"b"]]})");
  CHECK(answer(plane + glue, "[]") == R"({"cycle":true,"zero":true,"coefficients":[0],"bounds":[]})");
}

TEST_CASE("integers beyond 64 bits are strings of digits, those within are numbers", "[replay]") {
  const std::string text = header_line + "\n" + large_torsion(70) + "\n" +
                           R"({"op":"class","chain":[["36893488147419103232","K.e0"]]})" + "\n" +
                           R"({"op":"class","chain":[[1,"K.e70"]]})" + "\n";
  const auto objects = json_report(text, with_generators());
  REQUIRE(objects.size() == 4);
  CHECK(objects[0].at("torsion").dump() == R"([[],["1180591620717411303424"],[]])");
  const Json& generators = objects[3].at("generators");
  REQUIRE(generators.size() == 2);
  CHECK(generators[1].at("order") == "1180591620717411303424");
  check_chain(generators[1].at("bounds"));
  CHECK(generators[1].at("bounds").dump().find("\"590295810358705651712\"") != std::string::npos);
  CHECK(objects[2].at("class").at("zero") == true);
  // The generator is an odd multiple of e0, whichever: 2^65 times that is not 0 and fits no 64 bits.
  CHECK(objects[1].at("class").at("coefficients")[0].is_string());
}

TEST_CASE("the last integers of 64 bits are numbers", "[replay]") {
  const std::string loop =
      header_line + "\n" + R"({"op":"complex","name":"K","cells":[{"id":"v"},{"id":"e","faces":["v","v"]}]})" + "\n";
  const auto coefficient = [&](const std::string& n) {
    const auto objects = json_report(loop + R"({"op":"class","chain":[[)" + n + R"(,"K.e"]]})" + "\n");
    return objects[1].at("class").at("coefficients").dump();
  };
  CHECK(coefficient("9223372036854775807") == "[9223372036854775807]");
  CHECK(coefficient(R"("9223372036854775808")") == R"(["9223372036854775808"])");
  CHECK(coefficient("-9223372036854775808") == "[-9223372036854775808]");
  CHECK(coefficient(R"("-9223372036854775809")") == R"(["-9223372036854775809"])");
}

TEST_CASE("every line of every example has the shape that the format describes", "[replay]") {
  std::size_t examples = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SESAME_TEST_EXAMPLES)) {
    if (entry.path().extension() != ".jsonl") {
      continue;
    }
    CAPTURE(entry.path().string());
    has_parts = entry.path().stem() == "suspension_in_two_cells";
    ++examples;
    const std::string text = text_of_file(entry.path().string());
    const auto objects = json_report(text, with_generators());
    REQUIRE_FALSE(objects.empty());
    for (std::size_t k = 0; k + 1 < objects.size(); ++k) {
      check_step(objects[k], k + 1);
    }
    check_summary(objects.back(), objects.size() - 1);
  }
  CHECK(examples > 10);
}

TEST_CASE("terms of a class that name the same cell are added up", "[replay]") {
  const std::string text = header_line + "\n" + R"({"op":"simplex","name":"t","dim":1})" + "\n" +
                           R"({"op":"identify","pairs":[["t.0","t.1"]]})" + "\n";
  const auto answer = [&](const std::string& chain) {
    return json_report(text + R"({"op":"class","chain":)" + chain + "}\n")[2].at("class").dump();
  };
  CHECK(answer(R"([[1,"t.0"],[2,"t.1"]])") == R"({"cycle":true,"zero":false,"coefficients":[3],"bounds":null})");
  CHECK(answer(R"([[1,"t.0"],[-1,"t.1"]])") == R"({"cycle":true,"zero":true,"coefficients":[0],"bounds":[]})");
}

TEST_CASE("chains of cells of maps are written in simplices where that is asked for", "[replay]") {
  // A torus of one square.
  const std::string script = R"({"sesame":1,"ring":"Z"})"
                             "\n"
                             R"({"op":"polygon","name":"t","sides":4})"
                             "\n"
                             R"({"op":"sew","dim":2,"pairs":[["t:0","t:5"],["t:2","t:7"]]})"
                             "\n"
                             R"({"op":"class","chain":[[1,"t.1:0"]]})"
                             "\n"
                             R"({"op":"class","chain":[[1,"t.1:0"],[-1,"t.1:5"]]})"
                             "\n";
  const std::string out = report_on(script, replay::json_reporter_in_simplices, with_generators());
  const std::vector<std::string> lines = lines_of(out);
  REQUIRE(lines.size() == 5);
  CHECK(Json::parse(lines[3])["class"]["zero"] == true);
  CHECK(Json::parse(lines[3])["class"]["bounds"] == Json::array());
  const Json generators = Json::parse(lines.back())["generators"];
  REQUIRE(generators.size() == 4);
  CHECK(generators[1]["chain"].size() == 2);  // an edge is cut at its middle
  CHECK(generators[3]["chain"].size() == 8);  // and a square along eight darts
  for (const Json& term : generators[3]["chain"]) {
    CHECK_THAT(term[1].get<std::string>(), Catch::Matchers::StartsWith("t.<0-1-2>:"));
  }
  // They are cycles of the same map by simplices.
  std::string classes;
  for (const Json& generator : generators) {
    classes += Json{{"op", "class"}, {"chain", generator["chain"]}}.dump() + "\n";
  }
  std::string by_simplices = script.substr(0, script.find("{\"op\":\"class\""));
  by_simplices.replace(by_simplices.find("\"sides\":4"), 9, "\"sides\":4,\"as\":\"simplices\"");
  for (const std::string& line : lines_of(report_on(by_simplices + classes, replay::json_reporter))) {
    const Json found = Json::parse(line);
    if (found.contains("class")) {
      CHECK(found["class"]["cycle"] == true);
      CHECK(found["class"]["zero"] == false);
    }
  }
}

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "engine/engine.hpp"
#include "replay/script/script.hpp"
#include "tests/support/captured.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_file.hpp"
#include "tests/tools/mesh_support.hpp"
#include "tools/commands/commands.hpp"
#include "tools/mesh/script.hpp"
#include "tools/mesh/validity.hpp"

namespace sesame::tools {

namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using nlohmann::json;
using tests::Captured;

struct Run {
  int status = 0;
  std::string out;
  std::string errors;
};

Run run(std::vector<std::string> arguments) {
  const Captured out{std::cout};
  const Captured errors{std::cerr};
  CLI::App app{"sesame"};
  Run run;
  add_mesh_command(app, run.status);
  std::reverse(arguments.begin(), arguments.end());
  arguments.emplace_back("mesh");
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError&) {
    run.status = 1;
  }
  run.out = out.text();
  run.errors = errors.text();
  return run;
}

}  // namespace

TEST_CASE("sesame mesh --json gives one object with validity, groups and generators") {
  const Run result = run({"--json", mesh_path("torus.off")});
  REQUIRE(result.status == 0);
  CHECK(result.errors.empty());
  const json object = json::parse(result.out);
  CHECK(object.at("ring") == "Z");
  CHECK(object.at("betti") == json::array({1, 2, 1}));
  CHECK(object.at("torsion") == json::parse("[[],[],[]]"));
  CHECK(object.at("euler") == 0);
  CHECK(object.at("validity").at("closed") == true);
  CHECK(object.at("validity").at("components").at(0).at("genus") == 1);
  CHECK(object.at("generators").size() == 4);
  for (const json& generator : object.at("generators")) {
    if (generator.at("dim") != 1) {
      continue;
    }
    CHECK(generator.at("closed") == true);
    CHECK(generator.at("order") == 0);
    CHECK(generator.at("length").get<double>() > 0);
    CHECK(generator.at("vertices").size() == generator.at("chain").size());
  }
}

TEST_CASE("sesame mesh --json says on which side loops bound, and where they are") {
  const json object = json::parse(run({"--json", mesh_path("torus.off")}).out);
  CHECK(object.at("validity").at("components").at(0).at("loops_sorted") == true);
  CHECK(object.at("validity").at("components").at(0).at("loops_not_sorted").is_null());
  CHECK(object.at("loops_left_out") == 0);
  const Mesh mesh = read_fixture("torus.off");
  std::multiset<std::string> sides;
  for (const json& generator : object.at("generators")) {
    if (generator.at("dim") != 1) {
      CHECK_FALSE(generator.contains("loop"));
      continue;
    }
    sides.insert(generator.at("loop"));
    CHECK(generator.at("component") == 0);
    const auto vertices = generator.at("vertices").get<std::vector<std::uint32_t>>();
    const auto& edges = generator.at("edges");
    REQUIRE(generator.at("points").size() == vertices.size());
    REQUIRE(edges.size() == vertices.size());
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      CHECK(generator.at("points").at(k) == json(mesh.points[vertices[k]]));
      CHECK(edges.at(k) == json::array({vertices[k], vertices[(k + 1) % vertices.size()], 1}));
    }
  }
  CHECK(sides == std::multiset<std::string>{"handle", "tunnel"});
}

TEST_CASE("loops of what has no inside have no side, and sesame mesh says why") {
  const json object = json::parse(run({"--json", mesh_path("moebius.off")}).out);
  CHECK(object.at("validity").at("components").at(0).at("loops_sorted") == false);
  for (const json& generator : object.at("generators")) {
    CHECK((generator.at("dim") != 1 || generator.at("loop").is_null()));
  }
  const Run text = run({mesh_path("moebius.off")});
  CHECK_THAT(text.out, Contains("no side: it is not orientable, so it has no inside"));
  CHECK_THAT(text.out, !Contains("handle, length"));
}

TEST_CASE("sesame mesh --shorter-than leaves out long loops, and says how many") {
  const json object = json::parse(run({"--json", "--shorter-than", "5", mesh_path("torus.off")}).out);
  CHECK(object.at("shorter_than") == 5);
  CHECK(object.at("loops_left_out") == 1);
  CHECK(object.at("generators").size() == 3);
  const Run text = run({"--shorter-than", "5", mesh_path("torus.off")});
  CHECK_THAT(text.out, Contains("handle, length 4.82843"));
  CHECK_THAT(text.out, !Contains("tunnel, length"));
  CHECK_THAT(text.out, Contains("Left out: 1 loop of length 5 or more"));
  CHECK(run({"--shorter-than", "0", mesh_path("torus.off")}).status == 1);
}

TEST_CASE("sesame mesh --html writes a page of the mesh, and beside standard output only") {
  const tests::TemporaryFile html{""};
  const Run result = run({"--html", html.path(), "--shorter-than", "5", mesh_path("torus.off")});
  CHECK(result.errors.empty());
  REQUIRE(result.status == 0);
  const std::string page = contents_at(html.path());
  CHECK_THAT(page, StartsWith("<!DOCTYPE html>") && Contains(R"({"kind":"mesh",)") && Contains(R"("side":"tunnel")"));
  const Run refused = run({"--html", "-", mesh_path("torus.off")});
  CHECK(refused.status == 1);
  CHECK_THAT(refused.errors, Contains("--csv and --html should name files"));
  CHECK(run({"--html", mesh_path("torus.off"), mesh_path("torus.off")}).status == 1);
}

TEST_CASE("sesame mesh writes its loops into files, as drawings and as a table") {
  const tests::TemporaryFile obj{""};
  const tests::TemporaryFile ply{""};
  const tests::TemporaryFile vtk{""};
  const tests::TemporaryFile csv{""};
  const Run result =
      run({"--obj", obj.path(), "--ply", ply.path(), "--vtk", vtk.path(), "--csv", csv.path(), mesh_path("torus.off")});
  CHECK(result.errors.empty());
  REQUIRE(result.status == 0);
  CHECK_THAT(contents_at(obj.path()), Contains("g H1_0_handle\nl ") && Contains("g H1_1_tunnel\nl "));
  CHECK_THAT(contents_at(ply.path()), Contains("property int H1_0_handle") && Contains("element vertex 9\n"));
  CHECK_THAT(contents_at(vtk.path()), Contains("SCALARS H1_1_tunnel int 1"));
  const std::string table = contents_at(csv.path());
  CHECK(std::count(table.begin(), table.end(), '\n') == 7);
  CHECK_THAT(table, StartsWith("loop,side,component,order,length,edge,from,to,times,x1,y1,z1,x2,y2,z2\n"
                               "0,handle,0,0,4.82843,0,0,1,1,"));
  CHECK_THAT(table, Contains("\n1,tunnel,0,0,10.3862,2,7,1,1,"));
  // Drawings are meshes again, with the same surface on them.
  for (const auto& [path, name] : {std::pair{obj.path(), "again.obj"}, {ply.path(), "again.ply"}}) {
    const Validity again = validate(parsed(contents_at(path), name));
    CHECK(again.components.size() == 1);
    CHECK(again.components.at(0).genus() == 1);
  }
}

TEST_CASE("the report and a drawing cannot both go to standard output") {
  const Run result = run({"--csv", "-", mesh_path("torus.off")});
  CHECK(result.status == 1);
  CHECK_THAT(result.errors, Contains("should name files"));
}

TEST_CASE("chains of sesame mesh can be asked about in the script of sesame import") {
  const json object = json::parse(run({"--json", mesh_path("torus.off")}).out);
  std::stringstream script;
  REQUIRE(write_complex_script(read_fixture("torus.off"), script, {mesh_path("torus.off")}));
  replay::ScriptReader reader{replay::ByteSource::of_text(script.view(), "script")};
  REQUIRE(reader.header());
  engine::Engine engine;
  for (auto operation = reader.next(); operation && operation->has_value(); operation = reader.next()) {
    REQUIRE(engine.apply(**operation));
  }
  for (const json& generator : object.at("generators")) {
    const auto asked = ops::parse_operation(json{{"op", "class"}, {"chain", generator.at("chain")}}.dump());
    REQUIRE(asked);
    const auto report = engine.apply(*asked);
    REQUIRE(report);
    CHECK(report->answer->is_cycle);
    CHECK_FALSE(report->answer->is_zero);
  }
}

TEST_CASE("sesame mesh tells people what they need to know") {
  const Run result = run({mesh_path("torus.off")});
  CHECK(result.status == 0);
  CHECK_THAT(result.out, Contains("H1 = Z^2"));
  CHECK_THAT(result.out, Contains("2 tunnels"));
  CHECK_THAT(result.out, Contains("1 handle"));
  CHECK_THAT(result.out, Contains("1 cavity"));
  CHECK_THAT(result.out, Contains("not unique"));
  CHECK_THAT(result.out, Contains("not a proof"));
}

TEST_CASE("numbers that no double holds are strings in the JSON, and never inf or nan anywhere") {
  const std::string size = GENERATE("1e155", "1e200", "1.7e308", "1e-200", "5e-324");
  std::string text = "OFF 4 4 0\n0 0 0\nX 0 0\n0 X 0\n0 0 -X\n3 0 1 2\n3 0 3 1\n3 0 2 3\n3 1 3 2\n";
  for (auto at = text.find('X'); at != std::string::npos; at = text.find('X')) {
    text.replace(at, 1, size);
  }
  const tests::TemporaryFile file{text};
  const Run people = run({file.path()});
  const Run programs = run({file.path(), "--json"});
  for (const Run& each : {people, programs}) {
    CHECK(each.status == 0);
    CHECK_THAT(each.out, !Contains("inf") && !Contains("nan"));
  }
  const json surface = json::parse(programs.out).at("generators").back();
  REQUIRE(surface.at("dim") == 2);
  CHECK(surface.at("area").is_string());
  CHECK(surface.at("volume").is_string());
  for (const json& x : surface.at("centre")) {
    CHECK(x.is_number());
  }
}

TEST_CASE("faces that are left out are counted on standard error and in the JSON") {
  for (const bool as_json : {false, true}) {
    const Run result = as_json ? run({mesh_path("mended.off"), "--json"}) : run({mesh_path("mended.off")});
    CHECK(result.status == 0);
    CHECK(result.errors == mesh_path("mended.off") + ": left out 2 of 6 faces (1 degenerate, 1 duplicate)\n");
    if (!as_json) {
      continue;
    }
    const json validity = json::parse(result.out).at("validity");
    CHECK(validity.at("faces_in_file") == 6);
    CHECK(validity.at("faces") == 3);
    CHECK(validity.at("degenerate_faces") == 1);
    CHECK(validity.at("duplicate_faces") == 1);
    CHECK(validity.at("segments") == 1);
    CHECK(validity.at("folded_faces") == 0);
  }
}

TEST_CASE("the option generators-limit cuts the lists and says so") {
  const Run one = run({mesh_path("torus.off"), "--generators-limit", "1"});
  CHECK_THAT(one.out, Contains("and 1 more; --generators-limit 2 shows all"));
  const Run none = run({mesh_path("torus.off"), "--generators-limit", "0"});
  CHECK_THAT(none.out, !Contains("generators of"));
  CHECK_THAT(none.out, Contains("H1 = Z^2"));
  const json object = json::parse(run({"--json", mesh_path("torus.off"), "--generators-limit", "2"}).out);
  CHECK(object.at("generators").size() == 2);
}

TEST_CASE("over a field the report names the field and warns about torsion") {
  const Run result = run({mesh_path("torus.off"), "--ring", "Z/2"});
  CHECK_THAT(result.out, Contains("homology over Z/2"));
  CHECK_THAT(result.out, Contains("(Z/2)^2"));
  CHECK_THAT(result.out, Contains("--ring Z tells them apart"));
}

TEST_CASE("wrong usage ends with 1, a wrong mesh with 2 and the place of the fault") {
  CHECK(run({"there_is_no_such.off"}).status == 1);
  CHECK(run({mesh_path("torus.off"), "--ring", "R"}).status == 1);
  CHECK(run({mesh_path("torus.off"), "--generators-limit", "-1"}).status == 1);
  CHECK(run({}).status == 1);
  const Run wrong = run({mesh_path("wrong_index.off")});
  CHECK(wrong.status == 2);
  CHECK(wrong.out.empty());
  CHECK_THAT(wrong.errors, Contains("wrong_index.off:"));
}

TEST_CASE("every mesh that can be read gets a report") {
  for (const auto& entry : std::filesystem::directory_iterator{SESAME_TEST_MESHES}) {
    const std::string path = entry.path().string();
    INFO(path);
    for (const char* ring : {"Z", "Z/2", "Z/5"}) {
      const Run result = run({path, "--ring", ring});
      CHECK((result.status == 0 ? !result.out.empty() : result.status == 2 && !result.errors.empty()));
    }
  }
}

}  // namespace sesame::tools

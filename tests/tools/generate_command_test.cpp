#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "tests/support/captured.hpp"
#include "tests/support/catch.hpp"
#include "tests/tools/command_run.hpp"
#include "tools/commands/commands.hpp"

namespace sesame::tools {
namespace {

using Catch::Matchers::Contains;

CommandRun generate(const std::string& arguments) { return run_command(add_generate_command, "generate " + arguments); }

}  // namespace

TEST_CASE("generate writes each workload in its formats", "[bench]") {
  CHECK_THAT(generate("torus --size 3 --format tower").out, Catch::Matchers::StartsWith("i 0\ni 1\ni 0 1\ni 2\n"));
  CHECK(generate("torus --size 3 --format gudhi").out.starts_with("0 0 0\n0 1 1\n1 0 1 1\n"));
  CHECK(generate("torus-300 --size 3 --format phat").out.starts_with("0\n0\n1 0 1\n"));
  CHECK(generate("random-2-complex --size 3 --format phat").out == "0\n0\n0\n1 0 1\n1 0 2\n1 1 2\n2 3 4 5\n");
  CHECK(generate("cubical --size 1").out == std::string("\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 24));
  CHECK(generate("cubical-smooth --size 2 --format phat").out.size() > 27);
  const std::string rips = generate("rips --size 4 --format phat").out;
  CHECK(std::count(rips.begin(), rips.end(), '\n') == 15);
  CHECK_THAT(rips, Catch::Matchers::StartsWith("0\n0\n0\n0\n1 ") && Contains("\n3 "));
  for (const char* name : {"tower-A", "tower-B", "tower-C", "tower-D", "tower-stream"}) {
    const std::string tower = generate(std::string{name} + " --size 50").out;
    CHECK(std::count(tower.begin(), tower.end(), '\n') == 50);
    CHECK(generate(std::string{name} + " --size 50 --seed 2").out != tower);
  }
}

TEST_CASE("generate writes constructions as scripts", "[bench]") {
  const std::string torus = generate("torus-of-polygons --size 2").out;
  CHECK_THAT(torus,
             Catch::Matchers::StartsWith("{\"sesame\":1,\"ring\":\"Z\",\"title\":\"torus-of-polygons, size 2\"}\n"
                                         "{\"op\":\"polygon\",\"name\":\"t0\",\"sides\":4}\n"));
  CHECK_THAT(torus, Contains("{\"op\":\"sew\",\"dim\":2,\"pairs\":[[\"t0:4\",\"t2:1\"]]}\n"));
  CHECK(std::count(torus.begin(), torus.end(), '\n') == 1 + 3 * 4);
  CHECK(generate("torus-of-polygons --size 2 --format script").out == torus);
  const std::string cubes = generate("menger-of-cubes --size 1").out, maps = generate("menger-of-maps --size 1").out;
  CHECK_THAT(cubes, Contains("\"op\":\"simploid\"") && Contains("\"op\":\"identify\""));
  CHECK_THAT(maps, Contains("\"op\":\"gmap\"") && Contains("{\"op\":\"sew\",\"dim\":3,"));
  CHECK(std::count(cubes.begin(), cubes.end(), '\n') == std::count(maps.begin(), maps.end(), '\n'));
  const std::string simplified = generate("menger-simplified --size 1").out;
  CHECK_THAT(simplified.substr(simplified.find('\n')), Catch::Matchers::StartsWith(maps.substr(maps.find('\n'))));
  CHECK_THAT(simplified, Contains("{\"op\":\"remove_cell\",\"cell\":\"t"));
}

TEST_CASE("generate refuses what it cannot do, and says what it can", "[bench]") {
  const auto refused = [](const std::string& arguments) {
    const CommandRun run = generate(arguments);
    CHECK(run.status == 1);
    CHECK(run.out.empty());
    return run.errors;
  };
  CHECK_THAT(refused("nothing"),
             Contains("there is no \"nothing\"") && Contains("rips, temporal-network, torus, torus-300"));
  CHECK_THAT(refused("torus --size 2"), Contains("--size of torus goes from 3 to 5000"));
  CHECK_THAT(refused("torus --size 100000"), Contains("--size of torus goes from 3 to 5000"));
  CHECK_THAT(refused("cubical --size 2 --format gudhi"), Contains("use phat-binary or phat"));
  CHECK_THAT(refused("torus --size 3 --format script"), Contains("the format script is that of constructions"));
  CHECK_THAT(refused("menger-of-maps --size 5"), Contains("--size of menger-of-maps goes from 1 to 4"));
  CHECK_THAT(refused("torus-of-polygons --format phat"), Contains("a construction has the format script only"));
  CHECK_THAT(refused("tower-A --format phat"), Contains("a tower has the format tower only"));
  CHECK_THAT(refused("torus --size 3 -o /nowhere/torus"), Contains("cannot write /nowhere/torus"));
  CHECK_THROWS_AS(generate("torus --format stl"), CLI::ParseError);
}

TEST_CASE("generate writes a file", "[bench]") {
  const std::string path = (std::filesystem::temp_directory_path() / "sesame_generate_test").string();
  const CommandRun run = generate("torus --size 3 --format phat -o " + path);
  std::stringstream written;
  written << std::ifstream(path).rdbuf();
  std::filesystem::remove(path);
  CHECK(run.status == 0);
  CHECK(run.out.empty());
  CHECK(written.str() == generate("torus --size 3 --format phat").out);
}

}  // namespace sesame::tools

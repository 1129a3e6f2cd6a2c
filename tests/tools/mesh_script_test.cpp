#include "tools/mesh/script.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/catch.hpp"
#include "tests/tools/mesh_support.hpp"

namespace sesame::tools {

namespace {

using Catch::Matchers::Contains;
using nlohmann::json;
using Cells = std::array<std::size_t, 3>;

struct Script {
  ScriptSummary summary;
  std::vector<json> lines;
  std::vector<std::string> comments;
  std::string text;
};

using Writer = Result<ScriptSummary> (*)(const Mesh&, std::ostream&, const ScriptOptions&);

Script script_of(Writer write, const Mesh& mesh, const ScriptOptions& options) {
  std::ostringstream out;
  auto summary = write(mesh, out, options);
  REQUIRE(summary);
  Script script{*summary, {}, {}, out.str()};
  std::istringstream in{script.text};
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#')) {
      script.comments.push_back(line);
    } else {
      script.lines.push_back(json::parse(line));
    }
  }
  REQUIRE(script.lines.at(0).at("sesame") == 1);
  REQUIRE(script.lines.size() == script.summary.steps + 1);
  return script;
}

/// Every face is a cell listed before, and d_i d_j = d_{j-1} d_i for i < j.
void check_face_laws(const json& cells) {
  std::map<std::string, std::vector<std::string>> faces;
  for (const auto& cell : cells) {
    auto& own = faces[cell.at("id")];
    REQUIRE(own.empty());
    if (!cell.contains("faces")) {
      continue;
    }
    own = cell.at("faces").get<std::vector<std::string>>();
    for (const auto& face : own) {
      REQUIRE(faces.contains(face));
    }
    if (own.size() < 3) {
      continue;
    }
    for (std::size_t j = 1; j < 3; ++j) {
      for (std::size_t i = 0; i < j; ++i) {
        REQUIRE(faces.at(own[j]).at(i) == faces.at(own[i]).at(j - 1));
      }
    }
  }
}

/// A plain model of assembly: cells by name, glued by union-find, whole closures at a time.
class Assembly {
 public:
  void simplex(const json& op) {
    const std::string name = op.at("name");
    const int dimension = op.at("dim");
    REQUIRE(op.at("at").size() == static_cast<std::size_t>(dimension) + 1);
    add(name, dimension);
    for (int i = 0; dimension > 0 && i <= dimension; ++i) {
      add(name + "." + std::to_string(i), 0);
      place_[name + "." + std::to_string(i)] = op.at("at").at(static_cast<std::size_t>(i));
    }
    if (dimension < 2) {
      return;
    }
    for (const char* edge : {".0-1", ".0-2", ".1-2"}) {
      add(name + edge, 1);
    }
  }

  void identify(const json& op) {
    for (const auto& pair : op.at("pairs")) {
      glue(pair.at(0), pair.at(1));
    }
  }

  /// The classes of cells in each dimension.
  Cells cells() {
    Cells count{};
    for (const auto& [name, parent] : parent_) {
      if (parent == name) {
        ++count[static_cast<std::size_t>(dimension_.at(name))];
      }
    }
    return count;
  }

  std::size_t bodies() const { return bodies_; }
  void count_body(bool glued) { bodies_ += glued ? 0 : 1; }

 private:
  void add(const std::string& name, int dimension) {
    REQUIRE_FALSE(parent_.contains(name));
    parent_[name] = name;
    dimension_[name] = dimension;
  }

  std::string find(std::string name) {
    while (parent_.at(name) != name) {
      name = parent_.at(name);
    }
    return name;
  }

  void glue(const std::string& a, const std::string& b) {
    REQUIRE(dimension_.at(a) == dimension_.at(b));
    if (dimension_.at(a) == 1) {
      glue(end_of(a, 0), end_of(b, 0));
      glue(end_of(a, 1), end_of(b, 1));
    } else {
      REQUIRE(place_.at(a) == place_.at(b));
    }
    parent_[find(a)] = find(b);
  }

  static std::string end_of(const std::string& edge, std::size_t end) {
    const auto dot = edge.find('.');
    return edge.substr(0, dot + 1) + edge[dot + 1 + 2 * end];
  }

  std::map<std::string, std::string> parent_;
  std::map<std::string, int> dimension_;
  std::map<std::string, json> place_;
  std::size_t bodies_ = 0;
};

Assembly assembled(const Script& script) {
  Assembly assembly;
  for (std::size_t i = 1; i < script.lines.size(); ++i) {
    const auto& op = script.lines[i];
    if (op.at("op") == "simplex") {
      assembly.simplex(op);
      assembly.count_body(i + 1 < script.lines.size() && script.lines[i + 1].at("op") == "identify");
    } else if (op.at("op") == "identify") {
      REQUIRE(script.lines[i - 1].at("op") == "simplex");
      assembly.identify(op);
    } else {
      REQUIRE(op.at("op") == "expect");
    }
  }
  return assembly;
}

struct Case {
  std::string file;
  Cells cells;
  std::size_t bodies;
};

const std::vector<Case> cases{{"torus.off", {9, 27, 18}, 1},    {"cube.obj", {8, 18, 12}, 1},
                              {"moebius.off", {10, 20, 10}, 1}, {"bow_tie.off", {7, 12, 8}, 1},
                              {"book.off", {6, 11, 8}, 1},      {"tetrahedron.stl", {4, 6, 4}, 1},
                              {"mended.off", {6, 9, 4}, 1}};

}  // namespace

TEST_CASE("a complex script lists each cell once, after its faces, and obeys the face laws", "[mesh]") {
  const auto order = GENERATE(BuildOrder::breadth_first, BuildOrder::as_given);
  for (const auto& [file, expected, bodies] : cases) {
    INFO(file);
    const auto script = script_of(write_complex_script, read_fixture(file), {.source = file, .order = order});
    REQUIRE(script.lines.size() == 3);
    const auto& op = script.lines[1];
    CHECK(op.at("op") == "complex");
    CHECK(op.at("name") == file.substr(0, file.find('.')));
    check_face_laws(op.at("cells"));
    Cells count{};
    for (const auto& cell : op.at("cells")) {
      ++count[cell.contains("faces") ? cell.at("faces").size() - 1 : 0];
      CHECK(cell.contains("at") != cell.contains("faces"));
    }
    CHECK(count == expected);
    CHECK(Cells{script.summary.vertices, script.summary.edges, script.summary.triangles} == expected);
    CHECK(script.lines[2].at("cells") == json(expected));
  }
}

TEST_CASE("an assembly glues up to the cells of the mesh, each component connected all along", "[mesh]") {
  for (const auto& [file, expected, bodies] : cases) {
    INFO(file);
    const auto script = script_of(write_assembled_script, read_fixture(file), {.source = file});
    auto assembly = assembled(script);
    CHECK(assembly.cells() == expected);
    CHECK(assembly.bodies() == bodies);
    const auto& expect = script.lines.back();
    CHECK(expect.at("cells") == json(expected));
    CHECK(expect.at("euler") ==
          static_cast<int>(expected[0]) - static_cast<int>(expected[1]) + static_cast<int>(expected[2]));
  }
}

TEST_CASE("an assembly in the order of the file glues up to the same cells", "[mesh]") {
  const auto polygons = GENERATE(Polygons::fan, Polygons::cone);
  for (const auto& [file, expected, bodies] : cases) {
    INFO(file);
    const ScriptOptions options{.source = file, .polygons = polygons, .order = BuildOrder::as_given, .expect = false};
    const auto script = script_of(write_assembled_script, read_fixture(file), options);
    CHECK(assembled(script).cells() == Cells{script.summary.vertices, script.summary.edges, script.summary.triangles});
    CHECK(script.lines.back().at("op") != "expect");
  }
}

TEST_CASE("the form of the scripts is the one that is documented", "[mesh]") {
  const auto mesh = parsed("OFF 4 2 0\n0 0 0\n1 0 0\n0.1 1 0\n-1e-20 -1 2.5\n3 2 0 1\n3 3 1 0\n", "two.off");
  const auto assembly = script_of(write_assembled_script, mesh, {.source = "dir/two sheets.off", .ring = "Z/2"});
  CHECK(assembly.text ==
        "{\"sesame\":1,\"ring\":\"Z/2\",\"title\":\"two_sheets\"}\n"
        "# an assembly from dir/two sheets.off\n"
        "# 4 vertices, 5 edges, 2 triangles; they are counted from 0\n"
        "{\"op\":\"simplex\",\"name\":\"f0\",\"dim\":2,\"at\":[[0,0,0],[1,0,0],[0.1,1,0]]}\n"
        "{\"op\":\"simplex\",\"name\":\"f1\",\"dim\":2,\"at\":[[0,0,0],[1,0,0],[-1e-20,-1,2.5]]}\n"
        "{\"op\":\"identify\",\"pairs\":[[\"f1.0-1\",\"f0.0-1\"]]}\n"
        "{\"op\":\"expect\",\"cells\":[4,5,2],\"euler\":1}\n");
  const auto complex = script_of(write_complex_script, mesh, {.source = "", .expect = false});
  CHECK(
      complex.text ==
      "{\"sesame\":1,\"ring\":\"Z\",\"title\":\"mesh\"}\n"
      "# a complex\n"
      "# 4 vertices, 5 edges, 2 triangles; they are counted from 0\n"
      "{\"op\":\"complex\",\"name\":\"mesh\",\"cells\":[{\"id\":\"v0\",\"at\":[0,0,0]},{\"id\":\"v1\",\"at\":[1,0,0]},"
      "{\"id\":\"v2\",\"at\":[0.1,1,0]},{\"id\":\"e1-2\",\"faces\":[\"v2\",\"v1\"]},"
      "{\"id\":\"e0-2\",\"faces\":[\"v2\",\"v0\"]},{\"id\":\"e0-1\",\"faces\":[\"v1\",\"v0\"]},"
      "{\"id\":\"f0\",\"faces\":[\"e1-2\",\"e0-2\",\"e0-1\"]},{\"id\":\"v3\",\"at\":[-1e-20,-1,2.5]},"
      "{\"id\":\"e1-3\",\"faces\":[\"v3\",\"v1\"]},{\"id\":\"e0-3\",\"faces\":[\"v3\",\"v0\"]},"
      "{\"id\":\"f1\",\"faces\":[\"e1-3\",\"e0-3\",\"e0-1\"]}]}\n");
}

TEST_CASE("coherent order grows along edges, then through vertices, then to the next component", "[mesh]") {
  // Two strips that touch in point 3, a wire at point 5, and a triangle by itself; listed in a scattered order.
  const auto mesh = parsed(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nv 2 2 0\nv 9 0 0\nv 9 1 0\nv 9 2 0\nv 3 3 3\n"
      "f 1 2 3\nf 7 8 9\nf 4 5 6\nf 2 3 4\nl 6 10\n",
      "a.obj");
  const auto script = script_of(write_assembled_script, mesh, {.source = "a.obj"});
  std::vector<std::string> names;
  for (const auto& op : script.lines) {
    if (op.contains("dim")) {
      names.push_back(op.at("name"));
    }
  }
  CHECK(names == std::vector<std::string>{"f0", "f3", "f2", "l0", "f1"});
  auto assembly = assembled(script);
  CHECK(assembly.bodies() == 2);
  CHECK_THAT(script.text, Contains(R"({"op":"identify","pairs":[["f2.0","f3.2"]]})") &&
                              Contains(R"({"op":"identify","pairs":[["l0.0","f2.2"]]})"));
}

TEST_CASE("point clouds become points, and nothing is refused", "[mesh]") {
  const auto cloud = parsed("OFF 2 0 0\n0 0 0\n1 2 3\n", "a.off");
  const auto assembly = script_of(write_assembled_script, cloud, {.source = "a.off"});
  CHECK(assembly.lines.at(2) == json::parse(R"({"op":"simplex","name":"p1","dim":0,"at":[[1,2,3]]})"));
  CHECK(assembly.lines.back() == json::parse(R"({"op":"expect","cells":[2],"euler":2})"));
  const auto complex = script_of(write_complex_script, cloud, {.source = "a.off"});
  CHECK(complex.lines.at(1).at("cells").size() == 2);

  std::ostringstream out;
  CHECK_FALSE(write_complex_script(Mesh{}, out, {}));
  CHECK_FALSE(write_assembled_script(Mesh{}, out, {}));
  CHECK(out.str().empty());
}

TEST_CASE("what was changed on the way stands in the script and in the summary", "[mesh]") {
  const auto script = script_of(write_complex_script, read_fixture("mended.off"), {.source = "mended.off"});
  CHECK(script.summary.remarks.size() == 6);
  CHECK(script.comments.size() == 2 + script.summary.remarks.size());
  CHECK_THAT(script.summary.remarks.back(), Contains("fans"));
}

TEST_CASE("names of files become names of cells", "[mesh]") {
  CHECK(name_of_source("/a.b/knot 2.v1.off") == "knot_2_v1");
  CHECK(name_of_source("C:\\meshes\\torus.obj") == "torus");
  CHECK(name_of_source(".off") == "_off");
  CHECK(name_of_source("plain") == "plain");
  CHECK(name_of_source("dir/") == "mesh");
  CHECK(name_of_source("a(b|c),{d}*\"\n.stl") == "a_b_c___d____");
}

}  // namespace sesame::tools

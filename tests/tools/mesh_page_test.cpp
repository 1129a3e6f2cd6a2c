// The data of the page of a mesh, beside the mesh itself and the report.
#include <bit>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/tools/mesh_checks.hpp"
#include "tests/tools/mesh_support.hpp"
#include "tests/tools/space_shapes.hpp"
#include "tools/commands/mesh_page.hpp"
#include "tools/mesh/mesh_cells.hpp"

namespace sesame::tools {

namespace {

using nlohmann::json;

std::string bytes_of_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') {
      break;
    }
    bits = bits << 6U | static_cast<std::uint32_t>(digits.find(c));
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes += static_cast<char>(bits >> static_cast<unsigned>(count) & 0xffU);
    }
  }
  return bytes;
}

std::vector<std::uint32_t> words(const json& packed) {
  const std::string bytes = bytes_of_base64(packed.at("data"));
  const std::size_t width = packed.at("kind") == "u16" ? 2 : 4;
  std::vector<std::uint32_t> all;
  for (std::size_t at = 0; at < bytes.size(); at += width) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < width; ++k) {
      word |= std::uint32_t{static_cast<unsigned char>(bytes[at + k])} << 8 * k;
    }
    all.push_back(word);
  }
  return all;
}

/// The points of the page, in coordinates of the file.
std::vector<Point> points_of(const json& data) {
  std::vector<Point> points;
  const auto floats = words(data.at("points"));
  for (std::size_t k = 0; k < floats.size(); k += 3) {
    Point& point = points.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = std::bit_cast<float>(floats[k + i]);
      point[i] = data.at("frame").at("middle")[i].get<double>() + data.at("frame").at("scale").get<double>() * x;
    }
  }
  return points;
}

json page_of(const Mesh& mesh, MeshPageOptions options = {}) {
  options.source = "some.off";
  auto found = mesh_homology(mesh, {options.source});
  REQUIRE(found);
  return json::parse(mesh_page_data(mesh, *found, options));
}

/// Two points that nothing uses, a square, a triangle at a distance, and the square again.
Mesh with_gaps() {
  return parsed(
      "OFF\n9 3 0\n50 50 50\n0 0 0\n2 0 0\n2 2 0\n60 60 60\n0 2 0\n10 0 0\n10 1 0\n10 0 4\n4 1 2 3 5\n3 6 7 8\n4 5 3 2 "
      "1\n",
      "gaps.off");
}

}  // namespace

TEST_CASE("the page of a mesh has its points and triangles, and knows them by the numbers of the file") {
  const Mesh mesh = with_gaps();
  const json data = page_of(mesh);
  CHECK(data.at("kind") == "mesh");
  const auto numbers = words(data.at("numbers"));
  CHECK(numbers == std::vector<std::uint32_t>{1, 2, 3, 5, 6, 7, 8});
  const auto points = points_of(data);
  REQUIRE(points.size() == numbers.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(points[p][i] == Approx(mesh.points[numbers[p]][i]).margin(1e-6));
    }
  }
  CHECK(words(data.at("triangles")).size() == 9);
  CHECK(words(data.at("sides")).size() == 2 * 7);  // not the diagonal of the square
  CHECK(words(data.at("part")) == std::vector<std::uint32_t>{0, 0, 0, 0, 1, 1, 1});
  CHECK(data.at("bad_faces").at("duplicate").at(0).at("face") == 2);
  CHECK(data.at("bad_faces").at("duplicate").at(0).at("corners") == json::array({5, 3, 2, 1}));
  CHECK(data.at("components").at(1).at("box") == json::parse("[[10,0,0],[10,1,4]]"));
}

TEST_CASE("the page of a mesh has the places of what is wrong with it") {
  const json data = page_of(with_gaps());
  const auto boundary = words(data.at("places").at("boundary"));
  CHECK(boundary.size() == 2 * 7);
  CHECK(words(data.at("places").at("boundary_loop")).size() == 7);
  CHECK(data.at("boundary_loops") == 2);
  const json book =
      page_of(parsed("OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 -1 0\n3 0 1 2\n3 0 1 3\n3 1 0 4\n", "book.off"));
  CHECK(words(book.at("places").at("non_manifold_edges")) == std::vector<std::uint32_t>{0, 1});
  CHECK(words(book.at("places").at("non_manifold_vertices")) == std::vector<std::uint32_t>{0, 1});
}

TEST_CASE("the loops of a page are those of the report, along its points") {
  const Mesh mesh = read_fixture("torus.off");
  MeshPageOptions options;
  options.shorter_than = 5;
  const json data = page_of(mesh, options);
  CHECK(data.at("shorter_than") == 5);
  CHECK(data.at("loops_in_all") == 2);
  REQUIRE(data.at("loops").size() == 2);  // also the one that is not shorter
  const MeshHomology found = homology_of(mesh);
  std::size_t k = 0;
  for (const MeshGenerator* loop : of_degree(found, 1)) {
    const json& written = data.at("loops").at(k++);
    CHECK(written.at("side") == side_name(*loop->side));
    CHECK(written.at("length") == loop->length.to_double());
    REQUIRE(written.at("edges").size() == 2 * loop->edges.size());
    for (std::size_t e = 0; e < loop->edges.size(); ++e) {
      CHECK(written.at("edges")[2 * e] == loop->edges[e].vertices[0]);
    }
  }
  CHECK(data.at("surfaces").at(0).at("runs") == json::array({0, 18}));
}

TEST_CASE("what a page has no room for is counted") {
  MeshPageOptions options;
  options.limits = {.triangles = 100, .loops = 1, .edges = 1000, .surfaces = 0, .components = 0, .faces = 0};
  const json data = page_of(grid_torus(20, 6, 0.5), options);
  CHECK(data.at("triangles_in_all") == 240);
  CHECK(data.at("stride") == 3);
  CHECK(words(data.at("triangles")).size() == 240);
  CHECK(data.at("loops").size() == 1);
  CHECK(data.at("loops_in_all") == 2);
  CHECK(data.at("surfaces").empty());
  CHECK(data.at("surfaces_in_all") == 1);
  CHECK(data.at("components").empty());
  CHECK(data.at("components_in_all") == 1);
}

TEST_CASE("a page is of any mesh: of one point, of points only, of coordinates at the end of the doubles") {
  const json point = page_of(parsed("OFF\n1 0 0\n5 6 7\n", "point.off"));
  CHECK(points_of(point) == std::vector<Point>{{5, 6, 7}});
  const json large = page_of(parsed("OFF\n3 1 0\n-1.7e308 0 0\n1.7e308 0 0\n0 1.7e308 0\n3 0 1 2\n", "large.off"));
  CHECK(large.at("frame").at("scale") == 1.7e308);
  CHECK(points_of(large)[1][0] == 1.7e308);
}

}  // namespace sesame::tools

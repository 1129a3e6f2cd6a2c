#include <algorithm>
#include <sstream>

#include "tests/support/catch.hpp"
#include "tests/tools/mesh_support.hpp"
#include "tools/mesh/script.hpp"
#include "tools/mesh/validity.hpp"

namespace sesame::tools {

namespace {

struct Sample {
  std::string name;
  std::string bytes;
};

std::vector<Sample> samples() {
  std::vector<Sample> result;
  for (const char* file : {"torus.off", "cube.obj", "mended.off", "tetrahedron.ply", "tetrahedron.stl"}) {
    result.push_back({file, contents(file)});
  }
  for (const char* file : {"square_with_hole.off", "two_points_a_line.off", "colours_unannounced.off",
                           "homogeneous.off", "strips.ply", "strips_big_endian.ply", "binary_solid_longer.stl"}) {
    result.push_back({file, contents_at(std::string{SESAME_GOLDEN_MESHES} + "/" + file)});
  }
  result.push_back({"little.ply", binary_ply(false)});
  result.push_back({"big.ply", binary_ply(true)});
  result.push_back({"binary.stl", binary_stl("solid", {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}})});
  return result;
}

/// What a mesh promises, and that everything after it stands what the damage left.
void check_answer(const Result<Mesh>& mesh, const std::string& name) {
  if (!mesh) {
    REQUIRE(mesh.error().code == Errc::bad_input);
    REQUIRE(mesh.error().what.starts_with(name + ":"));
    return;
  }
  for (const auto corner : mesh->faces.corners()) {
    REQUIRE(corner < mesh->points.size());
  }
  for (const auto& line : mesh->lines) {
    REQUIRE(std::max(line[0], line[1]) < mesh->points.size());
  }
  const auto validity = validate(*mesh);
  REQUIRE(validity.vertices <= mesh->points.size());
  REQUIRE_FALSE(to_text(validity).empty());
  std::ostringstream out;
  REQUIRE(write_assembled_script(*mesh, out, {}).has_value() == !mesh->points.empty());
  REQUIRE(write_complex_script(*mesh, out, {}).has_value() == !mesh->points.empty());
}

}  // namespace

TEST_CASE("every truncation of a mesh file is answered", "[mesh][damage]") {
  for (const auto& [name, bytes] : samples()) {
    INFO(name);
    REQUIRE(parse_mesh(bytes, name));
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      INFO(size);
      check_answer(parse_mesh(std::string_view{bytes}.substr(0, size), name), name);
    }
  }
}

TEST_CASE("every change of one byte of a mesh file is answered", "[mesh][damage]") {
  for (const auto& [name, bytes] : samples()) {
    INFO(name);
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      INFO(at);
      for (const int flip : {0x01, 0x04, 0x10, 0x80, 0xff}) {
        auto damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ flip);
        check_answer(parse_mesh(damaged, name), name);
        if (flip == 0x01) {
          check_answer(parse_mesh(damaged, "noname"), "noname");
        }
      }
    }
  }
}

TEST_CASE("one format read as another is answered", "[mesh][damage]") {
  for (const auto& [name, bytes] : samples()) {
    for (const auto format : {Format::off, Format::obj, Format::ply, Format::stl}) {
      check_answer(parse_mesh(bytes, name, {.format = format, .weld = {}}), name);
    }
  }
}

}  // namespace sesame::tools

#include "tools/mesh/normalise.hpp"

#include "tests/support/catch.hpp"
#include "tests/tools/mesh_support.hpp"
#include "tools/mesh/triangulate.hpp"
#include "tools/mesh/validity.hpp"

namespace sesame::tools {

namespace {

using Catch::Matchers::Contains;
using FaceList = std::vector<std::vector<std::uint32_t>>;

/// A mesh of faces on points that are all at the origin.
Mesh mesh_of(std::size_t points, const FaceList& faces, std::vector<Edge> lines = {}) {
  Mesh mesh;
  mesh.points.resize(points);
  for (const auto& face : faces) {
    mesh.faces.push_face(face);
  }
  mesh.lines = std::move(lines);
  return mesh;
}

}  // namespace

TEST_CASE("every defect is mended as the policy says, and remarked", "[mesh]") {
  auto mesh = read_fixture("mended.off");
  const auto cleaning = normalise(mesh);
  CHECK(faces_of(mesh) == FaceList{{0, 1, 2, 3}, {1, 4, 2}, {0, 3, 2}});
  CHECK(mesh.lines == std::vector<Edge>{{4, 5}});
  CHECK(mesh.points.size() == 6);
  CHECK(mesh.points[5] == Point{3, 0, 0});
  CHECK(cleaning.shortened_faces == 1);
  CHECK(cleaning.segments == 1);
  CHECK(cleaning.unused_points == 1);
  REQUIRE(mesh.remarks.size() == 5);
  CHECK_THAT(mesh.remarks[0], Contains("took as lines 1 face") && Contains("face 5"));
  CHECK_THAT(mesh.remarks[1], Contains("shortened 1") && Contains("face 4"));
  CHECK_THAT(mesh.remarks[2], Contains("left out 1 degenerate face ") && Contains("face 3"));
  CHECK_THAT(mesh.remarks[3], Contains("left out 1 duplicate face ") && Contains("face 2"));
  CHECK_THAT(mesh.remarks[4], Contains("left out 1 point") && Contains("point 5"));
}

TEST_CASE("a clean mesh is left as it is", "[mesh]") {
  auto mesh = read_fixture("torus.off");
  const auto before = mesh;
  normalise(mesh);
  normalise(mesh);
  CHECK(faces_of(mesh) == faces_of(before));
  CHECK(mesh.points == before.points);
  CHECK(mesh.remarks.empty());
}

TEST_CASE("duplicates are faces with the same cycle of corners, not merely the same corners", "[mesh]") {
  auto mesh = mesh_of(4, {{0, 1, 2, 3}, {2, 1, 0, 3}, {0, 2, 1, 3}, {3, 0, 1, 2}, {0, 1, 2}});
  CHECK(normalise(mesh).duplicate_faces == 2);
  CHECK(faces_of(mesh) == FaceList{{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 1, 2}});
}

TEST_CASE("repeats in a row are one corner, and faces that have fewer than three then are left out", "[mesh]") {
  auto mesh = mesh_of(4, {{0, 1, 0, 2}, {0, 0, 1, 1, 2, 0}, {3, 3}, {1, 2, 2}, {3}, {}, {2, 3, 2}});
  const auto cleaning = normalise(mesh);
  CHECK(cleaning.degenerate_faces == 5);
  CHECK(cleaning.shortened_faces == 1);
  CHECK(cleaning.folded_faces == 1);
  CHECK(faces_of(mesh) == FaceList{{0, 1, 0, 2}, {0, 1, 2}});
  CHECK(mesh.points.size() == 3);
  CHECK_THAT(mesh.remarks.at(1), Contains("left out 5 degenerate faces") && Contains("face 2"));
  CHECK_THAT(mesh.remarks.at(2), Contains("kept 1 folded face") && Contains("face 0"));
}

TEST_CASE("lines that add nothing are left out", "[mesh]") {
  auto mesh = mesh_of(5, {{0, 1, 2}}, {{3, 3}, {2, 0}, {4, 3}, {3, 4}});
  CHECK(normalise(mesh).redundant_lines == 3);
  CHECK(mesh.lines == std::vector<Edge>{{4, 3}});
}

TEST_CASE("a fan has no new points, a cone one per polygon", "[mesh]") {
  auto fan = mesh_of(5, {{0, 1, 2, 3, 4}});
  triangulate(fan, Polygons::fan);
  CHECK(faces_of(fan) == FaceList{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  auto cone = read_fixture("cube.obj");
  triangulate(cone, Polygons::cone);
  CHECK(cone.points.size() == 14);
  CHECK(cone.faces.size() == 24);
  CHECK(cone.points[8] == Point{0.5, 0.5, 0});
  CHECK_THAT(cone.remarks.at(0), Contains("6 faces") && Contains("cones"));
}

TEST_CASE("triangulating keeps the topology where diagonals would meet other edges", "[mesh]") {
  // Two squares share opposite corners: a common diagonal 0-2 would close the loop between them.
  auto pillow = mesh_of(6, {{0, 1, 2, 3}, {0, 4, 2, 5}});
  triangulate(pillow, Polygons::fan);
  CHECK(faces_of(pillow) == FaceList{{0, 1, 2}, {0, 2, 3}, {4, 2, 5}, {4, 5, 0}});
  CHECK(validate(pillow).euler() == 0);

  auto crossed = mesh_of(4, {{0, 1, 2, 3}}, {{0, 2}, {1, 3}});
  triangulate(crossed, Polygons::fan);
  CHECK(crossed.points.size() == 5);
  CHECK(crossed.faces.size() == 4);
  CHECK(validate(crossed).euler() == -1);
  CHECK_THAT(crossed.remarks.at(0), Contains("as their diagonals are edges elsewhere"));
}

}  // namespace sesame::tools

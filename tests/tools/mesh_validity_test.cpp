#include "tools/mesh/validity.hpp"

#include "tests/support/catch.hpp"
#include "tests/tools/mesh_support.hpp"

namespace sesame::tools {

namespace {

using Catch::Matchers::Contains;

using Counts = std::vector<std::size_t>;
Counts cells(const Validity& validity) { return {validity.vertices, validity.edges, validity.faces}; }

Validity validity_of(std::string_view text) { return validate(parsed(text, "a.off")); }

}  // namespace

TEST_CASE("a torus of squares is a closed surface of genus 1", "[mesh]") {
  const auto torus = validate(read_fixture("torus.off"));
  CHECK(cells(torus) == Counts{9, 18, 9});
  CHECK(torus.polygons == 9);
  CHECK(torus.euler() == 0);
  CHECK(torus.is_closed());
  CHECK(torus.is_manifold());
  CHECK(torus.is_orientable());
  CHECK(torus.is_consistently_oriented());
  REQUIRE(torus.components.size() == 1);
  CHECK(torus.components[0].genus() == 1);
  CHECK_THAT(to_text(torus), Contains("a closed surface, 1 component") && Contains("genus 1"));
}

TEST_CASE("cube and tetrahedra are spheres in every format", "[mesh]") {
  const auto [file, expected] = GENERATE(table<std::string, Counts>(
      {{"cube.obj", {8, 12, 6}}, {"tetrahedron.ply", {4, 6, 4}}, {"tetrahedron.stl", {4, 6, 4}}}));
  const auto sphere = validate(read_fixture(file));
  CHECK(cells(sphere) == expected);
  CHECK(sphere.is_closed());
  CHECK(sphere.is_consistently_oriented());
  CHECK(sphere.components.at(0).genus() == 0);
}

TEST_CASE("a Moebius band is a surface that cannot be oriented, with one boundary loop", "[mesh]") {
  const auto band = validate(read_fixture("moebius.off"));
  CHECK(cells(band) == Counts{10, 20, 10});
  CHECK(band.boundary_edges == 10);
  CHECK(band.boundary_loops == 1);
  CHECK(band.is_manifold());
  CHECK_FALSE(band.is_closed());
  CHECK_FALSE(band.is_orientable());
  CHECK_FALSE(band.is_consistently_oriented());
  CHECK_FALSE(band.components.at(0).genus());
  CHECK_THAT(to_text(band), Contains("not orientable") && Contains("a surface with boundary"));
}

TEST_CASE("two tetrahedra that share a vertex are no surface there", "[mesh]") {
  const auto tie = validate(read_fixture("bow_tie.off"));
  CHECK(tie.non_manifold_vertices == 1);
  CHECK(tie.first_non_manifold_vertex == Point{0, 0, 0});
  CHECK(tie.non_manifold_edges == 0);
  CHECK(tie.components.size() == 1);
  CHECK(tie.is_closed());
  CHECK_FALSE(tie.is_manifold());
  CHECK(tie.is_orientable());
  CHECK_FALSE(tie.components[0].genus());
  CHECK_THAT(to_text(tie), Contains("non-manifold vertices 1") && Contains("not a surface"));
}

TEST_CASE("two tetrahedra that share an edge are no surface along it", "[mesh]") {
  const auto book = validate(read_fixture("book.off"));
  CHECK(cells(book) == Counts{6, 11, 8});
  CHECK(book.non_manifold_edges == 1);
  CHECK(book.first_non_manifold_edge == std::pair{Point{0, 0, 0}, Point{1, 0, 0}});
  CHECK(book.non_manifold_vertices == 2);
  CHECK(book.boundary_edges == 0);
  CHECK_FALSE(book.is_manifold());
  CHECK_THAT(to_text(book), Contains("1 on more than two faces"));
}

TEST_CASE("a turned face is found, and the surface stays orientable", "[mesh]") {
  const auto turned = validity_of("OFF 4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 2 3\n");
  CHECK(turned.is_orientable());
  CHECK(turned.reversed_edges == 1);
  CHECK_THAT(to_text(turned), Contains("disagree across 1 edge"));
}

TEST_CASE("components are judged one by one", "[mesh]") {
  const auto two = validity_of(
      "OFF 9 6 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n5 0 0\n6 0 0\n6 1 0\n5 1 0\n9 9 9\n"
      "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n3 4 5 6\n3 4 6 7\n");
  REQUIRE(two.components.size() == 2);
  CHECK(two.cleaning.unused_points == 1);
  CHECK(two.components[0].is_closed());
  CHECK(two.components[0].genus() == 0);
  CHECK_FALSE(two.components[1].is_closed());
  CHECK(two.components[1].boundary_loops == 1);
  CHECK(two.components[1].genus() == 0);
  CHECK(two.components[1].euler() == 1);
  CHECK_FALSE(two.is_closed());
  CHECK(two.is_manifold());
}

TEST_CASE("an annulus has two boundary loops and genus 0", "[mesh]") {
  const auto annulus =
      validity_of("OFF 6 3 0\n1 0 0\n0 1 0\n-1 -1 0\n2 0 0\n0 2 0\n-2 -2 0\n4 0 1 4 3\n4 1 2 5 4\n4 2 0 3 5\n");
  CHECK(annulus.boundary_loops == 2);
  CHECK(annulus.euler() == 0);
  CHECK(annulus.components.at(0).genus() == 0);
}

TEST_CASE("lines make a component less than a surface", "[mesh]") {
  const auto flag = validate(parsed("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 5\nf 1 2 3\nl 1 4\n", "a.obj"));
  CHECK(flag.lines == 1);
  CHECK(flag.edges == 4);
  CHECK(flag.non_manifold_vertices == 1);
  CHECK_FALSE(flag.is_manifold());
  const auto wire = validate(parsed("v 0 0 0\nv 1 0 0\nl 1 2\n", "a.obj"));
  CHECK(wire.non_manifold_vertices == 0);
  CHECK_FALSE(wire.is_manifold());
  CHECK_FALSE(wire.is_closed());
  CHECK_THAT(to_text(wire), Contains("lines only"));
}

TEST_CASE("point clouds and empty meshes are no surfaces", "[mesh]") {
  const auto cloud = validity_of("OFF 3 0 0\n0 0 0\n1 0 0\n1 0 0\n");
  CHECK(cells(cloud) == Counts{3, 0, 0});
  CHECK(cloud.components.size() == 3);
  CHECK_FALSE(cloud.is_manifold());
  const auto nothing = validate(Mesh{});
  CHECK(nothing.components.empty());
  CHECK_FALSE(nothing.is_manifold());
  CHECK_FALSE(nothing.is_closed());
}

TEST_CASE("what cleaning left out is in the report", "[mesh]") {
  const auto report = validate(read_fixture("mended.off"));
  CHECK(report.points_in_file == 7);
  CHECK(report.faces_in_file == 6);
  CHECK(report.cleaning.duplicate_faces == 1);
  CHECK(report.cleaning.degenerate_faces == 1);
  CHECK(report.remarks.size() == 5);
  CHECK_THAT(to_text(report), Contains("remark                left out 1 duplicate face"));
}

}  // namespace sesame::tools

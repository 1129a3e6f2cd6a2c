// Where meshes meet themselves: shapes of which it is known, and what follows for their loops. The twin in exact
// rationals is tests/scripts/self_intersections_test.py.
#include <algorithm>

#include "tests/tools/mesh_checks.hpp"
#include "tests/tools/mesh_support.hpp"
#include "tests/tools/space_shapes.hpp"
#include "tools/mesh/self_intersections.hpp"

namespace sesame::tools {

namespace {

using Catch::Matchers::Contains;

/// Two meshes as one, the second one moved.
Mesh beside(const Mesh& one, const Mesh& other, const Point& shift) {
  Mesh both;
  both.points = one.points;
  for (const Point& point : other.points) {
    both.points.push_back({point[0] + shift[0], point[1] + shift[1], point[2] + shift[2]});
  }
  for (std::size_t f = 0; f < one.faces.size(); ++f) {
    both.faces.push_face(one.faces[f]);
  }
  for (std::size_t f = 0; f < other.faces.size(); ++f) {
    std::vector<std::uint32_t> corners(other.faces[f].begin(), other.faces[f].end());
    for (std::uint32_t& corner : corners) {
      corner += static_cast<std::uint32_t>(one.points.size());
    }
    both.faces.push_face(corners);
  }
  return both;
}

}  // namespace

TEST_CASE("a surface that does not meet itself is said not to") {
  for (const Mesh& mesh : {grid_torus(40, 6, 0.5), grid_torus(12, 30, 3.5), tube_around(trefoil(120), 8, 0.3)}) {
    const SelfIntersections found = self_intersections(mesh);
    CHECK(found.is_complete);
    CHECK(found.meetings.empty());
  }
}

TEST_CASE("loops of a surface that crosses itself have no side, and the reason is said") {
  const MeshHomology found = homology_of(tube_around(trefoil(120), 8, 0.9));  // so thick that it runs through itself
  CHECK(found.meetings.crossing() > 0);
  REQUIRE(of_degree(found, 1).size() == 2);
  for (const MeshGenerator* loop : of_degree(found, 1)) {
    CHECK_FALSE(loop->side);
  }
  CHECK_THAT(found.sorting[0].why_not, Contains("meets itself: some of its faces cross"));
}

TEST_CASE("loops of surfaces that cross each other have no side, those of a third one have") {
  const Mesh torus = grid_torus(40, 6, 0.5);
  const Mesh pair = beside(torus, torus, {0.31, 0.17, 0.23});
  const MeshHomology found = homology_of(beside(pair, torus, {100, 0, 0}));
  CHECK(found.meetings.crossing() > 0);
  CHECK_THAT(found.sorting[0].why_not, Contains("meets that of component 1"));
  CHECK_THAT(found.sorting[1].why_not, Contains("meets that of component 0"));
  CHECK(found.sorting[2].is_sorted);
  const auto loops = of_degree(found, 1);
  CHECK(std::count_if(loops.begin(), loops.end(), [](const auto* loop) { return loop->side.has_value(); }) == 2);
}

TEST_CASE("surfaces that only touch keep their sides") {
  const Mesh torus = grid_torus(40, 6, 0.5);
  double low = 0;
  double high = 0;
  for (const Point& point : torus.points) {
    low = std::min(low, point[2]);
    high = std::max(high, point[2]);
  }
  const MeshHomology found = homology_of(beside(torus, torus, {0, 0, high - low}));
  CHECK_FALSE(found.meetings.meetings.empty());
  CHECK(found.meetings.crossing() == 0);
  CHECK(found.sorting[0].is_sorted);
  CHECK(found.sorting[1].is_sorted);
}

TEST_CASE("faces that meet are those of the file, and the place is on both") {
  // A face without corners enough before them, and a triangle through a square.
  const Mesh mesh = parsed(
      "OFF\n7 3 0\n0 0 0\n4 0 0\n4 4 0\n0 4 0\n1 1 -1\n3 1 -1\n2 2 3\n3 0 0 1\n4 0 1 2 3\n3 4 5 6\n", "through.off");
  const MeshHomology found = homology_of(mesh);
  REQUIRE(found.meetings.meetings.size() == 1);
  const FaceMeeting& meeting = found.meetings.meetings.front();
  CHECK(meeting.faces == std::array<std::uint32_t, 2>{1, 2});
  CHECK(meeting.crosses);
  CHECK(std::abs(meeting.place[2]) < 1e-12);
  CHECK(meeting.place[1] == Approx(1.25));
}

TEST_CASE("signs are exact where doubles are not: a fold of one last bit") {
  // Two triangles at an edge, nearly flat, and a third one that lies on one of them but for the last bit of a
  // coordinate.
  const std::string head = "OFF\n5 2 0\n0.1 0.1 0\n0.7 0.3 0\n0.2 0.9 ";
  const std::string tail = "\n0.3 0.3 0\n0.25 0.5 0\n3 0 1 2\n3 0 3 4\n";
  CHECK(self_intersections(parsed(head + "0" + tail, "flat.off")).meetings.size() == 1);
  // Lifted by 2^-60 at one corner, the small triangle is below it but for the common vertex.
  CHECK(self_intersections(parsed(head + "8.67361737988403547e-19" + tail, "lifted.off")).meetings.empty());
}

}  // namespace sesame::tools

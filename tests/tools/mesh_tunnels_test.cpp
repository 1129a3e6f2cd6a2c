#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "tests/tools/linking_numbers.hpp"
#include "tests/tools/mesh_checks.hpp"
#include "tests/tools/mesh_support.hpp"
#include "tests/tools/space_shapes.hpp"
#include "tools/mesh/loop_sorting.hpp"

namespace sesame::tools {

namespace {

std::vector<const MeshGenerator*> on_side(const MeshHomology& found, LoopSide side, std::uint32_t part = 0) {
  std::vector<const MeshGenerator*> loops;
  for (const MeshGenerator* loop : of_degree(found, 1)) {
    if (loop->side == side && loop->part == part) {
      loops.push_back(loop);
    }
  }
  return loops;
}

std::vector<WeightedSegment> weighted_edges(const MeshGenerator& loop) {
  std::vector<WeightedSegment> segments;
  for (const CycleEdge& edge : loop.edges) {
    segments.push_back({edge.points, static_cast<double>(edge.times.to_int64().value())});
  }
  return segments;
}

double linking_with(const MeshGenerator& loop, const std::vector<Point>& core) {
  return linking_number(weighted_edges(loop), segments_of(core));
}

/// What is said of every loop: its kind, its vertices.
std::multiset<std::pair<std::string, std::vector<std::uint32_t>>> kinds(const MeshHomology& found) {
  std::multiset<std::pair<std::string, std::vector<std::uint32_t>>> all;
  for (const MeshGenerator* loop : of_degree(found, 1)) {
    all.emplace(loop->side ? side_name(*loop->side) : "none", loop->vertices);
  }
  return all;
}

void check_sorted(MeshHomology& found, const std::vector<std::size_t>& genus_of_part) {
  check_basis(found, 1);
  REQUIRE(found.sorting.size() == genus_of_part.size());
  for (std::uint32_t part = 0; part < genus_of_part.size(); ++part) {
    INFO(found.sorting[part].why_not);
    CHECK(found.sorting[part].is_sorted == (genus_of_part[part] > 0));
    CHECK(on_side(found, LoopSide::handle, part).size() == genus_of_part[part]);
    CHECK(on_side(found, LoopSide::tunnel, part).size() == genus_of_part[part]);
  }
}

}  // namespace

TEST_CASE("the meridian of a torus of revolution is its handle loop, the longitude round the hole its tunnel loop") {
  MeshHomology found = homology_of(grid_torus(40, 6, 0.5));
  check_sorted(found, {1});
  const MeshGenerator& handle = *on_side(found, LoopSide::handle)[0];
  const MeshGenerator& tunnel = *on_side(found, LoopSide::tunnel)[0];
  CHECK(handle.length.to_double() == Approx(6 * 0.5));
  const auto meridian = windings(handle.vertices, 40, 6);
  const auto longitude = windings(tunnel.vertices, 40, 6);
  CHECK(meridian[0] == 0);
  CHECK(std::abs(meridian[1]) == 1);
  CHECK(std::abs(longitude[0]) == 1);
  CHECK(longitude[1] == 0);
}

TEST_CASE("a fat torus whose tunnel is the shorter one is sorted by sides and not by lengths") {
  // Radius 3.5 about a circle of radius 4: the longitude inside is 2 pi 0.5 long, the meridian 2 pi 3.5.
  MeshHomology found = homology_of(grid_torus(12, 30, 3.5));
  check_sorted(found, {1});
  const MeshGenerator& handle = *on_side(found, LoopSide::handle)[0];
  const MeshGenerator& tunnel = *on_side(found, LoopSide::tunnel)[0];
  CHECK(tunnel.length.to_double() < 4);
  CHECK(handle.length.to_double() > 15);
  CHECK(of_degree(found, 1).front() == &tunnel);
}

TEST_CASE("the tunnel loop of a knotted tube is that of a Seifert surface, however the tube is twisted") {
  const int turns = GENERATE(0, 3, -5);
  const std::vector<Point> core = trefoil(150);
  MeshHomology found = homology_of(tube_around(core, 8, 0.3, turns));
  check_sorted(found, {1});
  const MeshGenerator& handle = *on_side(found, LoopSide::handle)[0];
  const MeshGenerator& tunnel = *on_side(found, LoopSide::tunnel)[0];
  CHECK(std::abs(windings(handle.vertices, 150, 8)[0]) == 0);
  REQUIRE(tunnel.edges.size() >= 150);
  CHECK(linking_with(tunnel, core) == Approx(0).margin(1e-6));
  CHECK(std::abs(linking_with(handle, core)) == Approx(1));
}

TEST_CASE("of rings that are linked, joined to one surface or not, tunnel loops pass by both") {
  const bool joined = GENERATE(false, true);
  Cubes cubes(15);
  const std::array cores{fill_ring(cubes, {{2, 2, 5}, {10, 2, 5}, {10, 10, 5}, {2, 10, 5}}),
                         fill_ring(cubes, {{6, 6, 1}, {14, 6, 1}, {14, 6, 9}, {6, 6, 9}})};
  REQUIRE(std::abs(linking_number(cores[0], cores[1])) == Approx(1));
  if (joined) {
    cubes.fill({10, 2, 5}, {14, 2, 5});
    cubes.fill({14, 2, 5}, {14, 6, 5});
  }
  MeshHomology found = homology_of(cubes.surface());
  check_sorted(found, joined ? std::vector<std::size_t>{2} : std::vector<std::size_t>{1, 1});
  // As one surface, inside is in both; as two, each is as if it were alone.
  for (const MeshGenerator* loop : of_degree(found, 1)) {
    int around = 0;
    for (std::uint32_t k = 0; k < 2; ++k) {
      if (joined || loop->part == k) {
        around += std::abs(static_cast<int>(std::lround(linking_with(*loop, cores[k]))));
      }
    }
    CHECK(around == (loop->side == LoopSide::handle ? 1 : 0));
  }
}

TEST_CASE("a surface of genus two has two loops of each side") {
  MeshHomology found = homology_of(double_torus());
  check_sorted(found, {2});
  for (const MeshGenerator* handle : on_side(found, LoopSide::handle)) {
    CHECK(handle->vertices.size() == 5);
  }
}

TEST_CASE("moving, scaling, mirroring and turning faces round change no loop and no side") {
  std::mt19937 random{11};  // NOLINT(cert-msc51-cpp): the same cases every time
  const Mesh mesh = together(tube_around(trefoil(60), 6, 0.3, 1),
                             moved(double_torus(), {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}}, {20, 0, 0}));
  MeshHomology found = homology_of(mesh);
  check_sorted(found, {1, 2});
  const auto expected = kinds(found);
  CHECK(kinds(homology_of(turned_faces(mesh))) == expected);
  CHECK(kinds(homology_of(turned_faces(mesh, true))) == expected);
  CHECK(kinds(homology_of(moved(mesh, {Point{-1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}}, {}))) == expected);
  for (const double scale : {0x1p-600, 1.0, 0x1p300}) {
    auto rows = random_rotation(random);
    for (Point& row : rows) {
      row = {row[0] * scale, row[1] * scale, row[2] * scale};
    }
    MeshHomology other = homology_of(moved(mesh, rows, {5 * scale, -3 * scale, scale}));
    check_sorted(other, {1, 2});
    // Rounding may choose another one of loops of one length, but not another length.
    const auto loops = of_degree(found, 1);
    const auto others = of_degree(other, 1);
    for (std::size_t k = 0; k < loops.size(); ++k) {
      CHECK(others[k]->length.to_double() / scale == Approx(loops[k]->length.to_double()));
      CHECK(others[k]->side == loops[k]->side);
    }
  }
}

TEST_CASE("of nested surfaces each has its own inside") {
  const auto nested = together(tube_around(circle(40, 4), 12, 1), turned_faces(tube_around(circle(30, 4), 8, 0.4)));
  MeshHomology found = homology_of(nested);
  check_sorted(found, {1, 1});
  CHECK(on_side(found, LoopSide::handle, 0)[0]->length.to_double() == Approx(12 * 2 * std::sin(std::numbers::pi / 12)));
  CHECK(on_side(found, LoopSide::handle, 1)[0]->length.to_double() ==
        Approx(8 * 2 * 0.4 * std::sin(std::numbers::pi / 8)));
}

TEST_CASE("what is no closed orientable surface has no inside, and that is said") {
  const auto why_not = [](const Mesh& mesh) {
    const MeshHomology found = homology_of(mesh);
    for (const MeshGenerator* loop : of_degree(found, 1)) {
      CHECK_FALSE(loop->side);
    }
    REQUIRE(found.sorting.size() == 1);
    CHECK_FALSE(found.sorting[0].is_sorted);
    return found.sorting[0].why_not;
  };
  using Catch::Matchers::Contains;
  CHECK_THAT(why_not(annulus(8)), Contains("boundary"));
  CHECK_THAT(why_not(klein_bottle(12, 8)), Contains("not orientable"));
  CHECK_THAT(why_not(moore_space()), Contains("not a surface"));
  CHECK(why_not(tetrahedron()).empty());
}

TEST_CASE("a mesh of several kinds of components has its closed surfaces sorted, and the others as they are") {
  Mesh mesh = together(klein_bottle(12, 8),
                       moved(grid_torus(20, 6, 1), {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}}, {30, 0, 0}));
  mesh = together(std::move(mesh), annulus(9));
  MeshHomology found = homology_of(mesh);
  check_basis(found, 1);
  CHECK(found.sorting[1].is_sorted);
  CHECK(on_side(found, LoopSide::handle, 1).size() == 1);
  CHECK(on_side(found, LoopSide::tunnel, 1).size() == 1);
  std::map<std::uint32_t, int> loops;
  for (const MeshGenerator* loop : of_degree(found, 1)) {
    ++loops[loop->part];
  }
  CHECK(loops == std::map<std::uint32_t, int>{{0, 2}, {1, 2}, {2, 1}});
}

TEST_CASE("loops are sorted over every ring") {
  const auto ring = GENERATE("Q", "Z/2", "Z/3");
  const MeshHomology found = homology_of(tube_around(trefoil(60), 6, 0.3, 2), sparse::parse_ring(ring).value());
  CHECK(kinds(found) == kinds(homology_of(tube_around(trefoil(60), 6, 0.3, 2))));
}

TEST_CASE("triangles without area are no obstacle, and a remark says what was done") {
  // Every third triangle loses a strip along one of its sides: the middle of the side is a point of it, but not of its
  // neighbour, and a triangle without area is between the two.
  const Mesh whole = tube_around(trefoil(60), 6, 0.3, 1);
  Mesh mesh;
  mesh.points = whole.points;
  for (std::size_t f = 0; f < whole.faces.size(); ++f) {
    const std::uint32_t a = whole.faces[f][0];
    const std::uint32_t b = whole.faces[f][1];
    const std::uint32_t c = whole.faces[f][2];
    if (f % 3 != 0) {
      mesh.faces.push_face(whole.faces[f]);
      continue;
    }
    const auto middle = static_cast<std::uint32_t>(mesh.points.size());
    Point point{};
    for (std::size_t k = 0; k < 3; ++k) {
      point[k] = (mesh.points[a][k] + mesh.points[b][k]) / 2;
    }
    mesh.points.push_back(point);
    mesh.faces.push_face(std::array{a, middle, c});
    mesh.faces.push_face(std::array{middle, b, c});
    mesh.faces.push_face(std::array{a, b, middle});
  }
  MeshHomology found = homology_of(mesh);
  check_sorted(found, {1});
  CHECK(std::abs(linking_with(*on_side(found, LoopSide::tunnel)[0], trefoil(60))) == Approx(0).margin(1e-6));
  CHECK(std::abs(linking_with(*on_side(found, LoopSide::handle)[0], trefoil(60))) == Approx(1));
  REQUIRE(found.remarks.size() == 1);
  CHECK_THAT(found.remarks[0], Catch::Matchers::Contains("triangles without area"));
}

TEST_CASE("a surface whose linking numbers are not those of one with two sides is not sorted") {
  // Round an axis, an eight: each of its two lobes is inside for one side and outside for the other.
  std::vector<Point> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  constexpr std::uint32_t n = 24;
  constexpr std::uint32_t m = 18;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < m; ++j) {
      const double u = 2 * std::numbers::pi * i / n;
      const double v = 2 * std::numbers::pi * (j + 0.3) / m;
      const double r = 4 + std::sin(v) + 0.2 * std::sin(2 * v);
      points.push_back({r * std::cos(u), r * std::sin(u), std::sin(2 * v)});
      const auto at = [=](std::uint32_t di, std::uint32_t dj) { return (i + di) % n * m + (j + dj) % m; };
      triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
      triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
    }
  }
  const MeshHomology found = homology_of(mesh_of(std::move(points), triangles));
  REQUIRE(found.sorting.size() == 1);
  CHECK_FALSE(found.sorting[0].is_sorted);
  CHECK_THAT(found.sorting[0].why_not, Catch::Matchers::Contains("meets itself"));
}

}  // namespace sesame::tools

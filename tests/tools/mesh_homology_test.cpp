#include "tools/mesh/mesh_homology.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "sparse/smith.hpp"
#include "tests/support/catch.hpp"
#include "tests/tools/mesh_shapes.hpp"
#include "tests/tools/mesh_support.hpp"

namespace sesame::tools {

namespace {

using sparse::Integer;
using sparse::Integers;

MeshHomology homology_of(const Mesh& mesh, const sparse::AnyRing& ring = Integers{}) {
  auto found = mesh_homology(mesh, {"shape.off", ring, true});
  REQUIRE(found);
  return std::move(*found);
}

std::vector<const MeshGenerator*> of_degree(const MeshHomology& found, int degree) {
  std::vector<const MeshGenerator*> generators;
  for (const auto& generator : found.generators) {
    if (generator.degree == degree) {
      generators.push_back(&generator);
    }
  }
  return generators;
}

std::set<std::pair<std::uint32_t, std::uint32_t>> sides_of(const Mesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    for (std::size_t i = 0; i < face.size(); ++i) {
      sides.insert(std::minmax(face[i], face[(i + 1) % face.size()]));
    }
  }
  for (const auto& [a, b] : mesh.lines) {
    sides.insert(std::minmax(a, b));
  }
  return sides;
}

/// Closed, simple, along edges of the file, and as long as it says.
void check_loop(const Mesh& mesh, const MeshGenerator& generator) {
  const auto& loop = generator.vertices;
  REQUIRE(loop.size() >= 3);
  CHECK(std::set<std::uint32_t>(loop.begin(), loop.end()).size() == loop.size());
  CHECK(generator.chain.terms.size() == loop.size());
  const auto sides = sides_of(mesh);
  double length = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto a = loop[i];
    const auto b = loop[(i + 1) % loop.size()];
    CHECK(sides.contains(std::minmax(a, b)));
    const Point& p = mesh.points[a];
    const Point& q = mesh.points[b];
    length += std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  }
  CHECK(generator.length.to_double() == Approx(length));
}

/// The engine agrees that the generators of a degree generate: their classes are a basis, with the orders that they
/// claim.
void check_basis(MeshHomology& found, int degree) {
  const auto generators = of_degree(found, degree);
  const auto p = static_cast<std::size_t>(degree);
  const auto& torsion = found.homology.torsion.at(p);
  REQUIRE(generators.size() == torsion.size() + static_cast<std::size_t>(found.homology.betti.at(p)));
  const auto rows = static_cast<sparse::Index>(generators.size());
  sparse::Matrix<Integers> classes{Integers{}, rows, 0};
  for (const auto* generator : generators) {
    const auto answer = found.engine->classify(generator->chain);
    REQUIRE(answer.is_cycle);
    sparse::Terms<Integers> column;
    for (sparse::Index i = 0; i < rows; ++i) {
      if (!answer.coefficients[i].is_zero()) {
        column.push_back({i, answer.coefficients[i].numerator()});
      }
    }
    classes.append_column(column);
    if (!generator->order.is_zero()) {
      REQUIRE(generator->bounding);
      auto multiple = generator->chain;
      for (auto& term : multiple.terms) {
        term.coefficient *= generator->order;
      }
      CHECK(found.engine->maps().boundary(*generator->bounding).terms == multiple.terms);
    }
  }
  // Relations of the group, then the classes: together they generate everything.
  for (sparse::Index i = 0; i < torsion.size(); ++i) {
    classes.append_column(sparse::Terms<Integers>{{i, torsion[i]}});
  }
  const auto factors = sparse::invariant_factors(classes);
  CHECK(factors.size() == rows);
  CHECK(std::all_of(factors.begin(), factors.end(), [](const Integer& factor) { return factor == 1; }));
}

void check_all(const Mesh& mesh, MeshHomology& found) {
  for (int degree = 0; degree < static_cast<int>(found.homology.betti.size()); ++degree) {
    check_basis(found, degree);
  }
  for (const auto* loop : of_degree(found, 1)) {
    CHECK(loop->is_short);
    check_loop(mesh, *loop);
  }
}

/// How often a loop on grid_torus(n, m) runs along and around: no engine is asked.
std::array<int, 2> windings(const std::vector<std::uint32_t>& loop, std::uint32_t n, std::uint32_t m) {
  const auto step = [](std::uint32_t from, std::uint32_t to, std::uint32_t size) {
    const std::uint32_t forward = (to + size - from) % size;
    return forward <= 1 ? static_cast<int>(forward) : -1;
  };
  std::array<int, 2> turns{};
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto a = loop[i];
    const auto b = loop[(i + 1) % loop.size()];
    turns[0] += step(a / m, b / m, n);
    turns[1] += step(a % m, b % m, m);
  }
  return {turns[0] / static_cast<int>(n), turns[1] / static_cast<int>(m)};
}

}  // namespace

TEST_CASE("the short loops of a thin torus are a meridian with the fewest edges and a shortest longitude") {
  const Mesh mesh = grid_torus(40, 6, 0.5);
  MeshHomology found = homology_of(mesh);
  check_all(mesh, found);
  const auto loops = of_degree(found, 1);
  REQUIRE(loops.size() == 2);
  CHECK(loops[0]->vertices.size() == 6);
  CHECK(loops[0]->length.to_double() == Approx(6 * 0.5));
  const auto meridian = windings(loops[0]->vertices, 40, 6);
  const auto longitude = windings(loops[1]->vertices, 40, 6);
  CHECK(meridian[0] == 0);
  CHECK(std::abs(meridian[0] * longitude[1] - meridian[1] * longitude[0]) == 1);
  // The inner circle, j = 3, has radius 3.5.
  CHECK(loops[1]->length.to_double() == Approx(40 * 2 * 3.5 * std::sin(std::numbers::pi / 40)));
  CHECK(loops[1]->centre[0] == Approx(0).margin(1e-9));
}

TEST_CASE("each handle of a double torus gets its own two loops") {
  const Mesh mesh = double_torus();
  MeshHomology found = homology_of(mesh);
  CHECK(found.homology.betti == std::vector<std::int64_t>{1, 4, 1});
  check_all(mesh, found);
  const auto loops = of_degree(found, 1);
  CHECK(loops[0]->vertices.size() == 5);
  CHECK(loops[1]->vertices.size() == 5);
}

TEST_CASE("torsion of a Klein bottle is generated by a short loop, with the chain that twice the loop bounds") {
  const Mesh mesh = klein_bottle(20, 8);
  MeshHomology found = homology_of(mesh);
  CHECK(found.homology.betti == std::vector<std::int64_t>{1, 1, 0});
  check_all(mesh, found);
  const auto loops = of_degree(found, 1);
  REQUIRE(loops.size() == 2);
  CHECK(loops[0]->order == 2);
  CHECK(loops[0]->vertices.size() == 8);
  CHECK(loops[1]->order == 0);
}

TEST_CASE("the projective plane has a loop of order two, with three edges") {
  const Mesh mesh = projective_plane();
  MeshHomology found = homology_of(mesh);
  check_all(mesh, found);
  const auto loops = of_degree(found, 1);
  REQUIRE(loops.size() == 1);
  CHECK(loops[0]->order == 2);
  CHECK(loops[0]->vertices.size() == 3);
}

TEST_CASE("torsion of an odd prime order is shortened too") {
  const Mesh mesh = moore_space();
  MeshHomology found = homology_of(mesh);
  CHECK(found.homology.torsion.at(1) == std::vector<Integer>{3});
  check_all(mesh, found);
  const auto loops = of_degree(found, 1);
  REQUIRE(loops.size() == 1);
  CHECK(loops[0]->vertices == std::vector<std::uint32_t>{0, 1, 2});
}

TEST_CASE("torsion of different orders falls back on the generators of the engine") {
  const Mesh mesh = together(moore_space(), projective_plane());
  MeshHomology found = homology_of(mesh);
  CHECK(found.homology.torsion.at(1) == std::vector<Integer>{6});
  check_basis(found, 1);
  CHECK(of_degree(found, 1).at(0)->order == 6);
  CHECK_FALSE(of_degree(found, 1).at(0)->is_short);
}

TEST_CASE("over a field torsion and tunnels are generated by short loops alike") {
  const Mesh mesh = klein_bottle(20, 8);
  MeshHomology found = homology_of(mesh, sparse::Z2{});
  CHECK(found.homology.betti == std::vector<std::int64_t>{1, 2, 1});
  const auto loops = of_degree(found, 1);
  REQUIRE(loops.size() == 2);
  std::vector<std::vector<sparse::Rational>> classes;
  for (const auto* loop : loops) {
    check_loop(mesh, *loop);
    classes.push_back(found.engine->classify(loop->chain).coefficients);
  }
  CHECK((classes[0][0] * classes[1][1] - classes[0][1] * classes[1][0]).numerator().modulo(2) == 1);
  CHECK_FALSE(of_degree(found, 2).at(0)->volume);

  MeshHomology over_three = homology_of(moore_space(), *sparse::parse_ring("Z/3"));
  CHECK(over_three.homology.betti == std::vector<std::int64_t>{1, 1, 1});
  REQUIRE(of_degree(over_three, 1).size() == 1);
  CHECK_FALSE(over_three.engine->classify(of_degree(over_three, 1)[0]->chain).is_zero);
}

TEST_CASE("over Q a mesh has the tunnels and the cavities that it has over Z, and no torsion") {
  const Mesh bottle = klein_bottle(20, 8);
  MeshHomology found = homology_of(bottle, sparse::Rationals{});
  CHECK(found.homology.betti == std::vector<std::int64_t>{1, 1, 0});
  CHECK(found.homology.torsion == std::vector<std::vector<Integer>>(3));
  CHECK(sparse::ring_name(found.ring) == "Q");
  const auto loops = of_degree(found, 1);
  REQUIRE(loops.size() == 1);
  check_loop(bottle, *loops[0]);
  CHECK(loops[0]->order.is_zero());
  // It is of infinite order, which no multiple of a torsion loop is.
  auto multiple = loops[0]->chain;
  for (auto& term : multiple.terms) {
    term.coefficient *= 12;
  }
  CHECK_FALSE(found.engine->classify(multiple).is_zero);

  CHECK(homology_of(moore_space(), sparse::Rationals{}).homology.betti == std::vector<std::int64_t>{1, 0, 0});
  CHECK(homology_of(moore_space(), sparse::Rationals{}).generators.size() == 1);
  CHECK(of_degree(homology_of(tetrahedron(), sparse::Rationals{}), 2).at(0)->volume.value().to_double() ==
        Approx(8.0 / 3));
}

TEST_CASE("an annulus has its inner circle") {
  const Mesh mesh = annulus(12);
  MeshHomology found = homology_of(mesh);
  check_all(mesh, found);
  const auto loops = of_degree(found, 1);
  REQUIRE(loops.size() == 1);
  CHECK(loops[0]->length.to_double() == Approx(24 * std::sin(std::numbers::pi / 12)));
  CHECK(loops[0]->box[1][0] == Approx(1));
}

TEST_CASE("closed surfaces are summed up, one per component") {
  MeshHomology found = homology_of(together(tetrahedron(), tetrahedron(1e6)));
  CHECK(found.homology.betti == std::vector<std::int64_t>{2, 0, 2});
  check_basis(found, 0);
  check_basis(found, 2);
  const auto surfaces = of_degree(found, 2);
  CHECK(surfaces[0]->triangles == 4);
  CHECK(surfaces[0]->volume.value().to_double() == Approx(8.0 / 3));
  CHECK(surfaces[1]->volume.value().to_double() == Approx(8.0 / 3));
  CHECK(surfaces[1]->centre[0] == Approx(1e6));
  CHECK(surfaces[1]->area.to_double() == Approx(8 * std::sqrt(3)));
}

TEST_CASE("a surface whose faces point inwards encloses a negative volume") {
  Mesh mesh = tetrahedron();
  Mesh inside_out;
  inside_out.points = mesh.points;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    inside_out.faces.push_face(std::array{face[0], face[2], face[1]});
  }
  CHECK(of_degree(homology_of(inside_out), 2).at(0)->volume.value().to_double() == Approx(-8.0 / 3));
}

TEST_CASE("lengths, areas, volumes and centres hold for coordinates of every size that a double can have") {
  const int exponent = GENERATE(-1000, -600, 510, 520, 1020);
  const auto grown = [exponent](Mesh mesh) {
    for (Point& point : mesh.points) {
      point = scaled(point, exponent);
    }
    return mesh;
  };
  const auto check_same = [](const Measure& measure, double as_small, int shift) {
    CHECK(measure.value == Approx(std::ldexp(as_small, shift - measure.exponent)));
  };
  const MeshHomology small = homology_of(grid_torus(24, 6, 1));
  const MeshHomology large = homology_of(grown(grid_torus(24, 6, 1)));
  REQUIRE(small.generators.size() == large.generators.size());
  for (std::size_t i = 0; i < small.generators.size(); ++i) {
    const MeshGenerator& expected = small.generators[i];
    const MeshGenerator& found = large.generators[i];
    CHECK(found.vertices == expected.vertices);
    check_same(found.length, expected.length.to_double(), exponent);
    check_same(found.area, expected.area.to_double(), 2 * exponent);
    if (expected.volume) {
      check_same(found.volume.value(), expected.volume->to_double(), 3 * exponent);
    }
    const Point centre = scaled(found.centre, -exponent);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(centre[k] == Approx(expected.centre[k]).margin(1e-12));
    }
  }
}

TEST_CASE("the largest doubles have a centre between them") {
  constexpr double most = std::numeric_limits<double>::max();
  const MeshHomology found = homology_of(mesh_of({{-most, 0, 0}, {most, 0, 0}, {most, most, 0}, {-most, most, most}},
                                                 {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}));
  for (const MeshGenerator& generator : found.generators) {
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(generator.centre[k] >= generator.box[0][k]);
      CHECK(generator.centre[k] <= generator.box[1][k]);
    }
  }
  CHECK(to_text(of_degree(found, 2).at(0)->area).ends_with("e+617"));
}

TEST_CASE("numbers beyond the doubles are written out like any other") {
  CHECK(to_text(Measure{0.75, 1}) == "1.5");
  CHECK(to_text(Measure{0, 5000}) == "0");
  CHECK(to_text(Measure{1, 2000}) == "1.14813e+602");
  CHECK(to_text(Measure{-1, 2000}) == "-1.14813e+602");
  CHECK(to_text(Measure{1, -2000}) == "8.70981e-603");
  CHECK(to_text(Measure{1e300, 0}) == "1e+300");
  CHECK(to_text(Measure{9.9999999e200, 664}) == "7.65451e+400");
  CHECK(to_text(Measure{1e200, 700}) == "5.26014e+410");
}

TEST_CASE("a concave polygon has its own area and centre, not those of the triangles that it is cut into") {
  // A prism over an arrowhead: the fan from its first corner turns a triangle over.
  Mesh mesh;
  for (const double z : {0.0, 1.0}) {
    mesh.points.insert(mesh.points.end(), {{4, 0, z}, {0, 3, z}, {1, 0, z}, {0, -3, z}});
  }
  mesh.faces.push_face(std::array{3U, 2U, 1U, 0U});
  mesh.faces.push_face(std::array{4U, 5U, 6U, 7U});
  for (std::uint32_t k = 0; k < 4; ++k) {
    mesh.faces.push_face(std::array{k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k});
  }
  const MeshHomology found = homology_of(mesh);
  const auto& surface = *of_degree(found, 2).at(0);
  const double walls = 2 * 5 + 2 * std::sqrt(10);
  CHECK(surface.area.to_double() == Approx(2 * 9 + walls));
  CHECK(surface.volume.value().to_double() == Approx(9));
  CHECK(surface.centre[0] ==
        Approx((2 * 9 * (4.0 + 0 + 1) / 3 + 2 * 5 * 2.0 + 2 * std::sqrt(10) * 0.5) / (18 + walls)));
}

TEST_CASE("a point cloud has a component per point and nothing else") {
  const MeshHomology found = homology_of(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}));
  CHECK(found.homology.betti == std::vector<std::int64_t>{3});
  REQUIRE(found.generators.size() == 3);
  CHECK(found.generators[2].vertices == std::vector<std::uint32_t>{2});
}

TEST_CASE("loops follow the sides of polygons and have the numbers of the file, though points are left out") {
  Mesh mesh;
  mesh.points = {{9, 9, 9}, {0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0},
                 {8, 8, 8}, {1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}};
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t next = (k + 1) % 4;
    mesh.faces.push_face(std::array{1 + k, 1 + next, 6 + next, 6 + k});
  }
  MeshHomology found = homology_of(mesh);
  check_all(mesh, found);
  CHECK(of_degree(found, 1).at(0)->vertices == std::vector<std::uint32_t>{6, 7, 8, 9});
  CHECK(of_degree(found, 0).at(0)->vertices == std::vector<std::uint32_t>{1});
}

TEST_CASE("lines without faces make tunnels") {
  const Mesh mesh = parsed("v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3 1\n", "lines.obj");
  MeshHomology found = homology_of(mesh);
  CHECK(found.homology.betti == std::vector<std::int64_t>{1, 1});
  check_all(mesh, found);
}

TEST_CASE("non-manifold input has homology like any other") {
  const Mesh mesh = read_fixture("book.off");
  MeshHomology found = homology_of(mesh);
  check_all(mesh, found);
  CHECK_FALSE(found.validity.is_manifold());
}

TEST_CASE("a mesh without points is refused") {
  const auto found = mesh_homology(Mesh{}, {"nothing.off", Integers{}, true});
  REQUIRE_FALSE(found);
  CHECK(found.error().code == Errc::bad_input);
}

}  // namespace sesame::tools

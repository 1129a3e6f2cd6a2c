#include "tools/mesh/linking_form.hpp"

#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "tests/support/catch.hpp"
#include "tests/tools/linking_numbers.hpp"
#include "tests/tools/space_shapes.hpp"
#include "tools/mesh/measure.hpp"
#include "tools/mesh/normalise.hpp"
#include "tools/mesh/space_triangles.hpp"
#include "tools/mesh/validity.hpp"

namespace sesame::tools {

namespace {

using sparse::Index;

/// A surface of one part, cut, with its linking form.
struct CutSurface {
  explicit CutSurface(Mesh mesh_of_surface) : mesh{std::move(mesh_of_surface)} {
    normalise(mesh);
    points = within_one(mesh.points);
    incidence = incidence_of(mesh);
    const ExactSigns signs(points);
    const EdgeGraph graph(points, incidence.edges);
    std::vector<std::uint32_t> edges(incidence.edges.size());
    std::iota(edges.begin(), edges.end(), 0U);
    std::string why_not;
    auto cut = SurfaceCutter(mesh, incidence, graph, signs, points).cut(edges, why_not);
    INFO(why_not);
    REQUIRE(cut);
    system = std::move(*cut);
    form = linking_form(system, incidence.edges, signs);
    REQUIRE(form.obstacle.empty());
  }

  Mesh mesh;
  std::vector<Point> points;
  Incidence incidence;
  CutSystem system;
  LinkingForm form;
};

std::vector<WeightedSegment> loop_along(const CutSurface& surface, Index i) {
  std::vector<WeightedSegment> segments;
  for (const auto& [edge, direction] : surface.system.loops[i]) {
    const auto [low, high] = surface.incidence.edges[edge];
    segments.push_back({{surface.points[low], surface.points[high]}, static_cast<double>(direction)});
  }
  return segments;
}

Point between(const std::vector<Point>& points) {
  Point sum{};
  for (const Point& p : points) {
    for (std::size_t k = 0; k < 3; ++k) {
      sum[k] += p[k] / static_cast<double>(points.size());
    }
  }
  return sum;
}

/// y_j, moved by a distance along the normals: positive is outwards.
std::vector<WeightedSegment> loop_across(const CutSurface& surface, Index j, double distance) {
  std::map<Edge, Point> normal_of_side;
  const auto side = [](const SpaceTriangle& t, std::size_t k) {
    return Edge{std::min(t.points[k], t.points[(k + 1) % 3]), std::max(t.points[k], t.points[(k + 1) % 3])};
  };
  const auto normal = [&](const SpaceTriangle& t) {
    const auto& p = surface.points;
    return unit_vector(cross(minus(p[t.points[1]], p[t.points[0]]), minus(p[t.points[2]], p[t.points[0]])));
  };
  for (const SpaceTriangle& triangle : surface.system.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      Point& sum = normal_of_side[side(triangle, k)];
      const Point n = normal(triangle);
      sum = {sum[0] + n[0], sum[1] + n[1], sum[2] + n[2]};
    }
  }
  std::vector<WeightedSegment> segments;
  for (const SpaceTriangle& triangle : surface.system.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto* term = sparse::find_term<sparse::Integers>(triangle.outflow[k], j);
      if (term == nullptr) {
        continue;
      }
      const auto& p = surface.points;
      const Point n = unit_vector(normal_of_side.at(side(triangle, k)));
      Point to = between({p[triangle.points[k]], p[triangle.points[(k + 1) % 3]]});
      to = {to[0] + distance * n[0], to[1] + distance * n[1], to[2] + distance * n[2]};
      const Point from = between({p[triangle.points[0]], p[triangle.points[1]], p[triangle.points[2]]});
      segments.push_back({{from, to}, static_cast<double>(term->coefficient.to_int64().value())});
    }
  }
  return segments;
}

/// How often x_i and y_j cross, by the edges.
std::int64_t crossings(const CutSurface& surface, Index i, Index j) {
  std::int64_t sum = 0;
  for (const auto& [edge, direction] : surface.system.loops[i]) {
    for (const auto& [crossed, times] : surface.system.crossings) {
      const auto* term = sparse::find_term<sparse::Integers>(times, j);
      if (crossed == edge && term != nullptr) {
        sum += direction * term->coefficient.to_int64().value();
      }
    }
  }
  return sum;
}

void check_against_integral(const CutSurface& surface, double distance) {
  const Index rank = surface.system.rank;
  for (Index i = 0; i < rank; ++i) {
    for (Index j = 0; j < rank; ++j) {
      const auto exact = static_cast<double>(surface.form(i, j));
      const double meeting = i == j ? 1 : 0;
      CHECK(crossings(surface, i, j) == static_cast<std::int64_t>(meeting));
      const auto along = loop_along(surface, i);
      CHECK(linking_number(along, loop_across(surface, j, distance)) == Approx(exact).margin(1e-6));
      CHECK(linking_number(along, loop_across(surface, j, -distance)) == Approx(exact - meeting).margin(1e-6));
    }
  }
}

}  // namespace

TEST_CASE("linking numbers of loops and of those beside them are integrals of Gauss, on either side") {
  check_against_integral(CutSurface(grid_torus(14, 7, 1)), 1e-4);
  check_against_integral(CutSurface(tube_around(trefoil(60), 6, 0.3, 2)), 1e-4);
  check_against_integral(CutSurface(turned_faces(tube_around(trefoil(40), 5, 0.3), true)), 1e-4);
  check_against_integral(CutSurface(double_torus()), 1e-4);
}

TEST_CASE("linking numbers on a lattice, where much is on one line or in one plane, are those of the integral") {
  std::mt19937 random{3};  // NOLINT(cert-msc51-cpp): the same cases every time
  int compared = 0;
  for (int round = 0; round < 100 && compared < 8; ++round) {
    const Mesh mesh = random_cubes(4, 200, random).surface();
    const Validity validity = validate(mesh);
    if (validity.components.size() == 1 && validity.components[0].genus().value() > 0) {
      check_against_integral(CutSurface(mesh), 1e-4);
      ++compared;
    }
  }
  CHECK(compared == 8);
}

TEST_CASE("signs of determinants are those of exact numbers where doubles round") {
  // Three points on a line through numbers that have no short form, and one that is off it by the last bit.
  const std::vector<Point> points{
      {0.1, 0.1, 0.1}, {0.3, 0.3, 0.3}, {0.7, 0.7, 0.7}, {0.7, std::nextafter(0.7, 1), 0.7}};
  const ExactSigns signs(points);
  const auto at = [](std::uint32_t v) { return MeanPoint::vertex(v); };
  const Direction d{5, 11, -3};
  CHECK(signs.turn(at(0), at(1), at(2), d) == 0);
  CHECK(signs.turn(at(0), at(1), at(3), d) == -signs.turn(at(1), at(0), at(3), d));
  CHECK(signs.turn(at(0), at(1), at(3), d) != 0);
  CHECK(signs.side(at(0), at(1), at(2), at(3)) == 0);
  CHECK(signs.turn(MeanPoint::middle(0, 1), at(0), MeanPoint::middle({0, 1, 2}), d) == 0);
}

TEST_CASE("concave polygons are cut into triangles that lie in them") {
  const std::vector<Point> points{{0, 0, 1}, {4, 0, 1}, {4, 4, 1}, {2, 1, 1}, {0, 4, 1}};
  for (std::uint32_t first = 0; first < 5; ++first) {
    std::vector<std::uint32_t> polygon;
    for (std::uint32_t k = 0; k < 5; ++k) {
      polygon.push_back((first + k) % 5);
    }
    double area = 0;
    for (const auto& [a, b, c] : cut_in_space(points, polygon)) {
      const Point normal =
          cross(minus(points[polygon[b]], points[polygon[a]]), minus(points[polygon[c]], points[polygon[a]]));
      CHECK(normal[2] > 0);
      area += normal[2] / 2;
    }
    CHECK(area == Approx(16 - 6));
  }
}

}  // namespace sesame::tools

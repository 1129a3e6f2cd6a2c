#include "tools/mesh/chain_measures.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "tools/mesh/geometry.hpp"

namespace sesame::tools {

namespace {

/// The length of a vector along another; its own length when the other is nothing, but for rounding.
double part(const Point& normal, const Point& whole) {
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  const double length_of_whole = std::hypot(whole[0], whole[1], whole[2]);
  return length_of_whole > 1e-9 * length ? dot(normal, whole) / length_of_whole : length;
}

/// The mean, which was computed scaled by 2^-exponent; where all weights are zero, the middle of the box.
void place_centre(MeshGenerator& generator, const Point& moment, double weight, int exponent) {
  const auto& [low, high] = generator.box;
  for (std::size_t i = 0; i < 3; ++i) {
    const double mean = std::ldexp(moment[i] / weight, exponent);
    generator.centre[i] = weight > 0 ? std::clamp(mean, low[i], high[i]) : std::midpoint(low[i], high[i]);
  }
}

}  // namespace

sparse::Integer minus_one(const sparse::AnyRing& ring) {
  return std::visit([](const auto& r) { return r.to_integer(r.from(std::int64_t{-1})); }, ring);
}

bool has_signs(const sparse::AnyRing& ring) {
  return std::holds_alternative<sparse::Integers>(ring) || std::holds_alternative<sparse::Rationals>(ring);
}

void ChainMeasures::measure_cycle(MeshGenerator& generator) const {
  generator.box = empty_box();
  for (const auto& term : generator.chain.terms) {
    for (const auto end : cells_.ends(term.generator)) {
      extend(generator.box, triangles().points[end]);
    }
  }
  const int exponent = binary_exponent(generator.box);
  double length = 0;
  Point moment{};
  for (const auto& [coefficient, edge] : generator.chain.terms) {
    const auto [a, b] = cells_.ends(edge);
    const Point p = scaled(triangles().points[a], -exponent);
    const Point q = scaled(triangles().points[b], -exponent);
    const double weight = times(coefficient) * std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
    length += weight;
    for (std::size_t i = 0; i < 3; ++i) {
      moment[i] += weight * std::midpoint(p[i], q[i]);
    }
  }
  generator.length = {length, exponent};
  place_centre(generator, moment, length, exponent);
}

/// How often a cell is in a chain; over Z/p, a coefficient and its negative count alike.
double ChainMeasures::times(const sparse::Rational& coefficient) const {
  const sparse::Rational size = sparse::abs(coefficient == minus_one(ring_) ? sparse::Rational{1} : coefficient);
  return static_cast<double>(size.to_int64().value_or(std::numeric_limits<std::int64_t>::max()));
}

void ChainMeasures::measure_surface(MeshGenerator& generator) const {
  generator.box = empty_box();
  for (const auto& term : generator.chain.terms) {
    for (const auto corner : cells_.corners(term.generator)) {
      extend(generator.box, triangles().points[corner]);
    }
  }
  measure_area(generator);
  if (has_signs(ring_)) {
    generator.volume = volume(generator);
  }
}

/// Triangles of a concave polygon overlap, some of them turned over: each counts by its part of the area vector of
/// the whole polygon.
void ChainMeasures::measure_area(MeshGenerator& generator) const {
  const int exponent = binary_exponent(generator.box);
  std::unordered_map<std::uint32_t, Point> normal_of_face;
  for (const auto& term : generator.chain.terms) {
    const auto t = cells_.triangle(term.generator);
    Point& sum = normal_of_face[cells_.mesh().face_of_triangle[t]];
    const Point normal = normal_of(t, generator.box[0], exponent);
    for (std::size_t i = 0; i < 3; ++i) {
      sum[i] += normal[i];
    }
  }
  double area = 0;
  Point moment{};
  for (const auto& term : generator.chain.terms) {
    const auto t = cells_.triangle(term.generator);
    const Point normal = normal_of(t, generator.box[0], exponent);
    const double weight =
        times(term.coefficient) * part(normal, normal_of_face.at(cells_.mesh().face_of_triangle[t])) / 2;
    area += weight;
    for (const Point& corner : corners_from(generator.box[0], triangles().faces[t], exponent)) {
      for (std::size_t i = 0; i < 3; ++i) {
        moment[i] += weight * corner[i] / 3;
      }
    }
  }
  const Point origin = scaled(generator.box[0], -exponent);
  for (std::size_t i = 0; i < 3; ++i) {
    moment[i] += area * origin[i];
  }
  generator.area = {area, 2 * exponent};
  place_centre(generator, moment, area, exponent);
}

/// About the lowest corner of the box: far from the origin, volumes about the origin cancel badly.
Measure ChainMeasures::volume(const MeshGenerator& generator) const {
  const int exponent = binary_exponent(generator.box);
  double volume = 0;
  for (const auto& [coefficient, triangle] : generator.chain.terms) {
    const auto [a, b, c] = corners_from(generator.box[0], cells_.corners(triangle), exponent);
    volume += times(coefficient) * coefficient.sign() * dot(a, cross(b, c)) / 6;
  }
  return {volume, 3 * exponent};
}

/// Twice the area vector of a triangle, scaled by 2^-exponent.
Point ChainMeasures::normal_of(std::uint32_t triangle, const Point& origin, int exponent) const {
  const auto [a, b, c] = corners_from(origin, triangles().faces[triangle], exponent);
  return cross(minus(b, a), minus(c, a));
}

/// The corners as seen from a point, all scaled by 2^-exponent.
std::array<Point, 3> ChainMeasures::corners_from(const Point& origin, std::span<const std::uint32_t> corners,
                                                 int exponent) const {
  std::array<Point, 3> result{};
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = minus(scaled(triangles().points[corners[i]], -exponent), scaled(origin, -exponent));
  }
  return result;
}

}  // namespace sesame::tools

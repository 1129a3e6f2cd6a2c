#include "tools/mesh/exact_signs.hpp"

#include <algorithm>
#include <cmath>

#include "tools/mesh/geometry.hpp"

namespace sesame::tools {

namespace {

using sparse::Integer;
using Vector = std::array<Integer, 3>;

Integer determinant(const Vector& u, const Vector& v, const Vector& w) {
  return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

Vector as_integers(const Direction& d) { return {Integer{d[0]}, Integer{d[1]}, Integer{d[2]}}; }
Point as_doubles(const Direction& d) {
  return {static_cast<double>(d[0]), static_cast<double>(d[1]), static_cast<double>(d[2])};
}

/// The largest entry, and what a difference of points may be off by.
double size_of(const Point& v) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); }

// Sixfold points are within 6, so each coordinate is off by some 3e-15 at most, and each difference by 1e-14. The
// bounds below are those that follow for determinants, with some room: they cost a few more exact computations, no
// wrong sign.
constexpr double error_of_difference = 1e-14;

int sign(double x) { return (x > 0) - (x < 0); }

struct Odd {
  std::int64_t mantissa;
  int exponent;
};

/// x = mantissa * 2^exponent with an odd mantissa, or 0. Requires: x is finite.
Odd odd_part(double x) {
  int exponent = 0;
  auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  exponent -= 53;
  while (mantissa != 0 && mantissa % 2 == 0) {
    mantissa /= 2;
    ++exponent;
  }
  return {mantissa, exponent};
}

}  // namespace

ExactSigns::ExactSigns(std::span<const Point> points) : points_{points} {
  for (const Point& point : points) {
    for (const double x : point) {
      if (x != 0) {
        lowest_ = std::min(lowest_, odd_part(x).exponent);
      }
    }
  }
}

Point ExactSigns::sixfold(const MeanPoint& point) const {
  Point sum{};
  for (std::uint32_t k = 0; k < point.count; ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      sum[i] += points_[point.vertices[k]][i];
    }
  }
  for (double& x : sum) {
    x *= 6.0 / point.count;
  }
  return sum;
}

Integer ExactSigns::exact(double x) const {
  const Odd odd = odd_part(x);
  Integer value{odd.mantissa};
  for (int rest = odd.mantissa == 0 ? 0 : odd.exponent - lowest_; rest > 0; rest -= 60) {
    value *= Integer{std::int64_t{1} << std::min(rest, 60)};
  }
  return value;
}

/// Six times b - a, in units of 2^lowest_.
ExactSigns::Vector ExactSigns::difference(const MeanPoint& a, const MeanPoint& b) const {
  Vector result;
  for (std::size_t i = 0; i < 3; ++i) {
    Integer from;
    Integer to;
    for (std::uint32_t k = 0; k < a.count; ++k) {
      from += exact(points_[a.vertices[k]][i]);
    }
    for (std::uint32_t k = 0; k < b.count; ++k) {
      to += exact(points_[b.vertices[k]][i]);
    }
    result[i] = to * Integer{static_cast<int>(6 / b.count)} - from * Integer{static_cast<int>(6 / a.count)};
  }
  return result;
}

int ExactSigns::turn(const MeanPoint& a, const MeanPoint& b, const MeanPoint& c, const Direction& d) const {
  const Point from = sixfold(a);
  const Point u = minus(sixfold(b), from);
  const Point v = minus(sixfold(c), from);
  const Point along = as_doubles(d);
  const double value = dot(cross(u, v), along);
  const double size = std::max(size_of(u), size_of(v)) + error_of_difference;
  if (std::abs(value) > 60 * error_of_difference * size * size_of(along)) {
    return sign(value);
  }
  return determinant(difference(a, b), difference(a, c), as_integers(d)).sign();
}

int ExactSigns::turn(const MeanPoint& a, const MeanPoint& b, const Direction& w, const Direction& d) const {
  const Point normal = cross(as_doubles(w), as_doubles(d));  // exact: entries below 2^41
  const double value = dot(minus(sixfold(b), sixfold(a)), normal);
  if (std::abs(value) > 30 * error_of_difference * size_of(normal)) {
    return sign(value);
  }
  return determinant(difference(a, b), as_integers(w), as_integers(d)).sign();
}

int ExactSigns::side(const MeanPoint& a, const MeanPoint& b, const MeanPoint& c, const MeanPoint& e) const {
  const Point from = sixfold(a);
  const Point u = minus(sixfold(b), from);
  const Point v = minus(sixfold(c), from);
  const Point w = minus(sixfold(e), from);
  const double value = dot(cross(u, v), w);
  const double size = std::max({size_of(u), size_of(v), size_of(w)}) + error_of_difference;
  if (std::abs(value) > 60 * error_of_difference * size * size) {
    return sign(value);
  }
  return determinant(difference(a, b), difference(a, c), difference(a, e)).sign();
}

/// As seen from one of the corners: the volume does not depend on where it is seen from, the rounding does.
int ExactSigns::volume(std::span<const std::array<std::uint32_t, 3>> triangles) const {
  if (triangles.empty()) {
    return 0;
  }
  const MeanPoint origin = MeanPoint::vertex(triangles.front()[0]);
  const Point from = sixfold(origin);
  double sum = 0;
  double error = 0;
  for (const auto& [a, b, c] : triangles) {
    const Point u = minus(sixfold(MeanPoint::vertex(a)), from);
    const Point v = minus(sixfold(MeanPoint::vertex(b)), from);
    const Point w = minus(sixfold(MeanPoint::vertex(c)), from);
    const double size = std::max({size_of(u), size_of(v), size_of(w)}) + error_of_difference;
    sum += dot(cross(u, v), w);
    error += 60 * error_of_difference * size * size + 1e-16 * std::abs(sum);
  }
  if (std::abs(sum) > 2 * error) {
    return sign(sum);
  }
  Integer exact_sum;
  for (const auto& [a, b, c] : triangles) {
    exact_sum += determinant(difference(origin, MeanPoint::vertex(a)), difference(origin, MeanPoint::vertex(b)),
                             difference(origin, MeanPoint::vertex(c)));
  }
  return exact_sum.sign();
}

}  // namespace sesame::tools

#include "tools/mesh/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sesame::tools {

double Measure::to_double() const { return std::ldexp(value, exponent); }

bool is_less(const Measure& a, const Measure& b) {
  const int exponent = std::max(a.exponent, b.exponent);
  return std::ldexp(a.value, a.exponent - exponent) < std::ldexp(b.value, b.exponent - exponent);
}

std::string to_text(const Measure& measure) {
  const double number = measure.to_double();
  if (measure.value == 0 || std::isnormal(number)) {
    return fmt::format("{:.6g}", number);
  }
  const double decimal =
      std::log10(std::abs(measure.value)) + measure.exponent * (std::numbers::ln2 / std::numbers::ln10);
  const double power = std::floor(decimal);
  // A mantissa such as 9.9999999 is rounded to the next power of ten, as `1e+01`.
  std::string mantissa = fmt::format("{:.5e}", std::copysign(std::pow(10, decimal - power), measure.value));
  const auto split = mantissa.find('e');
  const int carry = std::stoi(mantissa.substr(split + 1));
  mantissa = fmt::format("{:g}", std::stod(mantissa.substr(0, split)));
  return fmt::format("{}e{:+}", mantissa, static_cast<int>(power) + carry);
}

int binary_exponent(std::span<const Point> points) {
  double largest = 0;
  for (const Point& point : points) {
    for (const double x : point) {
      largest = std::max(largest, std::abs(x));
    }
  }
  int exponent = 0;
  std::frexp(largest, &exponent);
  return exponent;
}

Point scaled(const Point& point, int exponent) {
  return {std::ldexp(point[0], exponent), std::ldexp(point[1], exponent), std::ldexp(point[2], exponent)};
}

std::vector<Point> within_one(std::vector<Point> points) {
  const int exponent = binary_exponent(points);
  for (Point& point : points) {
    point = scaled(point, -exponent);
  }
  return points;
}

}  // namespace sesame::tools

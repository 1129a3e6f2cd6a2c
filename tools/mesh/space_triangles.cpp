#include "tools/mesh/space_triangles.hpp"

#include <cmath>
#include <numeric>

#include "tools/mesh/geometry.hpp"

namespace sesame::tools {

namespace {

/// A polygon as seen against its area vector.
class FlatPolygon {
 public:
  FlatPolygon(std::span<const Point> points, std::span<const std::uint32_t> polygon)
      : points_{points}, polygon_{polygon} {
    for (std::uint32_t i = 1; i + 1 < polygon.size(); ++i) {
      const Point n = cross(from_first(i), from_first(i + 1));
      for (std::size_t k = 0; k < 3; ++k) {
        normal_[k] += n[k];
      }
    }
  }

  /// Twice the area of three corners, times the length of the area vector; negative when they turn the other way.
  [[nodiscard]] double area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Point& p = points_[polygon_[a]];
    return dot(cross(minus(points_[polygon_[b]], p), minus(points_[polygon_[c]], p)), normal_);
  }
  [[nodiscard]] bool is_seen() const { return dot(normal_, normal_) > 0; }

 private:
  [[nodiscard]] Point from_first(std::uint32_t corner) const {
    return minus(points_[polygon_[corner]], points_[polygon_[0]]);
  }

  std::span<const Point> points_;
  std::span<const std::uint32_t> polygon_;
  Point normal_{};
};

std::vector<CornerTriple> fan(const std::vector<std::uint32_t>& corners) {
  std::vector<CornerTriple> triangles;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    triangles.push_back({corners[0], corners[i], corners[i + 1]});
  }
  return triangles;
}

/// Whether the corner at a place among those that are left turns the right way, with none of the others in its
/// triangle.
bool is_ear(const FlatPolygon& polygon, const std::vector<std::uint32_t>& left, std::size_t place) {
  const std::uint32_t before = left[(place + left.size() - 1) % left.size()];
  const std::uint32_t here = left[place];
  const std::uint32_t after = left[(place + 1) % left.size()];
  if (polygon.area(before, here, after) <= 0) {
    return false;
  }
  for (const std::uint32_t other : left) {
    if (other != before && other != here && other != after && polygon.area(before, here, other) >= 0 &&
        polygon.area(here, after, other) >= 0 && polygon.area(after, before, other) >= 0) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::vector<CornerTriple> cut_in_space(std::span<const Point> points, std::span<const std::uint32_t> polygon) {
  std::vector<std::uint32_t> left(polygon.size());
  std::iota(left.begin(), left.end(), 0U);
  std::vector<CornerTriple> triangles = fan(left);
  const FlatPolygon flat(points, polygon);
  bool is_right = !flat.is_seen() || triangles.size() == 1;
  if (!is_right) {
    is_right = true;
    for (const auto& [a, b, c] : triangles) {
      is_right = is_right && flat.area(a, b, c) > 0;
    }
  }
  if (is_right) {
    return triangles;
  }
  triangles.clear();
  for (std::size_t place = 0; left.size() > 3 && place < left.size();) {
    if (!is_ear(flat, left, place)) {
      ++place;
      continue;
    }
    triangles.push_back({left[(place + left.size() - 1) % left.size()], left[place], left[(place + 1) % left.size()]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(place));
    place = 0;
  }
  const std::vector<CornerTriple> rest = fan(left);
  triangles.insert(triangles.end(), rest.begin(), rest.end());
  return triangles;
}

}  // namespace sesame::tools

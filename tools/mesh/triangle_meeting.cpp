#include "tools/mesh/triangle_meeting.hpp"

#include <algorithm>
#include <cmath>

#include "tools/mesh/geometry.hpp"

namespace sesame::tools {

namespace {

constexpr std::array<Direction, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// What a product of a vector with differences of points within 1 may be off by, with room.
double error_along(const Point& n) { return 1e-14 * (std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2])); }

Point unit_or_zero(const Point& v) {
  const double length = std::hypot(v[0], v[1], v[2]);
  return length > 0 ? Point{v[0] / length, v[1] / length, v[2] / length} : Point{};
}

Point plus(const Point& p, const Point& q) { return {p[0] + q[0], p[1] + q[1], p[2] + q[2]}; }

Point between(const Point& p, const Point& q, double t) {
  return {p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])};
}

bool has_both_signs(int a, int b, int c) { return std::min({a, b, c}) < 0 && std::max({a, b, c}) > 0; }

}  // namespace

TriangleContact TriangleMeeting::contact(const PointTriple& one, const PointTriple& other) const {
  std::array<std::uint32_t, 3> shared{};
  std::array<std::uint32_t, 3> rest{};
  std::size_t count = 0;
  std::size_t left = 0;
  for (const std::uint32_t point : one) {
    if (std::find(other.begin(), other.end(), point) != other.end()) {
      shared[count++] = point;
    } else {
      rest[left++] = point;
    }
  }
  if (count == 0) {
    return are_surely_apart(one, other) ? TriangleContact{} : contact_of_apart(one, other);
  }
  std::array<std::uint32_t, 3> beyond{};
  left = 0;
  for (const std::uint32_t point : other) {
    if (std::find(one.begin(), one.end(), point) == one.end()) {
      beyond[left++] = point;
    }
  }
  if (count == 1) {
    return contact_beyond_vertex(shared[0], {rest[0], rest[1]}, {beyond[0], beyond[1]});
  }
  return count == 2 ? contact_beyond_edge({shared[0], shared[1]}, rest[0], beyond[0]) : TriangleContact{};
}

/// By planes along the sides of either of them, in doubles: enough for most pairs in a flat part of a mesh, where exact
/// signs would be 0 and dear.
bool TriangleMeeting::are_surely_apart(const PointTriple& one, const PointTriple& other) const {
  const auto is_separating = [&](const Point& n) {
    const Point& origin = points_[one[0]];
    double least = 0;
    double most = 0;
    double least_other = 1e300;
    double most_other = -1e300;
    for (std::size_t k = 0; k < 3; ++k) {
      const double here = dot(n, minus(points_[one[k]], origin));
      const double there = dot(n, minus(points_[other[k]], origin));
      least = std::min(least, here);
      most = std::max(most, here);
      least_other = std::min(least_other, there);
      most_other = std::max(most_other, there);
    }
    const double error = 2 * error_along(n);
    return least_other - most > error || least - most_other > error;
  };
  for (const PointTriple& triangle : {one, other}) {
    const Point u = minus(points_[triangle[1]], points_[triangle[0]]);
    const Point normal = unit_or_zero(cross(u, minus(points_[triangle[2]], points_[triangle[0]])));
    if (is_separating(normal)) {
      return true;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (is_separating(unit_or_zero(cross(normal, minus(points_[triangle[(k + 1) % 3]], points_[triangle[k]]))))) {
        return true;
      }
    }
  }
  return false;
}

/// By the plane between the middles of both angles at the vertex.
bool TriangleMeeting::are_surely_apart_but_for(std::uint32_t apex, const Segment& one, const Segment& other) const {
  const auto way = [&](std::uint32_t point) { return minus(points_[point], points_[apex]); };
  const Point a = way(one.from);
  const Point b = way(one.to);
  const Point c = way(other.from);
  const Point d = way(other.to);
  const Point n =
      minus(unit_or_zero(plus(unit_or_zero(a), unit_or_zero(b))), unit_or_zero(plus(unit_or_zero(c), unit_or_zero(d))));
  const double error = error_along(n);
  return std::min(dot(n, a), dot(n, b)) > error && std::max(dot(n, c), dot(n, d)) < -error;
}

TriangleContact TriangleMeeting::contact_of_apart(const PointTriple& one, const PointTriple& other) const {
  TriangleContact found;
  for (std::size_t k = 0; k < 3 && found.kind != Contact::crosses; ++k) {
    for (const auto& [edges, triangle] : {std::pair{&one, &other}, std::pair{&other, &one}}) {
      const TriangleContact contact = pierce({(*edges)[k], (*edges)[(k + 1) % 3]}, *triangle);
      found = contact.kind > found.kind ? contact : found;
    }
  }
  return found;
}

/// A triangle is a cone over the edge across from a vertex. So when there is a point of both beyond it, there is one on
/// one of these edges; only a triangle without area may have the vertex itself there.
TriangleContact TriangleMeeting::contact_beyond_vertex(std::uint32_t apex, const Segment& one,
                                                       const Segment& other) const {
  if (are_surely_apart_but_for(apex, one, other)) {
    return {};
  }
  TriangleContact found;
  for (const auto& [edge, across] : {std::pair{&one, &other}, std::pair{&other, &one}}) {
    const PointTriple triangle{apex, across->from, across->to};
    if (const int from = side(apex, across->from, across->to, edge->from);
        from != 0 && from == side(apex, across->from, across->to, edge->to)) {
      return {};
    }
    if (!is_on(apex, *edge)) {
      const TriangleContact contact = pierce(*edge, triangle);
      found = contact.kind > found.kind ? contact : found;
      continue;
    }
    for (const std::uint32_t tip : {edge->from, edge->to}) {
      if (found.kind == Contact::none && !are_one_place(tip, apex) && is_on(tip, triangle)) {
        found = {Contact::touches, points_[tip]};
      }
    }
  }
  return found;
}

TriangleContact TriangleMeeting::contact_beyond_edge(const Segment& edge, std::uint32_t one,
                                                     std::uint32_t other) const {
  // Most are on both sides of the edge, and then doubles can tell: differences of points have the error of one
  // rounding.
  const Point along = minus(points_[edge.to], points_[edge.from]);
  const Point way = minus(points_[one], points_[edge.from]);
  const Point other_way = minus(points_[other], points_[edge.from]);
  const double size = dot(along, along) * std::sqrt(dot(way, way)) * std::sqrt(dot(other_way, other_way));
  if (dot(cross(along, way), cross(along, other_way)) < -1e-13 * size - 1e-290 ||
      side(edge.from, edge.to, one, other) != 0) {
    return {};
  }
  Axis axis{};
  if (find_axis({edge.from, edge.to, one}, axis)) {
    const bool is_over = turn(edge.from, edge.to, one, axis) == turn(edge.from, edge.to, other, axis);
    const Point middle = between(points_[edge.from], points_[edge.to], 0.5);
    return is_over ? TriangleContact{Contact::touches, middle} : TriangleContact{};
  }
  if (find_axis({edge.from, edge.to, other}, axis)) {
    return {};  // the one is a segment along the edge, and the other has nothing else on that line
  }
  // All on one line: who is beyond the same end of the edge, or at any place when the edge has no length?
  const PointTriple triangle{edge.from, edge.to, one};
  const PointTriple other_triangle{edge.from, edge.to, other};
  if (!is_on(other, edge) && is_on(other, triangle)) {
    return {Contact::touches, points_[other]};
  }
  return !is_on(one, edge) && is_on(one, other_triangle) ? TriangleContact{Contact::touches, points_[one]}
                                                         : TriangleContact{};
}

TriangleContact TriangleMeeting::pierce(const Segment& segment, const PointTriple& triangle) const {
  const auto [a, b, c] = triangle;
  const int from = side(a, b, c, segment.from);
  const int to = side(a, b, c, segment.to);
  if (from * to > 0) {
    return {};
  }
  const Point& p = points_[segment.from];
  const Point& q = points_[segment.to];
  if (from == 0 && to == 0) {
    TriangleContact found{Contact::touches, p};
    return meets_in_plane(segment, triangle, found.place) ? found : TriangleContact{};
  }
  const int ab = side(segment.from, segment.to, a, b);
  const int bc = side(segment.from, segment.to, b, c);
  const int ca = side(segment.from, segment.to, c, a);
  if (has_both_signs(ab, bc, ca)) {
    return {};
  }
  const Point normal = unit_or_zero(cross(minus(points_[b], points_[a]), minus(points_[c], points_[a])));
  const double height = std::abs(dot(normal, minus(p, points_[a])));
  const double other_height = std::abs(dot(normal, minus(q, points_[a])));
  const double t = height + other_height > 0 ? height / (height + other_height) : 0.5;
  const Point place = between(p, q, t);
  const bool is_inside = from != 0 && to != 0 && ab != 0 && bc != 0 && ca != 0;
  return {is_inside && is_deep(place, std::min(height, other_height), triangle) ? Contact::crosses : Contact::touches,
          place};
}

/// What is less deep may come from rounding: of coordinates, or of points that somebody put on an edge.
bool TriangleMeeting::is_deep(const Point& place, double depth, const PointTriple& triangle) const {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point& from = points_[triangle[k]];
    const Point side = minus(points_[triangle[(k + 1) % 3]], from);
    const double length = std::sqrt(dot(side, side));
    const Point across = cross(side, minus(place, from));
    longest = std::max(longest, length);
    depth = length > 0 ? std::min(depth, std::sqrt(dot(across, across)) / length) : 0;
  }
  return depth > 4e-6 * longest;
}

bool TriangleMeeting::meets_in_plane(const Segment& segment, const PointTriple& triangle, Point& place) const {
  Axis axis{};
  if (!find_axis(triangle, axis)) {
    place = points_[is_on(segment.to, hull(triangle)) ? segment.to : segment.from];
    return meet(segment, hull(triangle));
  }
  for (const std::uint32_t end : {segment.from, segment.to}) {
    if (is_in(end, triangle, axis)) {
      place = points_[end];
      return true;
    }
  }
  place = between(points_[segment.from], points_[segment.to], 0.5);
  for (std::size_t k = 0; k < 3; ++k) {
    if (meet_as_seen(segment, {triangle[k], triangle[(k + 1) % 3]}, axis)) {
      return true;
    }
  }
  return false;
}

bool TriangleMeeting::meet(const Segment& one, const Segment& other) const {
  if (side(one.from, one.to, other.from, other.to) != 0) {
    return false;
  }
  Axis axis{};
  const bool is_seen =
      find_axis({one.from, one.to, other.from}, axis) || find_axis({one.from, one.to, other.to}, axis) ||
      find_axis({other.from, other.to, one.from}, axis) || find_axis({other.from, other.to, one.to}, axis);
  return meet_as_seen(one, other, is_seen ? axis : axes[0]);
}

/// In a plane that is not seen from its side; or on one line.
bool TriangleMeeting::meet_as_seen(const Segment& one, const Segment& other, const Axis& axis) const {
  const int a = turn(one.from, one.to, other.from, axis);
  const int b = turn(one.from, one.to, other.to, axis);
  const int c = turn(other.from, other.to, one.from, axis);
  const int d = turn(other.from, other.to, one.to, axis);
  if (a != 0 || b != 0 || c != 0 || d != 0) {
    return a * b <= 0 && c * d <= 0;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [low, high] = std::minmax(points_[one.from][i], points_[one.to][i]);
    const auto [other_low, other_high] = std::minmax(points_[other.from][i], points_[other.to][i]);
    if (high < other_low || other_high < low) {
      return false;
    }
  }
  return true;
}

bool TriangleMeeting::is_in(std::uint32_t point, const PointTriple& triangle, const Axis& axis) const {
  const auto [a, b, c] = triangle;
  return !has_both_signs(turn(a, b, point, axis), turn(b, c, point, axis), turn(c, a, point, axis));
}

bool TriangleMeeting::is_on(std::uint32_t point, const PointTriple& triangle) const {
  return pierce({point, point}, triangle).kind != Contact::none;
}

bool TriangleMeeting::is_on(std::uint32_t point, const Segment& segment) const {
  Axis axis{};
  return !find_axis({segment.from, segment.to, point}, axis) && meet_as_seen({point, point}, segment, axes[0]);
}

bool TriangleMeeting::find_axis(const PointTriple& triple, Axis& axis) const {
  for (const Direction& each : axes) {
    if (turn(triple[0], triple[1], triple[2], each) != 0) {
      axis = each;
      return true;
    }
  }
  return false;
}

TriangleMeeting::Segment TriangleMeeting::hull(const PointTriple& triple) const {
  const auto [first, last] = std::minmax_element(
      triple.begin(), triple.end(), [this](std::uint32_t a, std::uint32_t b) { return points_[a] < points_[b]; });
  return {*first, *last};
}

}  // namespace sesame::tools

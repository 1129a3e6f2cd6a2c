/// \file
/// Whether two triangles in space meet beyond the vertices that they share, exactly.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "tools/mesh/exact_signs.hpp"

namespace sesame::tools {

using PointTriple = std::array<std::uint32_t, 3>;

/// How two sets have points in common.
enum class Contact {
  none,
  touches,
  crosses,  ///< an edge goes through the inside of a triangle, and some millionths of its size beyond
};

struct TriangleContact {
  Contact kind = Contact::none;
  Point place{};  ///< a point of both, but for rounding
};

/// Tests pairs of triangles, given by numbers of points: equal numbers are shared vertices, while points with different
/// numbers may be at one place.
class TriangleMeeting {
 public:
  /// Both must outlive it. `points` are those of `signs`, within 1 of 0.
  TriangleMeeting(std::span<const Point> points, const ExactSigns& signs) : points_{points}, signs_{signs} {}

  /// Triangles with the same three vertices have nothing in common beyond them.
  [[nodiscard]] TriangleContact contact(const PointTriple& one, const PointTriple& other) const;

 private:
  struct Segment {
    std::uint32_t from, to;
  };
  using Axis = Direction;

  [[nodiscard]] bool are_surely_apart(const PointTriple& one, const PointTriple& other) const;
  [[nodiscard]] bool are_surely_apart_but_for(std::uint32_t apex, const Segment& one, const Segment& other) const;
  [[nodiscard]] TriangleContact contact_of_apart(const PointTriple& one, const PointTriple& other) const;
  [[nodiscard]] TriangleContact contact_beyond_vertex(std::uint32_t apex, const Segment& one,
                                                      const Segment& other) const;
  [[nodiscard]] TriangleContact contact_beyond_edge(const Segment& edge, std::uint32_t one, std::uint32_t other) const;

  [[nodiscard]] TriangleContact pierce(const Segment& segment, const PointTriple& triangle) const;
  [[nodiscard]] bool is_deep(const Point& place, double depth, const PointTriple& triangle) const;
  [[nodiscard]] bool meets_in_plane(const Segment& segment, const PointTriple& triangle, Point& place) const;
  [[nodiscard]] bool meet(const Segment& one, const Segment& other) const;
  [[nodiscard]] bool meet_as_seen(const Segment& one, const Segment& other, const Axis& axis) const;
  [[nodiscard]] bool is_in(std::uint32_t point, const PointTriple& triangle, const Axis& axis) const;
  [[nodiscard]] bool is_on(std::uint32_t point, const PointTriple& triangle) const;
  [[nodiscard]] bool is_on(std::uint32_t point, const Segment& segment) const;
  /// An axis along which three points are seen to turn, if there is one.
  [[nodiscard]] bool find_axis(const PointTriple& triple, Axis& axis) const;
  /// The hull of three points on one line.
  [[nodiscard]] Segment hull(const PointTriple& triple) const;

  [[nodiscard]] int side(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
    return signs_.side(MeanPoint::vertex(a), MeanPoint::vertex(b), MeanPoint::vertex(c), MeanPoint::vertex(d));
  }
  [[nodiscard]] int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c, const Axis& axis) const {
    return signs_.turn(MeanPoint::vertex(a), MeanPoint::vertex(b), MeanPoint::vertex(c), axis);
  }
  [[nodiscard]] bool are_one_place(std::uint32_t a, std::uint32_t b) const { return points_[a] == points_[b]; }

  std::span<const Point> points_;
  const ExactSigns& signs_;
};

}  // namespace sesame::tools

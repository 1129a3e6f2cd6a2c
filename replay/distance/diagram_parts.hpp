/// \file
/// What the distances of persistence diagrams share: points of the plane, and matchings from their parts.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "replay/distance/diagram_distance.hpp"

namespace sesame::replay {

struct DiagramPoint {
  engine::Time birth, death;
};

[[nodiscard]] engine::Time distance(engine::Time x, engine::Time y);
[[nodiscard]] engine::Time ground_distance(const DiagramPoint& x, const DiagramPoint& y, GroundMetric ground);
[[nodiscard]] engine::Time distance_to_diagonal(const DiagramPoint& x, GroundMetric ground);

using PointId = std::uint32_t;
inline constexpr PointId no_point = std::numeric_limits<PointId>::max();

/// A diagram taken apart.
struct DiagramParts {
  explicit DiagramParts(std::span<const engine::Bar> bars);

  std::vector<DiagramPoint> points;    ///< the bars that end
  std::vector<std::size_t> places;     ///< theirs among all bars
  std::vector<std::size_t> essential;  ///< the places of the others, by birth
};

/// Partners on the right for the points of the left, such that the largest cost in the maximum metric is least. In
/// bottleneck_distance.cpp.
[[nodiscard]] std::vector<PointId> bottleneck_partners(std::span<const DiagramPoint> left,
                                                       std::span<const DiagramPoint> right);

/// The matching of all bars, when partners[i] is the point on the right of point i on the left, or no_point.
[[nodiscard]] std::vector<Match> whole_matching(std::span<const engine::Bar> left, std::span<const engine::Bar> right,
                                                const DiagramParts& left_parts, const DiagramParts& right_parts,
                                                std::span<const PointId> partners, GroundMetric ground);

}  // namespace sesame::replay

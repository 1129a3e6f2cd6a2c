#include "replay/distance/diagram_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sparse/contract.hpp"

namespace sesame::replay {

using engine::Time;

Time distance(Time x, Time y) { return x < y ? y - x : x - y; }

Time ground_distance(const DiagramPoint& x, const DiagramPoint& y, GroundMetric ground) {
  const Time across = distance(x.birth, y.birth), up = distance(x.death, y.death);
  return ground == GroundMetric::maximum ? std::max(across, up) : Time{std::hypot(across.nearest(), up.nearest())};
}

Time distance_to_diagonal(const DiagramPoint& x, GroundMetric ground) {
  const Time length = x.death - x.birth;
  const Time half = length.is_finite() ? length.half() : x.death.half() - x.birth.half();  // too long for a double
  return ground == GroundMetric::maximum ? half : Time{half.nearest() * std::numbers::sqrt2};
}

DiagramParts::DiagramParts(std::span<const engine::Bar> bars) {
  sparse::expects(bars.size() < no_point, "a diagram has fewer than 2^32 - 1 bars");
  for (std::size_t i = 0; i < bars.size(); ++i) {
    sparse::expects(bars[i].birth.is_finite() && bars[i].death >= bars[i].birth, "a bar begins, and then ends");
    if (bars[i].death == engine::never) {
      essential.push_back(i);
    } else {
      points.push_back({bars[i].birth, bars[i].death});
      places.push_back(i);
    }
  }
  std::stable_sort(essential.begin(), essential.end(),
                   [&](std::size_t x, std::size_t y) { return bars[x].birth < bars[y].birth; });
}

std::vector<Match> whole_matching(std::span<const engine::Bar> left, std::span<const engine::Bar> right,
                                  const DiagramParts& left_parts, const DiagramParts& right_parts,
                                  std::span<const PointId> partners, GroundMetric ground) {
  std::vector<Match> matching(left.size());
  std::vector<bool> is_matched(right.size());
  for (std::size_t i = 0; i < partners.size(); ++i) {
    const std::size_t place = left_parts.places[i];
    const DiagramPoint& point = left_parts.points[i];
    if (partners[i] == no_point) {
      matching[place] = {place, std::nullopt, distance_to_diagonal(point, ground)};
    } else {
      const std::size_t partner = right_parts.places[partners[i]];
      matching[place] = {place, partner, ground_distance(point, right_parts.points[partners[i]], ground)};
      is_matched[partner] = true;
    }
  }
  const std::vector<std::size_t>&ours = left_parts.essential, &theirs = right_parts.essential;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    if (i < theirs.size()) {
      matching[ours[i]] = {ours[i], theirs[i], distance(left[ours[i]].birth, right[theirs[i]].birth)};
      is_matched[theirs[i]] = true;
    } else {
      matching[ours[i]] = {ours[i], std::nullopt, engine::never};
    }
  }
  for (std::size_t j = 0; j < right.size(); ++j) {
    if (!is_matched[j]) {
      const bool is_essential = right[j].death == engine::never;
      matching.push_back(
          {std::nullopt, j,
           is_essential ? engine::never : distance_to_diagonal({right[j].birth, right[j].death}, ground)});
    }
  }
  return matching;
}

}  // namespace sesame::replay

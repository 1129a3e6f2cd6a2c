/// \file
/// Distances of persistence diagrams, exact, with the matchings that attain them.
///
/// Two bars of one dimension, or a bar and the diagonal, can be matched; a matching uses each bar once, and the
/// diagonal as often as it likes. Essential bars are matched among themselves: sorted by birth, which is best for every
/// q >= 1. With different numbers of them the distance is infinite.
///
/// Libraries were looked at before this was written: GUDHI's bottleneck distance needs CGAL's (GPL) search trees,
/// Hera's Wasserstein distance is an auction that stops at a relative error. Neither hands out an exact matching.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/towers/barcode.hpp"

namespace sesame::replay {

/// How far apart two points (birth, death) are: the larger of the two differences, or by Pythagoras. The diagonal is
/// (death - birth) / 2 away in the first, (death - birth) / sqrt(2) in the second.
enum class GroundMetric { maximum, euclidean };

/// Two bars that are matched, by their places in the diagrams given; none: the diagonal.
struct Match {
  std::optional<std::size_t> left, right;
  engine::Time cost;  ///< their distance in the ground metric; infinite for an essential bar without a partner
};

struct DiagramDistance {
  engine::Time value;
  std::vector<Match> matching;  ///< every bar once: those on the left in order, then the unmatched ones on the right
};

/// The least r such that all bars can be matched at a cost of at most r each, in the maximum metric. The dimensions of
/// the bars are not looked at.
/// Requires: births finite, death >= birth.
/// Cost for n bars in all: at most 64 matchings, each O(sqrt n) rounds that ask a search tree O(n) times; 10,000
/// against 10,000 random points take some tenths of a second. Memory O(n). Source: Efrat, Itai, Katz, "Geometry helps
/// in bottleneck matching" (2001), with the two sides of the problem taken apart; see bottleneck_distance.cpp.
[[nodiscard]] DiagramDistance bottleneck_distance(std::span<const engine::Bar> left,
                                                  std::span<const engine::Bar> right);

/// The least (sum of cost^q)^(1/q) over all matchings. The dimensions of the bars are not looked at. The result is
/// exact but for the rounding of sums.
/// Requires: as above, and q >= 1, finite.
/// Cost: O(n^2 * m) for n and m bars; 1,000 against 1,000 random points take some tenths of a second, 10,000 a minute
/// or two. Memory O(n + m), and the costs of all pairs while there are at most 16 million. Source: shortest augmenting
/// paths, Crouse, "On implementing 2D rectangular assignment algorithms" (2016), with the diagonal as a column of each
/// row's own; see wasserstein_distance.cpp.
[[nodiscard]] DiagramDistance wasserstein_distance(std::span<const engine::Bar> left,
                                                   std::span<const engine::Bar> right, double q = 1,
                                                   GroundMetric ground = GroundMetric::maximum);

}  // namespace sesame::replay

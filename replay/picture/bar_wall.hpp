/// \file
/// Bars that come in great numbers and are all as short: the wall of an assembly, where each piece is apart for a step.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/towers/barcode.hpp"

namespace sesame::replay {

/// The bars of one dimension that a picture draws together.
struct BarWall {
  engine::Time length = 0;                      ///< that most of them have; none is longer
  bool is_even = true;                          ///< all have it
  std::uint64_t bars = 0;                       ///< how many there are
  std::vector<std::vector<engine::Bar>> lanes;  ///< those that are drawn; the bars of a lane do not overlap
};

/// A wall is there when half of the bars of a dimension, and 20 of them at least, have the same length, which is no
/// more than `longest`: it is made of these and of all that are shorter. They are taken out of `bars`, which are those
/// of one dimension in order. Without bars when there is none. Bars that find no room in `most_lanes` are counted only.
BarWall take_wall(std::vector<engine::Bar>& bars, double longest, std::size_t most_lanes);

}  // namespace sesame::replay

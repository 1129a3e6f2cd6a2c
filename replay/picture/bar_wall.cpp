#include "replay/picture/bar_wall.hpp"

#include <algorithm>
#include <utility>

namespace sesame::replay {
namespace {

using engine::Bar;
using engine::Time;

constexpr std::size_t fewest_bars = 20;

/// The length that most of the bars that end have, and how many; the shorter one of two.
std::pair<Time, std::size_t> commonest_length(const std::vector<Bar>& bars) {
  std::vector<Time> lengths;
  for (const Bar& bar : bars) {
    if (bar.death != engine::never) {
      lengths.push_back(bar.death - bar.birth);
    }
  }
  std::sort(lengths.begin(), lengths.end());
  std::pair<Time, std::size_t> commonest{};
  for (auto begin = lengths.begin(); begin != lengths.end();) {
    const auto end = std::upper_bound(begin, lengths.end(), *begin);
    const auto count = static_cast<std::size_t>(end - begin);
    if (count > commonest.second) {
      commonest = {*begin, count};
    }
    begin = end;
  }
  return commonest;
}

}  // namespace

BarWall take_wall(std::vector<Bar>& bars, double longest, std::size_t most_lanes) {
  const auto [length, count] = commonest_length(bars);
  if (count < fewest_bars || 2 * count < bars.size() || length > longest) {
    return {};
  }
  BarWall wall;
  wall.length = length;
  std::vector<Bar> others;
  for (const Bar& bar : bars) {
    const Time own = bar.death - bar.birth;
    if (bar.death == engine::never || own > length) {
      others.push_back(bar);
      continue;
    }
    ++wall.bars;
    wall.is_even = wall.is_even && own == length;
    const auto lane = std::find_if(wall.lanes.begin(), wall.lanes.end(),
                                   [&](const std::vector<Bar>& l) { return l.back().death <= bar.birth; });
    if (lane != wall.lanes.end()) {
      lane->push_back(bar);
    } else if (wall.lanes.size() < most_lanes) {
      wall.lanes.push_back({bar});
    }
  }
  bars = std::move(others);
  return wall;
}

}  // namespace sesame::replay

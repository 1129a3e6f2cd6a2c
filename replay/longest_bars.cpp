#include <algorithm>
#include <functional>
#include <map>

#include "replay/barcode_panels.hpp"
#include "replay/text_buffer.hpp"

namespace sesame::replay {

std::vector<engine::Bar> longest_bars(const engine::Barcode& barcode, std::size_t most) {
  using engine::Bar;
  if (barcode.bars.size() <= most) {
    return barcode.bars;
  }
  const auto is_longer = [](const Bar& x, const Bar& y) {
    const double x_length = x.death / 2 - x.birth / 2, y_length = y.death / 2 - y.birth / 2;
    return x_length != y_length ? x_length > y_length : x < y;
  };
  std::map<int, std::vector<Bar>> by_dimension;
  for (const Bar& bar : barcode.bars) {
    by_dimension[bar.dimension].push_back(bar);
  }
  const std::size_t share = most / by_dimension.size();
  std::vector<Bar> taken, others;
  for (auto& [dimension, bars] : by_dimension) {
    const auto middle = bars.begin() + static_cast<std::ptrdiff_t>(std::min(share, bars.size()));
    std::partial_sort(bars.begin(), middle, bars.end(), is_longer);
    taken.insert(taken.end(), bars.begin(), middle);
    others.insert(others.end(), middle, bars.end());
  }
  const auto middle = others.begin() + static_cast<std::ptrdiff_t>(std::min(most - taken.size(), others.size()));
  std::partial_sort(others.begin(), middle, others.end(), is_longer);
  taken.insert(taken.end(), others.begin(), middle);
  std::sort(taken.begin(), taken.end());
  return taken;
}

std::string interval_text(const engine::Bar& bar) {
  const std::string death = bar.death == engine::never ? "\u221E" : number_text(bar.death);
  return "[" + number_text(bar.birth) + ", " + death + ")";
}

}  // namespace sesame::replay

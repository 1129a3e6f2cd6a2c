#include "replay/barcode/bars.hpp"

#include <algorithm>
#include <iterator>
#include <map>

#include "replay/text/text_buffer.hpp"

namespace sesame::replay {

using engine::Bar;
using engine::Time;

bool is_longer(const Bar& x, const Bar& y) {
  Time x_length = x.death - x.birth, y_length = y.death - y.birth;
  if (!x_length.is_finite() && !y_length.is_finite()) {  // they never end, or are too long for a double
    x_length = x.death.half() - x.birth.half();
    y_length = y.death.half() - y.birth.half();
  }
  return x_length != y_length ? x_length > y_length : x < y;
}

engine::Barcode selected(const engine::Barcode& barcode, const BarSelection& selection) {
  engine::Barcode taken{{}, barcode.hidden};
  std::copy_if(barcode.bars.begin(), barcode.bars.end(), std::back_inserter(taken.bars),
               [&](const Bar& bar) { return selection.has(bar); });
  return taken;
}

namespace {

/// Moves the longest `count` of the bars from `from` to `to`.
void take_longest(std::vector<Bar>& from, std::size_t count, std::vector<Bar>& to) {
  const auto middle = from.begin() + static_cast<std::ptrdiff_t>(std::min(count, from.size()));
  std::partial_sort(from.begin(), middle, from.end(), is_longer);
  to.insert(to.end(), from.begin(), middle);
  from.erase(from.begin(), middle);
}

}  // namespace

std::vector<Bar> longest_bars(const engine::Barcode& barcode, std::size_t most) {
  if (barcode.bars.size() <= most) {
    return barcode.bars;
  }
  struct Bars {
    std::vector<Bar> open, ended;
  };
  std::map<int, Bars> by_dimension;
  for (const Bar& bar : barcode.bars) {
    Bars& bars = by_dimension[bar.dimension];
    (bar.death == engine::never ? bars.open : bars.ended).push_back(bar);
  }
  const std::size_t share = most / by_dimension.size();
  std::vector<Bar> taken, others;
  for (auto& [dimension, bars] : by_dimension) {
    const std::size_t ended = std::min(bars.ended.size(), share - std::min(bars.open.size(), share / 2));
    take_longest(bars.ended, ended, taken);
    take_longest(bars.open, share - ended, taken);
    others.insert(others.end(), bars.open.begin(), bars.open.end());
    others.insert(others.end(), bars.ended.begin(), bars.ended.end());
  }
  take_longest(others, most - taken.size(), taken);
  std::sort(taken.begin(), taken.end());
  return taken;
}

std::string interval_text(const Bar& bar) {
  const std::string death = bar.death == engine::never ? "\u221E" : number_text(bar.death);
  return "[" + number_text(bar.birth) + ", " + death + ")";
}

std::string short_interval_text(const Bar& bar) {
  const std::string death = bar.death == engine::never ? "\u221E" : short_number_text(bar.death);
  return "[" + short_number_text(bar.birth) + ", " + death + ")";
}

}  // namespace sesame::replay

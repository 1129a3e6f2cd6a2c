#include "replay/zigzag/zigzag_bars.hpp"

#include <algorithm>

namespace sesame::replay {

void ZigzagBars::add(const engine::MomentBar& bar) {
  if (!dimensions_.have(static_cast<std::size_t>(bar.dimension))) {
    return;
  }
  if (bar.birth.time == bar.death.time) {
    ++hidden_;
    return;
  }
  if (bar.death.operation != operation_) {
    flush();
    operation_ = bar.death.operation;
  }
  at_hand_.push_back({bar.dimension, bar.birth.time, bar.death.time});
}

void ZigzagBars::flush() {
  std::ranges::sort(at_hand_);
  std::ranges::for_each(at_hand_, on_bar_);
  at_hand_.clear();
}

}  // namespace sesame::replay

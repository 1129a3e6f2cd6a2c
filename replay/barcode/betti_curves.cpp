#include "replay/barcode/betti_curves.hpp"

#include <algorithm>
#include <vector>

namespace sesame::replay {

std::size_t dimensions(const engine::Barcode& barcode) {
  return barcode.bars.empty() ? 0 : static_cast<std::size_t>(barcode.bars.back().dimension) + 1;
}

void for_each_betti_change(const engine::Barcode& barcode,
                           const std::function<void(engine::Time, std::span<const std::uint64_t>)>& visit) {
  struct Event {
    engine::Time time;
    std::size_t dimension;
    bool is_birth;
  };
  std::vector<Event> events;
  events.reserve(2 * barcode.bars.size());
  for (const engine::Bar& bar : barcode.bars) {
    const auto dimension = static_cast<std::size_t>(bar.dimension);
    events.push_back({bar.birth, dimension, true});
    if (bar.death != engine::never) {
      events.push_back({bar.death, dimension, false});
    }
  }
  std::sort(events.begin(), events.end(), [](const Event& x, const Event& y) { return x.time < y.time; });

  std::vector<std::uint64_t> betti(dimensions(barcode)), before = betti;
  for (auto event = events.begin(); event != events.end();) {
    const engine::Time time = event->time;
    for (; event != events.end() && event->time == time; ++event) {
      betti[event->dimension] += event->is_birth ? std::uint64_t{1} : ~std::uint64_t{0};  // modulo 2^64: one less
    }
    if (betti != before) {
      visit(time, betti);
      before = betti;
    }
  }
}

}  // namespace sesame::replay

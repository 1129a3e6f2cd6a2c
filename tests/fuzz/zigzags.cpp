// Zigzags: what is read is tracked over two fields as it comes, and beside that by one matrix at the end, which has
// nothing in common with it; Euler characteristics by ranks and by cells.
#include <algorithm>
#include <memory>
#include <vector>

#include "engine/zigzag/offline_zigzag.hpp"
#include "replay/tower/tower_reader.hpp"
#include "replay/zigzag/zigzag_bars.hpp"
#include "replay/zigzag/zigzag_replay.hpp"
#include "tests/fuzz/target.hpp"

using namespace sesame;
using namespace sesame::tests;
using engine::Bar;

namespace {

constexpr std::size_t longest_line = 4096, most_vertices = 12, most_operations = 200;

/// The barcode over one field, as it is known on the way.
struct Online {
  explicit Online(const char* ring)
      : bars{[this](const Bar& bar) { found.push_back(bar); }},
        barcode{engine::make_online_zigzag_barcode(sparse::parse_ring(ring).value(),
                                                   [this](const engine::MomentBar& bar) { bars.add(bar); })} {}
  Online(const Online&) = delete;
  Online& operator=(const Online&) = delete;

  std::vector<Bar> found;
  replay::ZigzagBars bars;
  std::unique_ptr<engine::ZigzagBarcode> barcode;
};

template <class Counts>
std::int64_t alternating_sum(const Counts& counts) {
  std::int64_t sum = 0, sign = 1;
  for (const std::uint64_t count : counts) {
    sum += sign * static_cast<std::int64_t>(count);
    sign = -sign;
  }
  return sum;
}

void demand_same_bars(Online& online, const engine::OfflineZigzag& offline) {
  online.barcode->for_each_open_bar([&](const engine::MomentBar& bar) { online.bars.add(bar); });
  online.bars.flush();
  std::vector<Bar> found;
  replay::ZigzagBars bars([&](const Bar& bar) { found.push_back(bar); });
  offline.for_each_bar(online.barcode->ring(), [&](const engine::MomentBar& bar) { bars.add(bar); });
  bars.flush();
  std::ranges::sort(found);
  std::ranges::sort(online.found);
  demand(found == online.found && bars.hidden() == online.bars.hidden(), "both ways have the same bars");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  auto opened = replay::TowerReader::from(replay::ByteSource::of_text(text_of(data, size), "zigzag"),
                                          replay::TowerFormat::zigzag, longest_line);
  if (!went_well(opened) || (*opened)->format() == replay::TowerFormat::script) {
    return 0;
  }
  Online modulo_2("Z/2"), modulo_3("Z/3");
  engine::OfflineZigzag offline;
  replay::ZigzagReplay zigzag({modulo_2.barcode.get(), modulo_3.barcode.get(), &offline});
  replay::TowerOperation operation{};
  for (std::size_t k = 0; k < most_operations; ++k) {
    const Result<bool> next = (*opened)->next(operation);
    if (!went_well(next) || !*next) {
      break;
    }
    if (operation.labels.size() <= most_vertices) {
      (void)went_well(zigzag.apply(operation));
    }
    for (const Online* online : {&modulo_2, &modulo_3}) {
      demand(alternating_sum(online->barcode->betti()) == alternating_sum(zigzag.cells()),
             "the Euler characteristic by ranks is that by cells");
    }
  }
  demand_same_bars(modulo_2, offline);
  demand_same_bars(modulo_3, offline);
  return 0;
}

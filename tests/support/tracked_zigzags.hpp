/// \file
/// The barcodes of small zigzags by the trackers of the engine.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/zigzag/offline_zigzag.hpp"
#include "engine/zigzag/zigzag_tracker.hpp"
#include "ops/simplicial/zigzag_complex.hpp"
#include "tests/support/plain_zigzags.hpp"

namespace sesame::tests {

/// Tells trackers of an operation, which has to be possible.
inline void apply(const ZigzagStep& step, ops::ZigzagComplex& complex,
                  const std::vector<engine::ZigzagTracker*>& trackers, engine::Moment moment) {
  using Cell = ops::ZigzagComplex::Cell;
  using Slots = std::span<const ops::ZigzagComplex::Slot>;
  const auto include = [&](Cell cell, Slots facets) {
    for (engine::ZigzagTracker* tracker : trackers) {
      tracker->include(cell.dimension, cell.slot, facets, moment);
    }
  };
  const auto exclude = [&](Cell cell) {
    for (engine::ZigzagTracker* tracker : trackers) {
      tracker->exclude(cell.dimension, cell.slot, moment);
    }
  };
  if (step.kind == 'i') {
    const Cell cell = complex.include(step.labels).value();
    include(cell, complex.facets());
  } else if (step.kind == 'd') {
    exclude(complex.exclude(step.labels).value());
  } else {
    sparse::expects(complex.contract(step.labels[0], step.labels[1], {include, exclude}).has_value(),
                    "a contraction of a test is possible");
  }
}

inline PlainBar plain_bar(const engine::MomentBar& bar) {
  return {bar.dimension, static_cast<std::int64_t>(bar.birth.operation),
          bar.death.time == engine::never ? -1 : static_cast<std::int64_t>(bar.death.operation)};
}

/// The bars of a zigzag, sorted, while it goes on and afterwards.
struct TrackedZigzag {
  std::vector<PlainBar> online, offline;

  TrackedZigzag(const std::vector<ZigzagStep>& zigzag, const std::string& ring_name) {
    const sparse::AnyRing ring = sparse::parse_ring(ring_name).value();
    const auto add_online = [&](const engine::MomentBar& bar) { online.push_back(plain_bar(bar)); };
    const auto tracker = engine::make_online_zigzag_barcode(ring, add_online);
    engine::OfflineZigzag recorded;
    ops::ZigzagComplex complex;
    for (std::size_t k = 0; k < zigzag.size(); ++k) {
      apply(zigzag[k], complex, {tracker.get(), &recorded}, {k, static_cast<double>(k)});
    }
    tracker->for_each_open_bar(add_online);
    recorded.for_each_bar(ring, [&](const engine::MomentBar& bar) { offline.push_back(plain_bar(bar)); });
    std::ranges::sort(online);
    std::ranges::sort(offline);
  }
};

}  // namespace sesame::tests

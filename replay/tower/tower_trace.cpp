#include "replay/tower/tower_trace.hpp"

namespace sesame::replay {
namespace {

engine::TrackerOptions with_cycles(engine::TrackerOptions options) {
  options.keeps_cycles = true;
  return options;
}

}  // namespace

TowerTrace::TowerTrace(const sparse::AnyRing& ring, engine::TrackerOptions options, TraceLimits limits)
    : tracker_{engine::make_barcode_tracker(
          ring, [](const engine::Bar&) {}, with_cycles(options))},
      limits_{limits} {}

void TowerTrace::include(int dimension, Slot slot, std::span<const Slot> facets, engine::Time time) {
  count();
  if (tracker_ != nullptr) {
    tracker_->include(dimension, slot, facets, time);
  }
}

void TowerTrace::contract(const ops::TowerComplex& complex, const ops::TowerComplex::Changes& changes,
                          engine::Time time) {
  count();
  if (tracker_ != nullptr) {
    tracker_->contract(complex, changes, time);
  }
}

/// Before an operation: whether there is room for it.
void TowerTrace::count() {
  if (tracker_ != nullptr && (operations_++ >= limits_.operations || tracker_->work().terms_touched > limits_.terms)) {
    tracker_.reset();
  }
}

}  // namespace sesame::replay

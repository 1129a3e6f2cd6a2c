/// \file
/// Towers with trackers of their barcodes.
#pragma once

#include <span>

#include "engine/towers/tower_tracker.hpp"
#include "tests/support/random_towers.hpp"

namespace sesame::tests {

/// Applies a step to a complex, and tells trackers of it.
inline void apply(const TowerStep& step, ops::TowerComplex& complex, std::span<engine::TowerTracker* const> trackers,
                  double time) {
  if (step.is_contraction) {
    const ops::TowerComplex::Changes& changes = *complex.plan_contraction(step.labels[0], step.labels[1]).value();
    for (engine::TowerTracker* tracker : trackers) {
      tracker->contract(complex, changes, time);
    }
    complex.contract();
    return;
  }
  const ops::TowerComplex::Slot slot = complex.include(step.labels).value();
  for (engine::TowerTracker* tracker : trackers) {
    tracker->include(static_cast<int>(step.labels.size()) - 1, slot, complex.facets(), time);
  }
}

}  // namespace sesame::tests

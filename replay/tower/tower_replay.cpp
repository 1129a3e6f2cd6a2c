#include "replay/tower/tower_replay.hpp"

#include <spdlog/logger.h>

#include "replay/text/log.hpp"

namespace sesame::replay {

Error told(const Error& error) {
  tower_log().debug("an operation did not happen: {}", error.what);
  return error;
}

using ops::Label;
using ops::TowerComplex;

void TowerReplay::include(int dimension, TowerComplex::Slot slot, std::span<const TowerComplex::Slot> facets,
                          engine::Time time) {
  for (engine::TowerTracker* tracker : trackers_) {
    tracker->include(dimension, slot, facets, time);
  }
}

/// Columns name cells all over the memory, so the time of a large matrix is that of waiting for them, unless they have
/// been asked for. The distances are in words of the input, some ten and some thirty columns.
void TowerReplay::prefetch(const TowerOperation& operation) const {
  constexpr std::size_t near_distance = 48;
  constexpr std::size_t far_distance = 160;
  const std::size_t words = operation.labels.size() + 2;
  if (operation.ahead.size() < far_distance + words) {
    return;
  }
  const auto far = operation.ahead.subspan(far_distance, words);
  for (const std::uint64_t word : far) {
    columns_.prefetch(word);
  }
  for (const engine::TowerTracker* tracker : trackers_) {
    tracker->prefetch(columns_, far, operation.ahead.subspan(near_distance, words));
  }
}

Status TowerReplay::apply(const TowerOperation& operation) {
  switch (operation.kind) {
    case TowerOperation::Kind::insert: {
      const Result<TowerComplex::Slot> slot = complex_.include(operation.labels);
      if (!slot) {
        return told(slot.error());
      }
      include(operation.dimension, *slot, complex_.facets(), operation.time);
      if (history_ != nullptr) {
        history_->include(complex_.labels(operation.dimension, *slot));
      }
      break;
    }
    case TowerOperation::Kind::remove:
      return told({Errc::bad_input, "a tower has no deletions; sesame zigzag takes them"});
    case TowerOperation::Kind::column: {
      prefetch(operation);
      const Result<std::uint32_t> slot = columns_.include(operation.dimension, operation.labels);
      if (!slot) {
        return told(slot.error());
      }
      include(operation.dimension, *slot, columns_.facets(), operation.time);
      if (history_ != nullptr) {
        history_->include_cell();
      }
      break;
    }
    case TowerOperation::Kind::contract: {
      const Label u = operation.labels[0];
      const Label v = operation.labels[1];
      const Result<const TowerComplex::Changes*> changes = complex_.plan_contraction(u, v);
      if (!changes) {
        return told(changes.error());
      }
      for (engine::TowerTracker* tracker : trackers_) {
        tracker->contract(complex_, **changes, operation.time);
      }
      complex_.contract();
      if (history_ != nullptr) {
        history_->contract(u, v);
      }
      break;
    }
  }
  ++operations_;
  return Done{};
}

}  // namespace sesame::replay

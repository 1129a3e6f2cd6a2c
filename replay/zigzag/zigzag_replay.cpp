#include "replay/zigzag/zigzag_replay.hpp"

#include <utility>

#include "replay/tower/tower_replay.hpp"

namespace sesame::replay {

ZigzagReplay::ZigzagReplay(std::vector<engine::ZigzagTracker*> trackers, engine::Dimensions dimensions,
                           ZigzagHistory* history)
    : trackers_{std::move(trackers)}, dimensions_{dimensions}, history_{history} {
  if (history_ != nullptr) {
    trackers_.push_back(history_);
  }
}

void ZigzagReplay::include(Cell cell, std::span<const Slot> facets, engine::Moment moment) {
  if (is_told(cell)) {
    for (engine::ZigzagTracker* tracker : trackers_) {
      tracker->include(cell.dimension, cell.slot, facets, moment);
    }
  }
}

void ZigzagReplay::exclude(Cell cell, engine::Moment moment) {
  if (is_told(cell)) {
    for (engine::ZigzagTracker* tracker : trackers_) {
      tracker->exclude(cell.dimension, cell.slot, moment);
    }
  }
}

Status ZigzagReplay::apply(const TowerOperation& operation) {
  const engine::Moment moment{operations_, operation.time};
  switch (operation.kind) {
    case TowerOperation::Kind::insert: {
      const Result<Cell> cell = complex_.include(operation.labels);
      if (!cell) {
        return told(cell.error());
      }
      include(*cell, complex_.facets(), moment);
      break;
    }
    case TowerOperation::Kind::remove: {
      const Result<Cell> cell = complex_.exclude(operation.labels);
      if (!cell) {
        return told(cell.error());
      }
      exclude(*cell, moment);
      break;
    }
    case TowerOperation::Kind::contract: {
      const Status contracted =
          complex_.contract(operation.labels[0], operation.labels[1],
                            {[&](Cell cell, std::span<const Slot> facets) { include(cell, facets, moment); },
                             [&](Cell cell) { exclude(cell, moment); }});
      if (!contracted) {
        return told(contracted.error());
      }
      break;
    }
    case TowerOperation::Kind::column:
      return told({Errc::bad_input, "a zigzag is one of simplices that are listed by their vertices"});
  }
  if (history_ != nullptr) {
    history_->end_operation(operation);
  }
  ++operations_;
  return Done{};
}

}  // namespace sesame::replay

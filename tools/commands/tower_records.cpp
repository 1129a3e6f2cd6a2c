#include "tools/commands/tower_records.hpp"

#include <fmt/format.h>

namespace sesame::tools {

using replay::TowerOperation;

TowerRecords::TowerRecords(const TowerRun& run, const engine::TrackerOptions& options)
    : run_{run}, asks_for_cycles_{run.arguments().generators.has_value()}, has_page_{run.outputs().html != nullptr} {
  if (has_page_) {
    operations_.emplace();
  }
  if (has_page_ && !asks_for_cycles_) {
    trace_.emplace(run.rings()[0], options);
  }
  if (asks_for_cycles_ || trace_) {
    history_.emplace();
  }
}

Status TowerRecords::Recorded::apply(const TowerOperation& operation) {
  if (Status legal = records_.check_points(operation); !legal) {
    return legal;
  }
  Status applied = tower_.apply(operation);
  if (applied) {
    records_.add(operation, tower_);
  }
  return applied;
}

Status TowerRecords::check_points(const TowerOperation& operation) const {
  if (run_.points() == nullptr || operation.kind != TowerOperation::Kind::insert) {
    return Done{};
  }
  const std::uint64_t points = run_.points()->points.size();
  for (const std::uint64_t label : operation.labels) {
    if (label >= points) {
      return Error{Errc::bad_input,
                   fmt::format("vertex {} has no point: {} has {}, {}", label, run_.points()->name,
                               points == 0 ? "none" : std::to_string(points),
                               points == 0 ? "and should have one a line"
                                           : fmt::format("which are those of the vertices 0 to {}", points - 1))};
    }
  }
  return Done{};
}

void TowerRecords::add(const TowerOperation& operation, replay::TowerReplay& tower) {
  if (trace_ && !is_traced() && history_.has_value()) {
    tower.end_history();
    history_.reset();
  }
  const std::uint64_t most = run_.points() != nullptr ? replay::TowerPageLimits{}.operations : 0;
  const bool is_wanted = asks_for_cycles_ || is_traced() || (operations_ && operations_->size() < most);
  if (!is_wanted) {
    operations_.reset();
  } else if (operations_) {
    operations_->add(operation, run_.line());
  }
}

}  // namespace sesame::tools

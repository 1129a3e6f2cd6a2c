#include <iostream>

#include "engine/group_tracker.hpp"
#include "tools/commands/tower_loops.hpp"

namespace sesame::tools {

using replay::Outcome;
using replay::TowerOperation;

Outcome run_groups(TowerRun& run) {
  replay::GroupSequence groups(run.prints() ? &std::cout : nullptr, run.dimensions());
  engine::GroupTracker tracker;
  replay::TowerReplay tower({&tracker});
  const Outcome outcome =
      run.read_all([&](const TowerOperation& operation) { return run.faces().apply(tower, operation); },
                   [&](const TowerOperation& operation) {
                     groups.add(operation.time, tracker.homology(tower.cells().size()), run.rings()[0]);
                   });
  if (run.is_reported(outcome)) {
    run.write_groups(groups, run.operations());
  }
  return outcome;
}

}  // namespace sesame::tools

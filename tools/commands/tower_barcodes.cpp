#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "engine/towers/barcode_tracker.hpp"
#include "replay/picture/svg.hpp"
#include "tools/commands/bar_sink.hpp"
#include "tools/commands/tower_loops.hpp"
#include "tools/commands/tower_records.hpp"

namespace sesame::tools {

using engine::Bar;
using replay::Outcome;
using replay::TowerOperation;
using replay::TowerResult;

namespace {

/// A tracker and a sink for each ring.
struct Trackers {
  std::vector<BarSink> sinks;
  std::vector<std::unique_ptr<engine::BarcodeTracker>> trackers;
  std::vector<engine::TowerTracker*> told;
};

engine::TrackerOptions tracker_options(const TowerRun& run) {
  return {run.is_matrix() ? engine::Slots::shared : engine::Slots::by_dimension, run.dimensions(),
          run.arguments().generators.has_value()};
}

Trackers trackers_of(const TowerRun& run, replay::PersWriter* pers) {
  const TowerArguments& arguments = run.arguments();
  const bool keeps_bars = arguments.json || run.rings().size() > 1 || run.outputs().need_barcode();
  Trackers made;
  made.sinks.reserve(run.rings().size());  // trackers point to them
  for (const sparse::AnyRing& ring : run.rings()) {
    made.sinks.emplace_back(arguments.selection, run.dimensions(), keeps_bars, pers);
    const auto add = [sink = &made.sinks.back()](const Bar& bar) { sink->add(bar); };
    made.trackers.push_back(engine::make_barcode_tracker(ring, add, tracker_options(run)));
    made.told.push_back(made.trackers.back().get());
  }
  return made;
}

/// With --every: cells and Betti numbers now and then.
void report_state(const TowerRun& run, const TowerOperation& operation, const replay::TowerReplay& tower,
                  std::span<const std::unique_ptr<engine::BarcodeTracker>> trackers) {
  if (run.reports_state(run.operations())) {
    for (const auto& tracker : trackers) {
      run.write_state(run.operations(), operation.time, tower.cells(), tracker->ring(), tracker->betti());
    }
    std::cout << std::flush;  // somebody may be waiting at the end of a pipe
  }
}

}  // namespace

Outcome run_barcodes(TowerRun& run) {
  std::optional<replay::PersWriter> pers = run.pers_writer();
  Trackers over = trackers_of(run, pers ? &*pers : nullptr);
  TowerRecords records(run, tracker_options(run));
  if (engine::TowerTracker* told = records.told()) {
    over.told.push_back(told);
  }
  replay::TowerReplay tower(over.told, records.history());
  TowerRecords::Recorded recorded(tower, records);
  TowerRun::Drawn drawn;
  const Outcome outcome =
      run.read_all([&](const TowerOperation& operation) { return run.faces().apply(recorded, operation); },
                   [&](const TowerOperation& operation) {
                     drawn.has_contractions |= operation.kind == TowerOperation::Kind::contract;
                     report_state(run, operation, tower, over.trackers);
                   });
  drawn.top_dimension = static_cast<int>(tower.cells().size()) - 1;
  if (!run.is_reported(outcome)) {
    return outcome;
  }
  std::vector<TowerResult> results;
  for (std::size_t r = 0; r < run.rings().size(); ++r) {
    over.trackers[r]->for_each_open_bar([&](const Bar& bar) { over.sinks[r].add(bar); });
    results.push_back(
        over.sinks[r].finish(run.provenance(run.rings()[r], run.operations()), over.trackers[r]->hidden()));
  }
  if (pers) {
    pers->finish(run.operations(), results[0].hidden);
  }
  // What was interrupted once writes its cycles, since a second interrupt ends it at once.
  const std::atomic<bool>* stop = outcome == Outcome::interrupted ? nullptr : &stop_requested();
  const std::optional<replay::GeneratorOptions>& wanted = run.arguments().generators;
  std::optional<replay::CycleReport> report;
  if (wanted) {
    report.emplace(*over.trackers[0], records.kept_history(), tower.operations(), run.arguments().selection, *wanted,
                   stop);
  }
  std::optional<replay::BarChainNamer> chains;
  std::optional<replay::TowerClasses> classes;
  drawn.operations = records.operations();
  if (engine::BarcodeTracker* cycles = records.cycles(*over.trackers[0]); run.outputs().html != nullptr) {
    if (cycles != nullptr && drawn.operations != nullptr) {
      chains.emplace(*cycles, records.kept_history(), tower.operations());
      drawn.classes = &classes.emplace(replay::TowerClasses{*chains, *drawn.operations, wanted, stop});
    } else {
      drawn.note = fmt::format(
          "The classes of the bars are not on this page: the tower has more than {} operations, or its chains are "
          "long. "
          "With --generators they are.",
          replay::with_separators(replay::TraceLimits{}.operations));
    }
  }
  run.write(results, report ? &*report : nullptr, drawn);
  return outcome == Outcome::done && stop_requested().load() ? Outcome::interrupted : outcome;
}

}  // namespace sesame::tools

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "engine/zigzag/deferred_zigzag.hpp"
#include "engine/zigzag/offline_zigzag.hpp"
#include "engine/zigzag/zigzag_tracker.hpp"
#include "replay/zigzag/zigzag_bars.hpp"
#include "replay/zigzag/zigzag_cycles.hpp"
#include "replay/zigzag/zigzag_replay.hpp"
#include "tools/commands/bar_sink.hpp"
#include "tools/commands/tower_loops.hpp"

namespace sesame::tools {

using replay::Outcome;
using replay::TowerOperation;

namespace {

/// With --every: cells and Betti numbers now and then.
void report_state(const TowerRun& run, const TowerOperation& operation, const replay::ZigzagReplay& zigzag,
                  const engine::ZigzagBarcode& barcode) {
  if (run.reports_state(run.operations())) {
    std::vector<std::uint64_t> betti = barcode.betti();
    while (!betti.empty() && !run.dimensions().have(betti.size() - 1)) {
      betti.pop_back();
    }
    run.write_state(run.operations(), operation.time, zigzag.cells(), barcode.ring(), betti);
    std::cout << std::flush;  // somebody may be waiting at the end of a pipe
  }
}

/// What --verify compares: the bars by the other of the two ways. Errors: law_broken, when they are not the same.
Status verify(const engine::OfflineZigzag& zigzag, const sparse::AnyRing& ring, std::vector<engine::Bar> online,
              engine::Dimensions dimensions) {
  std::vector<engine::Bar> offline;
  replay::ZigzagBars bars([&](const engine::Bar& bar) { offline.push_back(bar); }, dimensions);
  zigzag.for_each_bar(ring, [&](const engine::MomentBar& bar) { bars.add(bar); });
  bars.flush();
  std::ranges::sort(online);
  std::ranges::sort(offline);
  return online == offline ? Status{Done{}}
                           : Error{Errc::law_broken, "the two ways of computing the barcode differ; this is a bug"};
}

/// What --generators asks for: who takes the cycles of bars, and the names of their simplices.
struct Cycles {
  replay::ZigzagHistory history;
  replay::ZigzagCycles report;

  explicit Cycles(const TowerRun& run)
      : history{std::visit([](const auto& ring) { return ring.characteristic(); }, run.rings()[0])},
        report{run.arguments().json ? replay::ZigzagCycles::Form::json : replay::ZigzagCycles::Form::table,
               run.dimensions(), run.arguments().selection, *run.arguments().generators} {}

  void add(const engine::MomentBar& moments, const engine::ZigzagBarcode::Pieces& pieces) {
    if (const engine::Bar bar{moments.dimension, moments.birth.time, moments.death.time}; report.wants(bar)) {
      report.add(bar, history.named(moments, pieces()));
    }
  }
};

std::unique_ptr<engine::ZigzagBarcode> online_barcode(const sparse::AnyRing& ring,
                                                      const engine::ZigzagBarcode::OnBar& take, Cycles* cycles) {
  if (cycles == nullptr) {
    return engine::make_online_zigzag_barcode(ring, take);
  }
  return engine::make_online_zigzag_barcode(
      ring, take, [cycles](const auto& bar, const auto& pieces) { cycles->add(bar, pieces); },
      [cycles](int dimension) { return cycles->report.wants(dimension); });
}

}  // namespace

Outcome run_zigzag(TowerRun& run) {
  const sparse::AnyRing& ring = run.rings()[0];
  const TowerArguments& arguments = run.arguments();
  std::optional<replay::PersWriter> pers = run.pers_writer();
  BarSink sink(arguments.selection, run.dimensions(), arguments.json || run.outputs().need_barcode(),
               pers ? &*pers : nullptr);
  std::vector<engine::Bar> found;  // for --verify
  replay::ZigzagBars bars(
      [&](const engine::Bar& bar) {
        sink.add(bar);
        if (arguments.verifies) {
          found.push_back(bar);
        }
      },
      run.dimensions());
  const auto take = [&](const engine::MomentBar& bar) { bars.add(bar); };
  // What is read from a file ends, and nobody waits for what is known on the way.
  const bool is_online = arguments.verifies || arguments.generators || arguments.every > 0 ||
                         !std::filesystem::is_regular_file(arguments.file);
  const std::unique_ptr<Cycles> cycles = arguments.generators ? std::make_unique<Cycles>(run) : nullptr;
  engine::OfflineZigzag offline;  // for --verify
  engine::DeferredZigzag deferred(ring, take);
  const std::unique_ptr<engine::ZigzagBarcode> online = is_online ? online_barcode(ring, take, cycles.get()) : nullptr;
  std::vector<engine::ZigzagTracker*> told{&deferred};
  if (is_online) {
    told[0] = online.get();
  }
  if (arguments.verifies) {
    told.push_back(&offline);
  }
  replay::ZigzagReplay zigzag(told, run.dimensions(), cycles ? &cycles->history : nullptr);
  TowerRun::Drawn drawn;
  bool has_deletions = false;
  const Outcome outcome =
      run.read_all([&](const TowerOperation& operation) { return run.faces().apply(zigzag, operation); },
                   [&](const TowerOperation& operation) {
                     has_deletions |= operation.kind == TowerOperation::Kind::remove;
                     drawn.has_contractions |= operation.kind == TowerOperation::Kind::contract;
                     if (online) {
                       report_state(run, operation, zigzag, *online);
                     }
                   });
  if (!run.is_reported(outcome)) {
    return outcome;
  }
  if (online) {
    online->for_each_open_bar(take);
    if (cycles) {
      online->for_each_open_cycle([&](const auto& bar, const auto& pieces) { cycles->add(bar, pieces); });
    }
  } else {
    deferred.finish();
  }
  bars.flush();
  if (arguments.verifies) {
    if (const Status same = verify(offline, ring, std::move(found), run.dimensions()); !same) {
      std::cerr << "sesame zigzag: " << same.error().what << '\n';
      return Outcome::law_failed;
    }
  }
  replay::Provenance provenance = run.provenance(ring, run.operations());
  provenance.format = replay::format_name(has_deletions ? replay::TowerFormat::zigzag : replay::TowerFormat::tower);
  const replay::TowerResult result = sink.finish(std::move(provenance), bars.hidden());
  if (pers) {
    pers->finish(run.operations(), result.hidden);
  }
  drawn.has_contractions |= has_deletions;  // then nothing is left out as if the complex had been cut off
  drawn.top_dimension = static_cast<int>(zigzag.cells().size()) - 1;
  drawn.note = "The classes of the bars of a zigzag are not on this page.";
  run.write({&result, 1}, cycles ? &cycles->report : nullptr, drawn);
  return outcome;
}

}  // namespace sesame::tools

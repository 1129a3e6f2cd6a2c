#include <algorithm>
#include <iostream>
#include <optional>

#include "engine/history_zigzag.hpp"
#include "replay/zigzag/zigzag_cycles.hpp"
#include "tools/commands/bar_sink.hpp"
#include "tools/commands/tower_loops.hpp"

namespace sesame::tools {

using replay::Outcome;

namespace {

/// What --generators asks for: the cycles of the bars as they end.
class ScriptCycles {
 public:
  explicit ScriptCycles(const TowerRun& run)
      : characteristic_{std::visit([](const auto& ring) { return ring.characteristic(); }, run.rings()[0])},
        report_{run.arguments().json ? replay::ZigzagCycles::Form::json : replay::ZigzagCycles::Form::table,
                run.dimensions(), run.arguments().selection, *run.arguments().generators} {}

  void ask(engine::HistoryOptions& options) {
    options.wants = [this](int dimension) { return report_.wants(dimension); };
    options.on_cycles = [this](const engine::Bar& bar, const engine::HistoryOptions::Cycles& cycles) {
      if (report_.wants(bar)) {
        report_.add(bar, replay::pieces_of(bar, cycles(), characteristic_));
      }
    };
  }
  [[nodiscard]] const replay::ClassReport& report() const { return report_; }

 private:
  std::uint32_t characteristic_;
  replay::ZigzagCycles report_;
};

/// Takes the barcode, or the groups, from the engine of a replay.
class ScriptListener final : public replay::Reporter {
 public:
  ScriptListener(const TowerRun& run, replay::GroupSequence* groups, ScriptCycles* cycles)
      : run_{run}, groups_{groups}, cycles_{cycles} {}

  void step(engine::Engine& engine, const replay::ReportedStep& reported) override {
    steps = reported.step.step;
    if (groups_ != nullptr) {
      groups_->add(steps, reported.homology, engine.ring());
    } else if (run_.reports_state(steps)) {
      report_state(engine, reported.homology);
    }
  }
  void summary(engine::Engine& engine, const replay::Summary& summary) override {
    steps = summary.steps;
    if (groups_ != nullptr) {
      return;
    }
    engine::HistoryOptions options;
    options.verifies = run_.arguments().verifies;
    options.stop = summary.stop;
    options.stopped_after = &steps;
    if (cycles_ != nullptr) {
      cycles_->ask(options);
    }
    barcode = engine.barcode(options);
  }

  std::uint64_t steps = 0;
  Result<engine::Barcode> barcode = engine::Barcode{};

 private:
  /// With --every: cells and Betti numbers now and then.
  void report_state(const engine::Engine& engine, const engine::Homology& homology) const {
    std::vector<std::uint64_t> betti(homology.betti.begin(), homology.betti.end());
    while (!betti.empty() && (betti.back() == 0 || !run_.dimensions().have(betti.size() - 1))) {
      betti.pop_back();
    }
    run_.write_state(steps, engine::Time{steps}, engine.cells(), engine.ring(), betti);
    std::cout << std::flush;  // somebody may be waiting at the end of a pipe
  }

  const TowerRun& run_;
  replay::GroupSequence* groups_;
  ScriptCycles* cycles_;
};

void write_bars(const TowerRun& run, std::uint64_t steps, const engine::Barcode& barcode,
                const replay::ClassReport* cycles) {
  std::optional<replay::PersWriter> pers = run.pers_writer();
  BarSink sink(run.arguments().selection, run.dimensions(), true, pers ? &*pers : nullptr);
  std::ranges::for_each(barcode.bars, [&](const engine::Bar& bar) { sink.add(bar); });
  const replay::TowerResult result = sink.finish(run.provenance(run.rings()[0], steps), barcode.hidden);
  if (pers) {
    pers->finish(steps, result.hidden);
  }
  TowerRun::Drawn drawn;
  drawn.note =
      "The classes of a script's bars are not on this page: sesame replay --html draws its object and generators.";
  run.write({&result, 1}, cycles, drawn);
}

}  // namespace

Outcome run_script_as_tower(TowerRun& run) {
  replay::GroupSequence groups(run.prints() ? &std::cout : nullptr, run.dimensions());
  std::optional<ScriptCycles> cycles;
  if (run.arguments().generators) {
    cycles.emplace(run);
  }
  ScriptListener listener(run, run.is_integral() ? &groups : nullptr, cycles ? &*cycles : nullptr);
  replay::ReplayOptions options;
  options.ring = run.rings()[0];
  options.every = run.is_integral() ? 1 : run.arguments().every;
  options.stop = &stop_requested();
  options.needs_barcode = run.is_integral()                     ? replay::NeededBarcode::none
                          : run.arguments().command == "zigzag" ? replay::NeededBarcode::of_zigzag
                                                                : replay::NeededBarcode::of_tower;
  options.partial = run.arguments().partial;
  if (run.arguments().until > 0) {
    options.until = run.arguments().until;
  }
  replay::ScriptReader script = run.take_script();
  const Outcome outcome = replay::replay(script, options, &listener, std::cerr, run.progress());
  run.end_progress();
  if (!run.is_reported(outcome)) {
    return outcome;
  }
  if (run.is_integral()) {
    run.write_groups(groups, listener.steps);
    return outcome;
  }
  if (!listener.barcode) {
    std::cerr << "sesame " << run.arguments().command << ": " << listener.barcode.error().what << '\n';
    return replay::outcome_of(listener.barcode.error().code);
  }
  write_bars(run, listener.steps, *listener.barcode, cycles ? &cycles->report() : nullptr);
  return outcome;
}

}  // namespace sesame::tools

#include <algorithm>
#include <iostream>

#include "tools/commands/bar_sink.hpp"
#include "tools/commands/tower_loops.hpp"

namespace sesame::tools {

using replay::Outcome;

namespace {

/// Takes the barcode, or the groups, from the engine of a replay.
class ScriptListener final : public replay::Reporter {
 public:
  explicit ScriptListener(replay::GroupSequence* groups) : groups_{groups} {}
  void step(engine::Engine& engine, const replay::ReportedStep& reported) override {
    steps = reported.step.step;
    if (groups_ != nullptr) {
      groups_->add(steps, reported.homology, engine.ring());
    }
  }
  void summary(engine::Engine& engine, const replay::Summary& summary) override {
    steps = summary.steps;
    if (groups_ == nullptr) {
      barcode = engine.barcode().value();  // since the replay needs one
    }
  }

  std::uint64_t steps = 0;
  engine::Barcode barcode;

 private:
  replay::GroupSequence* groups_;
};

void write_bars(const TowerRun& run, std::uint64_t steps, const engine::Barcode& barcode) {
  std::optional<replay::PersWriter> pers = run.pers_writer();
  BarSink sink(run.arguments().selection, run.dimensions(), true, pers ? &*pers : nullptr);
  std::ranges::for_each(barcode.bars, [&](const engine::Bar& bar) { sink.add(bar); });
  const replay::TowerResult result = sink.finish(run.provenance(run.rings()[0], steps), barcode.hidden);
  if (pers) {
    pers->finish(steps, result.hidden);
  }
  TowerRun::Drawn drawn;
  drawn.note =
      "The classes of a script's bars are not known here: sesame replay --html draws its object and generators.";
  run.write({&result, 1}, nullptr, drawn);
}

}  // namespace

Outcome run_script_as_tower(TowerRun& run) {
  replay::GroupSequence groups(run.prints() ? &std::cout : nullptr, run.dimensions());
  ScriptListener listener(run.is_integral() ? &groups : nullptr);
  replay::ReplayOptions options;
  options.ring = run.rings()[0];
  options.every = run.is_integral() ? 1 : 0;
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
  } else {
    write_bars(run, listener.steps, listener.barcode);
  }
  return outcome;
}

}  // namespace sesame::tools

#include <algorithm>
#include <array>
#include <bit>

#include "engine/towers/barcode_tracker.hpp"
#include "replay/tower/tower_replay.hpp"
#include "sparse/contract.hpp"
#include "tools/bench/answer_check.hpp"
#include "tools/bench/loaded_operations.hpp"
#include "tools/bench/runs.hpp"

namespace sesame::tools {
namespace {

/// A tracker, and what it has reported.
class Tracked {
 public:
  Tracked(const Tracked&) = delete;
  Tracked& operator=(const Tracked&) = delete;
  ~Tracked() = default;
  Tracked(const Scenario& scenario, const std::string& method) {
    const auto on_bar = [this](const engine::Bar& bar) { bars_.add(bar); };
    const bool is_filtration = std::holds_alternative<CellFiltration>(scenario.input);
    engine::TrackerOptions tracking;
    tracking.slots = is_filtration ? engine::Slots::shared : engine::Slots::by_dimension;
    tracking.keeps_cycles = method == "cycles";
    tracker_ = engine::make_barcode_tracker(sparse::Z2{}, on_bar, tracking);
  }

  [[nodiscard]] engine::BarcodeTracker* get() const { return tracker_.get(); }
  [[nodiscard]] std::vector<std::uint64_t> betti() const { return tracker_->betti(); }
  /// The bars that have ended.
  [[nodiscard]] const BarSet& bars() const { return bars_; }
  /// Those and the others.
  [[nodiscard]] BarSet all_bars() const {
    BarSet all = bars_;
    tracker_->for_each_open_bar([&all](const engine::Bar& bar) { all.add(bar); });
    return all;
  }

 private:
  BarSet bars_;
  std::unique_ptr<engine::BarcodeTracker> tracker_;
};

Status check_euler(const Tracked& tracked, const replay::TowerReplay& tower) {
  if (alternating_sum(tracked.betti()) != alternating_sum(tower.cells())) {
    return Error{Errc::expectation, "the Euler characteristics of cells and of homology differ"};
  }
  return Done{};
}

Status check_end(const Tracked& tracked, const replay::TowerReplay& tower, const std::optional<Answer>& answer) {
  Status right = check_euler(tracked, tower);
  return right && answer ? check(tracked.betti(), *answer) : right;
}

Status check_against(const Tracked& tracked, const Tracked& other) {
  if (tracked.betti() != other.betti()) {
    return Error{Errc::expectation, "another tracker has other Betti numbers"};
  }
  if (tracked.bars() != other.bars()) {
    return Error{Errc::expectation, "another tracker has other bars"};
  }
  return Done{};
}

}  // namespace

void BarSet::add(const engine::Bar& bar) {
  std::uint64_t mixed = static_cast<std::uint64_t>(bar.dimension);
  for (const double time : {bar.birth.nearest(), bar.death.nearest()}) {
    mixed = (mixed ^ std::bit_cast<std::uint64_t>(time)) * 0x9e3779b97f4a7c15;
    mixed ^= mixed >> 29;
  }
  ++size;
  digest += mixed * 0xbf58476d1ce4e5b9;
  if (bar.death == engine::never) {
    betti.resize(std::max(betti.size(), static_cast<std::size_t>(bar.dimension) + 1), 0);
    ++betti[static_cast<std::size_t>(bar.dimension)];
  }
}

std::span<const std::string> tracker_methods() {
  static const std::array<std::string, 2> names{"sesame", "cycles"};
  return names;
}

Sample run_tracker(const Scenario& scenario, std::uint64_t size, const std::string& method, const RunOptions& options,
                   StepTimes& times) {
  const LoadedOperations operations(scenario, size);
  const Tracked tracked(scenario, method);
  replay::TowerReplay tower({tracked.get()});
  Sample sample =
      measure_steps(operations.size(), options, times, [&](std::size_t k) { return tower.apply(operations[k]); });
  const engine::BarcodeTracker::Work work = tracked.get()->work();
  sample.counts = {{"terms_touched", work.terms_touched},
                   {"terms_held", work.terms_held},
                   {"classes_held", work.classes_held},
                   {"bars", tracked.bars().size}};
  if (sample.verdict == Verdict::right) {
    if (const Status right = check_end(tracked, tower, scenario.answer(size)); !right) {
      sample.remark = right.error().what;
      sample.verdict = Verdict::wrong;
    }
  }
  return sample;
}

Sample check_tracker(const Scenario& scenario, std::uint64_t size, const std::string& method, std::uint64_t steps,
                     double most_seconds, StepTimes& times) {
  const LoadedOperations operations(scenario, size);
  const Tracked tracked(scenario, method), other(scenario, method == "cycles" ? "sesame" : "cycles");
  replay::TowerReplay tower({tracked.get(), other.get()});
  const auto checked_step = [&](std::size_t k) -> Status {
    if (Status status = tower.apply(operations[k]); !status) {
      return status;
    }
    Status right = check_euler(tracked, tower);
    if (right) {
      right = check_against(tracked, other);
    }
    if (!right) {
      return Error{Errc::expectation, "after operation " + std::to_string(k + 1) + ": " + right.error().what};
    }
    return right;
  };
  Sample sample = measure_steps(std::min<std::size_t>(steps, operations.size()), {most_seconds}, times, checked_step);
  sample.checked = sample.steps;
  return sample;
}

BarSet bars_of(const Scenario& scenario, std::uint64_t size) {
  const LoadedOperations operations(scenario, size);
  const Tracked tracked(scenario, "sesame");
  replay::TowerReplay tower({tracked.get()});
  for (std::size_t k = 0; k < operations.size(); ++k) {
    const Status status = tower.apply(operations[k]);
    sparse::expects(status.has_value(), "a filtration that was made can be carried out");
  }
  return tracked.all_bars();
}

}  // namespace sesame::tools

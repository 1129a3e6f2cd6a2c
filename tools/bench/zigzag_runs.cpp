#include <algorithm>
#include <array>

#include "engine/zigzag/offline_zigzag.hpp"
#include "replay/zigzag/zigzag_replay.hpp"
#include "sparse/contract.hpp"
#include "tools/bench/answer_check.hpp"
#include "tools/bench/loaded_operations.hpp"
#include "tools/bench/runs.hpp"

namespace sesame::tools {
namespace {

/// A zigzag that is followed in one of the two ways, or both, and the bars that they find.
class FollowedZigzag {
 public:
  enum class Way { online, offline, both };

  explicit FollowedZigzag(Way way)
      : online_{way == Way::offline
                    ? nullptr
                    : engine::make_online_zigzag_barcode(
                          sparse::Z2{}, [this](const engine::MomentBar& bar) { add(online_bars_, bar); })},
        replay_{trackers(way)} {}
  FollowedZigzag(const FollowedZigzag&) = delete;
  FollowedZigzag& operator=(const FollowedZigzag&) = delete;
  ~FollowedZigzag() = default;

  Status apply(const replay::TowerOperation& operation) { return replay_.apply(operation); }
  /// Finds what the online way leaves for the end, and all that the offline one has to find.
  void finish() {
    if (online_) {
      online_->for_each_open_bar([this](const engine::MomentBar& bar) { add(online_bars_, bar); });
    }
    if (offline_.inclusions() > 0) {
      offline_work_ =
          offline_.for_each_bar(sparse::Z2{}, [this](const engine::MomentBar& bar) { add(offline_bars_, bar); });
    }
  }

  [[nodiscard]] const engine::ZigzagBarcode& online() const { return *online_; }
  [[nodiscard]] engine::ZigzagBarcode::Work work() const { return online_ ? online_->work() : offline_work_; }
  [[nodiscard]] const BarSet& online_bars() const { return online_bars_; }
  [[nodiscard]] const BarSet& offline_bars() const { return offline_bars_; }
  [[nodiscard]] Status check_euler(const std::vector<std::int64_t>& betti) const {
    return alternating_sum(betti) == alternating_sum(replay_.cells())
               ? Status{Done{}}
               : Error{Errc::expectation, "the Euler characteristics of cells and of homology differ"};
  }

 private:
  std::vector<engine::ZigzagTracker*> trackers(Way way) {
    std::vector<engine::ZigzagTracker*> trackers;
    if (way != Way::offline) {
      trackers.push_back(online_.get());
    }
    if (way != Way::online) {
      trackers.push_back(&offline_);
    }
    return trackers;
  }
  static void add(BarSet& bars, const engine::MomentBar& bar) {
    bars.add({bar.dimension, bar.birth.time, bar.death.time});
  }

  BarSet online_bars_, offline_bars_;
  engine::OfflineZigzag offline_;
  engine::ZigzagBarcode::Work offline_work_;
  std::unique_ptr<engine::ZigzagBarcode> online_;
  replay::ZigzagReplay replay_;
};

/// What is wrong in the end with Betti numbers.
Status check_end(const FollowedZigzag& zigzag, const std::vector<std::int64_t>& betti,
                 const std::optional<Answer>& answer) {
  const Status right = zigzag.check_euler(betti);
  return right && answer ? check(std::vector<std::uint64_t>(betti.begin(), betti.end()), *answer) : right;
}

}  // namespace

std::span<const std::string> zigzag_methods() {
  static const std::array<std::string, 2> names{"online", "offline"};
  return names;
}

Sample run_zigzag(const Scenario& scenario, std::uint64_t size, const std::string& method, const RunOptions& options,
                  StepTimes& times) {
  const LoadedOperations operations(scenario, size);
  const bool is_online = method == "online";
  FollowedZigzag zigzag(is_online ? FollowedZigzag::Way::online : FollowedZigzag::Way::offline);
  Sample sample = measure_steps(operations.size(), options, times, [&](std::size_t k) {
    Status status = zigzag.apply(operations[k]);
    if (k + 1 == operations.size()) {
      zigzag.finish();
    }
    return status;
  });
  const BarSet& bars = is_online ? zigzag.online_bars() : zigzag.offline_bars();
  const engine::ZigzagBarcode::Work work = zigzag.work();
  sample.counts = {{"terms_touched", work.terms_touched}, {"terms_held", work.terms_held}, {"bars", bars.size}};
  if (sample.verdict == Verdict::right) {
    if (const Status right = check_end(zigzag, bars.betti, scenario.answer(size)); !right) {
      sample.remark = right.error().what;
      sample.verdict = Verdict::wrong;
    }
  }
  return sample;
}

Sample check_zigzag(const Scenario& scenario, std::uint64_t size, const std::string& /*method*/, std::uint64_t steps,
                    double most_seconds, StepTimes& times) {
  const LoadedOperations operations(scenario, size);
  FollowedZigzag zigzag(FollowedZigzag::Way::both);
  const std::size_t end = std::min<std::size_t>(steps, operations.size());
  const auto checked_step = [&](std::size_t k) -> Status {
    if (Status status = zigzag.apply(operations[k]); !status) {
      return status;
    }
    const std::vector<std::uint64_t> betti = zigzag.online().betti();
    Status right = zigzag.check_euler({betti.begin(), betti.end()});
    if (right && k + 1 == end) {
      zigzag.finish();
      if (zigzag.online_bars() != zigzag.offline_bars()) {
        right = Error{Errc::expectation, "the two ways find other bars"};
      }
    }
    return right ? right
                 : Error{Errc::expectation, "after operation " + std::to_string(k + 1) + ": " + right.error().what};
  };
  Sample sample = measure_steps(end, {most_seconds}, times, checked_step);
  sample.checked = sample.steps == end ? sample.steps : 0;
  return sample;
}

}  // namespace sesame::tools

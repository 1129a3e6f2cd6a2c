/// \file
/// What the log says of a step.
#pragma once

#include <chrono>
#include <optional>

#include "engine/engine.hpp"

namespace sesame::engine {

/// What a step did and what it took. Nothing is measured unless `step_log` wants to know when the step begins. Threads:
/// one at a time, for queries too.
class StepAccount {
 public:
  /// Before the step.
  explicit StepAccount(const Engine& engine);
  /// After it.
  void say(const StepReport& report) const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Beginning {
    Clock::time_point time;
    Work work;
  };

  const Engine& engine_;
  std::optional<Beginning> beginning_;
};

}  // namespace sesame::engine

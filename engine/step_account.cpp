#include "engine/step_account.hpp"

#include <fmt/format.h>
#include <spdlog/logger.h>

#include <string>

#include "engine/log.hpp"

namespace sesame::engine {
namespace {

/// "cells made: 7; bodies made: 1": what has changed, for an undo what is as it was before.
std::string description(const StepReport& report) {
  using ops::EventKind;
  const bool is_undo = report.steps_undone > 0;
  std::string text = is_undo ? fmt::format("steps taken back: {}", report.steps_undone) : "";
  const auto add = [&](const char* what, const char* undone, auto... kinds) {
    if (const std::uint64_t count = (report.events[kinds] + ...); count > 0) {
      text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", is_undo ? undone : what, count);
    }
  };
  add("cells made", "cells gone", EventKind::cell, EventKind::copy);
  add("cells merged or squashed", "cells separate again", EventKind::removal);
  add("cells removed", "cells there again", EventKind::deletion);
  add("incidences moved", "incidences moved back", EventKind::move);
  add("products and large cones", "products and large cones gone", EventKind::family);
  add("bodies made", "bodies gone", EventKind::body);
  add("bodies joined to others", "bodies apart again", EventKind::union_of_bodies);
  return text.empty() ? "nothing changed" : text;
}

}  // namespace

StepAccount::StepAccount(const Engine& engine) : engine_{engine} {
  if (step_log().should_log(spdlog::level::debug)) {
    beginning_ = Beginning{Clock::now(), engine.work()};
  }
}

void StepAccount::say(const StepReport& report) const {
  if (!beginning_) {
    return;
  }
  const std::chrono::duration<double, std::micro> took = Clock::now() - beginning_->time;
  Work work = engine_.work();
  work -= beginning_->work;
  step_log().debug("step {} ({}): {}; took {:.1f} us, {} terms read, {} written", report.step, report.op,
                   description(report), took.count(), work.rewritten_terms + work.path_links,
                   work.boundary_entries + work.rule_terms);
}

}  // namespace sesame::engine

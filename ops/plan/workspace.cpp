#include "ops/plan/workspace.hpp"

#include <fmt/format.h>

#include <concepts>
#include <variant>

#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

template <class Op>
concept Construction = requires(Planner& planner, const Op& operation, Plan& plan) {
  planner.plan(operation, plan);
};

}  // namespace

bool Workspace::is_construction(const Operation& operation) {
  return std::visit([]<class Op>(const Op&) { return Construction<Op>; }, operation);
}

Status Workspace::plan(const Operation& operation) {
  return std::visit(
      [&]<class Op>(const Op& op) -> Status {
        if constexpr (Construction<Op>) {
          return planner_.plan(op, plan_);
        } else if constexpr (std::same_as<Op, Note>) {
          plan_.clear();
          return Done{};
        } else {
          return Error{Errc::refused,
                       fmt::format("only construction steps can be planned, not \"{}\"", keyword(operation))};
        }
      },
      operation);
}

Moment Workspace::before(std::size_t step) const {
  const EventCounts since = structure_.journal().counts_since(steps_[step].begin);
  const auto less = [&since](auto count, auto... kinds) {
    return count - static_cast<std::uint32_t>((since[kinds] + ...));
  };
  const Moment at_end = structure_.now();
  return {less(at_end.created, EventKind::cell, EventKind::copy),
          less(at_end.links, EventKind::removal, EventKind::deletion),
          less(at_end.moves, EventKind::move),
          less(at_end.families, EventKind::family),
          less(at_end.copies, EventKind::copy),
          less(at_end.asked, EventKind::degenerate, EventKind::lazy)};
}

void Workspace::carry_out() {
  steps_.emplace_back(structure_.journal().end(), plan_.kind());
  structure_.apply(plan_);
}

Status Workspace::can_take_back(std::uint64_t steps) const {
  if (steps > below_ + steps_.size()) {
    return Error{Errc::refused,
                 fmt::format("cannot undo {} steps: only {} can be undone{}", steps, below_ + steps_.size(),
                             forgotten_ > 0 ? ", as older ones are not kept" : "")};
  }
  if (steps > steps_.size()) {
    return Error{Errc::refused, fmt::format("cannot undo {} steps: of these, {} came before the snapshot that this was "
                                            "read from, and need the steps before it to be done again",
                                            steps, steps - steps_.size())};
  }
  return Done{};
}

Status Workspace::take_back(std::uint64_t steps) {
  if (Status possible = can_take_back(steps); !possible) {
    return possible;
  }
  if (steps > 0) {
    const std::size_t first = steps_.size() - steps;
    structure_.truncate(steps_[first].begin);
    steps_.erase(steps_.end() - static_cast<std::ptrdiff_t>(steps), steps_.end());
  }
  return Done{};
}

void Workspace::forget_oldest_step() {
  ++forgotten_;
  if (below_ > 0) {
    --below_;
    return;
  }
  steps_.pop_front();
  structure_.forget_events_before(steps_.empty() ? structure_.journal().end() : steps_.front().begin);
}

void Workspace::forget_since(Journal::Position position) {
  sparse::expects(steps_.empty() || steps_.back().begin <= position, "only what queries made can be forgotten");
  structure_.truncate(position);
}

void Workspace::begin_with(const Workspace& other) {
  structure_.begin_with(other.structure_,
                        other.steps_.empty() ? other.structure_.forest().links() : other.before(0).links);
  forgotten_ = other.forgotten_ + other.below_ + other.steps_.size();
}

void Workspace::save(sparse::ArchiveWriter& to) const {
  structure_.save(to);
  to.put(below_ + steps_.size());
  to.put(forgotten_);
}

void Workspace::load(sparse::ArchiveReader& from) {
  structure_.load(from);
  below_ = from.get<std::uint64_t>();
  forgotten_ = from.get<std::uint64_t>();
  constexpr std::uint64_t most = std::uint64_t{1} << 56;
  from.check(below_ < most && forgotten_ < most, "steps are counted");
}

}  // namespace sesame::ops

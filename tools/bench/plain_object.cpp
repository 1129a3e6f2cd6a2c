#include "tools/bench/plain_object.hpp"

#include <fmt/format.h>

#include <concepts>
#include <limits>
#include <variant>

namespace sesame::tools {

PlainObject::PlainObject()
    : planner_{structure_, ops::Limits{.cells_of_explicit_cone = std::numeric_limits<std::int64_t>::max()}} {}

Status PlainObject::plan(const ops::Operation& operation) {
  return std::visit(
      [&]<class Op>(const Op& op) -> Status {
        if constexpr (requires { planner_.plan(op, plan_); }) {
          return planner_.plan(op, plan_);
        } else if constexpr (std::same_as<Op, ops::Note>) {
          plan_.clear();
          return Done{};
        } else {
          return Error{Errc::refused,
                       fmt::format("this method takes construction steps, not \"{}\"", ops::keyword(operation))};
        }
      },
      operation);
}

void PlainObject::carry_out() {
  history_.push_back(structure_.mark());
  structure_.apply(plan_);
}

Status PlainObject::take_back(std::uint64_t steps) {
  if (steps > history_.size()) {
    return Error{Errc::refused, fmt::format("cannot undo {} steps: only {} can be undone", steps, history_.size())};
  }
  for (; steps > 0; --steps) {
    structure_.truncate(history_.back());
    history_.pop_back();
  }
  return Done{};
}

}  // namespace sesame::tools

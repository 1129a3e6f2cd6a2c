// Removals of cells from the object.
#include <fmt/format.h>

#include <cstddef>
#include <unordered_set>
#include <vector>

#include "ops/cells/cell_order.hpp"
#include "ops/cells/cofaces.hpp"
#include "ops/plan/operation_plans.hpp"
#include "ops/plan/step_names.hpp"
#include "sparse/quoted.hpp"

namespace sesame::ops {
namespace {

/// The cells that go.
class RemovalPlanner {
 public:
  RemovalPlanner(const Structure& structure, const Limits& limits) : structure_{structure}, limits_{limits} {}

  /// A name may stand for a cell that another one stands for.
  Status add(const std::string& name) {
    const Result<Value> named = resolve_cell(name, structure_);
    if (!named) {
      return named.error();
    }
    if (named->is_degenerate()) {
      return Error{Errc::refused,
                   fmt::format("{} is degenerate, and no cell of its own: it goes when \"{}\" is removed, which it is "
                               "degenerate over",
                               sparse::quoted(name), structure_.name(named->cell))};
    }
    add(named->cell);
    return Done{};
  }

  /// Also what has one of them as a face, and so on. Errors: refused when that is too much.
  Status add_cofaces() {
    for (std::size_t k = 0; k < cells_.size(); ++k) {
      for (const CellId coface : cofaces(structure_, cells_[k])) {
        add(coface);
      }
      if (static_cast<std::int64_t>(cells_.size()) > limits_.cells_per_step) {
        return Error{Errc::refused, fmt::format("this step would remove more than {} cells, the limit for one step",
                                                limits_.cells_per_step)};
      }
    }
    return Done{};
  }

  /// Errors: refused when a cell has a coface that stays.
  [[nodiscard]] Status check_cofaces() const {
    for (const CellId cell : cells_) {
      for (const CellId coface : cofaces(structure_, cell)) {
        if (!known_.contains(coface)) {
          return Error{Errc::refused,
                       fmt::format("\"{}\" is a face of \"{}\", which would stay: remove that too, or say "
                                   "\"cofaces\":true",
                                   structure_.name(cell), structure_.name(coface))};
        }
      }
    }
    return Done{};
  }

  /// Each after those that have it as a face.
  void write(Plan& plan) {
    sort_by_dimension_and_age(structure_, cells_);
    plan.deletions.assign(cells_.rbegin(), cells_.rend());
    for (const CellId cell : plan.deletions) {
      if (structure_.abstract().contains(cell) && structure_.bodies().kind(structure_.body_of(cell)).is_abstract) {
        if (!plan.abstract) {
          plan.abstract.emplace();
        }
        plan.abstract->excluded.push_back(cell);
      }
    }
  }

 private:
  void add(CellId cell) {
    if (known_.insert(cell).second) {
      cells_.push_back(cell);
    }
  }

  const Structure& structure_;
  const Limits& limits_;
  std::vector<CellId> cells_;
  std::unordered_set<CellId> known_;  ///< the same
};

}  // namespace

Status plan_removal(const Remove& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  RemovalPlanner planner(structure, limits);
  for (const std::string& name : operation.cells) {
    if (Status added = planner.add(name); !added) {
      return added;
    }
  }
  if (Status closed = operation.cofaces ? planner.add_cofaces() : planner.check_cofaces(); !closed) {
    return closed;
  }
  planner.write(plan);
  return Done{};
}

}  // namespace sesame::ops

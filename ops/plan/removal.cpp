// Removals of cells from the object.
#include <fmt/format.h>

#include <cstddef>
#include <unordered_set>
#include <utility>
#include <vector>

#include "ops/cells/cofaces.hpp"
#include "ops/cells/cone_parts.hpp"
#include "ops/plan/operation_plans.hpp"
#include "ops/plan/step_names.hpp"
#include "ops/plan/taken_cells.hpp"
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
    if (known_.insert(named->cell).second) {
      cells_.push_back(named->cell);
    }
    return Done{};
  }

  /// Also what has one of them as a face, and so on. Errors: refused when that is too much.
  Status add_cofaces() {
    auto star = open_star(structure_, std::move(cells_), static_cast<std::size_t>(limits_.cells_per_step));
    if (!star) {
      return Error{Errc::refused, fmt::format("this step would remove more than {} cells, the limit for one step",
                                              limits_.cells_per_step)};
    }
    cells_ = *std::move(star);
    known_.insert(cells_.begin(), cells_.end());
    return Done{};
  }

  /// A cell that is no ball goes with its parts. Errors: refused when a part was named, and not the cell.
  Status add_parts(bool are_whole_stars) {
    for (std::size_t k = 0; k < cells_.size(); ++k) {
      const CellId cell = cells_[k];
      if (is_cone_part(structure_.cells().type(cell).type)) {
        const CellId whole = whole_of_part(structure_, cell);
        if (!are_whole_stars && !known_.contains(whole)) {
          return Error{Errc::refused, fmt::format("\"{}\" is a part of \"{}\", which is no ball: remove that",
                                                  structure_.name(cell), structure_.name(whole))};
        }
        if (known_.insert(whole).second) {
          cells_.push_back(whole);
        }
      }
      for (const CellId part : cone_parts(structure_, cell)) {
        if (known_.insert(part).second) {
          cells_.push_back(part);
        }
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

  void write(Plan& plan) { add_deletions(std::move(cells_), structure_, plan); }

 private:
  const Structure& structure_;
  const Limits& limits_;
  std::vector<CellId> cells_;
  std::unordered_set<CellId> known_;  ///< those named
};

}  // namespace

Status plan_removal(const Remove& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  RemovalPlanner planner(structure, limits);
  for (const std::string& name : operation.cells) {
    if (Status added = planner.add(name); !added) {
      return added;
    }
  }
  if (Status closed = operation.cofaces ? Status{Done{}} : planner.add_parts(false); !closed) {
    return closed;
  }
  if (Status closed = operation.cofaces ? planner.add_cofaces() : planner.check_cofaces(); !closed) {
    return closed;
  }
  if (Status closed = operation.cofaces ? planner.add_parts(true) : Status{Done{}}; !closed) {
    return closed;
  }
  planner.write(plan);
  return Done{};
}

}  // namespace sesame::ops

// Local operations on cells of maps: what they replace.
#include "ops/maps/cell_surgery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "ops/cells/name_text.hpp"
#include "ops/plan/operation_plans.hpp"
#include "ops/plan/rewired_cells.hpp"
#include "ops/plan/sewing.hpp"
#include "ops/plan/step_names.hpp"
#include "sparse/quoted.hpp"

namespace sesame::ops {
namespace {

using sparse::quoted;

/// A dart of a map by cells.
Result<NamedDart> dart_by_cells(const std::string& name, const Structure& structure) {
  Result<NamedDart> dart = dart_named(name, structure);
  if (dart && structure.darts().map_of(dart->dimension, dart->dart).is_by_simplices) {
    return Error{Errc::refused,
                 fmt::format("{} is a dart of a map by simplices, of which no cell is one of the object: "
                             "make the map without \"as\":\"simplices\"",
                             quoted(name))};
  }
  return dart;
}

/// A cell of a map, by a dart of it.
struct CellOfMap {
  int i;
  NamedDart dart;
};

/// "m.1:3", or "p", the face of a polygon.
Result<CellOfMap> cell_named(const std::string& name, const Structure& structure) {
  const auto split = split_dart(name);
  const std::string map = split ? name.substr(0, split->length) : name;
  const DartStore::Made* made = map_named(structure, map);
  const CellId face = made != nullptr && !split ? structure.directory().names()[made->name].cell : CellId{none};
  if (made == nullptr || (!split && face == none)) {
    return Error{Errc::unknown_name, fmt::format("there is no cell {} of a map: the i-cell of dart k of the map m is "
                                                 "called m.i:k",
                                                 quoted(name))};
  }
  const Result<NamedDart> dart =
      dart_by_cells(split ? fmt::format("{}:{}", map, split->dart) : fmt::format("{}:0", map), structure);
  if (!dart) {
    return dart.error();
  }
  const int i = split ? split->dimension : structure.dimension(face);
  if (i > made->dimension) {
    return Error{Errc::unknown_name, fmt::format("there is no cell {}: the map {} has dimension {}", quoted(name),
                                                 quoted(map), made->dimension)};
  }
  return CellOfMap{i, *dart};
}

DartView view_of(int dimension, const Structure& structure) {
  return {dimension, structure.darts().darts(dimension),
          [&structure, dimension](int i, Dart d) { return structure.darts().alpha(dimension, i, d); },
          [&structure, dimension](Dart d) { return quoted(name_of_dart(dimension, d, structure)); }};
}

std::string name_of_cell(const std::string& map, int i, const std::string& dart) {
  return fmt::format("{}.{}:{}", map, i, dart);
}

/// The cells that take the place of others, and what becomes of the darts. `new_map`: the name of that of new darts.
Status replace_cells(int dimension, int i, const CellSurgery& surgery, const std::string& new_map,
                     const Structure& structure, const Limits& limits, Plan& plan) {
  const RewiredMap map(structure.darts(), dimension, surgery);
  const auto name = [&](int of, Dart d) {
    if (map.is_made(d)) {
      return name_of_cell(new_map, of, std::to_string(d - map.first_made()));
    }
    const DartStore::Made& made = structure.darts().map_of(dimension, d);
    return name_of_cell(structure.directory().names()[made.name].text, of, dart_text(made, d - made.first));
  };
  if (Status s = RewiredCells(map, structure, name, plan).run(); !s) {
    return s;
  }
  map.write(i, plan);
  return check_room(static_cast<std::int64_t>(plan.cells.size()), structure, limits);
}

using TakeOut = Result<CellSurgery> (*)(const DartView&, int, Dart);

Status plan_without(const std::string& name, TakeOut take_out, const Structure& structure, const Limits& limits,
                    Plan& plan) {
  const Result<CellOfMap> cell = cell_named(name, structure);
  if (!cell) {
    return cell.error();
  }
  const auto& [i, dart] = *cell;
  const Result<CellSurgery> surgery = take_out(view_of(dart.dimension, structure), i, dart.dart);
  return surgery ? replace_cells(dart.dimension, i, *surgery, {}, structure, limits, plan) : surgery.error();
}

/// A cell of new darts, which are a map of their own.
template <class Op>
class NewCellPlanner {
 public:
  using PutIn = Result<CellSurgery> (*)(const DartView&, int, std::span<const Dart>);

  NewCellPlanner(const Op& operation, const Structure& structure, const Limits& limits, Plan& plan)
      : operation_{operation}, structure_{structure}, limits_{limits}, plan_{plan} {}

  Status run(PutIn put_in) {
    if (Status s = read_darts(); !s) {
      return s;
    }
    const Result<CellSurgery> surgery = put_in(view_of(dimension_, structure_), operation_.dimension, darts_);
    if (!surgery) {
      return surgery.error();
    }
    if (Status s = check_names(surgery->made); !s) {
      return s;
    }
    if (Status s =
            replace_cells(dimension_, operation_.dimension, *surgery, operation_.name, structure_, limits_, plan_);
        !s) {
      return s;
    }
    if (operation_.at && (plan_.cells.empty() || structure_.types().info(plan_.cells[0].type).dimension != 0)) {
      return Error{Errc::bad_input, fmt::format("\"{}\" makes no new vertex: leave \"at\" out", operation_.name)};
    }
    plan_.new_body = operation_.name;
    plan_.joined_bodies.push_back(structure_.bodies().size());
    return Done{};
  }

 private:
  Status read_darts() {
    for (const std::string& name : operation_.darts) {
      const Result<NamedDart> dart = dart_by_cells(name, structure_);
      if (!dart) {
        return dart.error();
      }
      if (!darts_.empty() && dart->dimension != dimension_) {
        return Error{Errc::refused, fmt::format("{} is a dart of a map of dimension {}, those before it of dimension "
                                                "{}: list darts of maps of one dimension",
                                                quoted(name), dart->dimension, dimension_)};
      }
      dimension_ = dart->dimension;
      darts_.push_back(dart->dart);
    }
    return darts_.empty() ? Status{Error{Errc::bad_input, "there is no dart to say where: list one at least"}}
                          : Status{Done{}};
  }

  /// Any new dart may name its cells.
  Status check_names(Dart made) const {
    if (Status s = check_new_name(operation_.name, structure_); !s) {
      return s;
    }
    for (int i = 0; i <= dimension_; ++i) {
      for (Dart d = 0; d < made; ++d) {
        if (const std::string full = name_of_cell(operation_.name, i, std::to_string(d));
            structure_.is_name_taken(full)) {
          return Error{Errc::bad_input,
                       fmt::format("the name \"{}\" is in use, so \"{}\" cannot name new darts: choose another", full,
                                   operation_.name)};
        }
      }
    }
    return Done{};
  }

  const Op& operation_;
  const Structure& structure_;
  const Limits& limits_;
  Plan& plan_;
  int dimension_ = 0;
  std::vector<Dart> darts_;
};

}  // namespace

Status plan_surgery(const RemoveCell& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  return plan_without(operation.cell, removal_of_cell, structure, limits, plan);
}

Status plan_surgery(const ContractCell& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  return plan_without(operation.cell, contraction_of_cell, structure, limits, plan);
}

Status plan_surgery(const InsertCell& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  return NewCellPlanner<InsertCell>(operation, structure, limits, plan).run(insertion_of_cell);
}

Status plan_surgery(const SplitCell& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  return NewCellPlanner<SplitCell>(operation, structure, limits, plan).run(splitting_of_cell);
}

}  // namespace sesame::ops

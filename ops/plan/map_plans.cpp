// Maps by their cells, or by the simplices of their simplicial analogue.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ops/cells/map_cells.hpp"
#include "ops/maps/map_conversions.hpp"
#include "ops/maps/rooted_map.hpp"
#include "ops/plan/analogue_writer.hpp"
#include "ops/plan/layers_writer.hpp"
#include "ops/plan/new_cells.hpp"
#include "ops/plan/operation_plans.hpp"
#include "ops/plan/step_names.hpp"

namespace sesame::ops {
namespace {

/// A map that is to be made, and as what.
struct Wanted {
  const std::string& name;
  const GMap& map;
  Dart halves;  ///< of an n-map, as in DartStore
  bool is_polygon;
  std::size_t points;  ///< that are given for its vertices

  [[nodiscard]] std::string dart(Dart d) const {
    return halves != 0 && d >= halves ? fmt::format("{}'", d - halves) : std::to_string(d);
  }
};

/// Either no vertex has a position, or each.
Status check_points(const Wanted& wanted) {
  const std::size_t vertices = wanted.points == 0 ? 0 : cells(wanted.map, 0).count();
  return vertices == wanted.points
             ? Status{Done{}}
             : Error{Errc::bad_input, fmt::format("\"{}\" has {} vertices, but {} points in \"at\": it should have one "
                                                  "for each, in the order of their least darts",
                                                  wanted.name, vertices, wanted.points)};
}

/// Are the names of all cells of a map free, from whichever dart?
Status check_names(const Wanted& wanted, const Structure& structure) {
  const auto& [name, map, halves, is_polygon, points] = wanted;
  if (Status s = check_new_name(name, structure); !s) {
    return s;
  }
  std::string full = name + ".";
  const std::size_t base = full.size();
  // What ends in "'" looks like no name of a face.
  if ((halves == 0 && !structure.directory().may_have_faces_named(name)) ||
      is_free_beginning(full, structure, map.size())) {
    return Done{};
  }
  for (int i = 0; i <= map.dimension(); ++i) {
    for (Dart d = 0; d < map.size(); ++d) {
      full.replace(base, std::string::npos, fmt::format("{}:{}", i, wanted.dart(d)));
      if (structure.is_name_taken(full)) {
        return Error{
            Errc::bad_input,
            fmt::format("the name \"{}\" is in use, so \"{}\" cannot name a new map: choose another", full, name)};
      }
    }
  }
  return Done{};
}

/// What i-sewing glues: the simplices with all numbers but i.
std::shared_ptr<const DartCells> sides(const GMap& map, const AnalogueWriter& simplices, CellId first) {
  auto cells = std::make_shared<DartCells>();
  for (int i = 0; i <= map.dimension(); ++i) {
    const IndexSet without = map.indices() & ~(IndexSet{1} << i);
    cells->of.emplace_back();
    for (Dart d = 0; d < map.size() && without != 0; ++d) {
      cells->of.back().push_back({simplices.simplex(without, d) - first, 0});
    }
  }
  return cells;
}

Status plan_by_simplices(const Wanted& wanted, const Structure& structure, const Limits& limits, Plan& plan) {
  const GMap& map = wanted.map;
  AnalogueWriter writer(wanted.name,
                        {map.dimension(), [&](IndexSet set) { return orbits(map, map.indices() & ~set); },
                         [](Dart d, int, int) { return d; }, [&](Dart d) { return wanted.dart(d); }},
                        structure, plan);
  if (Status s = writer.write(limits); !s) {
    return s;
  }
  plan.map = {map, sides(map, writer, plan.first), true, wanted.halves};
  plan.new_body = wanted.name;
  return Done{};
}

/// The type over which a map is one standard cell, so that all maps like it share what is known of its faces; or none.
/// That of a cell whose darts are numbered as its type has them.
TypeId standard_type(const Wanted& wanted, TypeTable& types) {
  const GMap& map = wanted.map;
  const int n = map.dimension();
  if (wanted.halves != 0 || n < 2) {
    return none;
  }
  for (Dart d = 0; d < map.size(); ++d) {
    if (!map.is_free(n, d)) {
      return none;
    }
  }
  const GMap boundary = map.restricted(n - 1);
  if (const auto order = darts_from(boundary, 0); order.size() != map.size() || !std::ranges::is_sorted(order)) {
    return none;
  }
  const TypeId type = types.cell_over(boundary);
  return type != none && types.canonical(type).type == type && types.canonical(type).root == 0 ? type : TypeId{none};
}

Status plan_by_cells(const Wanted& wanted, const Structure& structure, const Limits& limits, Plan& plan) {
  if (const TypeId type = standard_type(wanted, structure.types()); type != none) {
    const StandardCell& standard = structure.types().standard(type);
    if (Status s = check_room(static_cast<std::int64_t>(standard.cells.size()), structure, limits); !s) {
      return s;
    }
    write_standard(wanted.name, type, structure, plan);
    plan.map = {wanted.map, standard.darts};
    if (!wanted.is_polygon) {  // whose face is called as it is
      plan.standard = none;
      for (std::size_t k = 0; k < standard.cells.size(); ++k) {
        plan.names.append(wanted.name).append(1, '.').append(standard.cells[k].suffix);
        plan.cells[k].name_end = plan.names.size();
      }
    }
    return Done{};
  }
  const Result<std::vector<CellsOfMap>> layers = cells_of_map(wanted.map, structure.types(), true);
  if (!layers) {
    return Error{layers.error().code,
                 fmt::format("{}: make \"{}\" \"as\":\"simplices\"", layers.error().what, wanted.name)};
  }
  auto cells = write_layers(
      wanted.name, *layers, [&](Dart d) { return wanted.dart(d); }, structure, limits, plan);
  if (!cells) {
    return cells.error();
  }
  plan.map = {wanted.map, std::move(*cells), false, wanted.halves};
  plan.new_body = wanted.name;
  return Done{};
}

Status plan_map(const Wanted& wanted, bool as_simplices, const Structure& structure, const Limits& limits, Plan& plan) {
  if (wanted.map.size() == 0) {
    return Error{Errc::bad_input, fmt::format("\"{}\" has no darts: a map needs one at least", wanted.name)};
  }
  if (Status s = check_points(wanted); !s) {
    return s;
  }
  if (Status s = check_names(wanted, structure); !s) {
    return s;
  }
  return as_simplices ? plan_by_simplices(wanted, structure, limits, plan)
                      : plan_by_cells(wanted, structure, limits, plan);
}

}  // namespace

Status plan_map(const MakeGMap& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  const Result<GMap> map = GMap::make(operation.alpha);
  return map ? plan_map({operation.name, *map, 0, false, operation.at.size()}, operation.as_simplices, structure,
                        limits, plan)
             : Error{map.error().code, fmt::format("\"{}\" is no G-map: {}", operation.name, map.error().what)};
}

Status plan_map(const MakeMap& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  const Result<NMap> map = NMap::make(operation.beta);
  return map ? plan_map({operation.name, to_gmap(*map), map->size(), false, operation.at.size()},
                        operation.as_simplices, structure, limits, plan)
             : Error{map.error().code, fmt::format("\"{}\" is no map: {}", operation.name, map.error().what)};
}

Status plan_polygon(const MakePolygon& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  const auto& [name, sides, as_simplices, at] = operation;
  if (sides < 1) {
    return Error{Errc::bad_input, fmt::format("\"{}\" has {} sides: a polygon has 1 at least", name, sides)};
  }
  if (Status s = check_room(2 * std::int64_t{sides} + 1, structure, limits); !s) {
    return s;
  }
  const GMap map = polygon(static_cast<Dart>(sides));
  const Wanted wanted{name, map, 0, true, at.size()};
  if (Status s = check_points(wanted); !s) {
    return s;
  }
  if (Status s = check_names(wanted, structure); !s) {
    return s;
  }
  return as_simplices ? plan_by_simplices(wanted, structure, limits, plan)
                      : plan_by_cells(wanted, structure, limits, plan);
}

}  // namespace sesame::ops

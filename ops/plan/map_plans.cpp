// Maps by their cells, or by the simplices of their simplicial analogue.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ops/cells/map_cells.hpp"
#include "ops/maps/map_conversions.hpp"
#include "ops/plan/cone_cells.hpp"
#include "ops/plan/new_cells.hpp"
#include "ops/plan/operation_plans.hpp"
#include "ops/plan/step_names.hpp"

namespace sesame::ops {
namespace {

/// A map that is to be made, and as what.
struct Wanted {
  const std::string& name;
  const GMap& map;
  Dart halves;         ///< of an n-map, as in DartStore
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
  const auto& [name, map, halves, points] = wanted;
  if (Status s = check_new_name(name, structure); !s) {
    return s;
  }
  std::string full = name + ".";
  const std::size_t base = full.size();
  if (is_free_beginning(full, structure, map.size())) {
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

/// Writes the cells of a map, layer by layer.
class CellsWriter {
 public:
  CellsWriter(const Wanted& wanted, const std::vector<CellsOfMap>& layers, const Structure& structure, Plan& plan)
      : wanted_{wanted}, layers_{layers}, structure_{structure}, plan_{plan} {}

  /// Errors: bad_input, when the name of a part is in use.
  Result<std::shared_ptr<const DartCells>> write() {
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      nodes_.emplace_back();
      for (std::uint32_t c = 0; c < layers_[i].orbits.count(); ++c) {
        if (layers_[i].types[c] != none) {
          write_ball(i, c);
        } else if (Status s = write_cone(i, c); !s) {
          return s.error();
        }
        nodes_.back().push_back(plan_.first + (plan_.cells.size() - 1));
      }
    }
    auto cells = std::make_shared<DartCells>();
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      cells->of.emplace_back();
      for (Dart d = 0; d < layers_[i].places.size(); ++d) {
        cells->of.back().push_back({nodes_[i][layers_[i].orbits.of[d]] - plan_.first, layers_[i].places[d]});
      }
    }
    return std::shared_ptr<const DartCells>(std::move(cells));
  }

 private:
  [[nodiscard]] std::string name_of(std::size_t i, std::uint32_t c) const {
    return fmt::format("{}.{}:{}", wanted_.name, i, wanted_.dart(layers_[i].roots[c]));
  }

  void write_ball(std::size_t i, std::uint32_t c) {
    const std::size_t first_face = plan_.faces.size();
    for (const auto& [cell, dart] : layers_[i].faces_of(c)) {
      add_face({nodes_[i - 1][cell], structure_.maps().order_at(layers_[i - 1].types[cell], dart)}, plan_);
    }
    plan_.names += name_of(i, c);
    add_cell(layers_[i].types[c], first_face, plan_);
  }

  Status write_cone(std::size_t i, std::uint32_t c) {
    const ConeShape& shape = *layers_[i].cones.at(c);
    if (Status s = check_part_names(shape, name_of(i, c), structure_); !s) {
      return s;
    }
    std::vector<Dart> dart_at(layers_[i].places.size(), no_dart);  // by place in the canonical boundary
    for (Dart d = 0; d < layers_[i].places.size(); ++d) {
      if (layers_[i].orbits.of[d] == c) {
        dart_at[layers_[i].places[d]] = d;
      }
    }
    const auto face_at = [&](int q, Dart place) -> Result<SeenFace> {
      const CellsOfMap& layer = layers_[static_cast<std::size_t>(q)];
      const Dart d = dart_at[place];
      const std::uint32_t cell = layer.orbits.of[d];
      const TypeId type = layer.types[cell];
      return SeenFace{{nodes_[static_cast<std::size_t>(q)][cell], structure_.maps().order_at(type, layer.places[d])},
                      structure_.types().seen_from(type, layer.places[d])};
    };
    return add_cone_cell(shape, name_of(i, c), structure_.types(), face_at, plan_);
  }

  const Wanted& wanted_;
  const std::vector<CellsOfMap>& layers_;
  const Structure& structure_;
  Plan& plan_;
  std::vector<std::vector<CellId>> nodes_;  ///< by dimension and cell
};

/// The simplices of the simplicial analogue: one for each set of numbers I and each orbit of the involutions whose
/// numbers it has not. Face k is that of the set without its k-th number.
class AnalogueWriter {
 public:
  AnalogueWriter(const Wanted& wanted, const Structure& structure, Plan& plan)
      : wanted_{wanted},
        map_{wanted.map},
        structure_{structure},
        plan_{plan},
        first_(std::size_t{1} << (wanted.map.dimension() + 1)),
        orbits_(first_.size()) {}

  std::shared_ptr<const DartCells> write() {
    for (int size = 1; size <= map_.dimension() + 1; ++size) {
      for (IndexSet set = 1; set <= map_.indices(); ++set) {
        if (__builtin_popcountll(set) == size) {
          write_simplices(set, size);
        }
      }
    }
    auto cells = std::make_shared<DartCells>();
    for (int i = 0; i <= map_.dimension(); ++i) {  // what i-sewing glues
      const IndexSet without = map_.indices() & ~(IndexSet{1} << i);
      cells->of.emplace_back();
      for (Dart d = 0; d < map_.size() && without != 0; ++d) {
        cells->of.back().push_back({simplex(without, d) - plan_.first, 0});
      }
    }
    return cells;
  }

 private:
  [[nodiscard]] CellId simplex(IndexSet set, Dart d) const { return first_[set] + orbits_[set].of[d]; }

  void write_simplices(IndexSet set, int size) {
    std::vector<int> numbers;
    for (int i = 0; i <= map_.dimension(); ++i) {
      if ((set >> i & 1U) != 0) {
        numbers.push_back(i);
      }
    }
    first_[set] = plan_.first + plan_.cells.size();
    orbits_[set] = orbits(map_, map_.indices() & ~set);
    const TypeId type = structure_.types().simplex(size - 1);
    for (const Dart d : orbits_[set].first) {
      const std::size_t first_face = plan_.faces.size();
      for (int k = 0; k < size && size > 1; ++k) {
        add_face({simplex(set & ~(IndexSet{1} << numbers[static_cast<std::size_t>(k)]), d), same_order}, plan_);
      }
      fmt::format_to(std::back_inserter(plan_.names), "{}.<{}>:{}", wanted_.name, fmt::join(numbers, "-"),
                     wanted_.dart(d));
      add_cell(type, first_face, plan_);
    }
  }

  const Wanted& wanted_;
  const GMap& map_;
  const Structure& structure_;
  Plan& plan_;
  std::vector<CellId> first_;   ///< per set of numbers: the first of its simplices
  std::vector<Orbits> orbits_;  ///< and which one each dart is in
};

std::int64_t count_of_analogue(const GMap& map) {
  std::int64_t count = 0;
  for (IndexSet set = 1; set <= map.indices(); ++set) {
    count += orbits(map, map.indices() & ~set).count();
  }
  return count;
}

Status plan_by_simplices(const Wanted& wanted, const Structure& structure, const Limits& limits, Plan& plan) {
  if (Status s = check_room(count_of_analogue(wanted.map), structure, limits); !s) {
    return s;
  }
  plan.first = structure.cells().size();
  plan.map = {wanted.map, AnalogueWriter(wanted, structure, plan).write(), true, wanted.halves};
  plan.new_body = wanted.name;
  return Done{};
}

Status plan_by_cells(const Wanted& wanted, const Structure& structure, const Limits& limits, Plan& plan) {
  const Result<std::vector<CellsOfMap>> layers = cells_of_map(wanted.map, structure.types(), true);
  if (!layers) {
    return Error{layers.error().code,
                 fmt::format("{}: make \"{}\" \"as\":\"simplices\"", layers.error().what, wanted.name)};
  }
  std::int64_t count = 0;
  for (const CellsOfMap& layer : *layers) {
    count += layer.orbits.count();
    for (const auto& [cell, shape] : layer.cones) {
      count += static_cast<std::int64_t>(shape->generators.size()) - 1;
    }
  }
  if (Status s = check_room(count, structure, limits); !s) {
    return s;
  }
  plan.first = structure.cells().size();
  const auto cells = CellsWriter(wanted, *layers, structure, plan).write();
  if (!cells) {
    return cells.error();
  }
  plan.map = {wanted.map, *cells, false, wanted.halves};
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
  return map ? plan_map({operation.name, *map, 0, operation.at.size()}, operation.as_simplices, structure, limits, plan)
             : Error{map.error().code, fmt::format("\"{}\" is no G-map: {}", operation.name, map.error().what)};
}

Status plan_map(const MakeMap& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  const Result<NMap> map = NMap::make(operation.beta);
  return map ? plan_map({operation.name, to_gmap(*map), map->size(), operation.at.size()}, operation.as_simplices,
                        structure, limits, plan)
             : Error{map.error().code, fmt::format("\"{}\" is no map: {}", operation.name, map.error().what)};
}

/// By the standard cell of its type, which all polygons with as many sides share.
Status plan_polygon(const MakePolygon& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  const auto& [name, sides, as_simplices, at] = operation;
  if (sides < 1) {
    return Error{Errc::bad_input, fmt::format("\"{}\" has {} sides: a polygon has 1 at least", name, sides)};
  }
  if (Status s = check_room(2 * std::int64_t{sides} + 1, structure, limits); !s) {
    return s;
  }
  const GMap map = polygon(static_cast<Dart>(sides));
  const Wanted wanted{name, map, 0, at.size()};
  if (Status s = check_points(wanted); !s) {
    return s;
  }
  if (Status s = check_names(wanted, structure); !s) {
    return s;
  }
  if (as_simplices) {
    return plan_by_simplices(wanted, structure, limits, plan);
  }
  const TypeId type = structure.types().cell_over(map.restricted(1));
  write_standard(name, type, structure, plan);
  plan.map = {map, structure.types().standard(type).darts};
  return Done{};
}

}  // namespace sesame::ops

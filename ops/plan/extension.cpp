// Cells over whole maps.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ops/cells/map_cells.hpp"
#include "ops/maps/orbits.hpp"
#include "ops/maps/rooted_map.hpp"
#include "ops/plan/cone_cells.hpp"
#include "ops/plan/extended_simplices.hpp"
#include "ops/plan/new_cells.hpp"
#include "ops/plan/operation_plans.hpp"
#include "ops/plan/sewing.hpp"
#include "sparse/contract.hpp"
#include "sparse/quoted.hpp"

namespace sesame::ops {
namespace {

class ExtensionPlanner {
 public:
  ExtensionPlanner(const Structure& structure, Plan& plan)
      : structure_{structure}, store_{structure.darts()}, plan_{plan} {}

  Status run(const Extend& operation, const Limits& limits) {
    for (const std::string& name : operation.maps) {
      if (Status s = add_map(name); !s) {
        return s;
      }
    }
    if (maps_.empty()) {
      return Error{Errc::bad_input, "there is no map to extend: list one at least"};
    }
    add_what_is_sewn();
    if (Status s = gather(); !s) {
      return s;
    }
    if (are_by_simplices_) {
      return extend_simplices(gathered_, structure_, limits, plan_);
    }
    places_.assign(darts_.size(), 0);
    if (Status s = check_names(); !s) {
      return s;
    }
    plan_.first = structure_.cells().size();
    const Orbits all = components(map_);
    for (const Dart first : all.first) {
      if (Status s = add_cell_over(first); !s) {
        return s;
      }
      new_cells_.push_back(static_cast<std::uint32_t>(plan_.cells.size() - 1));
    }
    join_bodies(bodies_, plan_);
    write_darts(all);
    return Done{};
  }

 private:
  Status add_map(const std::string& name) {
    const DartStore::Made* map = map_named(structure_, name);
    if (map == nullptr) {
      return Error{Errc::unknown_name, fmt::format("there is no map {}", sparse::quoted(name))};
    }
    if (map->has_levels()) {
      return Error{Errc::refused, fmt::format("\"{}\" is a chain of cells with all levels that it has, and cannot be "
                                              "extended: make it with one level more",
                                              name)};
    }
    if (!maps_.empty() && map->dimension != dimension_) {
      return Error{Errc::refused, fmt::format("\"{}\" has dimension {}, and the maps before it {}: extend maps of one "
                                              "dimension",
                                              name, map->dimension, dimension_)};
    }
    if (!maps_.empty() && map->is_by_simplices != are_by_simplices_) {
      return Error{Errc::refused, fmt::format("\"{}\" is a map by {}, and those before it are by {}: extend them one "
                                              "after the other",
                                              name, map->is_by_simplices ? "simplices" : "cells",
                                              map->is_by_simplices ? "cells" : "simplices")};
    }
    if (map->dimension == largest_map_dimension) {
      return Error{Errc::refused, fmt::format("\"{}\" has dimension {}, the largest", name, map->dimension)};
    }
    dimension_ = map->dimension;
    are_by_simplices_ = map->is_by_simplices;
    maps_.insert(store_.number_of_map(dimension_, map->first));
    return Done{};
  }

  void add_what_is_sewn() {
    std::vector<std::uint32_t> pending(maps_.begin(), maps_.end());
    while (!pending.empty()) {
      const DartStore::Made& map = store_.map(pending.back());
      pending.pop_back();
      for (Dart d = map.first; d < map.first + map.count; ++d) {
        for (int i = 0; i <= dimension_; ++i) {
          const std::uint32_t other = store_.number_of_map(dimension_, store_.alpha(dimension_, i, d));
          if (maps_.insert(other).second) {
            pending.push_back(other);
          }
        }
      }
    }
  }

  [[nodiscard]] bool is_there(Dart d) const { return !store_.taken_out_with(dimension_, d); }

  /// All of those maps as one, without the darts that were taken out of them.
  Status gather() {
    std::unordered_map<Dart, Dart> number;
    for (const std::uint32_t of : maps_) {
      const DartStore::Made& map = store_.map(of);
      for (Dart d = map.first; d < map.first + map.count; ++d) {
        if (is_there(d)) {
          number.emplace(d, static_cast<Dart>(darts_.size()));
          darts_.push_back(d);
        }
      }
    }
    if (darts_.empty()) {
      return Error{Errc::refused, fmt::format("no dart of \"{}\" is left: there is nothing to extend",
                                              structure_.directory().names()[store_.map(*maps_.begin()).name].text)};
    }
    std::vector<std::vector<Dart>> alpha(static_cast<std::size_t>(dimension_) + 1);
    for (int i = 0; i <= dimension_; ++i) {
      for (const Dart d : darts_) {
        alpha[static_cast<std::size_t>(i)].push_back(number.at(store_.alpha(dimension_, i, d)));
      }
    }
    Result<GMap> map = GMap::make(std::move(alpha));
    sparse::expects(map.has_value(), "maps that are sewn are a map");
    map_ = std::move(*map);
    return Done{};
  }

  [[nodiscard]] const DartStore::Made& made(Dart local) const { return store_.map_of(dimension_, darts_[local]); }
  [[nodiscard]] std::string name(Dart local) const { return name_of_dart(dimension_, darts_[local], structure_); }

  /// All darts of the new cells name them.
  Status check_names() const {
    for (Dart local = 0; local < darts_.size(); ++local) {
      const std::string cell = cell_name(local);
      if (structure_.is_name_taken(cell)) {
        return Error{Errc::bad_input, fmt::format("the name \"{}\" is in use, and would be one of the new cell", cell)};
      }
    }
    return Done{};
  }
  [[nodiscard]] std::string cell_name(Dart local) const {
    return fmt::format("{}.{}:{}", structure_.directory().names()[made(local).name].text, dimension_ + 1,
                       dart_text(made(local), darts_[local] - made(local).first));
  }

  /// Cells may have been split, and then do not meet as the darts say.
  Status check_laws(const TypeInfo& info, const std::vector<Value>& faces, Dart first) const {
    for (const auto& [one, of_one, other, of_other, dart] : info.laws) {
      const Value seen_from_one = structure_.values().face(faces[one], of_one);
      const Value seen_from_other = structure_.values().face(faces[other], of_other);
      if (!(seen_from_one == structure_.maps().seen_from(dart, seen_from_other))) {
        return Error{
            Errc::refused,
            fmt::format("what \"{}\" belongs to has been split, and not by unsewing: \"{}\" and \"{}\" should "
                        "be one cell",
                        name(first), structure_.name(seen_from_one.cell), structure_.name(seen_from_other.cell))};
      }
    }
    return Done{};
  }

  /// The cell over a component.
  Status add_cell_over(Dart first) {
    TypeTable& types = structure_.types();
    const std::vector<Dart> order = darts_from(map_, first);
    for (const Dart d : order) {
      for (int i = 0; i <= dimension_; ++i) {
        if (map_.is_free(i, d)) {
          return Error{Errc::refused,
                       fmt::format("\"{}\" is {}-free, so what it belongs to is open and bounds no cell: sew "
                                   "it first",
                                   name(d), i)};
        }
      }
    }
    const TypeId as_seen = types.cell_over(restricted_to(map_, order, dimension_));
    if (as_seen == none) {
      return add_cone_over(first);
    }
    const TypeTable::Canonical canonical = types.canonical(as_seen);
    const TypeInfo& info = types.info(canonical.type);
    std::vector<Value> faces(info.faces.size());
    Dart root = no_dart;
    for (Dart k = 0; k < order.size(); ++k) {
      const Dart place = types.dart_from(canonical.type, canonical.root, k);
      places_[order[k]] = place;
      if (place == 0) {
        root = std::min(root, order[k]);
      }
      const CellShape::Place of_face = types.place_in_face(canonical.type, place);
      if (of_face.dart == 0) {
        const Result<Value> face = seen_now(dimension_, dimension_, darts_[order[k]], structure_);
        if (!face) {
          return face.error();
        }
        faces[of_face.face] = *face;
        bodies_.insert(structure_.body_of(face->cell));
      }
    }
    if (Status s = check_laws(info, faces, first); !s) {
      return s;
    }
    const std::size_t first_face = plan_.faces.size();
    for (const Value& face : faces) {
      add_face(structure_.values().incidence_of(face), plan_);
    }
    plan_.names += cell_name(root);
    add_cell(canonical.type, first_face, plan_);
    return Done{};
  }

  /// The same where that is no ball.
  Status add_cone_over(Dart first) {
    const std::vector<Dart> order = darts_from(map_, first);
    if (dimension_ + 1 < least_cone_dimension) {
      return Error{Errc::refused, fmt::format("the cell over what \"{}\" belongs to is no ball, as that has not the "
                                              "homology of a sphere: make it \"as\":\"simplices\", with one involution "
                                              "more",
                                              name(first))};
    }
    for (const Dart d : order) {
      const Result<Value> largest = seen_now(dimension_, dimension_, darts_[d], structure_);
      if (!largest) {
        return largest.error();
      }
      if (is_cone(structure_.cells().type(largest->cell).type)) {
        return Error{Errc::refused,
                     fmt::format("what \"{}\" belongs to has a cell that is no ball, the {}-cell of \"{}\": "
                                 "only cells of the largest dimension may be none",
                                 name(first), dimension_, name(d))};
      }
    }
    const GMap seen = restricted_to(map_, order, dimension_);
    const std::vector<Dart> rooted = darts_from(seen, canonical_root(seen));
    std::vector<Dart> dart_at;  // by place in the canonical boundary
    for (const Dart k : rooted) {
      places_[order[k]] = static_cast<Dart>(dart_at.size());
      dart_at.push_back(order[k]);
    }
    const ConeShape* shape = structure_.types().cone_over(restricted_to(seen, rooted, dimension_));
    if (shape == nullptr) {
      return Error{Errc::refused,
                   fmt::format("what \"{}\" belongs to has a cell that is no ball, so there is no cell over "
                               "it: make it \"as\":\"simplices\", with one involution more",
                               name(first))};
    }
    for (const Dart d : dart_at) {
      const auto sees = [&](int q) { return seen_now(dimension_, q, darts_[d], structure_); };
      if (Status s = check_faces_seen(dimension_ + 1, sees, sparse::quoted(name(d)), structure_, plan_); !s) {
        return s;
      }
    }
    const std::string name_of_cell = cell_name(dart_at[0]);
    const auto face_at = [&](int q, Dart place) -> Result<SeenFace> {
      const Result<Value> value = seen_now(dimension_, q, darts_[dart_at[place]], structure_);
      if (!value) {
        return value.error();
      }
      bodies_.insert(structure_.body_of(value->cell));
      return SeenFace{structure_.values().incidence_of(*value), value->type};
    };
    const auto first_new = static_cast<CellId>(plan_.first + plan_.cells.size());
    if (Status s = add_cone_cell(*shape, name_of_cell, structure_, face_at, plan_); !s) {
      return s;
    }
    const CellId left = left_of_new_cells(first_new, structure_, plan_);  // cells may have been split
    return left == none
               ? Status{Done{}}
               : Error{Errc::refused, fmt::format("what \"{}\" belongs to has been split, and not by unsewing: "
                                                  "\"{}\" is left in the boundary of the boundary of the cell "
                                                  "over it",
                                                  name(first), structure_.name(left))};
  }

  void write_darts(const Orbits& all) {
    Dart local = 0;
    for (const std::uint32_t number : maps_) {
      const DartStore::Made& map = store_.map(number);
      auto cells = std::make_shared<DartCells>();
      cells->of.resize(static_cast<std::size_t>(dimension_) + 2);
      for (Dart d = map.first; d < map.first + map.count; ++d) {
        for (int i = 0; i <= dimension_; ++i) {
          cells->of[static_cast<std::size_t>(i)].push_back(store_.seen(map, i, d));
        }
        if (is_there(d)) {
          cells->of.back().push_back({plan_.first + new_cells_[all.of[local]], places_[local]});
          ++local;
        } else {
          cells->of.back().push_back({UINT32_MAX, 0});
        }
      }
      plan_.extended.push_back({number, std::move(cells)});
    }
  }

  const Structure& structure_;
  const DartStore& store_;
  Plan& plan_;
  GatheredMaps gathered_;
  int& dimension_ = gathered_.dimension;
  std::set<std::uint32_t>& maps_ = gathered_.maps;
  std::vector<Dart>& darts_ = gathered_.darts;
  GMap& map_ = gathered_.map;
  bool are_by_simplices_ = false;
  std::vector<Dart> places_;              // per such place: which dart of the type of the new cell
  std::vector<std::uint32_t> new_cells_;  // per component: its cell, among the new ones
  std::set<BodyId> bodies_;
};

}  // namespace

Status plan_extension(const Extend& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  if (Status s = ExtensionPlanner(structure, plan).run(operation, limits); !s) {
    return s;
  }
  return check_room(static_cast<std::int64_t>(plan.cells.size()), structure, limits);
}

}  // namespace sesame::ops

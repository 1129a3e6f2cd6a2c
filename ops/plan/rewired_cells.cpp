#include "ops/plan/rewired_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "ops/cells/cofaces.hpp"
#include "ops/cells/cone_parts.hpp"
#include "ops/cells/map_cells.hpp"
#include "ops/maps/rooted_map.hpp"
#include "ops/plan/cone_cells.hpp"
#include "ops/plan/new_cells.hpp"
#include "ops/plan/sewing.hpp"
#include "ops/plan/taken_cells.hpp"
#include "sparse/contract.hpp"

namespace sesame::ops {

Status RewiredCells::run() {
  plan_.first = structure_.cells().size();
  for (int i = 0; i <= map_.dimension(); ++i) {
    if (Status s = add_level(i); !s) {
      return s;
    }
  }
  return finish();
}

Status RewiredCells::add_level(int i) {
  rewired_.merge(map_.rewired_but_for(i));
  for (const Dart d : rewired_) {
    if (Status s = map_.is_made(d) || old_of_.contains(d) ? Status{Done{}} : add_old_cell(i, d); !s) {
      return s;
    }
  }
  for (const Dart d : rewired_) {
    if (Status s = map_.is_gone(d) || after_.contains(d) ? Status{Done{}} : add_cell(i, d); !s) {
      return s;
    }
  }
  for (const OldCell& old : old_) {
    bodies_.insert(structure_.body_of(old.cell));
    if (Status s = old.is_kept ? Status{Done{}} : check_alone(i, old); !s) {
      return s;
    }
    take(old);
  }
  old_.clear();
  old_of_.clear();
  before_.clear();
  levels_.push_back(std::exchange(after_, {}));
  rewired_ = std::exchange(sees_others_, {});
  return Done{};
}

void RewiredCells::take(const OldCell& old) {
  if (old.is_kept) {
    kept_.insert(old.cell);
    return;
  }
  taken_.push_back(old.cell);
  const std::vector<CellId> parts = cone_parts(structure_, old.cell);
  taken_.insert(taken_.end(), parts.begin(), parts.end());
}

std::string RewiredCells::text(Dart d) const {
  return map_.is_made(d) ? "a new dart" : fmt::format("\"{}\"", name_of_dart(map_.dimension(), d, structure_));
}

Result<RewiredCells::SeenCell> RewiredCells::seen_before(int i, Dart d) const {
  const DartStore::Made& map = structure_.darts().map_of(map_.dimension(), d);
  if (const DartCells::Seen seen = structure_.darts().seen(map, i, d); seen.offset != none) {
    const CellId node{seen.offset};
    if (structure_.is_current(node) && !structure_.lazy().is_consumed(node)) {
      return SeenCell{node, is_cone(structure_.cells().type(node).type) ? 0 : seen.dart};
    }
  }
  const Result<Value> value = value_before(i, d);
  if (!value) {
    return value.error();
  }
  return value->is_degenerate() ? SeenCell{value->cell, 0, true}
                                : SeenCell{value->cell, structure_.maps().dart_of(value->order)};
}

Result<Value> RewiredCells::value_before(int i, Dart d) const {
  const auto value = seen_from_dart(structure_, structure_.darts().map_of(map_.dimension(), d), i, d);
  if (value && structure_.is_current(value->cell) && !structure_.lazy().is_consumed(value->cell)) {
    return *value;
  }
  return seen_now(map_.dimension(), i, d, structure_);
}

/// What a dart will see in a dimension that has been gone through. Requires: it is one of a cell above that has passed
/// check_seen, or made.
RewiredCells::SeenCell RewiredCells::seen_after(int i, Dart d) const {
  const Seen& level = levels_[static_cast<std::size_t>(i)];
  const auto at = level.find(d);
  return at != level.end() ? at->second : *seen_before(i, d);
}

/// Of a cell that is no cone and not degenerate, and may be a new one.
Value RewiredCells::value_of(const SeenCell& seen) const {
  const bool is_new = seen.cell >= plan_.first && !is_asked_for(seen.cell);
  const TypeId type = is_new ? plan_.cells[seen.cell - plan_.first].type : structure_.cells().type_id(seen.cell);
  const OrderId order = structure_.maps().order_at(type, seen.place);
  return {seen.cell, structure_.maps().seen_through(order, type), 0, order};
}

/// As seen_after.
Result<Value> RewiredCells::value_after(int i, Dart d) const {
  const Seen& level = levels_[static_cast<std::size_t>(i)];
  const auto at = level.find(d);
  return at != level.end() ? Result<Value>{value_of(at->second)} : value_before(i, d);
}

/// What a dart will see, as a face of a new cell.
SeenFace RewiredCells::face_seen_after(int i, Dart d) const {
  const Value value = *value_after(i, d);
  const bool is_new = value.cell >= plan_.first && !is_asked_for(value.cell);
  return {is_new ? Incidence{value.cell, value.order} : structure_.values().incidence_of(value), value.type};
}

std::vector<Value> RewiredCells::faces_of(CellId cell) const {
  const Value whole = structure_.values().plain(cell);
  std::vector<Value> faces(structure_.types().info(whole.type).faces.size());
  for (std::uint32_t k = 0; k < faces.size(); ++k) {
    faces[k] = structure_.values().face(whole, k);
  }
  return faces;
}

/// The face that a dart of a cell of this type lies in, as that dart sees it.
RewiredCells::SeenCell RewiredCells::face_at(const std::vector<Value>& faces, TypeId type, Dart place) const {
  const CellShape::Place in_face = structure_.types().place_in_face(type, place);
  const Value& face = faces[in_face.face];
  if (face.is_degenerate()) {
    return {face.cell, 0, true};
  }
  const Dart root = structure_.maps().dart_of(face.order);
  return {face.cell, structure_.types().dart_from(structure_.cells().type_id(face.cell), root, in_face.dart)};
}

/// Is `below`, which a dart sees in dimension i - 1, the face that the dart `place` of an old cell lies in?
bool RewiredCells::is_face(const std::vector<Value>& faces, const SeenCell& cell, int i, Dart d,
                           const SeenCell& below) const {
  const SeenCell face = face_at(faces, structure_.cells().type_id(cell.cell), cell.place);
  if (!face.is_degenerate || !below.is_degenerate) {
    return face == below;
  }
  return structure_.values().face(value_of(cell), 0) == *value_before(i - 1, d);
}

Status RewiredCells::add_old_cell(int i, Dart d) {
  OldCell old{map_.cell_before(i, d), none};
  for (const Dart of : old.darts) {
    const Result<SeenCell> value = seen_before(i, of);
    if (!value) {
      return value.error();
    }
    before_.emplace(of, *value);
    old_of_.emplace(of, old_.size());
  }
  old.cell = before_.at(d).cell;
  if (Status s = check_seen(i, old); !s) {
    return s;
  }
  const Dart naming = naming_.of(structure_.forest().oldest(old.cell), i, map_.dimension());
  old.naming = std::ranges::binary_search(old.darts, naming) ? naming : no_dart;
  old_.push_back(std::move(old));
  return Done{};
}

/// Do all these darts see one cell, and its faces as faces of it?
Status RewiredCells::check_seen(int i, const OldCell& old) const {
  const bool has_faces = i > 0 && !is_cone(structure_.cells().type(old.cell).type);
  const std::vector<Value> faces = has_faces ? faces_of(old.cell) : std::vector<Value>{};
  for (const Dart d : old.darts) {
    const SeenCell& seen = before_.at(d);
    bool is_whole = seen.cell == old.cell && !seen.is_degenerate;
    if (is_whole && has_faces) {
      const Result<SeenCell> face = seen_before(i - 1, d);
      if (!face) {
        return face.error();
      }
      is_whole = is_face(faces, seen, i, d, *face);
    }
    if (!is_whole) {
      return Error{Errc::refused, fmt::format("the {}-cell of {} has been split, and not by unsewing, or became "
                                              "degenerate: undo that first",
                                              i, text(d))};
    }
  }
  return Done{};
}

Status RewiredCells::add_cell(int i, Dart d) {
  const std::vector<Dart> darts = map_.cell_after(i, d);
  const GMap map = map_.map_of_cell(i, darts);
  const CellBoundary boundary = CellBoundaries(map).of(i, 0);
  std::map<std::size_t, std::size_t> met;  // old cells, by their numbers: how many darts
  for (const Dart of : darts) {
    if (const auto at = old_of_.find(of); at != old_of_.end()) {
      ++met[at->second];
    }
  }
  std::vector<std::pair<std::size_t, std::size_t>> by_size;
  for (const auto& [number, count] : met) {
    by_size.emplace_back(darts.size() - count, number);
  }
  std::ranges::sort(by_size);
  for (const auto& [rest, number] : by_size) {
    if (keep(i, boundary, darts, old_[number])) {
      return Done{};
    }
  }
  return make(i, boundary, darts);
}

/// `place`: which dart of the cell it is.
void RewiredCells::see(int i, Dart d, CellId cell, Dart place) {
  after_.emplace(d, SeenCell{cell, place});
  const auto at = before_.find(d);
  if (at == before_.end() || !(at->second == SeenCell{cell, place})) {
    plan_.newly_seen.push_back({map_.dimension(), i, d, {std::uint32_t{cell}, place}});
    sees_others_.insert(d);
  }
}

bool RewiredCells::keep(int i, const CellBoundary& boundary, const std::vector<Dart>& darts, OldCell& old) {
  TypeTable& types = structure_.types();
  const auto is_old = [&](Dart d) { return std::ranges::binary_search(old.darts, d); };
  if (old.is_kept ||
      (old.naming != no_dart && !map_.is_gone(old.naming) && !std::ranges::binary_search(darts, old.naming))) {
    return false;
  }
  const auto first = static_cast<std::size_t>(std::ranges::find_if(darts, is_old) - darts.begin());
  const TypeId type = structure_.cells().type_id(old.cell);
  const Dart root = before_.at(darts[first]).place;
  const std::vector<Dart> order = darts_from(boundary.map, boundary.boundary_darts[first]);
  if (order.size() != types.darts(type) ||
      types.cell_over(restricted_to(boundary.map, order, i - 1)) != types.seen_from(type, root)) {
    return false;
  }
  std::vector<Dart> places(order.size());
  for (Dart k = 0; k < order.size(); ++k) {
    places[order[k]] = types.dart_from(type, root, k);
  }
  const std::vector<Value> faces = i > 0 ? faces_of(old.cell) : std::vector<Value>{};
  for (std::size_t k = 0; k < darts.size(); ++k) {
    const Dart place = places[boundary.boundary_darts[k]];
    if ((is_old(darts[k]) && !(before_.at(darts[k]) == SeenCell{old.cell, place})) ||
        (i > 0 && !is_face(faces, {old.cell, place}, i, darts[k], seen_after(i - 1, darts[k])))) {
      return false;
    }
  }
  old.is_kept = true;
  for (std::size_t k = 0; k < darts.size(); ++k) {
    see(i, darts[k], old.cell, places[boundary.boundary_darts[k]]);
  }
  return true;
}

Status RewiredCells::make(int i, const CellBoundary& boundary, const std::vector<Dart>& darts) {
  TypeTable& types = structure_.types();
  const std::vector<Dart> order = darts_from(boundary.map, 0);
  const TypeId seen = types.cell_over(restricted_to(boundary.map, order, i - 1));
  if (seen == none && i == map_.dimension() && i >= least_cone_dimension) {
    return make_cone(boundary, darts);
  }
  if (seen == none) {
    return Error{Errc::refused, fmt::format("the {}-cell of {} would be no ball: its canonical boundary {}", i,
                                            text(darts.front()), why_no_sphere(boundary.map))};
  }
  const TypeTable::Canonical canonical = types.canonical(seen);
  std::vector<Dart> places(order.size());
  for (Dart k = 0; k < order.size(); ++k) {
    places[order[k]] = types.dart_from(canonical.type, canonical.root, k);
  }
  const CellId cell = plan_.first + static_cast<std::uint32_t>(plan_.cells.size());
  std::vector<Dart> faces(types.info(canonical.type).faces.size());  // from which dart each is seen
  Dart naming = no_dart;
  for (std::size_t k = 0; k < darts.size(); ++k) {
    const Dart place = places[boundary.boundary_darts[k]];
    naming = place == 0 ? std::min(naming, darts[k]) : naming;
    see(i, darts[k], cell, place);
    if (i > 0) {
      const CellShape::Place of_face = types.place_in_face(canonical.type, place);
      if (of_face.dart == 0) {
        faces[of_face.face] = darts[k];
      }
    }
  }
  const std::size_t first_face = plan_.faces.size();
  for (const Dart d : faces) {
    add_face(face_seen_after(i - 1, d).incidence, plan_);
  }
  plan_.names += name_(i, naming);
  ops::add_cell(canonical.type, first_face, plan_);
  return Done{};
}

/// A cell of the largest dimension that is no ball.
Status RewiredCells::make_cone(const CellBoundary& boundary, const std::vector<Dart>& darts) {
  const int n = map_.dimension();
  const std::vector<Dart> order = darts_from(boundary.map, canonical_root(boundary.map));
  std::vector<Dart> dart_at(order.size());  // by place in the canonical boundary
  std::vector<Dart> place_of(order.size());
  for (Dart k = 0; k < order.size(); ++k) {
    place_of[order[k]] = k;
  }
  for (std::size_t k = 0; k < darts.size(); ++k) {
    dart_at[place_of[boundary.boundary_darts[k]]] = darts[k];
  }
  const ConeShape* shape = structure_.types().cone_over(restricted_to(boundary.map, order, n - 1));
  sparse::expects(shape != nullptr, "the cells below have been made, or kept, as balls");
  for (const Dart d : darts) {
    const auto sees = [&](int q) { return value_after(q, d); };
    if (Status s = check_faces_seen(n, sees, text(d), structure_, plan_); !s) {
      return s;
    }
  }
  const auto face_at = [&](int q, Dart place) -> Result<SeenFace> { return face_seen_after(q, dart_at[place]); };
  const auto first_new = static_cast<CellId>(plan_.first + plan_.cells.size());
  if (Status s = add_cone_cell(*shape, name_(n, dart_at[0]), structure_, face_at, plan_); !s) {
    return s;
  }
  if (const CellId left = left_of_new_cells(first_new, structure_, plan_); left != none) {
    return Error{Errc::refused,
                 fmt::format("the {}-cell of {} would have a boundary with a boundary, as cells have been "
                             "split: undo that first",
                             n, text(dart_at[0]))};
  }
  const CellId cell = plan_.first + static_cast<std::uint32_t>(plan_.cells.size() - 1);
  for (Dart place = 0; place < dart_at.size(); ++place) {
    see(n, dart_at[place], cell, place);
  }
  return Done{};
}

/// Does the cell stand for cells of these darts only, or of such as see another one by now?
Status RewiredCells::check_alone(int i, const OldCell& old) const {
  bool is_alone = true;
  structure_.forest().for_each_member(old.cell, [&](CellId node) {
    const Dart dart = naming_.of(node, i, map_.dimension());
    if (dart == no_dart) {
      is_alone = false;
    } else if (!std::ranges::binary_search(old.darts, dart) &&
               !structure_.darts().taken_out_with(map_.dimension(), dart)) {
      const Result<SeenCell> value = seen_before(i, dart);
      is_alone = is_alone && (!value || value->cell != old.cell);
    }
  });
  return is_alone
             ? Status{Done{}}
             : Error{Errc::refused, fmt::format("the {}-cell \"{}\" of {} is glued to other cells, and not only by "
                                                "sewing: undo that first",
                                                i, structure_.name(old.cell), text(old.darts.front()))};
}

Status RewiredCells::finish() {
  std::erase_if(taken_, [&](CellId cell) { return kept_.contains(cell); });
  std::ranges::sort(taken_);
  taken_.erase(std::unique(taken_.begin(), taken_.end()), taken_.end());
  for (const CellId cell : taken_) {
    for (const CellId coface : cofaces(structure_, cell)) {
      if (!std::ranges::binary_search(taken_, coface)) {
        return Error{
            Errc::refused,
            fmt::format("\"{}\" has \"{}\" as a face, which would be replaced, and is no cell of the map there: "
                        "undo what made it so first",
                        structure_.name(coface), structure_.name(cell))};
      }
    }
  }
  join_bodies(bodies_, plan_);
  add_deletions(std::move(taken_), structure_, plan_);
  return Done{};
}

}  // namespace sesame::ops

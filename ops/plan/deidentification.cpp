#include "ops/plan/deidentification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <unordered_set>

#include "ops/cells/cofaces.hpp"
#include "ops/plan/cone_cells.hpp"
#include "ops/plan/double_boundary.hpp"
#include "ops/plan/new_cells.hpp"
#include "ops/plan/step_names.hpp"
#include "sparse/quoted.hpp"

namespace sesame::ops {
namespace {

/// What may fail comes first: an index has no entry for what there is not.
template <class T>
void make_room_for_one(std::vector<T>& list) {
  if (list.size() == list.capacity()) {
    list.reserve(2 * list.size() + 16);
  }
}

/// Boundaries of cells that are no balls may go on being cycles when something below them is split; but then those are
/// attached otherwise than their darts say.
Status check_cones(const std::vector<Move>& moves, const Structure& structure) {
  const auto parts = structure.bodies().parts();
  if (std::ranges::all_of(parts, [](std::uint64_t count) { return count == 0; })) {
    return Done{};
  }
  std::unordered_set<CellId> known;
  for (const Move& move : moves) {
    if (Status s = check_no_cone_above(move.cell, known, structure); !s) {
      return s;
    }
  }
  return Done{};
}

std::uint64_t hash_of(CellId c) { return sparse::spread_bits(c); }
std::uint64_t hash_of(const std::string& name) { return sparse::spread_bits(std::hash<std::string>{}(name)); }

}  // namespace

Status SplitPlanner::plan(const Deidentify& operation, const Limits& limits, Plan& plan) {
  for (const Deidentify::Split& split : operation.splits) {
    if (Status s = check_new_name(split.copy, structure_); !s) {
      return s;
    }
  }
  if (Status s = check_room(static_cast<std::int64_t>(operation.splits.size()), structure_, limits); !s) {
    return s;
  }
  forget();
  for (const Deidentify::Split& split : operation.splits) {
    if (Status s = add_copy(split); !s) {
      return s;
    }
  }
  for (std::size_t k = 0; k < operation.splits.size(); ++k) {
    for (const auto& [cell, face] : operation.splits[k].moves) {
      if (Status s = add_move(operation.splits[k], k, cell, face, plan); !s) {
        return s;
      }
    }
  }
  if (Status s = check_cones(plan.moves, structure_); !s) {
    return s;
  }
  add_cofaces();
  for (const CellId c : cells_) {
    if (Status s = check_laws(c); !s) {
      return s;
    }
  }
  write(plan);
  return Done{};
}

void SplitPlanner::forget() {
  for (; !copies_.empty(); copies_.pop_back()) {
    copy_index_.erase(copies_.back().name_hash, static_cast<std::uint32_t>(copies_.size()) - 1);
  }
  for (; !cells_.empty(); cells_.pop_back()) {
    cell_index_.erase(hash_of(cells_.back()), static_cast<std::uint32_t>(cells_.size()) - 1);
  }
  faces_ends_.clear();
  faces_.clear();
  first_copy_ = structure_.cells().size();
}

std::string SplitPlanner::name_of(CellId c) const {
  return is_copy(c) ? *copies_[c - first_copy_].name : structure_.name(c);
}

// ---- what the operation says

std::uint32_t SplitPlanner::copy_named(const std::string& name) const {
  return copy_index_.find(hash_of(name), [&](std::uint32_t k) { return *copies_[k].name == name; });
}

Status SplitPlanner::add_copy(const Deidentify::Split& split) {
  const Result<Value> named = resolve_cell(split.cell, structure_);
  if (!named) {
    return named.error();
  }
  if (named->is_degenerate()) {
    return Error{Errc::refused, fmt::format("\"{}\" is degenerate: only a cell that is not can be split", split.cell)};
  }
  if (Status s = check_no_cone(named->cell, "a split", structure_); !s) {
    return s;
  }
  const std::size_t number = copies_.size();
  const std::uint64_t name_hash = hash_of(split.copy);
  if (copy_named(split.copy) != sparse::HashIndex::nothing) {
    return Error{Errc::bad_input,
                 fmt::format("the name {} is given to two copies: names are unique", sparse::quoted(split.copy))};
  }
  make_room_for_one(copies_);
  copy_index_.insert(name_hash, static_cast<std::uint32_t>(number));
  copies_.push_back({named->cell, &split.copy, name_hash, named->order});
  faces_of(first_copy_ + number);
  return Done{};
}

Result<Incidence> SplitPlanner::movable(const std::string& name) const {
  if (const std::uint32_t copy = copy_named(name); copy != sparse::HashIndex::nothing) {
    return Incidence{first_copy_ + copy, copies_[copy].order};
  }
  const Result<Value> found = resolve_cell(name, structure_);
  if (!found) {
    return found.error();
  }
  if (found->is_degenerate()) {
    return Error{Errc::refused, fmt::format("\"{}\" is degenerate: its faces cannot move", name)};
  }
  return Incidence{found->cell, found->order};
}

Status SplitPlanner::add_move(const Deidentify::Split& split, std::size_t number, const std::string& name,
                              std::int64_t face, Plan& plan) {
  const Result<Incidence> named = movable(name);
  if (!named) {
    return named.error();
  }
  const auto [cell, order] = *named;
  const std::span<Value> faces = faces_of(cell);
  if (face < 0 || face >= static_cast<std::int64_t>(faces.size())) {
    return Error{Errc::bad_input,
                 fmt::format("\"{}\" has {} faces, counted from 0: there is no face {}", name, faces.size(), face)};
  }
  const auto face_number = static_cast<std::size_t>(face);
  VertexMaps& maps = structure_.maps();
  const TypeId type = structure_.cells().type_id(source_of(cell));
  const std::size_t slot =
      maps.face_of_cell({cell, maps.seen_through(order, type), 0, order}, static_cast<std::uint32_t>(face_number));
  Value& value = faces[slot];
  if (is_copy(value.cell)) {
    return Error{Errc::bad_input,
                 fmt::format("face {} of \"{}\" is moved twice in this step: it can go to one copy", face, name)};
  }
  if (value.is_degenerate() || value.cell != copies_[number].source) {
    return Error{Errc::bad_input, fmt::format("face {} of \"{}\" is {}\"{}\", not \"{}\": it cannot go to the copy "
                                              "\"{}\"",
                                              face, name, value.is_degenerate() ? "degenerate over " : "",
                                              name_of(value.cell), split.cell, split.copy)};
  }
  value.cell = first_copy_ + number;
  if (!is_copy(cell)) {
    plan.moves.push_back({cell, static_cast<std::uint32_t>(slot), value.cell, value.order});
  }
  return Done{};
}

// ---- faces as they will be

std::uint32_t SplitPlanner::place_of(CellId c) const {
  return cell_index_.find(hash_of(c), [&](std::uint32_t k) { return cells_[k] == c; });
}

bool SplitPlanner::add_cell_to_check(CellId c) {
  const auto place = static_cast<std::uint32_t>(cells_.size());
  make_room_for_one(cells_);
  const bool is_new = cell_index_.insert_new(hash_of(c), place, [&](std::uint32_t k) { return cells_[k] == c; });
  if (is_new) {
    cells_.push_back(c);
  }
  return is_new;
}

std::span<Value> SplitPlanner::faces_of(CellId c) {
  if (add_cell_to_check(c)) {
    const CellId source = source_of(c);
    const auto arity = static_cast<std::uint32_t>(structure_.faces().of(source).size());
    for (std::uint32_t k = 0; k < arity; ++k) {
      faces_.push_back(structure_.values().face_of_cell(source, k));
    }
    faces_ends_.push_back(faces_.size());
  }
  const std::span<const Value> faces = changed_faces(place_of(c));
  return std::span<Value>{faces_}.subspan(static_cast<std::size_t>(faces.data() - faces_.data()), faces.size());
}

std::span<const Value> SplitPlanner::changed_faces(std::size_t place) const {
  const std::size_t begin = place == 0 ? 0 : faces_ends_[place - 1];
  return std::span<const Value>{faces_}.subspan(begin, faces_ends_[place] - begin);
}

Value SplitPlanner::face(const Value& v, std::uint32_t k) const {
  return structure_.maps().face(v, k, [this](CellId c, std::uint32_t number) {
    const std::uint32_t place = place_of(c);
    return place < faces_ends_.size() ? changed_faces(place)[number] : structure_.values().face_of_cell(c, number);
  });
}

/// What has a copy as a face is among the changed cells.
void SplitPlanner::add_cofaces() {
  const std::size_t changed = cells_.size();
  for (std::size_t k = 0; k < changed; ++k) {
    if (is_copy(cells_[k])) {
      continue;
    }
    for (const CellId coface : cofaces(structure_, cells_[k])) {
      add_cell_to_check(coface);
    }
  }
}

/// Of a cell that is known by its boundary: is it still a cycle?
Status SplitPlanner::check_boundary(CellId c) const {
  const CellId left = left_of_double_boundary(
      c, structure_.maps(), [this](CellId cell) -> const TypeInfo& { return structure_.cells().type(source_of(cell)); },
      [this](CellId cell, std::uint32_t k) {
        return face({cell, structure_.cells().type_id(source_of(cell)), 0, same_order}, k);
      });
  return left == none ? Status{Done{}}
                      : Error{Errc::refused,
                              fmt::format("after this split the boundary of \"{}\" would be no cycle: \"{}\" would be "
                                          "left in the boundary of it: split more, or move more",
                                          name_of(c), name_of(left))};
}

Status SplitPlanner::check_laws(CellId c) const {
  const TypeId type = structure_.cells().type_id(source_of(c));
  if (is_by_boundary(structure_.types().info(type).type)) {
    return check_boundary(c);
  }
  const Value cell{c, type, 0};
  for (const FaceLaw& law : structure_.types().info(type).laws) {
    const Value one = face(face(cell, law.first), law.second);
    Value other = face(face(cell, law.other_first), law.other_second);
    if (law.other_dart != 0) {
      other = structure_.maps().seen_from(law.other_dart, other);
    }
    if (!(one == other)) {
      return Error{
          Errc::refused,
          fmt::format("after this split \"{}\" would break a face law: face {} of its face {} would be \"{}\", and "
                      "face {} of its face {} \"{}\", but they must be one cell: split more, or move more",
                      name_of(c), law.second, law.first, name_of(one.cell), law.other_second, law.other_first,
                      name_of(other.cell))};
    }
  }
  return Done{};
}

// ---- the plan

/// Copies are written by dimension, so that faces come before what they are faces of.
void SplitPlanner::write(Plan& plan) {
  order_.resize(copies_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::sort(order_.begin(), order_.end(), [this](std::size_t a, std::size_t b) {
    const int p = structure_.dimension(copies_[a].source);
    const int q = structure_.dimension(copies_[b].source);
    return p != q ? p < q : a < b;
  });
  plan.first = first_copy_;
  final_ids_.resize(copies_.size());
  for (std::size_t k = 0; k < order_.size(); ++k) {
    final_ids_[order_[k]] = plan.first + k;
  }
  for (std::size_t k = 0; k < order_.size(); ++k) {
    const NewCopy& copy = copies_[order_[k]];
    const std::size_t first_face = plan.faces.size();
    for (const Value& v : changed_faces(place_of(first_copy_ + order_[k]))) {
      add_face(
          is_copy(v.cell) ? Incidence{final_ids_[v.cell - first_copy_], v.order} : structure_.values().incidence_of(v),
          plan);
    }
    plan.names += *copy.name;
    plan.sources.push_back(copy.source);
    if (copy.order != same_order) {
      plan.name_orders.emplace_back(static_cast<std::uint32_t>(k), copy.order);
    }
    add_cell(structure_.cells().type_id(copy.source), first_face, plan);
  }
  for (Move& move : plan.moves) {
    move.to = final_ids_[move.to - first_copy_];
  }
}

}  // namespace sesame::ops

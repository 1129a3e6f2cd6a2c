// De-identifications.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "ops/cells/cofaces.hpp"
#include "ops/plan/new_cells.hpp"
#include "ops/plan/operation_plans.hpp"
#include "ops/plan/step_names.hpp"

namespace sesame::ops {
namespace {

/// Works out a de-identification: copies under ids of their own, faces as they would be, and the laws between them.
class SplitPlanner {
 public:
  SplitPlanner(const Deidentify& operation, const Structure& structure)
      : operation_{operation}, structure_{structure} {}

  Status run(Plan& plan) {
    for (const Deidentify::Split& split : operation_.splits) {
      if (Status s = add_copy(split); !s) {
        return s;
      }
    }
    for (std::size_t k = 0; k < operation_.splits.size(); ++k) {
      for (const auto& [cell, face] : operation_.splits[k].moves) {
        if (Status s = add_move(k, cell, face); !s) {
          return s;
        }
      }
    }
    for (const CellId c : cells_with_changed_faces()) {
      if (Status s = check_laws(c); !s) {
        return s;
      }
    }
    write(plan);
    return Done{};
  }

 private:
  struct NewCopy {
    CellId source;
    const std::string& name;
    OrderId order;  // in which the name of the cell that is split has its vertices; that of the copy has them so too
  };

  /// Copies have the ids that follow those in use, in the order of the operation until the plan is written.
  [[nodiscard]] bool is_copy(CellId c) const { return !is_asked_for(c) && c >= first_copy_; }
  [[nodiscard]] CellId source_of(CellId c) const { return is_copy(c) ? copies_[c - first_copy_].source : c; }
  [[nodiscard]] std::string name_of(CellId c) const {
    return is_copy(c) ? copies_[c - first_copy_].name : structure_.name(c);
  }

  Status add_copy(const Deidentify::Split& split) {
    const Result<Value> named = resolve_cell(split.cell, structure_);
    if (!named) {
      return named.error();
    }
    if (named->is_degenerate()) {
      return Error{Errc::refused,
                   fmt::format("\"{}\" is degenerate: only a cell that is not can be split", split.cell)};
    }
    const CellId id = first_copy_ + copies_.size();
    if (!copy_names_.emplace(split.copy, id).second) {
      return Error{Errc::bad_input,
                   fmt::format("the name \"{}\" is given to two copies: names are unique", split.copy)};
    }
    copies_.push_back({named->cell, split.copy, named->order});
    faces_of(id);
    return Done{};
  }

  /// What a name denotes in a list of moves: a copy, or a cell that is not degenerate. With the order in which the name
  /// stands for its vertices, by which its faces are counted.
  [[nodiscard]] Result<Incidence> movable(const std::string& name) const {
    if (const auto copy = copy_names_.find(name); copy != copy_names_.end()) {
      return Incidence{copy->second, copies_[copy->second - first_copy_].order};
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

  Status add_move(std::size_t split, const std::string& name, std::int64_t face) {
    const Result<Incidence> named = movable(name);
    if (!named) {
      return named.error();
    }
    const auto [cell, order] = *named;
    std::vector<Value>& faces = faces_of(cell);
    if (face < 0 || face >= static_cast<std::int64_t>(faces.size())) {
      return Error{Errc::bad_input,
                   fmt::format("\"{}\" has {} faces, counted from 0: there is no face {}", name, faces.size(), face)};
    }
    const auto number = static_cast<std::size_t>(face);
    const std::size_t slot = order == same_order ? number : structure_.maps().permutation(order)[number];
    Value& value = faces[slot];
    if (is_copy(value.cell)) {
      return Error{Errc::bad_input,
                   fmt::format("face {} of \"{}\" is moved twice in this step: it can go to one copy", face, name)};
    }
    if (value.is_degenerate() || value.cell != copies_[split].source) {
      return Error{Errc::bad_input,
                   fmt::format("face {} of \"{}\" is {}\"{}\", not \"{}\": it cannot go to the copy \"{}\"", face, name,
                               value.is_degenerate() ? "degenerate over " : "", name_of(value.cell),
                               operation_.splits[split].cell, operation_.splits[split].copy)};
    }
    value.cell = first_copy_ + split;
    if (!is_copy(cell)) {
      moves_.push_back({cell, static_cast<std::uint32_t>(slot), value.cell, value.order});
    }
    return Done{};
  }

  /// The faces of a cell that is split or whose incidences move; kept, in the order in which they were asked for.
  std::vector<Value>& faces_of(CellId c) {
    const auto [at, is_new] = faces_.try_emplace(c);
    if (is_new) {
      changed_.push_back(c);
      const auto arity = static_cast<std::uint32_t>(structure_.faces().of(source_of(c)).size());
      for (std::uint32_t k = 0; k < arity; ++k) {
        at->second.push_back(structure_.values().face_of_cell(source_of(c), k));
      }
    }
    return at->second;
  }

  [[nodiscard]] Value face(const Value& v, std::uint32_t k) const {
    return structure_.maps().face(v, k, [this](CellId c, std::uint32_t number) {
      const auto changed = faces_.find(c);
      return changed != faces_.end() ? changed->second[number] : structure_.values().face_of_cell(c, number);
    });
  }

  /// Copies, cells with moves, and the cofaces of these.
  [[nodiscard]] std::vector<CellId> cells_with_changed_faces() const {
    std::vector<CellId> cells = changed_;
    std::unordered_set<CellId> seen(cells.begin(), cells.end());
    for (const CellId c : changed_) {
      if (is_copy(c)) {
        continue;  // what has a copy as a face is among the changed cells
      }
      for (const CellId coface : cofaces(structure_, c)) {
        if (seen.insert(coface).second) {
          cells.push_back(coface);
        }
      }
    }
    return cells;
  }

  [[nodiscard]] Status check_laws(CellId c) const {
    const TypeId type = structure_.cells().type_id(source_of(c));
    const Value cell{c, type, 0};
    for (const FaceLaw& law : structure_.types().info(type).laws) {
      const Value one = face(face(cell, law.first), law.second);
      const Value other = face(face(cell, law.other_first), law.other_second);
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

  /// Copies by dimension, so that faces come before what they are faces of.
  [[nodiscard]] std::vector<std::size_t> copies_by_dimension() const {
    std::vector<std::size_t> order(copies_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
      return structure_.dimension(copies_[a].source) < structure_.dimension(copies_[b].source);
    });
    return order;
  }

  void write(Plan& plan) const {
    const std::vector<std::size_t> order = copies_by_dimension();
    std::vector<std::vector<Incidence>> faces;
    for (const std::size_t k : order) {
      faces.emplace_back();
      for (const Value& v : faces_.at(first_copy_ + k)) {
        faces.back().push_back(is_copy(v.cell) ? Incidence{v.cell, v.order} : structure_.values().incidence_of(v));
      }
    }
    plan.first = first_copy_;
    std::vector<CellId> id(copies_.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      id[order[k]] = plan.first + k;
    }
    const auto final_id = [&](CellId c) { return is_copy(c) ? id[c - first_copy_] : c; };
    for (std::size_t k = 0; k < order.size(); ++k) {
      const NewCopy& copy = copies_[order[k]];
      const std::size_t first_face = plan.faces.size();
      for (const auto& [node, order_of_face] : faces[k]) {
        add_face({final_id(node), order_of_face}, plan);
      }
      plan.names += copy.name;
      plan.sources.push_back(copy.source);
      if (copy.order != same_order) {
        plan.name_orders.emplace_back(static_cast<std::uint32_t>(k), copy.order);
      }
      add_cell(structure_.cells().type_id(copy.source), first_face, plan);
    }
    for (const Move& move : moves_) {
      plan.moves.push_back({move.cell, move.slot, final_id(move.to), move.order});
    }
  }

  const Deidentify& operation_;
  const Structure& structure_;
  const CellId first_copy_ = structure_.cells().size();
  std::vector<NewCopy> copies_;
  std::unordered_map<std::string_view, CellId> copy_names_;
  std::unordered_map<CellId, std::vector<Value>> faces_;  // references into it stay valid
  std::vector<CellId> changed_;                           // its keys
  std::vector<Move> moves_;
};

}  // namespace

Status plan_deidentification(const Deidentify& operation, const Structure& structure, const Limits& limits,
                             Plan& plan) {
  for (const Deidentify::Split& split : operation.splits) {
    if (Status s = check_new_name(split.copy, structure); !s) {
      return s;
    }
  }
  if (Status s = check_room(static_cast<std::int64_t>(operation.splits.size()), structure, limits); !s) {
    return s;
  }
  return SplitPlanner(operation, structure).run(plan);
}

}  // namespace sesame::ops

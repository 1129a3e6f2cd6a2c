#include "ops/plan/cone_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ops/cells/cofaces.hpp"
#include "ops/plan/double_boundary.hpp"

namespace sesame::ops {
namespace {

bool is_new(CellId cell, const Plan& plan) { return cell >= plan.first && cell < plan.first + plan.cells.size(); }

Value planned_face(CellId cell, std::uint32_t k, const Structure& structure, const Plan& plan) {
  const std::uint32_t at = plan.cells[cell - plan.first].first_face + k;
  const auto order = std::ranges::lower_bound(plan.face_orders, std::pair{at, OrderId{}});
  const OrderId seen_in = order != plan.face_orders.end() && order->first == at ? order->second : same_order;
  const CellId node = plan.faces[at];
  return is_new(node, plan) ? Value{node, plan.cells[node - plan.first].type, 0, seen_in}
                            : structure.maps().reordered(seen_in, structure.values().of(node));
}

}  // namespace

CellId left_of_new_cells(CellId first, const Structure& structure, const Plan& plan) {
  CellId left = none;
  for (CellId c = first; c < plan.first + plan.cells.size() && left == none; ++c) {
    left = left_of_double_boundary(
        c, structure.maps(),
        [&](CellId cell) -> const TypeInfo& {
          return is_new(cell, plan) ? structure.types().info(plan.cells[cell - plan.first].type)
                                    : structure.cells().type(cell);
        },
        [&](CellId cell, std::uint32_t k) {
          return is_new(cell, plan) ? planned_face(cell, k, structure, plan) : structure.values().face_of_cell(cell, k);
        });
  }
  return left;
}

Status check_faces_seen(int n, const std::function<Result<Value>(int)>& sees, const std::string& dart,
                        const Structure& structure, const Plan& plan) {
  for (int q = 1; q < n; ++q) {
    const Result<Value> above = sees(q);
    const Result<Value> below = above ? sees(q - 1) : above;
    if (!below) {
      return below.error();
    }
    if (is_new(above->cell, plan) || structure.values().face(*above, 0) == *below) {
      continue;  // new cells are made of what is seen
    }
    return Error{Errc::refused,
                 fmt::format("what {} belongs to has been split, and not by unsewing: it sees \"{}\", "
                             "which is no face there of \"{}\"; undo that first",
                             dart, is_new(below->cell, plan) ? "a new cell" : structure.name(below->cell),
                             structure.name(above->cell))};
  }
  return Done{};
}

Status check_no_cone_above(CellId cell, std::unordered_set<CellId>& known, const Structure& structure) {
  std::vector<CellId> pending;
  if (known.insert(cell).second) {
    pending.push_back(cell);
  }
  while (!pending.empty()) {
    const CellId at = pending.back();
    pending.pop_back();
    const CellType& type = structure.cells().type(at).type;
    if (is_cone(type) || is_cone_part(type)) {
      const std::string whole = structure.name(is_cone(type) ? at : whole_of_part(structure, at));
      return Error{
          Errc::refused,
          fmt::format("faces of \"{}\" cannot move to copies: it belongs to \"{}\", which is no ball, and whose "
                      "darts would see other faces than the cell has; unsew that first, or remove it",
                      structure.name(cell), whole)};
    }
    for (const CellId coface : cofaces(structure, at)) {
      if (known.insert(coface).second) {
        pending.push_back(coface);
      }
    }
  }
  return Done{};
}

Status check_cofaces(CellId cell, const std::unordered_set<CellId>& known, std::string_view what,
                     const Structure& structure) {
  for (const CellId coface : cofaces(structure, cell)) {
    const CellType& type = structure.cells().type(coface).type;
    if (!known.contains(coface) && !is_cone(type) && !is_cone_part(type)) {
      return Error{Errc::refused, fmt::format("\"{}\" is a face of \"{}\", which is no cell of its map: {} would tear "
                                              "that; remove it first",
                                              structure.name(cell), structure.name(coface), what)};
    }
  }
  return Done{};
}

Status check_no_cone(CellId cell, std::string_view what, const Structure& structure) {
  const CellType& type = structure.cells().type(cell).type;
  return is_cone(type) || is_cone_part(type)
             ? Error{Errc::refused, fmt::format("\"{}\" is a {}: {} is possible of other cells only; make the map "
                                                "\"as\":\"simplices\"",
                                                structure.name(cell), describe(type), what)}
             : Status{Done{}};
}

}  // namespace sesame::ops

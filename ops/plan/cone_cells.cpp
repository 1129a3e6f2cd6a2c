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

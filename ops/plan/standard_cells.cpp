// Simplices and simploids with all their faces.
#include <fmt/format.h>

#include <optional>
#include <string>

#include "ops/plan/new_cells.hpp"
#include "ops/plan/operation_plans.hpp"
#include "ops/plan/step_names.hpp"

namespace sesame::ops {
namespace {

/// Are the names of the whole cell and of its faces free?
/// Cost: one look-up, and one for each face when there are names like theirs.
Status check_names(const std::string& name, TypeId type, const Structure& structure) {
  if (Status s = check_new_name(name, structure); !s || !structure.directory().may_have_faces_named(name)) {
    return s;
  }
  const StandardCell& standard = structure.types().standard(type);
  for (std::size_t k = 0; k + 1 < standard.cells.size(); ++k) {
    const std::string full = name + "." + standard.cells[k].suffix;
    if (structure.is_name_taken(full)) {
      return Error{Errc::bad_input,
                   fmt::format("the name \"{}\" is in use, so \"{}\" cannot name a new {}: choose another", full, name,
                               describe(structure.types().info(type).type))};
    }
  }
  return Done{};
}

/// The type of a standard cell with names that are free. Errors: refused, bad_input.
Result<TypeId> check_cell(const std::string& name, const CellType& type, const Structure& structure,
                          const Limits& limits) {
  if (Status s = check_standard(type, structure, limits); !s) {
    return s.error();
  }
  const TypeId id =
      is_simplex(type) ? structure.types().simplex(type.empty() ? 0 : type[0]) : structure.types().intern(type);
  if (Status s = check_names(name, id, structure); !s) {
    return s.error();
  }
  return id;
}

}  // namespace

void write_standard(const std::string& name, TypeId type, const Structure& structure, Plan& plan) {
  const StandardCell& standard = structure.types().standard(type);
  plan.first = structure.cells().size();
  for (const StandardFace& cell : standard.cells) {
    const std::size_t first_face = plan.faces.size();
    for (std::size_t k = 0; k < cell.faces.size(); ++k) {
      const OrderId order = cell.face_darts.empty()
                                ? OrderId{same_order}
                                : structure.maps().order_at(standard.cells[cell.faces[k]].type, cell.face_darts[k]);
      add_face({plan.first + cell.faces[k], order}, plan);
    }
    add_cell(cell.type, first_face, plan);
  }
  plan.standard = type;
  plan.new_body = name;
}

Status plan_simplex(const MakeSimplex& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  const std::string& name = operation.name;
  const bool is_vertex = operation.dimension == 0;
  const auto type = check_cell(name, is_vertex ? CellType{} : CellType{operation.dimension}, structure, limits);
  if (!type) {
    return type.error();
  }
  if (Status s = is_vertex ? check_new_name(name + ".0", structure) : Done{}; !s) {  // a further name of it
    return s;
  }
  write_standard(name, *type, structure, plan);
  return Done{};
}

Status plan_simploid(const MakeSimploid& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  const std::string& name = operation.name;
  const auto type = check_cell(name, operation.type, structure, limits);
  if (!type) {
    return type.error();
  }
  write_standard(name, *type, structure, plan);
  if (operation.type.empty()) {  // it has one name only, unlike a simplex
    plan.standard = none;
    plan.names = name;
    plan.cells.back().name_end = name.size();
  }
  return Done{};
}

}  // namespace sesame::ops

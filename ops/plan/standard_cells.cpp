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
Status check_names(const std::string& name, TypeId type, const Structure& structure) {
  if (Status s = check_new_name(name, structure); !s) {
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

/// Comes after the last look at a name, which may make lazy cells: the plan counts on ids.
void write(const std::string& name, TypeId type, const Structure& structure, Plan& plan) {
  const StandardCell& standard = structure.types().standard(type);
  plan.first = structure.cells().size();
  for (std::size_t k = 0; k < standard.cells.size(); ++k) {
    const StandardFace& cell = standard.cells[k];
    plan.names.append(name);
    if (k + 1 < standard.cells.size()) {
      plan.names.append(1, '.').append(cell.suffix);
    }
    const std::size_t first_face = plan.faces.size();
    for (const std::uint32_t face : cell.faces) {
      plan.faces.push_back(plan.first + face);
    }
    add_cell(cell.type, first_face, plan);
  }
  plan.new_body = name;
}

/// `alias`: a further name of the whole cell, when it has one.
Status plan_standard(const std::string& name, const CellType& type, const std::optional<std::string>& alias,
                     const Structure& structure, const Limits& limits, Plan& plan) {
  if (Status s = check_standard(type, structure, limits); !s) {
    return s;
  }
  const TypeId id = structure.types().intern(type);
  if (Status s = check_names(name, id, structure); !s) {
    return s;
  }
  if (Status s = alias ? check_new_name(*alias, structure) : Done{}; !s) {
    return s;
  }
  write(name, id, structure, plan);
  if (alias) {
    plan.aliases.emplace_back(*alias, plan.first);
  }
  return Done{};
}

}  // namespace

Status plan_simplex(const MakeSimplex& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  const std::string& name = operation.name;
  if (operation.dimension == 0) {  // "t" and its vertex "t.0" are one cell
    return plan_standard(name, {}, name + ".0", structure, limits, plan);
  }
  return plan_standard(name, {operation.dimension}, {}, structure, limits, plan);
}

Status plan_simploid(const MakeSimploid& operation, const Structure& structure, const Limits& limits, Plan& plan) {
  return plan_standard(operation.name, operation.type, {}, structure, limits, plan);
}

}  // namespace sesame::ops

/// \file
/// The generators of cells of maps that are no balls.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "ops/cells/cone_parts.hpp"
#include "ops/cells/structure.hpp"
#include "ops/plan/new_cells.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// A face of a new cell, as it is seen, with its type as seen from there.
struct SeenFace {
  Incidence incidence;
  TypeId type;
};

/// Adds a cell to a plan, its parts before it, which are named `name~1`, `name~2`, ..., as far as these names are free.
/// `face_at(q, dart)` is what a dart of the canonical boundary sees in dimension q. Errors: those of `face_at`.
/// Cost: the terms of the boundaries, and the names that are tried.
template <class FaceAt>
Status add_cone_cell(const ConeShape& shape, const std::string& name, const Structure& structure, FaceAt&& face_at,
                     Plan& plan) {
  std::vector<SeenFace> own;
  std::uint32_t number = 0;
  const auto next_name = [&] {
    std::string part;
    do {
      part = name + '~' + std::to_string(++number);
    } while (structure.is_name_taken(part));
    return part;
  };
  for (std::size_t g = 0; g < shape.generators.size(); ++g) {
    const ConeShape::Generator& generator = shape.generators[g];
    const bool is_cell = g + 1 == shape.generators.size();
    std::vector<TypeTable::BoundaryFace> faces;
    const std::size_t first_face = plan.faces.size();
    for (const auto& [q, dart, coefficient] : generator.terms) {
      const Result<SeenFace> face = face_at(q, dart);
      if (!face) {
        return face.error();
      }
      add_face(face->incidence, plan);
      faces.push_back({coefficient, face->type});
    }
    for (const auto& [earlier, coefficient] : generator.of_this) {
      add_face(own[earlier].incidence, plan);
      faces.push_back({coefficient, own[earlier].type});
    }
    const TypeId type =
        structure.types().by_boundary(generator.degree, faces, is_cell ? KnownBy::cone : KnownBy::cone_part);
    own.push_back({{plan.first + plan.cells.size()}, type});
    plan.names += is_cell ? name : next_name();
    add_cell(type, first_face, plan);
  }
  return Done{};
}

/// A cell that is left in the boundary of the boundary of some new cell, from one of them on; or none.
[[nodiscard]] CellId left_of_new_cells(CellId first, const Structure& structure, const Plan& plan);

/// Does a dart, called `dart`, see faces of what it sees above, in all dimensions below n? A split moves incidences,
/// but not what darts see. `sees(q)`: what it sees in dimension q. Errors: those of `sees`; refused, naming two cells.
Status check_faces_seen(int n, const std::function<Result<Value>(int)>& sees, const std::string& dart,
                        const Structure& structure, const Plan& plan);

/// Errors: refused, when a cell is below one that is no ball, or is one, naming both: darts of that would see another
/// face than the cell has when it has lost one to a copy. `known` has been looked at, and gets what is. Cost: its star.
Status check_no_cone_above(CellId cell, std::unordered_set<CellId>& known, const Structure& structure);

/// Errors: refused, when a cell has a coface besides some and the generators of cells that are no balls.
Status check_cofaces(CellId cell, const std::unordered_set<CellId>& known, std::string_view what,
                     const Structure& structure);
/// Errors: refused, when a cell is no ball, or a part of one. `what` is that which is possible of others only.
Status check_no_cone(CellId cell, std::string_view what, const Structure& structure);

}  // namespace sesame::ops

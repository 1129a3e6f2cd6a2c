/// \file
/// The generators of cells of maps that are no balls.
#pragma once

#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "ops/cells/structure.hpp"
#include "ops/plan/new_cells.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// A face of a new cell, as it is seen, with its type as seen from there.
struct SeenFace {
  Incidence incidence;
  TypeId type;
};

/// Adds a cell with its parts to a plan, named `name` and `name~1`, `name~2`, .... `face_at(q, dart)` is what a dart of
/// the canonical boundary sees in dimension q. Errors: those of `face_at`. Cost: the terms of the boundaries.
template <class FaceAt>
Status add_cone_cell(const ConeShape& shape, const std::string& name, TypeTable& types, FaceAt&& face_at, Plan& plan) {
  std::vector<SeenFace> own;
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
    const TypeId type = types.by_boundary(generator.degree, faces, is_cell ? KnownBy::cone : KnownBy::cone_part);
    own.push_back({{plan.first + plan.cells.size()}, type});
    plan.names += is_cell ? name : name + '~' + std::to_string(g + 1);
    add_cell(type, first_face, plan);
  }
  return Done{};
}

/// Errors: bad_input, when the name of a part is in use.
Status check_part_names(const ConeShape& shape, const std::string& name, const Structure& structure);
/// Errors: refused, when a cell has a coface besides some and the generators of cells that are no balls.
Status check_cofaces(CellId cell, const std::unordered_set<CellId>& known, std::string_view what,
                     const Structure& structure);
/// What a part of a cell is called after that: "m.3:0" of "m.3:0~1".
[[nodiscard]] std::string name_of_whole(const std::string& part);
/// The current parts of a current cell that is no ball.
[[nodiscard]] std::vector<CellId> cone_parts(const Structure& structure, CellId cell);
/// Errors: refused, when a cell is no ball, or a part of one. `what` is that which is possible of others only.
Status check_no_cone(CellId cell, std::string_view what, const Structure& structure);

}  // namespace sesame::ops

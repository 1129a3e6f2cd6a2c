/// \file
/// What is left of the boundary of a boundary, where no face law says that it is nothing.
#pragma once

#include <cstdint>
#include <map>

#include "ops/cells/value.hpp"
#include "sparse/integer.hpp"

namespace sesame::ops {

/// A cell that has another coefficient than 0 in the boundary of the boundary of a cell, or none. `type_of(cell)` gives
/// the description of the type of a cell, `face_of(cell, k)` a face as a value in normal form.
/// Cost: the faces of faces, times the logarithm of their number.
template <class TypeOf, class FaceOf>
[[nodiscard]] CellId left_of_double_boundary(CellId cell, const VertexMaps& maps, TypeOf type_of, FaceOf face_of) {
  std::map<CellId, sparse::Integer> sum;
  const auto for_each_face = [&](CellId c, auto visit) {
    const TypeInfo& type = type_of(c);
    for (std::uint32_t k = 0; k < type.faces.size(); ++k) {
      if (const Value face = face_of(c, k); !face.is_degenerate()) {
        visit(face.cell, std::int64_t{type.faces[k].sign} * maps.sign(face.order));
      }
    }
  };
  for_each_face(cell, [&](CellId face, std::int64_t sign) {
    for_each_face(face, [&](CellId of_face, std::int64_t inner) {
      sum[of_face] += sparse::Integer{sign} * sparse::Integer{inner};
    });
  });
  for (const auto& [left, coefficient] : sum) {
    if (!coefficient.is_zero()) {
      return left;
    }
  }
  return none;
}

}  // namespace sesame::ops

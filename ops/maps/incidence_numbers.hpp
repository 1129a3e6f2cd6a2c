/// \file
/// The complex of the cells of a map, by incidence numbers.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "ops/maps/gmap.hpp"
#include "ops/maps/orbits.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// Signs of the darts of a connected map such that each involution changes them: +1 for dart 0. Nothing, but the dart
/// where this fails, when an involution fixes a dart, or the map is not orientable. Cost: darts times involutions.
struct DartSigns {
  std::vector<std::int8_t> of;  ///< empty when there are none
  enum class Fault : std::uint8_t { nothing, fold, one_sided } fault = Fault::nothing;
  Dart where = no_dart;
};
[[nodiscard]] DartSigns dart_signs(const GMap& connected);

/// The cells of a map, each with its boundary as a sum of cells of one dimension less with coefficients.
///
/// The i-cell of a dart d is oriented so that the least dart of the cell counts +1: then a dart counts as many as the
/// signs of its canonical boundary say. The coefficient of a cell c in the boundary of another one is the number of
/// times that a dart of the canonical boundary of c is one in that of the other one with the same sign, less the number
/// of times with the opposite one. It is the complex of the object if each canonical boundary is a homology sphere.
struct IncidenceComplex {
  std::vector<Orbits> cells;  ///< by dimension
  /// Per dimension and cell: (cell of one dimension less, coefficient), ascending, coefficients not 0.
  std::vector<std::vector<std::vector<std::pair<std::uint32_t, int>>>> boundaries;
};
/// Errors    refused, naming a dart: a cell is not orientable, or folded. Cost: n^2 times the darts.
[[nodiscard]] Result<IncidenceComplex> incidence_complex(const GMap& map);

/// Whether a connected map without free darts has the homology of a sphere of its dimension over Z, as all canonical
/// boundaries of its cells do. What is asked of a cell's boundary for the cell to count as a ball.
/// Cost: n^2 times the darts; from dimension 3 on that of Smith forms.
[[nodiscard]] bool is_homology_sphere(const GMap& map);

}  // namespace sesame::ops

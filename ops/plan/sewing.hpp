/// \file
/// The darts of maps by their names, and what sewing them glues.
#pragma once

#include <string>
#include <vector>

#include "ops/cells/structure.hpp"
#include "ops/plan/congruence.hpp"
#include "ops/vocabulary/operation.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// A dart of a map of some dimension. See DartStore.
struct NamedDart {
  int dimension;
  Dart dart;
};
/// "m:3". Errors: unknown_name. Cost: the logarithm of the number of maps.
[[nodiscard]] Result<NamedDart> dart_named(const std::string& name, const Structure& structure);
[[nodiscard]] std::string name_of_dart(int dimension, Dart dart, const Structure& structure);
/// What a dart sees in a dimension by now, as in seen_from_dart. Errors: unknown_name, when that was removed or went
/// into a product.
[[nodiscard]] Result<Value> seen_now(int dimension, int i, Dart dart, const Structure& structure);

/// The equations that sewing darts comes to, and into a plan what becomes of the darts.
/// Errors    unknown_name; refused, naming a dart: one that is not free, orbits that are not alike.
/// Cost      The darts that are sewn, times the dimension.
[[nodiscard]] Result<std::vector<Equation>> equations_of(const Sew& operation, const Structure& structure, Plan& plan);

}  // namespace sesame::ops

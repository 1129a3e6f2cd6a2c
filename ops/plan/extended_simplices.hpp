/// \file
/// Cones over whole maps by simplices.
#pragma once

#include <set>
#include <vector>

#include "ops/cells/structure.hpp"
#include "ops/plan/limits.hpp"

namespace sesame::ops {

/// Maps of one dimension with all that is sewn to them, as one.
struct GatheredMaps {
  int dimension = 0;
  std::set<std::uint32_t> maps;  ///< numbers
  std::vector<Dart> darts;       ///< of these that are there, one map after the other
  GMap map;                      ///< whose darts are places in that list
};

/// Each component of maps by simplices gets the cone over it, whose apex has the number n + 1: for each set of numbers,
/// the empty one too, and each of its orbits a simplex with one number more.
/// Errors    bad_input: a name; refused, naming darts: of an orbit that do not see one simplex, as cells were split or
///           removed; the limits.
/// Cost      n 2^n times the darts.
Status extend_simplices(const GatheredMaps& gathered, const Structure& structure, const Limits& limits, Plan& plan);

}  // namespace sesame::ops

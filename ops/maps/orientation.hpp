/// \file
/// Whether the darts of a map can be told apart into those of one hand and those of the other.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ops/maps/incidence.hpp"

namespace sesame::ops {

/// Where a G-map has no 0-free dart, and no alpha_i with i >= 2 agrees anywhere with alpha_0, its darts are turned by
/// alpha_0 and then alpha_i, i >= 1, where that one is not free. A component is orientable when this leaves two classes
/// of its darts, and not when it leaves one. Source: P. Lienhardt (1994), extended to maps with boundary, for which a
/// free dart must not join the classes.
enum class Orientability { orientable, not_orientable, undefined };

struct ComponentOrientability {
  Dart first = no_dart;  ///< the smallest dart of the component
  Orientability is = Orientability::undefined;
  /// Of what is undefined, a dart of the component where it fails: with index 0 the dart is 0-free, with i >= 2 alpha_i
  /// and alpha_0 agree on it.
  std::optional<IndexedDart> obstacle;
};

/// For each component, in the order of `components`. Cost: the darts times n. Requires: n >= 0.
[[nodiscard]] std::vector<ComponentOrientability> orientability(const GMap& map);
/// Of all components together: whether each is orientable.
/// Errors    refused, naming a dart, when that is undefined for one.
[[nodiscard]] Result<bool> is_orientable(const GMap& map);
/// Whether orientability is defined for all components; else refused, naming a dart.
[[nodiscard]] Status check_turning(const GMap& map);

/// A sign for each dart.
struct Signs {
  std::vector<std::int8_t> of;          ///< 1 or -1; empty when there are no such signs
  std::optional<IndexedDart> conflict;  ///< then: an involution, and a dart to whose image it would give its own sign
};

/// Signs with the opposite one at alpha_i(d), for each chosen i, wherever d is not i-free. The smallest dart of each
/// orbit of these involutions has the sign 1. Cost: the darts, times the involutions.
[[nodiscard]] Signs signs(const GMap& map, IndexSet involutions);

}  // namespace sesame::ops

/// \file
/// From n-maps to G-maps, and back where there is an orientation.
#pragma once

#include <vector>

#include "ops/maps/nmap.hpp"

namespace sesame::ops {

/// The G-map of an n-map, always: each dart k becomes two, dart k and, at the other end of its edge, dart k + size,
/// which alpha_0 exchanges. Its i-cells are those of the n-map, and it has the vertices that no dart leaves besides.
/// Free darts stay free: what is nowhere for a beta is its own image for an alpha. Source: P. Lienhardt (1994),
/// extended to maps with boundary. Cost: n^2 times the darts. Requires: a size below 2^31.
[[nodiscard]] GMap to_gmap(const NMap& map);

/// Half of a G-map.
struct HalfOfMap {
  NMap map;
  std::vector<Dart> dart;  ///< per dart of it: what dart of the G-map it is, in increasing order
};

/// The n-map of a G-map with the orientation of a dart: beta_i is alpha_0 and then alpha_i, i >= 1, where that one is
/// not free, on what these reach from the dart. From a dart of the other orientation it is the inverse map, on the
/// other half of the darts. Cost: n^2 times the darts. Requires: n >= 0. Errors    bad_input: no such dart. Refused,
/// naming a dart: 0-free; alpha_i for i >= 2 agrees with alpha_0 on it, so
///           that beta_i would fix it (the reason why some maps of P. Lienhardt (1994) are refused here); it cannot be
///           reached; or it has the orientation of the dart alpha_0 of it, which is that the map is not orientable.
[[nodiscard]] Result<HalfOfMap> to_nmap(const GMap& map, Dart start);

/// Both orientations of a G-map beside each other, on the same darts; each n-map of a part of it is a component.
/// Errors    refused, as above, but for the last two reasons. Cost: n^2 times the darts. Requires: n >= 0.
[[nodiscard]] Result<NMap> turning_map(const GMap& map);

}  // namespace sesame::ops

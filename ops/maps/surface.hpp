/// \file
/// Which surface a connected map of dimension 2 is.
#pragma once

#include <cstdint>
#include <string>

#include "ops/maps/gmap.hpp"

namespace sesame::ops {

/// A connected surface, as the classification of surfaces has it (H. Seifert, W. Threlfall, 1934): the boundary
/// circles, once filled with discs, leave a sphere, a connected sum of tori or one of projective planes.
struct Surface {
  bool orientable = true;
  std::int64_t summands = 0;  ///< tori, or projective planes when it is not orientable
  std::int64_t boundary_circles = 0;
  [[nodiscard]] std::int64_t euler() const { return 2 - (orientable ? 2 : 1) * summands - boundary_circles; }
  friend bool operator==(const Surface&, const Surface&) = default;
};

/// The surface of a 2-G-map. Every dart may be free, of each index: all that is free is boundary. Cost: the darts.
/// Errors    refused: another dimension (nothing like it is known there), no dart, not connected (naming a dart that
///           cannot be reached).
[[nodiscard]] Result<Surface> surface_of(const GMap& map);
/// Its name: "a torus", "a sum of 3 projective planes with 2 boundary circles", "a disc".
[[nodiscard]] std::string describe(const Surface& surface);

}  // namespace sesame::ops

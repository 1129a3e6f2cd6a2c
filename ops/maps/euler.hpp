/// \file
/// Euler characteristics of maps: that of the object, and what counting cells makes of it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ops/maps/incidence.hpp"

namespace sesame::ops {

/// Per dimension 0, ..., n: how many simplices the simplicial analogue has: those with numbers I are the orbits of the
/// involutions without I. Cost: 2^(n+1) times the darts, times n.
[[nodiscard]] std::vector<std::uint64_t> simplex_counts(const GMap& map);
/// Per dimension 0, ..., n: how many cells. Cost: the darts times n^2.
[[nodiscard]] std::vector<std::uint64_t> cell_counts(const GMap& map);

/// The Euler characteristic of the object, with or without boundary: the alternating sum of `simplex_counts`. Of an
/// n-map it is that of its G-map (map_conversions.hpp). It adds up over components.
[[nodiscard]] std::int64_t simplicial_euler(const GMap& map);
/// The alternating sum of `cell_counts`, which is cheaper and means nothing unless cells are balls: see below.
[[nodiscard]] std::int64_t cellular_euler(const GMap& map);

/// What breaks the conditions of P. Lienhardt (1994) under which both characteristics agree. They suffice; that they
/// are broken does not say that the characteristics differ.
struct EulerConditions {
  std::optional<IndexedDart> free;    ///< a dart that is free: the map has boundary
  std::optional<IndexedDart> folded;  ///< a dart b with alpha_i(b) among what all but alpha_{i-1}, alpha_i, alpha_{i+1}
                                      ///< reach from it: something is folded onto itself. So is a free dart.
  std::optional<IndexedDart> hollow;  ///< a dart whose component under alpha_0, ..., alpha_i, i < n, has not the
                                      ///< characteristic of an i-sphere: the boundary of a cell, no ball then
  [[nodiscard]] bool hold() const { return !free && !folded && !hollow; }
};

/// Each witness is the first one: of the least index, and of its darts the least. Cost: as `simplex_counts`.
[[nodiscard]] EulerConditions euler_conditions(const GMap& map);

}  // namespace sesame::ops

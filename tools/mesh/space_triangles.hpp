/// \file
/// Polygons cut into triangles that lie where the polygon does.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/mesh/mesh.hpp"

namespace sesame::tools {

/// Three corners of a polygon, by their places in it, in its order.
using CornerTriple = std::array<std::uint32_t, 3>;

/// Cuts a polygon as a fan from its first corner when that has no triangle turned over, else by cutting off ears, so
/// that flat concave polygons are covered once. `triangulate` (triangulate.hpp) minds the topology only; here places
/// count, and diagonals may join points that an edge joins too.
///
/// Where the polygon has no such triangles, as some that are far from flat, the rest is a fan. Requires: at least three
/// corners. Cost: the corners for a fan, at most their cube else.
[[nodiscard]] std::vector<CornerTriple> cut_in_space(std::span<const Point> points,
                                                     std::span<const std::uint32_t> polygon);

}  // namespace sesame::tools

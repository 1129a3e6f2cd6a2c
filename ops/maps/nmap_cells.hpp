/// \file
/// Orbits of the darts of an n-map: its cells and components.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "ops/maps/nmap.hpp"
#include "ops/maps/orbits.hpp"

namespace sesame::ops {

/// The i-cells, i = 0, ..., n: for i > 0, what all beta but beta_i reach, forwards and back. For i = 0, the darts that
/// leave a vertex: what beta_0 and then beta_j reach for j >= 2, and beta_i and then beta_j for 2 <= i < j, each of
/// them in one step, for where the dart between is missing they lead nowhere. In a map with boundary a vertex that no
/// dart leaves is no orbit: vertices are counted in the G-map of the map (map_conversions.hpp). With n <= 1 cells are
/// single darts. Cost: the darts times n, for vertices n^2.
[[nodiscard]] Orbits cells(const NMap& map, int i);
[[nodiscard]] Orbits components(const NMap& map);
[[nodiscard]] bool is_connected(const NMap& map);
/// A dart of the i-cell of d from where one of the steps around that cell leads nowhere: such a cell is open. `no_dart`
/// when there is none. Cost: the darts.
[[nodiscard]] Dart opening(const NMap& map, int i, Dart d);

/// The dual: (n-i)-cells are the i-cells, dart by dart. beta'_k is beta_n and then beta_{n-k} for k < n, and beta'_n is
/// beta_n; with n = 1, beta'_1 is beta_0. Cost: n^2 times the darts.
/// Errors    refused, naming a dart: one is n-free (the dual would lose what is beyond), or beta_n and beta_i agree on
///           one for an i <= n - 2 (beta'_{n-i} would fix a dart).
[[nodiscard]] Result<NMap> dual(const NMap& map);

/// The graph that a 2-map draws: vertices are its 0-cells, by their numbers in `cells(map, 0)`, and each edge has the
/// two that it leads between, that of its smaller dart first; loops and several edges between two vertices are usual.
/// In the order of `cells(map, 1)`. Requires: dimension 2, no 2-free dart.
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> graph_of(const NMap& map);

}  // namespace sesame::ops

/// \file
/// Constructions to measure with: objects with known homology, put together step by step. Each is determined by its
/// parameters and seed, on every machine.
#pragma once

#include <cstdint>
#include <vector>

#include "ops/vocabulary/operation.hpp"

namespace sesame::tools {

using Operations = std::vector<ops::Operation>;

/// In which order an object is assembled from its tiles: its cells of the largest dimension.
enum class Order {
  inside_out,   ///< breadth first, each tile glued at once to what is there: one step makes it, one step glues it
  random,       ///< the tiles in random order, each glued at once to what is there
  tiles_first,  ///< all tiles, then all gluings, a side at a time, both in random order: as many pieces as can be
};
struct Assembly {
  Order order = Order::inside_out;
  std::uint64_t seed = 1;  ///< of the random orders
};

// ---- surfaces

/// The torus of n x n squares, n >= 1: 4 n^2 cells. H = Z, Z^2, Z.
[[nodiscard]] Operations torus(std::uint32_t n, Assembly assembly = {});
/// The Klein bottle of n x n squares cut into triangles, n >= 3: 6 n^2 cells. H = Z, Z + Z/2, 0.
[[nodiscard]] Operations klein_bottle(std::uint32_t n, Assembly assembly = {});
/// Squares, each made and then glued to a Klein bottle of its own. H = Z^count, Z^count + (Z/2)^count.
[[nodiscard]] Operations separate_klein_bottles(std::uint32_t count);
/// The orientable surface of a genus: tori of n x n squares cut into triangles, each joined to the one before along a
/// triangle that both lose. genus >= 1, n >= 4: 6 genus n^2 - 8 (genus - 1) cells. H = Z, Z^(2 genus), Z.
[[nodiscard]] Operations surface_of_genus(std::uint32_t genus, std::uint32_t n, Assembly assembly = {});

/// The torus of n x n polygons with four sides, n >= 1, sewn side by side, row by row: 3 n^2 steps, 4 n^2 cells.
/// H = Z, Z^2, Z.
[[nodiscard]] Operations torus_of_polygons(std::uint32_t n);

// ---- solids

/// Menger's sponge, 0 <= level <= 4: 20^level cubes, glued along their squares. H = Z, Z^menger_tunnels(level).
[[nodiscard]] Operations menger_sponge(int level, Assembly assembly = {});
/// The same of cubes that are 3-G-maps of 48 darts, sewn where the others are glued, by the same steps.
[[nodiscard]] Operations menger_sponge_of_maps(int level, Assembly assembly = {});
/// The same, and then, cell by cell with `remove_cell`, as few cells as are left when whatever lies between two different
/// cells goes and the groups stay: one volume, cut by a face for each tunnel.
[[nodiscard]] Operations simplified_menger_sponge(int level);
/// 0, 5, 81, 1409, 26433 for the levels 0 to 4. The sponge is a ball with this number of handles: its surface has
/// 2 20^level + 4 8^level squares, and (21 20^level + 38 8^level - 59) / 133 is the genus of it.
[[nodiscard]] std::int64_t menger_tunnels(int level);

/// The 3-torus of n^3 cubes, each cut into the six tetrahedra of Freudenthal's triangulation, n >= 1: 26 n^3 cells.
/// H = Z, Z^3, Z^3, Z.
[[nodiscard]] Operations freudenthal_torus(std::uint32_t n, Assembly assembly = {});

// ---- the same place again and again

/// `places` pairs of triangles with a common edge; then, `times` times, the third vertices of a pair become one, which
/// makes a loop, and are split again: the pairs take turns. H = Z^places, with one Z in H_1 after each gluing.
[[nodiscard]] Operations glued_and_split(std::uint32_t places, std::uint64_t times);
/// The same, but each gluing is undone.
[[nodiscard]] Operations glued_and_undone(std::uint32_t places, std::uint64_t times);
/// A square; then, `times` times, its opposite sides are glued, which makes a torus, and in one step it is cut open
/// along both circles. H = Z, with Z^2 and Z above it after each gluing.
[[nodiscard]] Operations glued_and_cut_square(std::uint64_t times);
/// The construction, then as many steps that each take one back: the object is empty in the end.
/// Requires: there is no undo in it.
[[nodiscard]] Operations replayed_backwards(Operations operations);

/// The torus of n x n squares cut into triangles, n >= 3, in one insertion; then `times` times a random triangle is
/// removed, or one of those that have been is inserted again. With m > 0 triangles away H = Z, Z^(1 + m); with all of
/// them there H = Z, Z^2, Z.
[[nodiscard]] Operations torus_with_triangles_edited(std::uint32_t n, std::uint64_t times, std::uint64_t seed);

// ---- complexes, cones, products

/// All edges between the vertices, then `triangles` different random triangles (as many as there are when that is
/// fewer), inserted one by one. H_0 = Z; the ranks of H_1 and H_2 differ by binomial(vertices - 1, 2) - triangles.
/// Requires vertices <= 2000.
[[nodiscard]] Operations random_triangles(std::uint32_t vertices, std::size_t triangles, std::uint64_t seed);

/// `points` points, then cones over everything, one after the other: (points + 1) 2^cones - 1 cells. H = Z from the
/// first cone on.
[[nodiscard]] Operations iterated_cones(std::uint32_t points, std::uint32_t cones);
/// The sphere as the boundary of a cross-polytope: two points, suspended `dimension` times by a cone over everything
/// and a second one over what was there before. 3^(dimension + 1) - 1 cells. H = that of the sphere.
[[nodiscard]] Operations suspended_points(std::uint32_t dimension);
/// The Klein bottle of n x n squares, suspended: 18 n^2 + 2 cells. H = Z, 0, Z + Z/2, 0.
[[nodiscard]] Operations suspended_klein_bottle(std::uint32_t n, Assembly assembly = {});

/// The product of circles of `edges` edges each: (2 edges)^factors cells. H_p has rank binomial(factors, p).
/// edges >= 1, factors >= 1.
[[nodiscard]] Operations product_of_circles(std::uint32_t edges, std::uint32_t factors);
/// The same, then `gluings` < edges of its vertices become one with its first vertex, step by step: each step adds a
/// loop, so the rank of H_1 is factors + gluings.
[[nodiscard]] Operations glued_product_of_circles(std::uint32_t edges, std::uint32_t factors, std::uint32_t gluings);

// ---- all at once

/// The Klein bottle of n x n squares cut into triangles, n >= 3, as one `complex`: 6 n^2 cells. H = Z, Z + Z/2, 0.
[[nodiscard]] Operations klein_bottle_at_once(std::uint32_t n);
/// The simplices of `rips_filtration` as one insertion, in that order.
[[nodiscard]] Operations rips_at_once(std::uint32_t points, std::size_t cells, std::uint64_t seed);

// ---- torsion

/// The matching complex of the complete graph on n vertices: its vertices are the edges, its simplices sets of disjoint
/// ones. In one step. For n = 7: H = Z, Z/3, Z^20; for n = 11: Z, 0, 0, Z^1188 + (Z/3)^45, Z^252.
[[nodiscard]] Operations matching_complex(std::uint32_t n);
/// The chessboard complex of n x n squares: its vertices are the squares, its simplices sets of them of which no two
/// are in one row or column. In one step. For n = 5: H = Z, 0, Z/3, Z^56; for n = 7: Z, 0, 0, 0, Z^588 + (Z/3)^66,
/// Z^792.
[[nodiscard]] Operations chessboard_complex(std::uint32_t n);
/// Tetrahedra; then their faces are glued in random pairs, in the order of their vertices, a pair a step.
[[nodiscard]] Operations random_gluings(std::uint32_t tetrahedra, std::uint64_t seed);
/// All edges between the vertices in one step, then triangles in random order, one a step: those that raise the rank of
/// the boundary, which is told modulo a prime. H = Z, a finite group, 0.
[[nodiscard]] Operations acyclic_triangles(std::uint32_t vertices, std::uint64_t seed);

}  // namespace sesame::tools

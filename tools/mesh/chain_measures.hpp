/// \file
/// How long, how large and where the cycles of a mesh are.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sparse/ring.hpp"
#include "tools/mesh/mesh_cells.hpp"
#include "tools/mesh/mesh_generator.hpp"

namespace sesame::tools {

/// -1 as the engine writes it over a ring.
[[nodiscard]] sparse::Integer minus_one(const sparse::AnyRing& ring);
/// Whether a coefficient and its negative differ: over Z and Q.
[[nodiscard]] bool has_signs(const sparse::AnyRing& ring);

/// Measures chains of a mesh over a ring. Sums are scaled by powers of two: squares of coordinates may be beyond a
/// double.
class ChainMeasures {
 public:
  /// Both must outlive it.
  ChainMeasures(const MeshCells& cells, const sparse::AnyRing& ring) : cells_{cells}, ring_{ring} {}

  /// Of the chain of a generator of degree 1: box, length, centre.
  void measure_cycle(MeshGenerator& generator) const;
  /// Of degree 2: box, area, centre, and the volume where there are signs.
  void measure_surface(MeshGenerator& generator) const;

 private:
  [[nodiscard]] const Mesh& triangles() const { return cells_.mesh().triangles; }
  [[nodiscard]] double times(const sparse::Rational& coefficient) const;
  void measure_area(MeshGenerator& generator) const;
  [[nodiscard]] Measure volume(const MeshGenerator& generator) const;
  [[nodiscard]] Point normal_of(std::uint32_t triangle, const Point& origin, int exponent) const;
  [[nodiscard]] std::array<Point, 3> corners_from(const Point& origin, std::span<const std::uint32_t> corners,
                                                  int exponent) const;

  const MeshCells& cells_;
  const sparse::AnyRing& ring_;
};

}  // namespace sesame::tools

/// \file
/// Filtrations to measure with: cell complexes in an order in which every cell comes after its faces. Each is
/// determined by its size and seed, on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <span>
#include <vector>

namespace sesame::tools {

/// Lists of numbers, one after another.
class NumberLists {
 public:
  void push_back(std::span<const std::uint32_t> list) {
    numbers_.insert(numbers_.end(), list.begin(), list.end());
    ends_.push_back(numbers_.size());
  }
  [[nodiscard]] std::size_t size() const { return ends_.size(); }
  [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends_[i - 1];
    return {numbers_.data() + begin, ends_[i] - begin};
  }

 private:
  std::vector<std::uint32_t> numbers_;
  std::vector<std::size_t> ends_;
};

/// Cells by their place in the filtration.
struct Filtration {
  std::vector<std::uint8_t> dimensions;
  std::vector<double> values;  ///< not decreasing
  NumberLists faces;           ///< the places of the faces of codimension 1, ascending
  NumberLists vertices;        ///< of each simplex, ascending; empty when the cells are no simplices

  [[nodiscard]] std::size_t size() const { return dimensions.size(); }
  [[nodiscard]] bool is_simplicial() const { return vertices.size() == size(); }
};

/// The torus of n x n vertices, every square cut by a diagonal: 6 n^2 cells, ordered by their largest vertex, which is
/// their value, then dimension, then vertices. Requires 3 <= n <= 20000.
Filtration torus_filtration(std::uint32_t n);

/// The Vietoris-Rips complex, up to tetrahedra, of `points` random points in the unit cube, up to the length at which
/// it has `cells` cells or more (all of them when it never has): ordered by diameter, dimension, vertices.
Filtration rips_filtration(std::uint32_t points, std::size_t cells, std::uint64_t seed);

/// Random values in [0, 1) on the n^3 vertices of a cubical grid; every cell has the largest value of its vertices, and
/// cells are ordered by value, dimension, position. Every round of smoothing replaces a value by the mean over the
/// vertices at most one step away in each direction. Requires 1 <= n <= 800.
Filtration cubical_filtration(std::uint32_t n, unsigned rounds_of_smoothing, std::uint64_t seed);

/// All vertices, then all edges, then `triangles` different random triangles (as many as there are when that is fewer);
/// the value is the place. Requires vertices <= 2000.
Filtration random_two_complex(std::uint32_t vertices, std::size_t triangles, std::uint64_t seed);

/// The boundary matrix as PHAT reads it. ASCII: a line `dim r1 r2 ...` a cell. Binary, in 64 bit integers of this
/// machine: the number of cells, then for each dim, the number of rows, the rows.
void write_phat(std::ostream& out, const Filtration& filtration);
void write_phat_binary(std::ostream& out, const Filtration& filtration);
/// A line `dim v0 ... vd value` a simplex. Requires is_simplicial().
void write_gudhi(std::ostream& out, const Filtration& filtration);
/// A line `i v0 ... vd` a simplex. Requires is_simplicial().
void write_tower(std::ostream& out, const Filtration& filtration);

}  // namespace sesame::tools

/// \file
/// The cells of an object as it is now, in an order, with their boundaries: what every format of an export begins with.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ops/cells/per_node.hpp"
#include "ops/cells/structure.hpp"
#include "sparse/result.hpp"

namespace sesame::replay {

/// A face in a boundary: its number among the cells of its dimension, and how often it is there, never 0.
struct BoundaryTerm {
  std::uint32_t face;
  int coefficient;
  friend bool operator==(const BoundaryTerm&, const BoundaryTerm&) = default;
};

/// The cells of an object by dimension, those of one by age, oriented as their canonical names say. To be used as long
/// as the structure is not changed.
///
/// Threads: one at a time, for queries too.
class ObjectCells {
 public:
  /// Lists them. Errors, refused: products and large cones would have to be written out, and there are more than
  /// `most` cells. Cost: the cells ever made, and those of products and large cones.
  [[nodiscard]] static Result<ObjectCells> list(const ops::Structure& structure, std::uint64_t most);

  [[nodiscard]] const ops::Structure& structure() const { return *structure_; }
  /// One more than the dimension of the object, 0 when it has no cells.
  [[nodiscard]] std::size_t dimensions() const { return cells_.size(); }
  [[nodiscard]] std::span<const ops::CellId> of(std::size_t dimension) const {
    return dimension < cells_.size() ? std::span<const ops::CellId>{cells_[dimension]} : std::span<const ops::CellId>{};
  }
  [[nodiscard]] std::uint64_t size() const;
  /// The number of a cell among those of its dimension, from 0. Requires: it is one of them.
  [[nodiscard]] std::uint32_t number(ops::CellId cell) const { return number_[cell]; }
  /// The boundary of a cell, by face; degenerate faces count 0.
  void boundary(ops::CellId cell, std::vector<BoundaryTerm>& terms) const;
  /// The numbers of the vertices of a cell, in the lexicographic order of the vertices of its type, as its canonical
  /// name has them; of a polygon of a map in turn, and none of a larger cell of a map. One that is several vertices of
  /// the cell is listed as often.
  void corners(ops::CellId cell, std::vector<std::uint32_t>& corners) const;

 private:
  explicit ObjectCells(const ops::Structure& structure) : structure_{&structure} {}

  const ops::Structure* structure_;
  std::vector<std::vector<ops::CellId>> cells_;  ///< by dimension
  ops::PerNode<std::uint32_t> number_;           ///< of those that are none of the object, 0
};

}  // namespace sesame::replay

/// \file
/// Simploids: the types of cells, their faces, the laws between faces, and the standard cell of each type.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ops/ids.hpp"
#include "sparse/archive.hpp"

namespace sesame::ops {

/// A simploid of type (a_1, ..., a_n), a_i >= 1, is a product of simplices of dimensions a_1, ..., a_n.
/// A vertex has the empty type, a p-simplex the type (p), a p-cube the type (1, ..., 1).
using CellType = std::vector<int>;

/// The k-th face operator of a type, in the flattened order d^1_0, d^1_1, ..., d^2_0, ...
struct FaceOperator {
  int component;  ///< i, counted from 0
  int vertex;     ///< j in 0..a_i
  int sign;       ///< (-1)^(j + a_1 + ... + a_{i-1})
  TypeId type;    ///< of the face
};

/// Face `second` of face `first` is the same cell as face `other_second` of face `other_first`.
struct FaceLaw {
  std::uint32_t first, second, other_first, other_second;
};

/// One cell of a standard simploid: its faces are earlier cells of the same list.
struct StandardFace {
  TypeId type;
  std::vector<std::uint32_t> faces;  ///< in flattened order, as positions in StandardCell::cells
  std::string suffix;                ///< vertex subsets, "0-1x0"; the whole cell has its own
};

/// A standard simploid with all its faces, by dimension and then lexicographically in the vertex subsets; the top last.
struct StandardCell {
  std::vector<StandardFace> cells;
  std::vector<std::uint32_t> by_suffix;  ///< their positions, sorted by suffix

  /// The position of the cell with a suffix, or none. Cost: the logarithm of the number of cells.
  [[nodiscard]] std::uint32_t find(std::string_view suffix) const;
};

/// Everything about one type.
struct TypeInfo {
  CellType type;
  int dimension = 0;
  std::vector<FaceOperator> faces;
  std::vector<FaceLaw>
      laws;  ///< each unordered pair of equal double faces once; they imply that boundaries compose to 0
};

/// The types met so far, each described once. Knowledge, not state: it only grows, and nothing depends on its order.
class TypeTable {
 public:
  TypeTable();
  TypeTable(const TypeTable&) = delete;
  TypeTable& operator=(const TypeTable&) = delete;
  ~TypeTable() = default;

  /// The id of a type; describes it when it is new. Requires: all entries >= 1 and total_faces(type) is small enough.
  TypeId intern(const CellType& type);
  TypeId simplex(int dimension);
  [[nodiscard]] TypeId vertex() const { return 0; }
  /// The type of a product of cells of two types: the one after the other.
  TypeId product(TypeId left, TypeId right);
  /// The type of the cone over a cell: a simplex of one more dimension, or `by_edge` the product with an edge.
  TypeId coned(TypeId base, bool by_edge);
  [[nodiscard]] const TypeInfo& info(TypeId id) const { return infos_[id]; }
  /// The standard cell of a type, made when first asked for. Cost then: the number of its faces times its dimension.
  const StandardCell& standard(TypeId id);
  [[nodiscard]] TypeId size() const { return static_cast<TypeId>(infos_.size()); }

  // ---- to an archive, and into a new table from one, which fails when it is unsound
  void save(sparse::ArchiveWriter& to) const;
  void load(sparse::ArchiveReader& from);

 private:
  std::deque<TypeInfo> infos_;
  std::map<CellType, TypeId> ids_;
  std::vector<TypeId> simplices_;                         ///< by dimension, or none
  std::vector<std::unique_ptr<StandardCell>> standards_;  ///< by type, those that were asked for
};

/// The number of cells of a standard simploid, the product of 2^(a_i + 1) - 1; saturates at 2^63 - 1.
[[nodiscard]] std::int64_t standard_cell_count(const CellType& type);
/// "vertex", "simplex of dimension 2", "cube of dimension 2", "simploid [2,1]".
[[nodiscard]] std::string describe(const CellType& type);
/// True for vertices and types (p).
[[nodiscard]] bool is_simplex(const CellType& type);

}  // namespace sesame::ops

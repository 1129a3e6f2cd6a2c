/// \file
/// The types of cells, simploids and cells of maps: their faces, the laws between faces, and the standard cell of each.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ops/cells/cell_shape.hpp"
#include "ops/cells/cone_shape.hpp"
#include "ops/cells/dart_cells.hpp"
#include "ops/ids.hpp"
#include "ops/maps/gmap.hpp"
#include "sparse/archive.hpp"

namespace sesame::ops {

/// A simploid of type (a_1, ..., a_n), a_i >= 1, is a product of simplices of dimensions a_1, ..., a_n.
/// A vertex has the empty type, a p-simplex the type (p), a p-cube the type (1, ..., 1).
/// The type of a cell of a map that is none of these is 0, its dimension p >= 2, and the images under alpha_0, ...,
/// alpha_{p-1} of the darts of its canonical boundary, as CellShape has them.
/// The type of a cell that is known by its boundary is a KnownBy, its dimension, and for each face its coefficient
/// there, and the length and the numbers of its type.
using CellType = std::vector<int>;

/// How a cell comes to be known by its boundary.
enum class KnownBy : int {
  listing = -1,  ///< it was listed so
  /// It stands for a cell of a map that is no ball, or is another generator of it, a *part*: see ConeShape.
  cone = -2,
  cone_part = -3,
};
[[nodiscard]] inline bool is_of_map(const CellType& type) { return !type.empty() && type[0] == 0; }
[[nodiscard]] inline bool is_by_boundary(const CellType& type) { return !type.empty() && type[0] < 0; }
/// Whether it stands for a cell that is no ball, and may have parts; or is one of those.
[[nodiscard]] inline bool is_cone(const CellType& type) {
  return !type.empty() && type[0] == static_cast<int>(KnownBy::cone);
}
[[nodiscard]] inline bool is_cone_part(const CellType& type) {
  return !type.empty() && type[0] == static_cast<int>(KnownBy::cone_part);
}
/// A product of simplices.
[[nodiscard]] inline bool is_simploid(const CellType& type) { return type.empty() || type[0] > 0; }

/// The k-th face operator of a type, in the flattened order d^1_0, d^1_1, ..., d^2_0, ...
/// That of a cell of a map has number k where its component is 0 and its vertex k; its sign is that of the root of the
/// face, and its type that of the face as seen from there. That of a cell known by its boundary has its coefficient for
/// a sign.
struct FaceOperator {
  int component;  ///< i, counted from 0
  int vertex;     ///< j in 0..a_i
  int sign;       ///< (-1)^(j + a_1 + ... + a_{i-1}): the coefficient in the boundary
  TypeId type;    ///< of the face
};

/// Face `second` of face `first` is the same cell as face `other_second` of face `other_first`, seen from a dart of it
/// where that is a cell of a map.
struct FaceLaw {
  std::uint32_t first, second, other_first, other_second;
  Dart other_dart = 0;
};

/// One cell of a standard simploid: its faces are earlier cells of the same list.
struct StandardFace {
  TypeId type;
  std::vector<std::uint32_t> faces;  ///< in flattened order, as positions in StandardCell::cells
  /// From which dart of these each is seen; empty for simploids, whose faces keep the order of their vertices.
  std::vector<Dart> face_darts;
  std::string suffix;  ///< vertex subsets, "0-1x0", or dimension and dart, "1:2"; the whole cell has its own
};

/// A standard simploid with all its faces, by dimension and then lexicographically in the vertex subsets; the top last.
struct StandardCell {
  std::vector<StandardFace> cells;
  std::shared_ptr<const DartCells> darts;  ///< of the cell of a map, whose darts are those of its boundary
  std::vector<std::uint32_t> by_suffix;    ///< their positions, sorted by suffix

  /// The position of the cell with a suffix, or none. Cost: the logarithm of the number of cells.
  [[nodiscard]] std::uint32_t find(std::string_view suffix) const;
};

/// Everything about one type.
struct TypeInfo {
  CellType type;
  int dimension = 0;
  std::vector<FaceOperator> faces;
  std::vector<FaceLaw>
      laws;  ///< each unordered pair of equal double faces once; they imply that boundaries compose to 0. No law says
             ///< this of a cell known by its boundary: it is to be looked at with its faces.
  std::unique_ptr<const CellShape> shape;  ///< of a cell of a map, else null
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

  // ---- cells that are known by their boundaries
  struct BoundaryFace {
    int coefficient;  ///< not 0
    TypeId type;
  };
  /// The type of those of a dimension >= 1 with some faces, in this order. How many numbers it consists of; it should
  /// not be too many.
  TypeId by_boundary(int dimension, std::span<const BoundaryFace> faces, KnownBy known_by = KnownBy::listing);
  [[nodiscard]] std::size_t length_by_boundary(std::span<const BoundaryFace> faces) const;

  // ---- cells of maps; where vertices and edges are asked about they are cells of maps with one and two darts
  /// The type of the cell over a canonical boundary, rooted at dart 0, or none when that is no homology sphere. A
  /// vertex is over a point, an edge over two. Cost: when it is new, is_homology_sphere.
  TypeId cell_over(const GMap& boundary);
  /// The shape of the cell over a connected boundary, which need be no homology sphere, and not be rooted in any way;
  /// null when a cell of the boundary is no ball. Cost: when it is new, cone_shape_of.
  const ConeShape* cone_over(const GMap& boundary);
  /// How many darts the canonical boundary has.
  [[nodiscard]] Dart darts(TypeId id) const;
  /// The type of the same cells as seen from another dart. Cost: their darts, when it is asked for first.
  TypeId seen_from(TypeId id, Dart root);
  /// Which dart of a cell dart d is, where d is counted from the dart `root` of the cell; and the other way round.
  [[nodiscard]] Dart dart_from(TypeId id, Dart root, Dart d);
  [[nodiscard]] Dart dart_seen_from(TypeId id, Dart root, Dart d);
  /// Of which face a dart is, and which dart of it; and the dart of a cell from which a face is seen.
  [[nodiscard]] CellShape::Place place_in_face(TypeId id, Dart d) const;
  [[nodiscard]] Dart face_root(TypeId id, std::uint32_t face) const;
  /// +1 or -1: whether the dart sees the cell with its own orientation.
  [[nodiscard]] int sign_of_dart(TypeId id, Dart d) const;
  /// The type that all these cells have when they are made, whichever dart sees them, and which dart of it the root is.
  struct Canonical {
    TypeId type;
    Dart root;
  };
  Canonical canonical(TypeId id);
  /// The standard cell of a type, made when first asked for. Cost then: the number of its faces times its dimension.
  const StandardCell& standard(TypeId id);
  [[nodiscard]] TypeId size() const { return static_cast<TypeId>(infos_.size()); }

  // ---- to an archive, and into a new table from one, which fails when it is unsound
  void save(sparse::ArchiveWriter& to) const;
  void load(sparse::ArchiveReader& from);

 private:
  TypeId add(CellType type, TypeInfo info);
  TypeId intern_shape(const GMap& boundary);
  const std::vector<Dart>& order_from(TypeId id, Dart root);
  StandardCell standard_simploid(const CellType& whole);
  StandardCell standard_of_map(TypeId whole);
  bool load_by_boundary(const CellType& type, sparse::ArchiveReader& from);
  bool load_shape(const CellType& type, sparse::ArchiveReader& from);

  std::deque<TypeInfo> infos_;
  std::map<CellType, TypeId> ids_;
  std::vector<TypeId> simplices_;                                ///< by dimension, or none
  std::vector<std::unique_ptr<StandardCell>> standards_;         ///< by type, those that were asked for
  std::map<std::pair<TypeId, Dart>, std::vector<Dart>> orders_;  ///< of darts, from the roots that were asked for
  std::map<TypeId, Canonical> canonical_;                        ///< those that were asked for
  std::map<CellType, std::optional<ConeShape>> cones_;           ///< likewise, by what they are over
};

/// The number of cells of a standard simploid, the product of 2^(a_i + 1) - 1; saturates at 2^63 - 1.
[[nodiscard]] std::int64_t standard_cell_count(const CellType& type);
/// "vertex", "simplex of dimension 2", "cube of dimension 2", "simploid [2,1]", "polygon with 5 sides", "cell of
/// dimension 3 with 48 darts", "cell of dimension 2 with a boundary of 4 terms".
[[nodiscard]] std::string describe(const CellType& type);
/// True for vertices and types (p).
[[nodiscard]] bool is_simplex(const CellType& type);

}  // namespace sesame::ops

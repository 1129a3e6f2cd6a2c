/// \file
/// Values: cells with their vertices in any order, or seen from any dart, and degenerate cells; their arithmetic.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "ops/cells/cell_type.hpp"
#include "ops/cells/degeneracy.hpp"
#include "ops/ids.hpp"
#include "sparse/archive.hpp"

namespace sesame::ops {

/// A map from the vertices of some type onto those of a cell, component by component; the cell has a component for each
/// one that is not sent to a single vertex. `order` puts the vertices into the order of those that they go to, and
/// leaves the order of vertices that go to one; after that the map is monotone, and the directions that it collapses
/// are `collapsed`.
///
/// The value of a cell of a map is the cell as seen from a dart, which is what its order says; its type is that of the
/// cell as seen from there, and no direction is collapsed.
///
/// In normal form the cell is a current one. Then there is one value for each cell of the object, in each order of its
/// vertices, and for each degenerate one (the Eilenberg-Zilber lemma, for symmetric simplicial sets in which no cell is
/// itself in another order).
struct Value {
  CellId cell = none;
  TypeId type = 0;
  Degeneracy collapsed = 0;
  OrderId order = same_order;
  [[nodiscard]] bool is_degenerate() const { return collapsed != 0; }
  /// A cell, its vertices in its own order.
  [[nodiscard]] bool is_plain() const { return collapsed == 0 && order == same_order; }
  friend bool operator==(const Value&, const Value&) = default;
};

[[nodiscard]] inline std::size_t mix(std::size_t seed, std::uint64_t value) {
  return (seed ^ value) * 0x9E37'79B9'7F4A'7C15ULL ^ (seed >> 29);
}
struct ValueHash {
  std::size_t operator()(const Value& v) const {
    return mix(mix(v.cell, std::uint64_t{v.type} << 32U | v.order), v.collapsed);
  }
};

/// Where vertices go: an entry for each vertex of a type, the components one after the other as those of its faces are,
/// and in it the number of a vertex of the cell, counted from 0 in each component.
using VertexMap = std::vector<std::uint8_t>;

/// The arithmetic of values, and the orders that occur. Orders are permutations of the vertices of a type, which are
/// numbered through all components; none moves a vertex to another component. Those of a cell of a map are its darts:
/// the one from which it is seen takes the place of its root. They are knowledge, not state, as types are: they only
/// grow in number, and nothing depends on theirs. Cost of all below: O(1) where vertices keep their order, else the
/// square of their number; of cells of maps the logarithm of the darts that were met, or the darts when one is met
/// first.
class VertexMaps {
 public:
  explicit VertexMaps(TypeTable& types) : types_{types} {}
  [[nodiscard]] TypeTable& types() const { return types_; }

  /// The map of a value, and the value of a map.
  [[nodiscard]] VertexMap map_of(const Value& v) const;
  [[nodiscard]] Value value_of(CellId cell, TypeId type, const VertexMap& map);

  /// The value whose map is that of `outer`, then that of `inner`: `inner` is what the cell of `outer` is.
  [[nodiscard]] Value compose(const Value& outer, const Value& inner);
  [[nodiscard]] OrderId compose(OrderId outer, OrderId inner);
  [[nodiscard]] OrderId inverse(OrderId order);
  /// A value with its vertices in another order: vertex k of the new one is vertex order(k) of the old one.
  [[nodiscard]] Value reordered(OrderId order, const Value& v) {
    return compose(Value{none, seen_through(order, v.type), 0, order}, v);
  }

  /// Face k of a value, in normal form. `face_of(cell, number)` gives the faces of cells, in normal form.
  template <class FaceOf>
  [[nodiscard]] Value face(const Value& v, std::uint32_t k, FaceOf face_of) {
    if (v.is_plain()) {
      return face_of(v.cell, k);
    }
    const auto [rest, of_cell] = without_vertex(v, k);
    return of_cell == DegenerateFace::itself ? rest : compose(rest, face_of(v.cell, of_cell));
  }

  /// The product of two values, as a value of some cell: of the product of their cells.
  [[nodiscard]] Value product(CellId cell, const Value& left, const Value& right);
  /// The cone over a value, as a value of some cell, the cone over its cell: with one more vertex, the last one; or
  /// `by_edge` times an edge.
  [[nodiscard]] Value coned(CellId cell, const Value& v, bool by_edge);

  // ---- cells of maps; vertices and edges are such cells, too
  /// The order in which a cell of a type is seen from a dart of it.
  [[nodiscard]] OrderId order_at(TypeId type, Dart dart);
  /// Which dart it is.
  [[nodiscard]] Dart dart_of(OrderId order) const {
    return order == same_order ? 0 : is_of_map(order) ? orders_[order].dart : 1;
  }
  /// The type that a cell of a type has when it is seen in an order: the same one for simploids.
  [[nodiscard]] TypeId seen_through(OrderId order, TypeId type) {
    return is_of_map(order) ? types_.seen_from(type, orders_[order].dart) : type;
  }
  /// A value as another dart of it sees it.
  [[nodiscard]] Value seen_from(Dart dart, const Value& v) { return reordered(order_at(v.type, dart), v); }
  /// Which face of its cell face k of a value is that is not degenerate.
  [[nodiscard]] std::uint32_t face_of_cell(const Value& v, std::uint32_t k);

  /// Whether any other order but the same one has ever occurred.
  [[nodiscard]] bool has_orders() const { return orders_.size() > 1; }
  /// The order that sends vertex k to entry k. Requires: a permutation that keeps to the components.
  [[nodiscard]] OrderId order(std::span<const std::uint8_t> permutation);
  /// The permutation of an order; empty for the same order, and of a cell of a map.
  [[nodiscard]] std::span<const std::uint8_t> permutation(OrderId order) const { return orders_[order].permutation; }
  /// The order that another table has. Requires: its types are types here, but for those that cells have as seen from
  /// other darts.
  [[nodiscard]] OrderId taken_from(const VertexMaps& other, OrderId order) {
    const Order& taken = other.orders_[order];
    return taken.type != none ? order_at(taken.type, taken.dart) : this->order(taken.permutation);
  }
  /// +1 or -1: what the order does to the orientation of a cell.
  [[nodiscard]] int sign(OrderId order) const { return orders_[order].sign; }

  // ---- to an archive, and into a new table from one, which fails when it is unsound
  void save(sparse::ArchiveWriter& to) const;
  void load(sparse::ArchiveReader& from);
  /// Whether an order is one of the vertices of a type, which is a type; whether a value is one of a cell of a type.
  [[nodiscard]] bool is_order_of(OrderId order, TypeId type) const;
  [[nodiscard]] bool is_value_of(const Value& v, TypeId of_cell) const;

 private:
  struct Order {
    std::vector<std::uint8_t> permutation;
    int sign;
    TypeId type = none;  ///< of a cell of a map, seen from a dart
    Dart dart = 0;
  };
  struct FaceStep {
    Value rest;             ///< type and map are those of the face, onto face `of_cell` of the cell
    std::uint32_t of_cell;  ///< or DegenerateFace::itself: the cell itself
  };
  [[nodiscard]] FaceStep without_vertex(const Value& v, std::uint32_t k);
  [[nodiscard]] FaceStep face_of_map(const Value& v, std::uint32_t k);
  [[nodiscard]] bool is_of_map(OrderId order) const { return orders_[order].type != none; }

  TypeTable& types_;
  std::vector<Order> orders_{{{}, 1}};
  std::map<std::vector<std::uint8_t>, OrderId> index_;
  std::map<std::pair<TypeId, Dart>, OrderId> index_of_darts_;
};

}  // namespace sesame::ops

/// \file
/// What products of cells of maps look like.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "ops/cells/cell_type.hpp"
#include "ops/maps/map_product.hpp"

namespace sesame::ops {

/// The product of two cells of maps, vertices and edges among them, each seen from its dart 0.
struct ProductShape {
  TypeId type;                ///< that it has
  ProductDarts darts;         ///< of its canonical boundary
  std::vector<Dart> places;   ///< per such dart: which dart of the type it is
  std::vector<Dart> of_face;  ///< per face of the type: such a dart, from which the face is seen
};

/// Each worked out once. Knowledge, not state, as types are.
///
/// Threads: one at a time, as queries keep what they find.
class ProductTypes {
 public:
  explicit ProductTypes(TypeTable& types) : types_{types} {}

  /// Whether a cell of a type is one of a map, or looks like one: a vertex, an edge, or what is over a sphere.
  [[nodiscard]] static bool is_factor(const TypeInfo& type);
  /// Whether a product is small enough: its dimension, and the darts of its canonical boundary.
  [[nodiscard]] static bool is_possible(const TypeTable& types, TypeId left, TypeId right);
  static constexpr std::uint64_t most_darts = std::uint64_t{1} << 15;

  /// Requires: two factors whose product is possible. Cost: when it is new, canonical_root of the canonical boundary,
  /// and is_homology_sphere.
  [[nodiscard]] const ProductShape& of(TypeId left, TypeId right) const;

 private:
  TypeTable& types_;
  mutable std::map<std::pair<TypeId, TypeId>, ProductShape> known_;
};

}  // namespace sesame::ops

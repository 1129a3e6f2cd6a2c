#include "ops/cells/product_types.hpp"

#include "ops/maps/rooted_map.hpp"
#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

/// What a cell is over.
GMap boundary_of(const TypeInfo& type) {
  return type.shape != nullptr ? type.shape->boundary
         : type.dimension == 0 ? GMap::points(1)
                               : std::move(*GMap::make({{1, 0}}));
}

}  // namespace

bool ProductTypes::is_factor(const TypeInfo& type) {
  return type.shape != nullptr || (type.dimension <= 1 && is_simplex(type.type));
}

bool ProductTypes::is_possible(const TypeTable& types, TypeId left, TypeId right) {
  const int k = types.info(left).dimension, l = types.info(right).dimension;
  return k + l <= largest_map_dimension && count_of_darts(types.darts(left), k, types.darts(right), l) <= most_darts;
}

const ProductShape& ProductTypes::of(TypeId left, TypeId right) const {
  if (const auto known = known_.find({left, right}); known != known_.end()) {
    return known->second;
  }
  const GMap one = boundary_of(types_.info(left)), other = boundary_of(types_.info(right));
  const GMap boundary = boundary_of_product(one, other);
  ProductShape shape{none, {one.size(), one.dimension() + 1, other.size(), other.dimension() + 1}, {}, {}};
  const std::vector<Dart> order = darts_from(boundary, 0);
  sparse::expects(order.size() == boundary.size(), "what a product of balls is over is connected");
  const TypeId seen = types_.cell_over(restricted_to(boundary, order, boundary.dimension()));
  sparse::expects(seen != none, "the product of two balls is one");
  const TypeTable::Canonical canonical = types_.canonical(seen);
  shape.type = canonical.type;
  shape.places.resize(order.size());
  std::vector<Dart> dart_at(order.size());
  for (Dart k = 0; k < order.size(); ++k) {
    const Dart place = types_.dart_from(canonical.type, canonical.root, k);
    shape.places[order[k]] = place;
    dart_at[place] = order[k];
  }
  for (std::uint32_t face = 0; face < types_.info(shape.type).faces.size(); ++face) {
    shape.of_face.push_back(dart_at[types_.face_root(shape.type, face)]);
  }
  return known_.emplace(std::pair{left, right}, std::move(shape)).first->second;
}

}  // namespace sesame::ops

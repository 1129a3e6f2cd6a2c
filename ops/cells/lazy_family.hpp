/// \file
/// Cells that are made when they are asked for: those of a product of two bodies, and of a cone over whole bodies.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ops/cells/value.hpp"

namespace sesame::ops {

enum class FamilyKind : std::uint8_t {
  product,             ///< cells are pairs of cells
  simplicial_product,  ///< n-simplices are pairs of values of dimension n without a common collapsed direction
  cone,                ///< the cells of some bodies, and v*c for each of them
  map_product,         ///< cells are pairs of cells of maps, and cells of maps: see ProductShape
};
enum class LazyPart : std::uint8_t {
  pair,   ///< of a product
  base,   ///< of a cone: a cell that it was taken over
  coned,  ///< of a cone: v*c
};

/// What a step that makes a family is to do.
struct NewFamily {
  FamilyKind kind;
  std::string name;                   ///< of the product; the apex of the cone
  std::vector<BodyId> bodies;         ///< the factors, left and right; or all bodies under the cone
  bool by_edges = false;              ///< a cone whose cells are products with an edge, its far end squashed
  std::vector<std::uint64_t> counts;  ///< of its cells, by dimension; without the apex
  std::uint64_t simploids = 0;        ///< of these, the ones of a type longer than one
};

/// A family of lazy cells. The bodies that it is made of are frozen: nothing in them changes any more.
struct LazyFamily {
  FamilyKind kind;
  std::string name;
  std::vector<BodyId> bodies;
  bool by_edges = false;
  CellId apex = none;                 ///< of a cone
  CellId first = 0;                   ///< nodes with smaller ids were created before the family
  LinkId links = 0;                   ///< removals until then
  BodyId body = none;                 ///< that it made
  std::vector<std::uint64_t> counts;  ///< as in NewFamily
};

/// What a lazy cell is made of: current cells of the frozen bodies, with collapsed directions in simplicial products.
struct LazyKey {
  FamilyId family;
  LazyPart part;
  Value left;
  Value right;
  friend bool operator==(const LazyKey&, const LazyKey&) = default;
};
/// Threads: one at a time, as queries keep what they find.
struct LazyCell {
  LazyKey key;
  bool is_expanded = false;
  std::vector<CellId> faces = {};    ///< when expanded
  std::vector<OrderId> orders = {};  ///< of the faces
  mutable std::string name = {};     ///< when asked for
};

struct LazyKeyHash {
  std::size_t operator()(const LazyKey& key) const {
    return mix(mix(ValueHash{}(key.left), ValueHash{}(key.right)),
               std::uint64_t{key.family} << 2 | static_cast<std::uint64_t>(key.part));
  }
};

}  // namespace sesame::ops

/// \file
/// The darts that cells of maps are called by.
#pragma once

#include <map>
#include <unordered_map>
#include <utility>

#include "ops/cells/structure.hpp"

namespace sesame::ops {

/// For nodes of maps of one dimension. A cell of a product of maps, P.(a|b), counts as called by the least dart that it
/// was made with.
///
/// Threads: one at a time, for queries too.
class NamingDarts {
 public:
  explicit NamingDarts(const Structure& structure) : structure_{structure} {}

  /// Among all darts of maps of a dimension that of an i-cell, or no_dart. Cost: of a cell of a product when it is
  /// asked for the first time the darts of that, else the length of the name.
  [[nodiscard]] Dart of(CellId node, int i, int dimension) const;

 private:
  [[nodiscard]] Dart in_product(CellId node, int i, std::string_view called, int dimension) const;

  const Structure& structure_;
  using FirstDarts = std::unordered_map<std::uint32_t, Dart>;                // by node
  mutable std::map<std::pair<std::uint32_t, int>, FirstDarts> of_products_;  // by the first dart of the map, and i
};

}  // namespace sesame::ops

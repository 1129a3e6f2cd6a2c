/// \file
/// The simplices that darts of maps by simplices see by now.
#pragma once

#include <string>
#include <unordered_map>

#include "ops/cells/structure.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// What the darts of the maps by simplices of one dimension n see: the n-simplex that was made for each, and its faces
/// as they are by now.
///
/// Threads: one at a time, for queries too.
class SimplicesOfDarts {
 public:
  SimplicesOfDarts(const Structure& structure, int dimension) : structure_{structure}, dimension_{dimension} {}

  [[nodiscard]] IndexSet all() const { return (IndexSet{2} << dimension_) - 1; }
  /// "m.<0-2>:3"
  [[nodiscard]] std::string name(IndexSet numbers, Dart dart) const;
  /// The simplex with some numbers, in normal form; it may be degenerate. Errors: refused, naming the dart, when its
  /// n-simplex was removed or went into a product. Cost: O(n), and once for each dart its name.
  [[nodiscard]] Result<Value> seen(IndexSet numbers, Dart dart);
  /// The node that was made as the n-simplex of a dart. Errors: refused, when none is called so any more.
  [[nodiscard]] Result<CellId> made(Dart dart) const;

 private:
  const Structure& structure_;
  int dimension_;
  std::unordered_map<Dart, Value> largest_;
};

}  // namespace sesame::ops

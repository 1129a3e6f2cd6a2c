/// \file
/// Maps whose darts a local operation rewires: as they are and as they will be.
#pragma once

#include <cstdint>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "ops/cells/plan.hpp"
#include "ops/cells/structure.hpp"
#include "ops/maps/cell_surgery.hpp"

namespace sesame::ops {

/// The maps of one dimension before and after an operation, dart by dart. Cost of what is not said: O(1).
class RewiredMap {
 public:
  RewiredMap(const DartStore& store, int dimension, const CellSurgery& surgery);

  [[nodiscard]] int dimension() const { return dimension_; }
  [[nodiscard]] bool is_gone(Dart d) const { return gone_.contains(d); }
  [[nodiscard]] bool is_made(Dart d) const { return d >= first_made_; }
  [[nodiscard]] Dart first_made() const { return first_made_; }
  [[nodiscard]] Dart before(int i, Dart d) const { return store_.alpha(dimension_, i, d); }
  [[nodiscard]] Dart after(int i, Dart d) const;

  /// The darts that go, that are made, or that another index than one leads elsewhere.
  [[nodiscard]] std::set<Dart> rewired_but_for(int i) const;
  /// The darts of an i-cell, ascending. Cost: their number, times the dimension.
  [[nodiscard]] std::vector<Dart> cell_before(int i, Dart d) const;
  [[nodiscard]] std::vector<Dart> cell_after(int i, Dart d) const;
  /// The map on all darts of an i-cell to be, alone: alpha_i fixes them.
  [[nodiscard]] GMap map_of_cell(int i, const std::vector<Dart>& darts) const;

  /// What becomes of the darts, into a plan. `with`: the dimension of the cell that those which go belong to.
  void write(int with, Plan& plan) const;

 private:
  using Key = std::uint64_t;
  static Key key(int i, Dart d) { return static_cast<Key>(i) << 32U | d; }
  void write_new_map(Plan& plan) const;

  const DartStore& store_;
  int dimension_;
  const CellSurgery& surgery_;
  Dart first_made_;
  std::unordered_set<Dart> gone_;
  std::unordered_map<Key, Dart> images_;
};

}  // namespace sesame::ops

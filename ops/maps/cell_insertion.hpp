/// \file
/// New cells within cells of maps.
#pragma once

#include <map>
#include <span>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "ops/maps/cell_surgery.hpp"

namespace sesame::ops {

/// A map, or its dual, by its own indices.
class IndexedView {
 public:
  IndexedView(const DartView& map, bool is_dual) : map_{map}, is_dual_{is_dual} {}
  [[nodiscard]] int dimension() const { return map_.dimension; }
  [[nodiscard]] Dart size() const { return map_.size; }
  [[nodiscard]] bool is_dual() const { return is_dual_; }
  /// The index in the map that was given.
  [[nodiscard]] int index(int i) const { return is_dual_ ? map_.dimension - i : i; }
  [[nodiscard]] Dart alpha(int i, Dart d) const { return map_.alpha(index(i), d); }
  [[nodiscard]] std::string name(Dart d) const { return map_.name(d); }

 private:
  const DartView& map_;
  bool is_dual_;
};

/// Puts an i-cell into a map, i <= 2: see insertion_of_cell.
class CellInsertion {
 public:
  CellInsertion(const IndexedView& map, int i) : map_{map}, i_{i}, next_{map.size()} {}
  /// Requires: i is less than the dimension of the map.
  Result<CellSurgery> run(std::span<const Dart> darts);

 private:
  /// The new darts at a dart and at all that the involutions above alpha_{i+1} reach from it, in one order for alike
  /// ones: on its side, and beyond.
  struct Side {
    std::vector<Dart> near, beyond;
  };
  [[nodiscard]] Dart alpha(int k, Dart d) const;
  void join(int k, Dart a, Dart b);
  void join(int k, const std::vector<Dart>& some, const std::vector<Dart>& others);
  Result<Side> place(Dart d);
  /// What is reached by some involutions, as they were.
  [[nodiscard]] std::vector<Dart> reached(Dart from, int first, int last) const;
  [[nodiscard]] Error no_insertion(const std::string& why) const;

  Status insert_edge(Dart one, Dart other);
  Status insert_loose_edge(Dart d);
  Status insert_face(std::span<const Dart> path);
  [[nodiscard]] Status check_commuting() const;

  const IndexedView& map_;
  int i_;
  Dart next_;                                    // dart to be made
  std::map<std::pair<int, Dart>, Dart> images_;  // where they are others
  std::unordered_set<Dart> placed_;              // darts that have a new one beside them
};

}  // namespace sesame::ops

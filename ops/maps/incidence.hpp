/// \file
/// How the cells of a map lie to each other, where it is free, and paths of darts.
#pragma once

#include <optional>
#include <vector>

#include "ops/maps/nmap_cells.hpp"

namespace sesame::ops {

/// The cell of a dimension that a dart is of. Several darts denote one cell.
struct MapCell {
  int dimension = 0;
  Dart dart = 0;
};

/// A dart where one involution, that of an index, does what is being told.
struct IndexedDart {
  int index = 0;
  Dart dart = no_dart;
  friend bool operator==(const IndexedDart&, const IndexedDart&) = default;
};

/// Incidence and adjacency of the cells of a map of either kind. Lists of cells are lists of their smallest darts, in
/// increasing order. Making one costs the orbits of each dimension; a question, the darts of the cells that it meets.
class MapIncidence {
 public:
  explicit MapIncidence(const GMap& map);
  explicit MapIncidence(const NMap& map);

  [[nodiscard]] int dimension() const { return static_cast<int>(cells_.size()) - 1; }
  /// The i-cells.
  [[nodiscard]] const Orbits& cells(int i) const { return cells_[static_cast<std::size_t>(i)]; }
  /// The darts of a cell, in increasing order.
  [[nodiscard]] std::vector<Dart> darts(MapCell cell) const;

  /// Different dimensions, and a dart in both. A cell is not incident to itself, here, nor to one of its dimension.
  [[nodiscard]] bool are_incident(MapCell a, MapCell b) const;
  /// The j-cells incident to a cell; none when j is its dimension.
  [[nodiscard]] std::vector<Dart> incident(MapCell cell, int j) const;

  /// Equal dimensions i >= 1, and an (i-1)-cell incident to both: vertices are never adjacent, in this sense, and each
  /// other cell is to itself.
  [[nodiscard]] bool are_adjacent(MapCell a, MapCell b) const;
  /// The cells adjacent to a cell, without itself.
  [[nodiscard]] std::vector<Dart> adjacent(MapCell cell) const;

 private:
  void list_darts();
  [[nodiscard]] std::uint32_t number(MapCell cell) const { return cells(cell.dimension).of[cell.dart]; }

  std::vector<Orbits> cells_;
  std::vector<std::vector<Dart>> darts_;           // per dimension: all darts, cell by cell
  std::vector<std::vector<std::uint32_t>> begin_;  // per dimension: where each cell begins, and the end
};

/// The i-free darts, in increasing order; of an n-map, i = 0, too.
[[nodiscard]] std::vector<Dart> free_darts(const GMap& map, int i);
[[nodiscard]] std::vector<Dart> free_darts(const NMap& map, int i);
/// Without i-free darts. Of a *map* "closed" means: without boundary; of manifolds some say "closed" for the contrary.
[[nodiscard]] bool is_closed(const GMap& map, int i);
[[nodiscard]] bool is_closed(const NMap& map, int i);
/// For every i: from 0, of an n-map from 1 (beta_0 is total where beta_1 is).
[[nodiscard]] bool is_closed(const GMap& map);
[[nodiscard]] bool is_closed(const NMap& map);

/// Which involution leads from each dart of a sequence to the next one, the least that does; of an n-map among beta_0
/// to beta_n. Nothing when the sequence is no path: some step is none. Cost: its length times n.
[[nodiscard]] std::optional<std::vector<int>> steps_of_path(const GMap& map, const std::vector<Dart>& darts);
[[nodiscard]] std::optional<std::vector<int>> steps_of_path(const NMap& map, const std::vector<Dart>& darts);
/// A shortest path between two darts, with both; empty when they are in different components. Cost: the darts times n.
[[nodiscard]] std::vector<Dart> path(const GMap& map, Dart from, Dart to);
[[nodiscard]] std::vector<Dart> path(const NMap& map, Dart from, Dart to);

}  // namespace sesame::ops

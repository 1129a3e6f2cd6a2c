/// \file
/// The pairs of a filtration over a field.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/zigzag/reduced_columns.hpp"
#include "engine/zigzag/zigzag_filtration.hpp"

namespace sesame::engine {

/// A part of the boundary matrix of a filtration, or of its transpose, as it is reduced: columns in order, and the
/// larger row of two is that of the cell with which the column is paired rather.
class FiltrationMatrix {
 public:
  using Place = ZigzagFiltration::Place;

  /// Boundaries of `columns`, as far as `rows` have them; both are places, ascending.
  static FiltrationMatrix boundaries(const ZigzagFiltration& filtration, std::span<const Place> columns,
                                     std::span<const Place> rows);
  /// The coboundaries of `columns` in `rows`; these are ascending, and the matrix has all in the opposite order.
  static FiltrationMatrix coboundaries(const ZigzagFiltration& filtration, std::span<const Place> columns,
                                       std::span<const Place> rows);

  [[nodiscard]] std::size_t columns() const { return columns_.size(); }
  [[nodiscard]] std::size_t rows() const { return rows_.size(); }
  [[nodiscard]] std::span<const SignedRow> operator[](std::size_t column) const {
    return {entries_.data() + first_[column], first_[column + 1] - first_[column]};
  }
  [[nodiscard]] Place place_of_column(std::size_t column) const { return columns_[column]; }
  [[nodiscard]] Place place_of_row(std::size_t row) const { return rows_[row]; }

 private:
  std::vector<Place> columns_, rows_;
  std::vector<std::uint64_t> first_;  ///< per column, and the end
  std::vector<SignedRow> entries_;
};

/// Pairs the cells of a filtration.
///
/// Between two dimensions the pairs are found by reducing boundaries, or coboundaries. Most of the work is where there
/// are most cells, and there it is done by coboundaries, as those that have no pair cost most; the other dimensions are
/// done before, those above by boundaries, and those below by coboundaries. Then all cells that have partners among
/// them are left out: as columns, and as rows. Where coboundaries become too long for the memory, boundaries are taken.
/// Sources: C. Chen, M. Kerber, "Persistent homology computation with a twist" (2011); V. de Silva, D. Morozov,
/// M. Vejdemo-Johansson, "Dualities in persistent (co)homology" (2011).
template <sparse::Ring R>
class FiltrationPairs {
 public:
  using Place = ZigzagFiltration::Place;
  static constexpr Place no_place = UINT32_MAX;

  /// Coboundaries may have so many entries for a cell, on average; in words of 32 bits over Z/2.
  static constexpr std::uint64_t usual_entries = 64;

  FiltrationPairs(R ring, const ZigzagFiltration& filtration, std::uint64_t most_entries = usual_entries)
      : ring_{ring},
        filtration_{filtration},
        most_entries_{most_entries},
        killer_(filtration.size(), no_place),
        is_killer_(filtration.size()) {
    for (Place place = 0; place < filtration.size(); ++place) {
      const auto dimension = static_cast<std::size_t>(filtration.dimension(place) + 1);
      cells_.resize(std::max(cells_.size(), dimension + 1));
      cells_[dimension].push_back(place);
    }
    std::size_t largest = 0;  // with those one dimension below
    for (std::size_t d = 1; d < cells_.size(); ++d) {
      largest = largest == 0 || cells_at(d) > cells_at(largest) ? d : largest;
    }
    std::size_t top = cells_.size();
    for (; top > largest + 1; --top) {
      reduce_boundaries(top - 1);
    }
    std::size_t d = 1;
    while (d < top && reduce_coboundaries(d)) {
      ++d;
    }
    for (; top > d; --top) {
      reduce_boundaries(top - 1);
    }
  }

  /// Calls visit(place, killer) for all pairs and, with no_place, for what has no partner.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (Place place = 0; place < killer_.size(); ++place) {
      if (!is_killer_[place]) {
        visit(place, killer_[place]);
      }
    }
  }
  [[nodiscard]] ZigzagBarcode::Work work() const { return work_; }

 private:
  [[nodiscard]] std::size_t cells_at(std::size_t d) const { return cells_[d].size() + cells_[d - 1].size(); }

  [[nodiscard]] std::vector<Place> unpaired(std::size_t d) const {
    std::vector<Place> places;
    for (const Place place : cells_[d]) {
      if (killer_[place] == no_place && !is_killer_[place]) {
        places.push_back(place);
      }
    }
    return places;
  }
  void pair(Place place, Place killer) {
    killer_[place] = killer;
    is_killer_[killer] = true;
  }

  /// Pairs cells of the dimensions d - 2 and d - 1: those of `cells_[d - 1]` and `cells_[d]`.
  void reduce_boundaries(std::size_t d) {
    const FiltrationMatrix matrix = FiltrationMatrix::boundaries(filtration_, unpaired(d), unpaired(d - 1));
    reduce(matrix, UINT64_MAX, [&](Place row, Place column) { pair(row, column); });
  }
  /// The same. False when it takes too much memory; then no cells have been paired.
  bool reduce_coboundaries(std::size_t d) {
    const FiltrationMatrix matrix = FiltrationMatrix::coboundaries(filtration_, unpaired(d - 1), unpaired(d));
    return reduce(matrix, most_entries_ * (matrix.columns() + matrix.rows()),
                  [&](Place row, Place column) { pair(column, row); });
  }

  /// Calls on_pair(row, column) for all pairs, unless more entries have to be held: then it returns false.
  template <class OnPair>
  bool reduce(const FiltrationMatrix& matrix, std::uint64_t most_held, OnPair&& on_pair) {
    constexpr std::uint32_t nobody = UINT32_MAX;
    std::vector<std::uint32_t> owner(matrix.rows(), nobody);  // the column that a row leads
    ReducedColumns<R> reduced(ring_, matrix.rows(), matrix.columns());
    bool is_done = true;
    for (std::uint32_t column = 0; column < matrix.columns() && is_done; ++column) {
      const std::span<const SignedRow> entries = matrix[column];
      if (entries.empty()) {
        continue;
      }
      const std::uint32_t row = std::ranges::max(entries, {}, &SignedRow::row).row();
      if (owner[row] == nobody) {  // nothing to do, and nothing to keep
        owner[row] = column;
        continue;
      }
      reduced.begin(entries);
      for (auto lead = reduced.lead(); lead != ReducedColumns<R>::no_row; lead = reduced.lead()) {
        const std::uint32_t other = owner[lead];
        if (other == nobody) {
          owner[lead] = column;
          reduced.store(column);
        } else if (reduced.has(other)) {
          reduced.eliminate(other);
        } else {
          reduced.eliminate(matrix[other]);
        }
      }
      is_done = reduced.held() <= most_held;
    }
    work_.terms_touched += reduced.touched();
    work_.terms_held = std::max(work_.terms_held, reduced.held());
    for (std::size_t row = 0; row < owner.size() && is_done; ++row) {
      if (owner[row] != nobody) {
        on_pair(matrix.place_of_row(row), matrix.place_of_column(owner[row]));
      }
    }
    return is_done;
  }

  R ring_;
  const ZigzagFiltration& filtration_;
  std::uint64_t most_entries_;
  std::vector<std::vector<Place>> cells_;  ///< by dimension + 1, ascending
  std::vector<Place> killer_;              ///< of each cell whose class has one
  std::vector<bool> is_killer_;
  ZigzagBarcode::Work work_;
};

}  // namespace sesame::engine

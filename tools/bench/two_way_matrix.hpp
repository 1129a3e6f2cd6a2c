/// \file
/// Sparse matrices by columns that also know where the entries of a row are.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "sparse/chain.hpp"

namespace sesame::tools {

/// A matrix whose rows can be substituted: what composing with a map that moves few generators comes to.
///
/// Per row it lists the columns that may have an entry there; entries that cancel stay listed until the row is read.
/// Before rows are asked for the first time nothing is listed.
template <sparse::Ring R>
class TwoWayMatrix {
 public:
  using Index = sparse::Index;
  using Terms = sparse::Terms<R>;

  explicit TwoWayMatrix(R ring) : ring_{ring} {}

  /// Appends a column.
  void append_column(std::span<const sparse::Term<R>> terms);
  [[nodiscard]] const Terms& column(Index j) const { return columns_[j]; }
  template <class Visit>
  void for_each_in_column(Index j, const Visit& visit) const {
    std::for_each(columns_[j].begin(), columns_[j].end(), visit);
  }
  /// column j += factor * terms. Cost: the terms of both.
  void add_to_column(Index j, const typename R::Element& factor, std::span<const sparse::Term<R>> terms);
  void clear_column(Index j) { columns_[j] = {}; }

  /// The columns that have an entry in this row, ascending. Cost: the columns that are listed there.
  [[nodiscard]] const std::vector<Index>& columns_with(Index row);
  /// How many columns are listed for a row: at least as many as have an entry there.
  [[nodiscard]] std::size_t listed(Index row);
  /// The entry in a row of a column; zero when there is none.
  [[nodiscard]] typename R::Element entry(Index row, Index j) const;
  /// Composes with the map that sends generator `row` of the target to `by`, and every other one to itself.
  /// Requires: `by` has no term in this row. Cost: the columns with an entry in the row, times the terms of `by`.
  void substitute(Index row, const Terms& by);

  /// The number of entries. Cost: the columns.
  [[nodiscard]] std::uint64_t entries() const;
  /// The entries that were read and written by substitutions and additions.
  [[nodiscard]] std::uint64_t touched() const { return touched_; }

 private:
  void list(Index row, Index j);
  void list_all();

  R ring_;
  std::vector<Terms> columns_;
  std::vector<std::vector<Index>> rows_;
  bool lists_rows_ = false;
  std::uint64_t touched_ = 0;
};

}  // namespace sesame::tools

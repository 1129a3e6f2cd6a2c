/// \file
/// The part of the small complex whose boundary is not zero: over Z, what carries the torsion. Empty over a field.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include "engine/right/symbol.hpp"

namespace sesame::engine {

/// The nonzero columns of dS, by small generator, with an index of their rows and the pivots of their Hermite form: a
/// column that has been settled owns the pivot in its last row. Every change is journaled, so that undo restores
/// columns and pivots as they were.
template <Ring R>
class TorsionCore {
 public:
  using Column = Terms<R, Symbol>;

  [[nodiscard]] const std::map<Symbol, Column>& columns() const { return columns_; }
  [[nodiscard]] const Column* find(Symbol x) const;
  /// The columns that have an entry in a row, by increasing symbol.
  [[nodiscard]] std::vector<Symbol> columns_with_row(Symbol row) const;
  /// The column whose last row is the settled pivot `row`, or no_symbol.
  [[nodiscard]] Symbol pivot_owner(Symbol row) const;
  /// Grows with every change: two equal values mean that nothing changed in between.
  [[nodiscard]] std::uint64_t version() const { return version_; }

  /// Sets a column; an empty one is taken out. A pivot that it owned is released when its last row changes.
  void set(Symbol x, Column column);
  /// Requires: x has a column. Whoever owned the pivot before has released it.
  void own_pivot(Symbol x);
  void release_pivot(Symbol x);

  [[nodiscard]] std::size_t journal_size() const { return journal_.size(); }
  /// Restores the columns to what they were when the journal had that size.
  void undo(std::size_t journal_size);

 private:
  void replace(Symbol x, Column column);
  [[nodiscard]] bool owns_pivot(Symbol x) const;
  void set_ownership(Symbol x, bool owns);

  struct Edit {
    Symbol x;
    std::optional<Column> before;  ///< the column, when it changed
    bool owned_pivot;
  };
  std::map<Symbol, Column> columns_;
  std::unordered_map<Symbol, std::vector<Symbol>> rows_;  // unordered: columns_with_row sorts
  std::unordered_map<Symbol, Symbol> pivots_;
  std::vector<Edit> journal_;
  std::uint64_t version_ = 0;
};

}  // namespace sesame::engine

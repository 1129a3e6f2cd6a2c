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
/// column that has been settled owns the pivot in its last row. What a column was at the last mark is journaled when it
/// first changes after it, so that undo restores columns and pivots as they were, and a step that changes a column a
/// thousand times keeps one copy.
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
  /// Cost: both columns, and the rows that only one of them has.
  void set(Symbol x, Column column);
  /// Requires: x has a column. Whoever owned the pivot before has released it.
  void own_pivot(Symbol x);
  void release_pivot(Symbol x);

  /// A moment to which `undo` can go back.
  using Mark = std::size_t;
  [[nodiscard]] Mark mark() { return epoch_ = journal_.size(); }
  /// Restores columns and pivots to what they were at a mark.
  void undo(Mark mark);

 private:
  /// What there was of a symbol at the mark before its edit.
  struct Edit {
    Symbol x;
    std::optional<Column> before;  ///< the column, when it changed
    bool owned_pivot;
  };
  using Place = typename std::map<Symbol, Column>::iterator;

  Edit& edit_of(Symbol x);
  void replace(Place at, Symbol x, Column& column);
  void move_rows(Symbol x, const Column& before, const Column& after);
  void leave_row(Symbol x, Symbol row);
  [[nodiscard]] bool owns_pivot(Symbol x) const;
  void set_ownership(Symbol x, bool owns);

  std::map<Symbol, Column> columns_;
  std::unordered_map<Symbol, std::vector<Symbol>> rows_;  // unordered: columns_with_row sorts
  std::unordered_map<Symbol, Symbol> pivots_;
  std::vector<Edit> journal_;
  Mark epoch_ = 0;                                     ///< the last mark, or where undo went back to
  std::unordered_map<Symbol, std::size_t> last_edit_;  ///< where in the journal; perhaps no longer
  std::uint64_t version_ = 0;
};

}  // namespace sesame::engine

/// \file
/// What becomes of the boundaries of small symbols: eliminations, and over Z the core and its moves.
#pragma once

#include <cstdint>
#include <set>
#include <span>

#include "engine/right/effort.hpp"
#include "engine/right/rules.hpp"
#include "engine/right/torsion_core.hpp"

namespace sesame::engine {

/// Keeps dS. Over a field a symbol whose boundary is not 0 is eliminated with the youngest symbol of that, and dS = 0.
///
/// Over Z a boundary that has no unit stays, as a column of the TorsionCore. *Settling* the columns that have changed
/// brings them towards Hermite form by columns, by moves that are changes of basis, x' = x - q y, of columns and of
/// rows, so that units hidden in them appear and are eliminated: 2 and 3 in one row, or in one column, become a unit.
/// Moves are made only while coefficients stay small, a unit is eliminated only when it is *mild* (the rest of its
/// column is small or at most one term), and a step makes a bounded number of moves: dense cores would otherwise get
/// coefficients of thousands of digits, as Hermite forms do. What is left undone costs a larger S, never a wrong
/// answer.
///
/// Invariant: the symbols of the core, columns and rows, are small. Source: engine/LIVE_FORM.md.
template <Ring R>
class Settling {
 public:
  using Element = typename R::Element;
  using TermType = sparse::Term<R, Symbol>;

  /// All of them must outlive it.
  Settling(R ring, Rules<R>& rules, Effort& effort) : ring_{ring}, rules_{rules}, effort_{effort} {}

  /// dS of the small symbols that have one, in symbols.
  [[nodiscard]] const TorsionCore<R>& core() const { return core_; }

  /// A small symbol that is in no column has this boundary, which is not 0: eliminates it, or keeps the boundary.
  void place(Symbol x, const Terms<R, Symbol>& column);
  /// The boundary of a small symbol has this more, which is not 0. Requires: over a field, that is all of it.
  void extend(Symbol x, Terms<R, Symbol> more);
  /// A small symbol has this boundary, which is not 0, and is settled.
  void restore(Symbol x, const Terms<R, Symbol>& column, bool owns_pivot);
  /// Settles what has changed since. Over a field there is nothing to do.
  void settle();
  /// Takes a small symbol out of S, with its boundary.
  void consume(Symbol x);

  /// A moment to which `undo` can go back.
  [[nodiscard]] typename TorsionCore<R>::Mark mark() { return core_.mark(); }
  void undo(typename TorsionCore<R>::Mark mark) { core_.undo(mark); }
  /// Forgets what an OverBudget has cut off.
  void drop_work() { unsettled_.clear(); }

 private:
  [[nodiscard]] const TermType* mild_unit(const Terms<R, Symbol>& column) const;
  void eliminate(Symbol a, Symbol b, const Terms<R, Symbol>& column);
  void substitute_row(Symbol row, std::span<const TermType> value);
  void settle_column(Symbol x);
  void settle_coprime(Symbol x);
  void settle_pivot(Symbol x, Symbol owner);
  void settle_row_of(Symbol x);
  bool reduce_rows(Symbol x);
  bool combine(Symbol x, const Element& q, Symbol y);

  R ring_;
  Rules<R>& rules_;
  Effort& effort_;
  TorsionCore<R> core_;
  std::set<Symbol> unsettled_;  ///< columns
  int moves_left_ = 0;          ///< changes of basis that this step may still make
};

}  // namespace sesame::engine

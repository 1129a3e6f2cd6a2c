/// \file
/// What follows when cells are made equal, or one becomes degenerate.
#pragma once

#include <compare>
#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "ops/cells/structure.hpp"
#include "sparse/hash_index.hpp"
#include "sparse/result.hpp"

namespace sesame::ops {

/// Two values of one type, in normal form, that are to become equal.
using Equation = std::pair<Value, Value>;

/// The least congruence in which some equations hold: an equality of values, as symmetric simplicial sets have them,
/// that goes over to their faces and to other orders of their vertices. Keeps its memory between calls.
///
/// Closing under faces needs no look at cofaces, so the cost does not depend on the object. Cells of one type have
/// faces of the same types in the same order, so the only thing that can be refused is a cell that is itself in another
/// order. That two degenerate values are equal says, by the Eilenberg-Zilber lemma, no more and no less than what it
/// says along sections of each that take every vertex between them.
///
/// Threads: one at a time, for queries too.
class Congruence {
 public:
  explicit Congruence(const Structure& structure) : structure_{structure} {}

  /// What becomes of the cells of the present structure, in an order in which it can be carried out.
  ///
  /// Errors    refused: a cell would be one with itself in another order, though it is not degenerate.
  /// Cost      Proportional to the cells that the equations touch with all their faces, times the dimension.
  [[nodiscard]] Result<std::vector<Merge>> close(const std::vector<Equation>& equations);

 private:
  struct Entry {
    CellId cell;
    CellId parent;  ///< itself, or none: it becomes degenerate
    Value becomes;  ///< the parent in an order, or what is degenerate
  };
  /// A cell in its class; in an order in which classes can be carried out.
  struct Member {
    int dimension;
    std::uint32_t root, entry;  ///< entries
    auto operator<=>(const Member&) const = default;
  };

  /// The cell that the class of c goes by, with the order in which it has the vertices of c. It may be degenerate.
  [[nodiscard]] Value root(CellId c);
  /// What a value is by now.
  [[nodiscard]] Value value(Value v);
  [[nodiscard]] static std::uint64_t hash_of(CellId c) { return sparse::spread_bits(c); }
  /// The number of the entry of a cell, or none.
  [[nodiscard]] std::uint32_t entry_of(CellId c) const {
    return index_.find(hash_of(c), [&](std::uint32_t k) { return entries_[k].cell == c; });
  }
  /// The number of the entry of a cell, which there is from now on.
  std::uint32_t touch(CellId c);
  void forget_entries();
  /// Makes two values equal as they are by now. What this says of their faces is left pending.
  void equate(Value one, Value other);
  /// A cell, in its own order, becomes a value, but for the faces of the two. False when that is known.
  bool send(CellId cell, const Value& becomes);
  /// The equation of two degenerate values, restricted to sections of the degeneracies of the first.
  void add_restrictions(const Value& one, const Value& other);
  /// An error when a cell would be one with itself in another order; if it is degenerate by now, an equation.
  Status settle_foldings();
  [[nodiscard]] std::vector<Merge> merges();
  void add_merges(std::span<const Member> of_class, std::vector<Merge>& out);

  const Structure& structure_;
  std::vector<Equation> pending_;
  std::vector<Entry> entries_;    // union-find over the current cells that are touched, in the order in which they came
  sparse::HashIndex index_;       // of the entries by cell
  std::vector<Member> members_;   // scratch: of all classes
  std::vector<CellId> of_class_;  // scratch
  std::set<std::pair<CellId, OrderId>> foldings_;  // cells that would be themselves in another order
};

}  // namespace sesame::ops

/// \file
/// De-identifications as they happened: copies of cells, and incidences that moved to them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "ops/cells/moment.hpp"
#include "ops/cells/plan.hpp"
#include "ops/ids.hpp"

namespace sesame::ops {

/// Which cells are copies of which, and what faces cells have had. Append-only but for undo, the last one first.
/// Cost of every query and change: O(1) or as said.
class SplitHistory {
 public:
  /// A copy: made of `source` at a moment.
  struct Copy {
    CellId copy, source;
    Moment moment;
  };
  /// A move as it happened: face `slot` of `cell` was `before` and became `after` when there were `links` removals.
  struct MadeMove {
    CellId cell;
    std::uint32_t slot;
    CellId before, after;
    LinkId links;
    OrderId order_before, order_after;
  };
  /// The faces of a cell some of which have moved, as they are now.
  struct MovedFaces {
    std::vector<CellId> faces;
    std::vector<OrderId> orders;         ///< of these
    std::vector<std::uint32_t> history;  ///< numbers of moves
  };

  // ---- copies
  [[nodiscard]] std::uint32_t copies() const { return static_cast<std::uint32_t>(copies_.size()); }
  /// What c is a copy of, or null.
  [[nodiscard]] const Copy* copy(CellId c) const {
    const auto at = copies_.empty() ? copy_index_.end() : copy_index_.find(c);
    return at == copy_index_.end() ? nullptr : &copies_[at->second];
  }
  /// The copies that were made of a node itself.
  [[nodiscard]] std::span<const CellId> copies_of(CellId source) const {
    const auto at = copies_of_.find(source);
    return at == copies_of_.end() ? std::span<const CellId>{} : at->second;
  }

  // ---- moves
  [[nodiscard]] std::span<const MadeMove> moves() const { return moves_; }
  /// Calls visit(move) for the moves of face k of a cell whose numbers are in [first, last), in order.
  template <class Visit>
  void for_each_move_of(CellId c, std::uint32_t k, std::uint32_t first, std::uint32_t last, Visit&& visit) const;
  /// The numbers of the moves that ended at a node, in order.
  [[nodiscard]] std::span<const std::uint32_t> moves_onto(CellId node) const {
    const auto at = moved_onto_.find(node);
    return at == moved_onto_.end() ? std::span<const std::uint32_t>{} : at->second;
  }
  /// Null when no face of c has moved.
  [[nodiscard]] const MovedFaces* moved_faces(CellId c) const {
    const auto at = moved_.empty() ? moved_.end() : moved_.find(c);
    return at == moved_.end() ? nullptr : &at->second;
  }

  // ---- change
  void add_copy(const Copy& copy);
  void undo_last_copy();
  /// Makes a move. `as_created()`: the MovedFaces of the cell before any move, asked for when this is its first.
  template <class AsCreated>
  void add_move(const Move& move, LinkId links, AsCreated&& as_created);
  void undo_last_move();

 private:
  void record(const Move& move, LinkId links, MovedFaces& moved);

  std::vector<Copy> copies_;
  std::unordered_map<CellId, std::uint32_t> copy_index_;
  std::unordered_map<CellId, std::vector<CellId>> copies_of_;
  std::vector<MadeMove> moves_;
  std::unordered_map<CellId, MovedFaces> moved_;                       ///< cells that have moved incidences
  std::unordered_map<CellId, std::vector<std::uint32_t>> moved_onto_;  ///< per node: the moves that ended at it
};

template <class Visit>
void SplitHistory::for_each_move_of(CellId c, std::uint32_t k, std::uint32_t first, std::uint32_t last,
                                    Visit&& visit) const {
  const MovedFaces* moved = moved_faces(c);
  if (moved == nullptr) {
    return;
  }
  const std::vector<std::uint32_t>& history = moved->history;
  for (auto at = std::lower_bound(history.begin(), history.end(), first); at != history.end() && *at < last; ++at) {
    if (moves_[*at].slot == k) {
      visit(moves_[*at]);
    }
  }
}

template <class AsCreated>
void SplitHistory::add_move(const Move& move, LinkId links, AsCreated&& as_created) {
  const auto known = moved_.find(move.cell);
  record(move, links, known != moved_.end() ? known->second : moved_.emplace(move.cell, as_created()).first->second);
}

}  // namespace sesame::ops

/// \file
/// De-identifications as they happened: copies of cells, and incidences that moved to them.
#pragma once

#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>

#include "ops/cells/cell_store.hpp"
#include "ops/cells/moment.hpp"
#include "ops/cells/plan.hpp"
#include "ops/ids.hpp"
#include "sparse/archive.hpp"
#include "sparse/growing_array.hpp"
#include "sparse/hash_index.hpp"

namespace sesame::ops {

/// Moves by their numbers, from `begin` to before `end`.
struct MoveRange {
  std::uint32_t begin, end;
};

/// Which cells are copies of which, and what faces cells have had. Append-only but for undo, the last one first.
/// Cost of every query and change: O(1) or as said, without pauses for tables that grow. Memory: 36 bytes a copy, 21 a
/// move, 20 for each face of a cell with moved ones, and an entry in a table or two for each.
class SplitHistory {
 public:
  /// A copy: made of `source` at a moment.
  struct Copy {
    CellId copy, source;
    Moment moment;
    std::uint32_t previous = none;  ///< the number of the copy that was made of the same source before
  };
  /// A move as it happened: face `slot` of `cell` became `after`, in an order, when there were `links` removals.
  struct MadeMove {
    CellId cell;
    std::uint32_t slot;
    CellId after;
    LinkId links;
    OrderId order_after;
  };
  /// The faces of a cell some of which have moved, as they are now, and their orders. Valid until the next change.
  struct MovedFaces {
    std::span<const CellId> faces;
    std::span<const OrderId> orders;
  };

  // ---- copies
  [[nodiscard]] std::uint32_t copies() const { return static_cast<std::uint32_t>(copies_.size()); }
  /// What c is a copy of, or null.
  [[nodiscard]] const Copy* copy(CellId c) const {
    const std::uint32_t number =
        copies_.empty() ? std::uint32_t{none}
                        : copy_index_.find(hash_of(c), [&](std::uint32_t k) { return copies_[k].copy == c; });
    return number == none ? nullptr : &copies_[number];
  }
  /// Calls visit(copy) for the copies that were made of a node itself, as far as they are none of the first `since`
  /// ones, the latest first.
  template <class Visit>
  void for_each_copy_of(CellId source, std::uint32_t since, Visit&& visit) const {
    for (std::uint32_t number = last_copy_of(source); number != none && number >= since;
         number = copies_[number].previous) {
      visit(copies_[number].copy);
    }
  }

  // ---- moves
  [[nodiscard]] std::uint32_t moves() const { return static_cast<std::uint32_t>(moves_.size()); }
  [[nodiscard]] MadeMove move(std::uint32_t number) const {
    const Record& record = moves_[number];
    return {record.cell, slots_[number], record.after, record.links, order_after(number)};
  }
  /// What the face was before a move.
  [[nodiscard]] CellId face_before(std::uint32_t number) const {
    const Record& record = moves_[number];
    return record.previous != none ? moves_[record.previous].after
                                   : first_faces_[rows_[row_of(record.cell)].first + slots_[number]];
  }
  /// The last move of face k of a cell among the first `moves` ones, if there is one. Cost: the moves of the face since
  /// then.
  [[nodiscard]] std::optional<MadeMove> last_move_of(CellId c, std::uint32_t k, std::uint32_t moves) const {
    const std::uint32_t number = last_number_of(c, k, moves);
    return number == none ? std::nullopt : std::optional{move(number)};
  }
  /// Calls visit(move) for the moves of face k of a cell whose numbers are in [first, last), in order.
  /// Cost: the moves of the face since the first of them.
  template <class Visit>
  void for_each_move_of(CellId c, std::uint32_t k, std::uint32_t first, std::uint32_t last, Visit&& visit) const {
    boost::container::small_vector<std::uint32_t, 16> numbers;
    for (std::uint32_t number = last_number_of(c, k, last); number != none && number >= first;
         number = moves_[number].previous) {
      numbers.push_back(number);
    }
    for (; !numbers.empty(); numbers.pop_back()) {
      visit(move(numbers.back()));
    }
  }
  /// Calls visit(move) for the moves that ended at a node, as far as they are none of the first `since` ones, the
  /// latest first.
  template <class Visit>
  void for_each_move_onto(CellId node, std::uint32_t since, Visit&& visit) const {
    for (std::uint32_t number = last_move_onto(node); number != none && number >= since;
         number = moves_[number].previous_onto) {
      visit(move(number));
    }
  }
  /// Nothing when no face of c has moved.
  [[nodiscard]] std::optional<MovedFaces> moved_faces(CellId c) const {
    const std::uint32_t row = row_of(c);
    return row == none ? std::nullopt : std::optional{faces_of(rows_[row])};
  }

  // ---- change
  /// The moment and the cells of a copy; `previous` is found here.
  void add_copy(const Copy& copy);
  void undo_last_copy();
  /// Makes a move. `faces` and `order(k)`: the faces of the cell and their orders as it was created.
  template <class OrderOf>
  void add_move(const Move& move, LinkId links, std::span<const CellId> faces, OrderOf&& order) {
    if (row_of(move.cell) == none) {
      add_row(move.cell, faces);
      for (std::uint32_t k = 0; k < faces.size(); ++k) {
        orders_.push_back(order(k));
        first_orders_.push_back(order(k));
      }
    }
    record(move, links);
  }
  void undo_last_move();

  // ---- to an archive, and into a new history from one, which fails when it is unsound
  void save(sparse::ArchiveWriter& to) const;
  /// `now`: the moment when it was saved.
  void load(sparse::ArchiveReader& from, const Moment& now, const CellStore& cells, const VertexMaps& maps);

 private:
  /// What is not rare of a move.
  struct Record {
    CellId cell, after;
    LinkId links;
    std::uint32_t previous;       ///< the number of the move of the same face before, or none
    std::uint32_t previous_onto;  ///< of the one that ended at the same node before
  };
  /// A cell with moved faces: where they are in the lists of these.
  struct Row {
    CellId cell;
    std::uint32_t first, arity;
  };

  static std::uint64_t hash_of(CellId c) { return sparse::spread_bits(c); }
  /// Or none.
  [[nodiscard]] std::uint32_t row_of(CellId c) const {
    return rows_.empty() ? std::uint32_t{none}
                         : row_index_.find(hash_of(c), [&](std::uint32_t row) { return rows_[row].cell == c; });
  }
  [[nodiscard]] MovedFaces faces_of(const Row& row) const {
    return {{faces_.data() + row.first, row.arity}, {orders_.data() + row.first, row.arity}};
  }
  [[nodiscard]] std::uint32_t last_copy_of(CellId source) const {
    return last_copies_.find(hash_of(source), [&](std::uint32_t k) { return copies_[k].source == source; });
  }
  [[nodiscard]] std::uint32_t last_move_onto(CellId node) const {
    return last_moves_onto_.find(hash_of(node), [&](std::uint32_t k) { return moves_[k].after == node; });
  }
  [[nodiscard]] OrderId order_after(std::uint32_t number) const {
    if (orders_after_.empty()) [[likely]] {
      return same_order;
    }
    const auto known = orders_after_.find(number);
    return known == orders_after_.end() ? OrderId{same_order} : known->second;
  }
  [[nodiscard]] std::uint32_t last_number_of(CellId c, std::uint32_t k, std::uint32_t moves) const;
  void add_row(CellId cell, std::span<const CellId> faces);
  void record(const Move& move, LinkId links);
  void load_copies(sparse::ArchiveReader& from, const Moment& now, const CellStore& cells);
  void load_moves(sparse::ArchiveReader& from, const Moment& now, const CellStore& cells, const VertexMaps& maps);

  sparse::GrowingArray<Copy> copies_;
  sparse::HashIndex copy_index_;
  sparse::HashIndex last_copies_;  ///< of sources: the numbers of the copies that were made of them last
  sparse::GrowingArray<Record> moves_;
  sparse::GrowingArray<std::uint8_t> slots_;                 ///< per move
  std::unordered_map<std::uint32_t, OrderId> orders_after_;  ///< by move, where it is not the same
  sparse::HashIndex last_moves_onto_;                        ///< of nodes: the moves that ended at them last
  // Cells that have moved incidences, in the order in which that began; and per face of theirs:
  sparse::GrowingArray<Row> rows_;
  sparse::HashIndex row_index_;
  sparse::GrowingArray<CellId> faces_, first_faces_;  ///< now, and as created
  sparse::GrowingArray<OrderId> orders_, first_orders_;
  sparse::GrowingArray<std::uint32_t> last_moves_;
};

}  // namespace sesame::ops

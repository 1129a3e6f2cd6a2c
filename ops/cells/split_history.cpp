#include "ops/cells/split_history.hpp"

#include <algorithm>
#include <utility>

#include "sparse/contract.hpp"

namespace sesame::ops {
namespace {

/// An index of the last of a kind under each key goes from one to the next, or back. Either may be none.
void replace(sparse::HashIndex& index, std::uint64_t hash, std::uint32_t number, std::uint32_t by) {
  if (number != none) {
    index.erase(hash, number);
  }
  if (by != none) {
    index.insert(hash, by);
  }
}

}  // namespace

void SplitHistory::add_copy(const Copy& copy) {
  const std::uint32_t number = copies();
  const std::uint32_t previous = last_copy_of(copy.source);
  copies_.push_back(copy);
  copies_.back().previous = previous;
  copy_index_.insert(hash_of(copy.copy), number);
  replace(last_copies_, hash_of(copy.source), previous, number);
}

void SplitHistory::undo_last_copy() {
  const Copy last = copies_.back();
  const std::uint32_t number = copies() - 1;
  copy_index_.erase(hash_of(last.copy), number);
  replace(last_copies_, hash_of(last.source), number, last.previous);
  copies_.pop_back();
}

std::uint32_t SplitHistory::last_number_of(CellId c, std::uint32_t k, std::uint32_t moves) const {
  const std::uint32_t row = row_of(c);
  std::uint32_t number = row == none ? std::uint32_t{none} : last_moves_[rows_[row].first + k];
  while (number != none && number >= moves) {
    number = moves_[number].previous;
  }
  return number;
}

void SplitHistory::add_row(CellId cell, std::span<const CellId> faces) {
  const auto arity = static_cast<std::uint32_t>(faces.size());
  row_index_.insert(hash_of(cell), static_cast<std::uint32_t>(rows_.size()));
  rows_.push_back({cell, static_cast<std::uint32_t>(faces_.size()), arity});
  for (const CellId face : faces) {
    faces_.push_back(face);
    first_faces_.push_back(face);
    last_moves_.push_back(none);
  }
}

void SplitHistory::record(const Move& move, LinkId links) {
  sparse::expects(move.slot <= UINT8_MAX, "a cell has few faces: see Limits::cells_of_standard");
  const std::uint32_t number = moves();
  const std::uint32_t at = rows_[row_of(move.cell)].first + move.slot;
  const std::uint32_t previous_onto = last_move_onto(move.to);
  faces_[at] = move.to;
  orders_[at] = move.order;
  moves_.push_back({move.cell, move.to, links, std::exchange(last_moves_[at], number), previous_onto});
  slots_.push_back(static_cast<std::uint8_t>(move.slot));
  if (move.order != same_order) {
    orders_after_.emplace(number, move.order);
  }
  replace(last_moves_onto_, hash_of(move.to), previous_onto, number);
}

void SplitHistory::undo_last_move() {
  const std::uint32_t number = moves() - 1;
  const Record made = moves_.back();
  const std::uint32_t row = row_of(made.cell);
  const Row of = rows_[row];
  const std::uint32_t at = of.first + slots_.back();
  faces_[at] = face_before(number);
  orders_[at] = made.previous != none ? order_after(made.previous) : first_orders_[at];
  last_moves_[at] = made.previous;
  replace(last_moves_onto_, hash_of(made.after), number, made.previous_onto);
  orders_after_.erase(number);
  moves_.pop_back();
  slots_.pop_back();
  // A row begins with the first move of its cell, so the last row goes first.
  if (std::all_of(last_moves_.begin() + of.first, last_moves_.begin() + of.first + of.arity,
                  [](std::uint32_t last) { return last == none; })) {
    row_index_.erase(hash_of(of.cell), row);
    rows_.pop_back();
    for (auto* list : {&faces_, &first_faces_}) {
      list->truncate(of.first);
    }
    for (auto* list : {&orders_, &first_orders_}) {
      list->truncate(of.first);
    }
    last_moves_.truncate(of.first);
  }
}

// --------------------------------------------------------------------------------------------------------- archives

void SplitHistory::save(sparse::ArchiveWriter& to) const {
  to.put_list(copies_);
  to.put(static_cast<std::uint64_t>(moves_.size()));
  for (std::uint32_t number = 0; number < moves(); ++number) {
    to.put(move(number));
  }
}

void SplitHistory::load(sparse::ArchiveReader& from, const Moment& now, const CellStore& cells,
                        const VertexMaps& maps) {
  load_copies(from, now, cells);
  load_moves(from, now, cells, maps);
}

void SplitHistory::load_copies(sparse::ArchiveReader& from, const Moment& now, const CellStore& cells) {
  const auto copies = from.get_list<sparse::GrowingArray<Copy>>();
  copies_.reserve(copies.size());
  for (const Copy& each : copies) {
    const Moment& then = each.moment;
    const bool is_sound = each.copy < cells.size() && then.created <= each.copy && cells.contains(each.source) &&
                          cells.type_id(each.source) == cells.type_id(each.copy) && then.links <= now.links &&
                          then.moves <= now.moves && then.families <= now.families && then.copies <= this->copies() &&
                          is_asked_for(then.asked) && then.asked <= now.asked && copy(each.copy) == nullptr;
    if (!from.check(is_sound, "a copy is a cell of the type of another one")) {
      return;
    }
    add_copy(each);
    from.check(copies_.back().previous == each.previous, "a copy is told from the one before");
  }
}

void SplitHistory::load_moves(sparse::ArchiveReader& from, const Moment& now, const CellStore& cells,
                              const VertexMaps& maps) {
  const auto moves = from.get_list<sparse::GrowingArray<MadeMove>>();
  moves_.reserve(moves.size());
  LinkId links = 0;
  for (const MadeMove& each : moves) {
    const bool is_sound =
        cells.contains(each.cell) && each.slot < cells.type(each.cell).faces.size() && each.slot <= UINT8_MAX &&
        cells.contains(each.after) && maps.is_order_of(each.order_after, cells.type_id(each.after)) &&
        maps.is_value_of({each.after, cells.type(each.cell).faces[each.slot].type, 0, each.order_after},
                         cells.type_id(each.after)) &&
        each.links >= links && each.links <= now.links;
    if (!from.check(is_sound, "a move ends at a cell of the type of the face")) {
      return;
    }
    links = each.links;
    const auto faces = cells.faces(each.cell);
    if (from.check(faces.size() == cells.type(each.cell).faces.size(),
                   "what moves is a face of a cell that has some")) {
      add_move({each.cell, each.slot, each.after, each.order_after}, each.links, faces,
               [&](std::uint32_t k) { return cells.order(each.cell, k); });
    }
  }
}

}  // namespace sesame::ops

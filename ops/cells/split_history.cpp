#include "ops/cells/split_history.hpp"

#include <algorithm>
#include <utility>

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
    last_moves_.push_back(none);
  }
}

void SplitHistory::record(const Move& move, LinkId links) {
  const auto number = static_cast<std::uint32_t>(moves_.size());
  const std::uint32_t at = rows_[row_of(move.cell)].first + move.slot;
  const std::uint32_t previous_onto = last_move_onto(move.to);
  const CellId before = std::exchange(faces_[at], move.to);
  const OrderId order_before = std::exchange(orders_[at], move.order);
  moves_.push_back({move.cell, move.slot, before, move.to, links, order_before, move.order,
                    std::exchange(last_moves_[at], number), previous_onto});
  replace(last_moves_onto_, hash_of(move.to), previous_onto, number);
}

void SplitHistory::undo_last_move() {
  const MadeMove made = moves_.back();
  replace(last_moves_onto_, hash_of(made.after), static_cast<std::uint32_t>(moves_.size() - 1), made.previous_onto);
  moves_.pop_back();
  const std::uint32_t row = row_of(made.cell);
  const Row of = rows_[row];
  faces_[of.first + made.slot] = made.before;
  orders_[of.first + made.slot] = made.order_before;
  last_moves_[of.first + made.slot] = made.previous;
  // A row begins with the first move of its cell, so the last row goes first.
  if (std::all_of(last_moves_.begin() + of.first, last_moves_.begin() + of.first + of.arity,
                  [](std::uint32_t number) { return number == none; })) {
    row_index_.erase(hash_of(of.cell), row);
    rows_.pop_back();
    faces_.truncate(of.first);
    orders_.truncate(of.first);
    last_moves_.truncate(of.first);
  }
}

}  // namespace sesame::ops

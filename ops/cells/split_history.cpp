#include "ops/cells/split_history.hpp"

#include <utility>

namespace sesame::ops {
namespace {

/// The last of what is listed under a key goes; no key has an empty list.
template <class Map>
void drop_last_of(Map& lists, CellId key) {
  const auto at = lists.find(key);
  at->second.pop_back();
  if (at->second.empty()) {
    lists.erase(at);
  }
}

}  // namespace

void SplitHistory::add_copy(const Copy& copy) {
  copy_index_.emplace(copy.copy, copies());
  copies_.push_back(copy);
  copies_of_[copy.source].push_back(copy.copy);
}

void SplitHistory::undo_last_copy() {
  drop_last_of(copies_of_, copies_.back().source);
  copy_index_.erase(copies_.back().copy);
  copies_.pop_back();
}

void SplitHistory::record(const Move& move, LinkId links, MovedFaces& moved) {
  const auto number = static_cast<std::uint32_t>(moves_.size());
  moved.history.push_back(number);
  const CellId before = std::exchange(moved.faces[move.slot], move.to);
  const OrderId order_before = std::exchange(moved.orders[move.slot], move.order);
  moves_.push_back({move.cell, move.slot, before, move.to, links, order_before, move.order});
  moved_onto_[move.to].push_back(number);
}

void SplitHistory::undo_last_move() {
  const MadeMove& made = moves_.back();
  const auto moved = moved_.find(made.cell);
  moved->second.faces[made.slot] = made.before;
  moved->second.orders[made.slot] = made.order_before;
  moved->second.history.pop_back();
  if (moved->second.history.empty()) {
    moved_.erase(moved);
  }
  drop_last_of(moved_onto_, made.after);
  moves_.pop_back();
}

}  // namespace sesame::ops

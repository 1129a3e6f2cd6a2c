#include "ops/cells/coface_index.hpp"

#include <algorithm>

namespace sesame::ops {
namespace {

/// Whether a node is not undone.
bool is_there(CellId node, const CellStore& cells) {
  return node < (is_asked_for(node) ? cells.asked() : cells.size());
}

}  // namespace

std::vector<CellId> CofaceIndex::entries(CellId current) const {
  if (!is_made_) {
    make();
  }
  tidy(current);
  std::vector<CellId> entries;
  entries.reserve(list(current).size);
  for_each(list(current), [&](CellId node) { entries.push_back(node); });
  return entries;
}

bool CofaceIndex::is_coface(CellId cell, CellId current) const {
  const auto nodes = faces_.of(cell);
  return std::any_of(nodes.begin(), nodes.end(), [&](CellId node) { return values_.of(node).cell == current; });
}

void CofaceIndex::make() const {
  is_made_ = true;
  links_when_made_ = forest_.links();
  for (CellId c = 0; c < cells_.size(); ++c) {
    if (forest_.is_current(c)) {
      add_cell(c);
    }
  }
  const auto add_origin = [this](CellId node) {
    if (const CellId cell = values_.of(node).cell; cell != node) {
      push(cell, node);
    }
  };
  for (CellId c = asked_node(0); c < cells_.asked(); ++c) {
    if (cells_.lazy(c) != none) {
      add_origin(c);
      if (forest_.is_current(c) && faces_.have_moved(c)) {  // to what it has not by its family
        add_cell(c);
      }
    }
  }
  for (const Cone& cone : cones_) {
    add_origin(cone.apex);
  }
}

void CofaceIndex::forget() {
  is_made_ = false;
  lists_ = {};
  pool_ = {};
  free_ = none;
  overfull_.clear();
  removals_ = {};
}

void CofaceIndex::add_cell(CellId node) const {
  for (const CellId face : faces_.of(node)) {
    push(values_.of(face).cell, node);
  }
}

CofaceIndex::List& CofaceIndex::list(CellId current) const {
  while (!(current < (is_asked_for(current) ? lists_.asked() : lists_.made()))) {
    lists_.push_back(current, {});
  }
  return lists_[current];
}

void CofaceIndex::push(CellId current, CellId node) const {
  List& of = list(current);
  if (of.first != none && pool_[of.first].node == node) {
    return;
  }
  std::uint32_t at = free_;
  if (at == none) {
    at = static_cast<std::uint32_t>(pool_.size());
    pool_.push_back({});
  } else {
    free_ = pool_[at].next;
  }
  pool_[at] = {node, of.first};
  of.first = at;
  ++of.size;
  // Not only when it becomes so: a cell that was removed then, and is there again by undo, would never be tidied.
  if (of.is_overfull()) {
    overfull_.push_back(current);
  }
}

void CofaceIndex::pop(List& list) const {
  const std::uint32_t at = list.first;
  list.first = pool_[at].next;
  --list.size;
  pool_[at].next = free_;
  free_ = at;
}

void CofaceIndex::tidy(CellId current) const {
  List& of = list(current);
  kept_.clear();
  for_each(of, [&](CellId node) {
    if (!is_there(node, cells_)) {
      return;
    }
    if (is_origin(node) && values_.of(node).cell == current) {
      kept_.push_back(node);
    } else if (const CellId cell = forest_.find(node); cell != none && is_coface(cell, current)) {
      kept_.push_back(cell);
    }
  });
  std::sort(kept_.begin(), kept_.end());
  kept_.erase(std::unique(kept_.begin(), kept_.end()), kept_.end());
  while (of.size > 0) {
    pop(of);
  }
  of.size_when_tidy = static_cast<std::uint32_t>(kept_.size());
  ++of.times_tidied;
  for (const CellId node : kept_) {
    push(current, node);
  }
}

void CofaceIndex::on_undo_of_cell(CellId node) {
  if (!is_made_) {
    return;
  }
  for (const CellId face : faces_.of(node)) {
    List& of = list(values_.of(face).cell);
    if (of.first != none && pool_[of.first].node == node) {
      pop(of);
    }
  }
}

void CofaceIndex::before_removal(CellId removed, CellId becomes) {
  if (!is_made_) {
    return;
  }
  if (list(removed).is_overfull()) {
    tidy(removed);  // undo may have filled it, and the end of the step will not find it
  }
  removals_.push_back({list(becomes).size, list(becomes).times_tidied, becomes});
  for (std::uint32_t at = list(removed).first; at != none; at = pool_[at].next) {
    push(becomes, pool_[at].node);
  }
  if (is_origin(removed)) {
    push(becomes, removed);
  }
}

void CofaceIndex::on_undo_of_removal(CellId current) {
  if (!is_made_) {
    return;
  }
  if (forest_.links() < links_when_made_) {
    return forget();
  }
  const Removal removal = removals_.back();
  removals_.pop_back();
  if (removal.becomes != none) {
    List& of = list(removal.becomes);
    while (of.times_tidied == removal.times_tidied && of.size > removal.size) {
      pop(of);
    }
  }
  add_cell(current);
}

void CofaceIndex::on_end_of_step() {
  for (const CellId cell : overfull_) {
    if (is_there(cell, cells_) && forest_.is_current(cell) && list(cell).is_overfull()) {  // once of many
      tidy(cell);
    }
  }
  overfull_.clear();
}

}  // namespace sesame::ops

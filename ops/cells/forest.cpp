#include "ops/cells/forest.hpp"

#include <algorithm>
#include <iterator>

namespace sesame::ops {

CellId Forest::find_at(CellId c, LinkId links) const {
  while (c != none && parent_[c] != c && link_of_[c] < links) {
    c = parent_[c];
  }
  // A node that was degenerate from the start has no link.
  return c != none && parent_[c] == none && link_of_[c] == none ? none : c;
}

OrientedCell Forest::find_oriented_at(CellId c, LinkId links) const {
  int sign = 1;
  for (CellId at = c; reversals_ != 0 && at != none && link_of_[at] < links; at = parent_[at]) {
    sign *= sign_of(link_of_[at]);
  }
  return {find_at(c, links), sign};
}

CellId Forest::last_root(CellId c) const {
  while (parent_[c] != c && parent_[c] != none) {
    c = parent_[c];
  }
  return c;
}

CellId Forest::oldest_at(CellId node, LinkId links) const {
  CellId oldest = oldest_[node];
  while (oldest != node) {
    LinkId joined = none;  // the removal that made it a member
    for (CellId at = oldest; at != node; at = parent_[at]) {
      joined = link_of_[at];
    }
    if (joined < links) {
      break;
    }
    oldest = links_[joined].oldest_before;
  }
  return oldest;
}

OrderId Forest::order_of(LinkId link) const {
  const auto at = orders_.empty() ? orders_.end() : orders_.find(link);
  return at == orders_.end() ? same_order : at->second;
}

LinkId Forest::links_before_step(LinkId link) const {
  return *std::prev(std::upper_bound(first_links_.begin(), first_links_.end(), link));
}

std::span<const CellId> Forest::squashed_onto(CellId node) const {
  const auto at = squashed_onto_.empty() ? squashed_onto_.end() : squashed_onto_.find(node);
  return at == squashed_onto_.end() ? std::span<const CellId>{} : at->second;
}

void Forest::add(CellId node) {
  parent_.push_back(node, node);
  oldest_.push_back(node, node);
  size_.push_back(node, 1);
  link_of_.push_back(node, none);
  last_child_.push_back(node, none);
}

void Forest::pop_back(CellId node) {
  parent_.pop_back(node);
  oldest_.pop_back(node);
  size_.pop_back(node);
  link_of_.pop_back(node);
  last_child_.pop_back(node);
}

void Forest::squash(CellId node, const Value& becomes) {
  parent_[node] = none;
  squashed_.emplace(node, becomes);
  squashed_onto_[becomes.cell].push_back(node);
}

void Forest::unsquash(CellId node) {
  const auto squashed = squashed_.find(node);
  squashed_onto_.at(squashed->second.cell).pop_back();
  squashed_.erase(squashed);
  parent_[node] = node;
}

void Forest::add_link(const Link& link, OrderId order, int sign) {
  link_of_[link.removed] = links();
  reverses_.push_back(sign < 0);
  reversals_ += sign < 0 ? 1 : 0;
  if (order != same_order) {
    orders_.emplace(links(), order);
  }
  links_.push_back(link);
}

void Forest::link(CellId removed, CellId survivor, OrderId order, int sign, CellId oldest) {
  add_link({removed, oldest_[survivor], last_child_[survivor]}, order, sign);
  last_child_[survivor] = links() - 1;
  parent_[removed] = survivor;
  size_[survivor] += size_[removed];
  oldest_[survivor] = oldest;
}

void Forest::link_squashed(CellId removed, const Value& becomes) {
  add_link({removed, none, none}, same_order, 1);
  squash(removed, becomes);
}

CellId Forest::undo_last_link() {
  const Link link = links_.back();
  links_.pop_back();
  orders_.erase(links());
  reversals_ -= reverses_.back() ? 1 : 0;
  reverses_.pop_back();
  const CellId survivor = parent_[link.removed];
  if (survivor == none) {
    unsquash(link.removed);
  } else {
    size_[survivor] -= size_[link.removed];
    oldest_[survivor] = link.oldest_before;
    last_child_[survivor] = link.previous_child;
    parent_[link.removed] = link.removed;
  }
  link_of_[link.removed] = none;
  if (first_links_.back() == links()) {
    first_links_.pop_back();
  }
  return link.removed;
}

}  // namespace sesame::ops

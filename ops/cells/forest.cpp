#include "ops/cells/forest.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>

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
  if (becomes.cell == none) {
    deletions_.links_.push_back(links());
    parent_[removed] = none;
  }
  add_link({removed, none, none}, same_order, 1);
  if (becomes.cell != none) {
    squash(removed, becomes);
  }
}

CellId Forest::undo_last_link() {
  const Link link = links_.back();
  links_.pop_back();
  orders_.erase(links());
  reversals_ -= reverses_.back() ? 1 : 0;
  reverses_.pop_back();
  const CellId survivor = parent_[link.removed];
  if (deletions_.size() > 0 && deletions_.links_.back() == links()) {
    deletions_.links_.pop_back();
    parent_[link.removed] = link.removed;
  } else if (survivor == none) {
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

// --------------------------------------------------------------------------------------------------------- archives

namespace {

/// A removal, as it is written. The parents and the numbers of members follow from all of them.
struct SavedLink {
  CellId removed, survivor;
};
/// A degenerate node, by what it is over.
struct SavedSquash {
  CellId over, node;
  Degeneracy collapsed;
  TypeId type;
  OrderId order;
};

}  // namespace

void Forest::save(sparse::ArchiveWriter& to) const {
  sparse::GrowingArray<SavedLink> links;
  links.reserve(links_.size());
  for (const Link& link : links_) {
    links.push_back({link.removed, parent_[link.removed]});
  }
  to.put_list(links);
  // Whether the oldest member of the removed one was the older one: from the last on, what it was after each.
  std::vector<std::uint8_t> is_theirs(links_.size());
  std::unordered_map<CellId, CellId> oldest_after;
  for (std::size_t k = links_.size(); k-- > 0;) {
    if (const CellId survivor = links[k].survivor; survivor != none) {
      CellId& after = oldest_after.try_emplace(survivor, oldest_[survivor]).first->second;
      is_theirs[k] = after == links_[k].oldest_before ? 0 : 1;
      after = links_[k].oldest_before;
    }
  }
  to.put_list(is_theirs);
  to.put_map(orders_);
  to.put_list(first_links_);
  to.put_list(deletions_.links_);
  std::vector<CellId> over;
  for (const auto& [cell, nodes] : squashed_onto_) {
    if (!nodes.empty()) {
      over.push_back(cell);
    }
  }
  std::sort(over.begin(), over.end());
  sparse::GrowingArray<SavedSquash> squashes;
  for (const CellId cell : over) {
    for (const CellId node : squashed_onto_.at(cell)) {
      const Value& value = squashed_.at(node);
      squashes.push_back({cell, node, value.collapsed, value.type, value.order});
    }
  }
  to.put_list(squashes);
}

void Forest::load(sparse::ArchiveReader& from, const CellStore& cells, const VertexMaps& maps) {
  for (const CellId first : {CellId{0}, asked_node(0)}) {
    const std::size_t kind = is_asked_for(first) ? 1 : 0;
    const std::size_t count = std::uint32_t{kind == 0 ? cells.size() : cells.asked()} - std::uint32_t{first};
    for (auto* list : {&parent_.lists()[kind], &oldest_.lists()[kind]}) {
      list->resize(count);
      std::iota(list->begin(), list->end(), first);
    }
    for (auto* list : {&link_of_.lists()[kind], &last_child_.lists()[kind]}) {
      list->resize(count);
      std::fill(list->begin(), list->end(), none);
    }
    size_.lists()[kind].resize(count);
    std::fill(size_.lists()[kind].begin(), size_.lists()[kind].end(), 1U);
  }
  load_links(from, cells, maps);
  first_links_ = from.get_list<sparse::GrowingArray<LinkId>>();
  from.check(std::is_sorted(first_links_.begin(), first_links_.end(), std::less_equal<>{}) &&
                 first_links_.empty() == links_.empty() &&
                 (links_.empty() || (first_links_[0] == 0 && first_links_.back() < links())),
             "each removal belongs to a step");
  load_deletions(from);
  load_squashed(from, cells, maps);
}

void Forest::load_links(sparse::ArchiveReader& from, const CellStore& cells, const VertexMaps& maps) {
  const auto links = from.get_list<sparse::GrowingArray<SavedLink>>();
  const auto is_theirs = from.get_list<std::vector<std::uint8_t>>();
  std::unordered_map<LinkId, OrderId> orders;
  from.get_map<LinkId, OrderId>([&](LinkId link, OrderId order) { orders.emplace(link, order); });
  if (!from.check(links.size() == is_theirs.size() && links.size() < none, "each removal is one of some cell")) {
    return;
  }
  links_.reserve(links.size());
  for (std::size_t k = 0; k < links.size() && from.is_good(); ++k) {
    const auto [removed, survivor] = links[k];
    if (!from.check(parent_.contains(removed) && is_current(removed), "what is removed was a current cell")) {
      return;
    }
    if (survivor == none) {
      add_link({removed, none, none}, same_order, 1);
      parent_[removed] = none;
      continue;
    }
    const auto known = orders.empty() ? orders.end() : orders.find(LinkId{k});
    const OrderId order = known == orders.end() ? same_order : known->second;
    const TypeId type = cells.type_id(removed);
    if (from.check(parent_.contains(survivor) && is_current(survivor) && survivor != removed &&
                       cells.type_id(survivor) == type && size_[survivor] >= size_[removed] &&
                       maps.is_order_of(order, type),
                   "a cell becomes a current cell of its type with no fewer members, in an order of its vertices")) {
      link(removed, survivor, order, maps.sign(order), oldest_[is_theirs[k] != 0 ? removed : survivor]);
    }
  }
  from.check(orders.size() == orders_.size(), "the orders are those of removals");
}

void Forest::load_deletions(sparse::ArchiveReader& from) {
  auto& deletions = deletions_.links_;
  deletions = from.get_list<sparse::GrowingArray<LinkId>>();
  from.check(std::is_sorted(deletions.begin(), deletions.end(), std::less_equal<>{}) &&
                 std::all_of(deletions.begin(), deletions.end(),
                             [this](LinkId link) { return link < links() && parent_[removed(link)] == none; }),
             "what is taken away has become nothing else");
}

void Forest::load_squashed(sparse::ArchiveReader& from, const CellStore& cells, const VertexMaps& maps) {
  const auto squashes = from.get_list<sparse::GrowingArray<SavedSquash>>();
  for (const SavedSquash& each : squashes) {
    const Value value{each.over, each.type, each.collapsed, each.order};
    const bool is_sound = parent_.contains(each.node) && parent_.contains(each.over) && value.is_degenerate() &&
                          value.type == cells.type_id(each.node) && maps.is_value_of(value, cells.type_id(each.over)) &&
                          !squashed_.contains(each.node) && !is_deleted(*this, each.node) &&
                          (parent_[each.node] == none ||
                           (is_current(each.node) && is_asked_for(each.node) && cells.lazy(each.node) == none));
    if (!from.check(is_sound, "what is degenerate is so over a cell")) {
      return;
    }
    squash(each.node, value);
  }
  bool is_told_of_all = true;
  cells.for_each_node([&](CellId node) {
    const bool must_be = parent_[node] == none || (is_asked_for(node) && cells.lazy(node) == none);
    is_told_of_all = is_told_of_all && (!must_be || squashed_.contains(node) || is_deleted(*this, node));
  });
  from.check(is_told_of_all, "what has become degenerate is so over a cell");
}

}  // namespace sesame::ops

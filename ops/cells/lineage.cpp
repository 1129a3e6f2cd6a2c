#include "ops/cells/lineage.hpp"

#include <algorithm>

namespace sesame::ops {
namespace {

bool differ_in_order_only(const Value& one, const Value& other) {
  return one.cell == other.cell && one.type == other.type && one.collapsed == other.collapsed;
}

}  // namespace

Instant Lineage::end_of(CellId node) const {
  if (is_deleted(structure_.forest(), node)) {
    return never;
  }
  if (structure_.forest().parent(node) != node) {
    const LinkId link = structure_.forest().link_of(node);
    return link == none ? 0 : instant_after(link);  // 0: degenerate from the start
  }
  const FamilyId family = structure_.lazy().consumed_by(node);
  return family != none && structure_.lazy().family(family).kind == FamilyKind::cone
             ? instant_of(structure_.lazy().family(family).links, family + 1)
             : never;
}

void Lineage::advance(Value& at) const {
  const CellId node = at.cell;
  const TypeId type = structure_.cells().type_id(node);
  const CellId parent = structure_.forest().parent(node);
  if (parent == node) {
    at.cell = structure_.lazy().cell(structure_.lazy().consumed_by(node), LazyPart::base, {node, type, 0});
  } else if (parent == none) {
    at = structure_.maps().compose(at, structure_.forest().squashed(node));
  } else {
    at = structure_.maps().compose(at,
                                   {parent, type, 0, structure_.forest().order_of(structure_.forest().link_of(node))});
  }
}

void Lineage::advance_until(Value& at, Instant instant) const {
  for (Instant end = end_of(at.cell); end != never && end <= instant; end = end_of(at.cell)) {
    advance(at);
  }
}

/// Along a lineage instants increase, so whichever ends first goes on first; what has met stays together.
Lineage::Meeting Lineage::meeting(Value one, Value other) const {
  CellId last = none;  // to be given up
  while (!differ_in_order_only(one, other)) {
    const Instant end_of_one = end_of(one.cell);
    const Instant end_of_other = end_of(other.cell);
    if (std::min(end_of_one, end_of_other) == never) {
      return {};
    }
    Value& next = end_of_one <= end_of_other ? one : other;
    last = next.cell;
    advance(next);
  }
  Instant instant = last == none ? 0 : end_of(last);
  if (last != none && structure_.forest().link_of(last) != none) {
    instant = instant_after(structure_.forest().links_before_step(structure_.forest().link_of(last)));
    // What a step makes degenerate has no order left, however the step came to it.
    const auto goes_on = [&](const Value& at) {
      const LinkId link = structure_.forest().link_of(at.cell);
      return link != none && instant_after(structure_.forest().links_before_step(link)) == instant;
    };
    while (goes_on(one) && goes_on(other)) {
      advance(one);
      advance(other);
    }
  }
  VertexMaps& maps = structure_.maps();
  return {instant, maps.compose(one.order, maps.inverse(other.order))};
}

std::vector<CellId> Lineage::nodes_that_are(Value value) const {
  advance_to_now(value);
  std::vector<CellId> found;
  std::vector<CellId> pending{value.cell};
  while (!pending.empty()) {
    const CellId root = pending.back();
    pending.pop_back();
    Value of_root = structure_.values().plain(root);
    advance_to_now(of_root);
    structure_.forest().for_each_member(root, [&](CellId member) {
      if (differ_in_order_only(of_root, value)) {
        found.push_back(member);
      }
      if (const LazyCell* lazy = structure_.lazy().of(member); lazy != nullptr && lazy->key.part == LazyPart::base) {
        pending.push_back(lazy->key.left.cell);
      }
      if (value.is_degenerate()) {
        const auto over = structure_.forest().squashed_onto(member);
        pending.insert(pending.end(), over.begin(), over.end());
      }
    });
  }
  return found;
}

}  // namespace sesame::ops

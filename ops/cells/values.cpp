#include "ops/cells/values.hpp"

namespace sesame::ops {

/// Along the path of the forest: to a current cell, or to one that has become degenerate.
void Values::advance_to_root(Value& v) const {
  if (!forest_.has_orders()) {
    v.cell = forest_.last_root(v.cell);
    return;
  }
  for (CellId parent = forest_.parent(v.cell); parent != v.cell && parent != none; parent = forest_.parent(v.cell)) {
    if (const OrderId order = forest_.order_of(forest_.link_of(v.cell)); order != same_order) {
      v = maps_.compose(v, {parent, cells_.type_id(parent), 0, order});
    }
    v.cell = parent;
  }
}

Value Values::normal_form(Value v) const {
  advance_to_root(v);
  while (forest_.parent(v.cell) == none && !is_deleted(forest_, v.cell)) {
    v = maps_.compose(v, forest_.squashed(v.cell));
    advance_to_root(v);
  }
  return v;
}

Value Values::face_of_cell(CellId c, std::uint32_t k) const {
  const Value node = of(faces_.of(c)[k]);
  const OrderId order = faces_.order(c, k);
  return order == same_order ? node : maps_.reordered(order, node);
}

Incidence Values::incidence_of(const Value& v) const {
  if (!v.is_degenerate()) {
    return {v.cell, v.order};
  }
  if (const auto known = degenerate_index_.find(v); known != degenerate_index_.end()) {
    return {known->second};
  }
  const CellId node = cells_.add_asked(v.type, none, cells_.body(v.cell));
  forest_.add(node);
  forest_.squash(node, v);
  degenerate_index_.emplace(v, node);
  journal_.append(EventKind::degenerate, node);
  return {node};
}

void Values::undo_degenerate(CellId node) {
  degenerate_index_.erase(forest_.squashed(node));
  forest_.unsquash(node);
}

void Values::load(sparse::ArchiveReader& from) {
  for (CellId node = asked_node(0); node < cells_.asked() && from.is_good(); ++node) {
    if (cells_.lazy(node) == none) {
      from.check(degenerate_index_.emplace(forest_.squashed(node), node).second, "each degenerate node is there once");
    }
  }
}

}  // namespace sesame::ops

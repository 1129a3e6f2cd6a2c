// How each kind of event is taken back.
#include "ops/cells/structure.hpp"

#include <utility>

namespace sesame::ops {

/// Requires: the node was squashed last of those that are still degenerate over the same node.
void Structure::unsquash(CellId node) const {
  const auto squashed = nodes_->squashed.find(node);
  nodes_->squashed_onto.at(squashed->second.cell).pop_back();
  nodes_->squashed.erase(squashed);
  nodes_->parent[node] = node;
}

void Structure::undo_last_family() {
  const LazyFamily& family = families_.back();
  add_counts(family.counts, counts_, true);
  bodies_.undo_family(family.body, family.bodies, family.counts,
                      [this](std::span<const std::uint64_t> counts) { add_counts(counts, counts_, false); });
  nodes_->lazy_made.pop_back();
  if (family.kind == FamilyKind::cone) {
    cones_.pop_back();
  }
  families_.pop_back();
}

void Structure::undo_last_link() {
  Nodes& n = *nodes_;
  const Link link = links_.back();
  links_.pop_back();
  link_orders_.erase(links());
  reversals_ -= reverses_.back() ? 1 : 0;
  reverses_.pop_back();
  const CellId survivor = n.parent[link.removed];
  if (survivor == none) {
    unsquash(link.removed);
  } else {
    n.size[survivor] -= n.size[link.removed];
    n.oldest[survivor] = link.oldest_before;
    n.last_child[survivor] = link.previous_child;
    n.parent[link.removed] = link.removed;
  }
  n.link_of[link.removed] = none;
  count(link.removed, 1);
  if (first_links_.back() == links()) {
    first_links_.pop_back();
  }
}

void Structure::drop_last_node() {
  Nodes& n = *nodes_;
  const CellId c = created() - 1;
  bodies_.drop_cell(n.body[c], c);
  for (auto* column : {&n.type, &n.first_incidence, &n.parent, &n.oldest, &n.size, &n.link_of, &n.last_child, &n.name,
                       &n.lazy, &n.body}) {
    column->pop_back();
  }
  n.first_face.pop_back();
}

void Structure::undo_last_cell() {
  Nodes& n = *nodes_;
  const CellId c = created() - 1;
  count(c, -1);
  while (n.faces.size() > n.first_face[c]) {
    if (!face_orders_.empty()) {
      face_orders_.erase(n.faces.size() - 1);
    }
    n.first_incidence[n.faces.back()] = n.next_incidence.back();
    n.faces.pop_back();
    n.next_incidence.pop_back();
  }
  drop_last_name();
  drop_last_node();
}

void Structure::undo_last_copy() {
  const CellId c = created() - 1;
  splits_.undo_last_copy();
  name_orders_.erase(c);
  undo_last_cell();
}

void Structure::undo_last_degenerate() {
  const CellId c = created() - 1;
  nodes_->degenerate_index.erase(nodes_->squashed.at(c));
  unsquash(c);
  drop_last_node();
}

void Structure::undo_last_lazy() {
  const LazyKey& key = nodes_->lazy_cells.back().key;
  nodes_->lazy_index.erase(key);
  nodes_->lazy_made[key.family].pop_back();
  nodes_->lazy_cells.pop_back();
  drop_last_node();
}

void Structure::undo_last_expansion() {
  LazyCell& lazy = nodes_->lazy_cells[nodes_->lazy[nodes_->expanded.back()]];
  lazy.faces.clear();
  lazy.orders.clear();
  lazy.is_expanded = false;
  nodes_->expanded.pop_back();
}

void Structure::undo_last_event() {
  switch (journal_->pop()) {
    case EventKind::cell:
      return undo_last_cell();
    case EventKind::copy:
      return undo_last_copy();
    case EventKind::degenerate:
      return undo_last_degenerate();
    case EventKind::lazy:
      return undo_last_lazy();
    case EventKind::expansion:
      return undo_last_expansion();
    case EventKind::removal:
      return undo_last_link();
    case EventKind::move:
      return splits_.undo_last_move();
    case EventKind::family:
      return undo_last_family();
    case EventKind::cone:
      return cones_.pop_back();
    case EventKind::name:
      return drop_last_name();
    case EventKind::body:
      return bodies_.undo_last();
    case EventKind::union_of_bodies:
      return bodies_.undo_last_union();
    case EventKind::body_kind:
      return bodies_.undo_last_kind_change();
    case EventKind::simplicial:
      return abstract_.truncate(abstract_.mark() - 1);
  }
}

void Structure::truncate(Journal::Position position) {
  while (journal_->end() > position) {
    undo_last_event();
  }
}

}  // namespace sesame::ops

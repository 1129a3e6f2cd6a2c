#include "ops/cells/structure.hpp"

#include <algorithm>
#include <iterator>

namespace sesame::ops {

Structure::Structure()
    : types_{std::make_unique<TypeTable>()},
      maps_{std::make_unique<VertexMaps>(*types_)},
      nodes_{std::make_unique<Nodes>()},
      journal_{std::make_unique<Journal>()} {}
Structure::~Structure() = default;

std::span<const CellId> Structure::faces_as_created(CellId c) const {
  if (!families_.empty() && nodes_->lazy[c] != none) {
    LazyCell& lazy = nodes_->lazy_cells[nodes_->lazy[c]];
    if (!lazy.is_expanded) {
      for (const Incidence& face : faces_of_lazy(lazy.key)) {
        lazy.faces.push_back(face.node);
        lazy.orders.push_back(face.order);
        has_orders_ = has_orders_ || face.order != same_order;
      }
      lazy.is_expanded = true;
      note(EventKind::expansion, nodes_->expanded.size());
      nodes_->expanded.push_back(c);
    }
    return lazy.faces;
  }
  return {nodes_->faces.data() + nodes_->first_face[c], type(c).faces.size()};
}

std::span<const CellId> Structure::faces(CellId c) const {
  const SplitHistory::MovedFaces* moved = splits_.moved_faces(c);
  return moved != nullptr ? moved->faces : faces_as_created(c);
}

OrderId Structure::known_order_as_created(CellId c, std::uint32_t k) const {
  if (!families_.empty() && nodes_->lazy[c] != none) {
    (void)faces_as_created(c);
    return nodes_->lazy_cells[nodes_->lazy[c]].orders[k];
  }
  const auto at = face_orders_.find(nodes_->first_face[c] + k);
  return at == face_orders_.end() ? same_order : at->second;
}

OrderId Structure::known_order_of_face(CellId c, std::uint32_t k) const {
  const SplitHistory::MovedFaces* moved = splits_.moved_faces(c);
  return moved != nullptr ? moved->orders[k] : known_order_as_created(c, k);
}

OrderId Structure::order_of(LinkId link) const {
  const auto at = link_orders_.empty() ? link_orders_.end() : link_orders_.find(link);
  return at == link_orders_.end() ? same_order : at->second;
}

CellId Structure::find_at(CellId c, LinkId links) const {
  while (c != none && nodes_->parent[c] != c && nodes_->link_of[c] < links) {
    c = nodes_->parent[c];
  }
  // A node that was degenerate from the start has no link.
  return c != none && nodes_->parent[c] == none && nodes_->link_of[c] == none ? none : c;
}

Structure::Oriented Structure::find_oriented_at(CellId c, LinkId links) const {
  int sign = 1;
  for (CellId at = c; reversals_ != 0 && at != none && nodes_->link_of[at] < links; at = nodes_->parent[at]) {
    sign *= sign_of(nodes_->link_of[at]);
  }
  return {find_at(c, links), sign};
}

Structure::Oriented Structure::oriented_face_at(CellId c, std::uint32_t k, const Moment& moment) const {
  CellId node = faces_as_created(c)[k];
  int sign = face_sign(c, k);
  splits_.for_each_move_of(c, k, 0, moment.moves, [&](const MadeMove& made) {
    node = made.after;
    sign = sign_after(made);
  });
  const Oriented face = find_oriented_at(node, moment.links);
  return {face.cell, sign * face.sign};
}

LinkId Structure::links_before_step(LinkId link) const {
  return *std::prev(std::upper_bound(first_links_.begin(), first_links_.end(), link));
}

CellId Structure::last_root(CellId c) const {
  const std::vector<CellId>& parent = nodes_->parent;
  while (parent[c] != c && parent[c] != none) {
    c = parent[c];
  }
  return c;
}

bool Structure::was_current(CellId c, const Moment& moment) const {
  const LazyCell* lazy = lazy_of(c);
  if (lazy != nullptr ? lazy->key.family >= moment.families : c >= moment.created) {
    return false;
  }
  if (!families_.empty() && bodies_.consumed_by(nodes_->body[c]) < moment.families) {  // none is more than any
    return false;
  }
  return find_at(c, moment.links) == c;
}

Value Structure::value(CellId c) const { return normal_form({c, nodes_->type[c], 0}); }

/// Along the path of the forest: to a current cell, or to one that has become degenerate.
void Structure::advance_to_root(Value& v) const {
  if (link_orders_.empty()) {
    v.cell = last_root(v.cell);
    return;
  }
  for (CellId parent = nodes_->parent[v.cell]; parent != v.cell && parent != none; parent = nodes_->parent[v.cell]) {
    if (const OrderId order = order_of(nodes_->link_of[v.cell]); order != same_order) {
      v = maps_->compose(v, {parent, nodes_->type[parent], 0, order});
    }
    v.cell = parent;
  }
}

Value Structure::normal_form(Value v) const {
  advance_to_root(v);
  while (nodes_->parent[v.cell] == none) {
    v = maps_->compose(v, nodes_->squashed.at(v.cell));
    advance_to_root(v);
  }
  return v;
}

Value Structure::face_of_cell(CellId c, std::uint32_t k) const {
  const Value node = value(faces(c)[k]);
  const OrderId order = order_of_face(c, k);
  return order == same_order ? node : maps_->reordered(order, node);
}

Value Structure::face(const Value& v, std::uint32_t k) const {
  return maps_->face(v, k, [this](CellId c, std::uint32_t number) { return face_of_cell(c, number); });
}

Incidence Structure::incidence_of(const Value& v) const {
  if (!v.is_degenerate()) {
    return {v.cell, v.order};
  }
  if (const auto known = nodes_->degenerate_index.find(v); known != nodes_->degenerate_index.end()) {
    return {known->second};
  }
  const CellId node = add_node(v.type, none, none, nodes_->body[v.cell]);
  squash(node, v);
  nodes_->degenerate_index.emplace(v, node);
  note(EventKind::degenerate, node);
  return {node};
}

std::span<const std::uint64_t> Structure::counts() const {
  std::size_t used = counts_.size();
  while (used > 0 && counts_[used - 1] == 0) {
    --used;
  }
  return {counts_.data(), used};
}

/// The node whose faces contain an entry of the list of all faces.
CellId Structure::owner_of(std::uint32_t entry) const {
  const auto& first = nodes_->first_face;
  return static_cast<CellId>(std::upper_bound(first.begin(), first.end(), entry) - first.begin() - 1);
}

std::vector<std::pair<CellId, std::uint32_t>> Structure::places_of(CellId node, const Moment& since,
                                                                   std::size_t most) const {
  std::vector<std::pair<CellId, std::uint32_t>> places;
  for (std::uint32_t entry = nodes_->first_incidence[node]; entry != none && places.size() <= most;
       entry = nodes_->next_incidence[entry]) {  // the latest first
    const CellId owner = owner_of(entry);
    if (owner < since.created) {
      break;
    }
    places.emplace_back(owner, entry - static_cast<std::uint32_t>(nodes_->first_face[owner]));
  }
  const std::span<const std::uint32_t> onto = splits_.moves_onto(node);
  for (auto at = std::lower_bound(onto.begin(), onto.end(), since.moves); at != onto.end(); ++at) {
    places.emplace_back(splits_.moves()[*at].cell, splits_.moves()[*at].slot);
  }
  return places;
}

void Structure::add_cofaces(CellId current, std::vector<CellId>& out) const {
  std::vector<CellId> pending{current};  // and what is degenerate over it
  while (!pending.empty()) {
    const CellId root = pending.back();
    pending.pop_back();
    for_each_member(root, [&](CellId node) {
      for (std::uint32_t entry = nodes_->first_incidence[node]; entry != none; entry = nodes_->next_incidence[entry]) {
        out.push_back(owner_of(entry));
      }
      for (const std::uint32_t number : splits_.moves_onto(node)) {
        out.push_back(splits_.moves()[number].cell);
      }
      if (const auto over = nodes_->squashed_onto.find(node); over != nodes_->squashed_onto.end()) {
        pending.insert(pending.end(), over->second.begin(), over->second.end());
      }
      if (const LazyCell* lazy = lazy_of(node)) {
        add_lazy_cofaces(lazy->key, node, out);
      }
      for (FamilyId f = 0; f < families(); ++f) {
        if (families_[f].apex == node) {
          add_cofaces_of_apex(f, out);
        }
      }
    });
  }
}

std::vector<CellId> Structure::cofaces(CellId current) const {
  std::vector<CellId> candidates;
  add_cofaces(current, candidates);
  std::vector<CellId> cells;
  for (const CellId candidate : candidates) {
    const CellId c = find(candidate);
    if (c == none) {
      continue;
    }
    const auto nodes = faces(c);
    if (std::any_of(nodes.begin(), nodes.end(), [&](CellId node) { return value(node).cell == current; })) {
      cells.push_back(c);
    }
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  std::sort(cells.begin(), cells.end(), [this](CellId a, CellId b) { return is_older(oldest(a), oldest(b)); });
  return cells;
}

const Cone* Structure::cone_from(CellId apex) const {
  const auto found = std::lower_bound(cones_.begin(), cones_.end(), apex,
                                      [](const Cone& cone, CellId cell) { return cone.apex < cell; });
  return found != cones_.end() && found->apex == apex ? &*found : nullptr;
}

CellId Structure::oldest_at(CellId node, LinkId links) const {
  CellId oldest = nodes_->oldest[node];
  while (oldest != node) {
    LinkId joined = none;  // the removal that made it a member
    for (CellId at = oldest; at != node; at = nodes_->parent[at]) {
      joined = nodes_->link_of[at];
    }
    if (joined < links) {
      break;
    }
    oldest = links_[joined].oldest_before;
  }
  return oldest;
}

std::span<const CellId> Structure::squashed_onto(CellId node) const {
  const auto at = nodes_->squashed_onto.find(node);
  return at == nodes_->squashed_onto.end() ? std::span<const CellId>{} : at->second;
}

std::optional<BodyId> Structure::lookup_body(std::string_view name) const {
  const NameTable::Name* found = names_.find(name);
  if (found == nullptr || found->body == none) {
    return std::nullopt;
  }
  BodyId body = bodies_.find(found->body);
  for (FamilyId family = bodies_.consumed_by(body); family != none && families_[family].kind == FamilyKind::cone;
       family = bodies_.consumed_by(body)) {
    body = bodies_.find(families_[family].body);
  }
  return body;
}

std::vector<CellId> Structure::cells_of(BodyId body) const {
  std::vector<CellId> cells;
  std::vector<BodyId> pending{bodies_.find(body)};
  while (!pending.empty()) {
    const Bodies::Made& b = bodies_.made(pending.back());
    pending.pop_back();
    pending.insert(pending.end(), b.children.begin(), b.children.end());
    for (const Bodies::Range& range : b.cells) {
      for (CellId c = range.first; c < range.last; ++c) {
        if (is_current(c)) {
          cells.push_back(c);
        }
      }
    }
    if (b.family != none) {
      make_all_cells_of(b.family);
      const std::vector<CellId>& made = nodes_->lazy_made[b.family];
      std::copy_if(made.begin(), made.end(), std::back_inserter(cells), [this](CellId c) { return is_current(c); });
    }
  }
  std::sort(cells.begin(), cells.end(), [this](CellId a, CellId b) { return is_older(oldest(a), oldest(b)); });
  return cells;
}

Moment Structure::moment_at(Journal::Position position) const {
  const EventCounts since = journal_->counts_since(position);
  const auto less = [&since](std::uint32_t now, auto... kinds) {
    return static_cast<std::uint32_t>(now - (since[kinds] + ...));
  };
  return {less(created(), EventKind::cell, EventKind::copy, EventKind::degenerate, EventKind::lazy),
          less(links(), EventKind::removal), less(static_cast<std::uint32_t>(splits_.moves().size()), EventKind::move),
          less(families(), EventKind::family), less(splits_.copies(), EventKind::copy)};
}

}  // namespace sesame::ops

#include "ops/cells/structure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "ops/cells/name_reader.hpp"
#include "ops/cells/name_text.hpp"
#include "sparse/contract.hpp"

namespace sesame::ops {

using sparse::expects;

Structure::Structure()
    : types_{std::make_unique<TypeTable>()},
      maps_{std::make_unique<VertexMaps>(*types_)},
      nodes_{std::make_unique<Nodes>()},
      journal_{std::make_unique<Journal>()} {}
Structure::~Structure() = default;

// ------------------------------------------------------------------------------------------------------------- cells

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
  if (!moved_.empty()) {
    if (const auto moved = moved_.find(c); moved != moved_.end()) {
      return moved->second.faces;
    }
  }
  return faces_as_created(c);
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
  if (const auto moved = moved_.empty() ? moved_.end() : moved_.find(c); moved != moved_.end()) {
    return moved->second.orders[k];
  }
  return known_order_as_created(c, k);
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
  for_each_move_of(c, k, 0, moment.moves, [&](const MadeMove& made) {
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
  if (!families_.empty() && consumed_by(nodes_->body[c]) < moment.families) {  // none is more than any
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

const Structure::Copy* Structure::copy(CellId c) const {
  if (copies_.empty()) {
    return nullptr;
  }
  const auto at = copy_index_.find(c);
  return at == copy_index_.end() ? nullptr : &copies_[at->second];
}

std::span<const CellId> Structure::copies_of(CellId source) const {
  const auto at = copies_of_.find(source);
  return at == copies_of_.end() ? std::span<const CellId>{} : at->second;
}

// ---------------------------------------------------------------------------------------------------------- cofaces

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
  if (const auto onto = moved_onto_.find(node); onto != moved_onto_.end()) {
    const std::vector<std::uint32_t>& numbers = onto->second;
    for (auto at = std::lower_bound(numbers.begin(), numbers.end(), since.moves); at != numbers.end(); ++at) {
      places.emplace_back(moves_[*at].cell, moves_[*at].slot);
    }
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
      if (const auto onto = moved_onto_.find(node); onto != moved_onto_.end()) {
        for (const std::uint32_t number : onto->second) {
          out.push_back(moves_[number].cell);
        }
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

/// The cells of a lazy cone that have the apex as a face: over vertices, and over all when the far end is squashed.
void Structure::add_cofaces_of_apex(FamilyId id, std::vector<CellId>& out) const {
  const LazyFamily& family = families_[id];
  for (const BodyId body : family.bodies) {
    for (const CellId c : cells_of(body)) {
      if (family.by_edges || dimension(c) == 0) {
        out.push_back(lazy_cell(id, LazyPart::coned, {c, nodes_->type[c], 0}));
      }
    }
  }
}

/// Candidates for the cofaces, within its family, of a lazy cell.
void Structure::add_lazy_cofaces(const LazyKey& key, CellId cell, std::vector<CellId>& out) const {
  const LazyFamily& family = families_[key.family];
  const auto as_value = [this](CellId c) { return Value{c, nodes_->type[c], 0}; };
  if (family.kind == FamilyKind::cone) {
    for (const CellId coface : cofaces(key.left.cell)) {
      out.push_back(lazy_cell(key.family, key.part, as_value(coface)));
    }
    if (key.part == LazyPart::base) {
      out.push_back(lazy_cell(key.family, LazyPart::coned, key.left));
    }
    return;
  }
  if (family.kind == FamilyKind::product) {
    for (const CellId coface : cofaces(key.left.cell)) {
      out.push_back(lazy_cell(key.family, LazyPart::pair, as_value(coface), key.right));
    }
    for (const CellId coface : cofaces(key.right.cell)) {
      out.push_back(lazy_cell(key.family, LazyPart::pair, key.left, as_value(coface)));
    }
    return;
  }
  std::vector<CellId> lefts = cofaces(key.left.cell);
  std::vector<CellId> rights = cofaces(key.right.cell);
  lefts.push_back(key.left.cell);
  rights.push_back(key.right.cell);
  for (const CellId left : lefts) {
    for (const CellId right : rights) {  // a face may be degenerate over the cell: any larger dimension
      const int p = dimension(left);
      const int q = dimension(right);
      for (int n = dimension(cell) + 1; n <= p + q; ++n) {
        for_each_pair_of_degeneracies(n, p, q, [&](Degeneracy l, Degeneracy r) {
          const TypeId type = types_->simplex(n);
          out.push_back(lazy_cell(key.family, LazyPart::pair, {left, type, l}, {right, type, r}));
        });
      }
    }
  }
}

// -------------------------------------------------------------------------------------------------------- lazy cells

Incidence Structure::lazy_face(FamilyId family, LazyPart part, const Value& left, const Value& right) const {
  const LazyFamily& f = families_[family];
  LazyKey key{family, part, left, right};
  Value made;  // the value that the cell has: collapsed directions of its own
  if (part == LazyPart::pair && f.kind == FamilyKind::simplicial_product) {
    made.type = left.type;
    made.collapsed = left.collapsed & right.collapsed;
    const Degeneracy common = made.collapsed;
    const TypeId type = types_->simplex(types_->info(left.type).dimension - std::popcount(common));
    key.left = {left.cell, type, without(left.collapsed, common)};
    key.right = {right.cell, type, without(right.collapsed, common)};
    made.cell = type;  // for now: the type of the cell underneath
  } else {
    key.left = {left.cell, nodes_->type[left.cell], 0};
    made = left;
    made.cell = key.left.type;
    if (part == LazyPart::pair) {
      key.right = {right.cell, nodes_->type[right.cell], 0};
      made = maps_->product(types_->product(key.left.type, key.right.type), left, right);
    } else if (part == LazyPart::coned) {
      made = maps_->coned(types_->coned(key.left.type, f.by_edges), left, f.by_edges);
    }
  }
  const TypeId type = std::exchange(made.cell, none);
  if (const auto known = nodes_->lazy_index.find(key); known != nodes_->lazy_index.end()) {
    made.cell = known->second;
  } else {
    made.cell = add_node(type, none, static_cast<std::uint32_t>(nodes_->lazy_cells.size()), f.body);
    nodes_->lazy_cells.push_back({key});
    nodes_->lazy_index.emplace(key, made.cell);
    nodes_->lazy_made[family].push_back(made.cell);
    note(EventKind::lazy, made.cell);
  }
  return made.is_degenerate() ? incidence_of(normal_form(made)) : Incidence{made.cell, made.order};
}

std::vector<Incidence> Structure::faces_of_lazy(const LazyKey& key) const {
  const LazyFamily& family = families_[key.family];
  const auto arity = [this](const Value& v) { return static_cast<std::uint32_t>(types_->info(v.type).faces.size()); };
  std::vector<Incidence> faces;
  switch (key.part) {
    case LazyPart::pair:
      if (family.kind == FamilyKind::simplicial_product) {
        for (std::uint32_t k = 0; k < arity(key.left); ++k) {
          faces.push_back(lazy_face(key.family, key.part, face(key.left, k), face(key.right, k)));
        }
        break;
      }
      for (std::uint32_t k = 0; k < arity(key.left); ++k) {
        faces.push_back(lazy_face(key.family, key.part, face(key.left, k), key.right));
      }
      for (std::uint32_t k = 0; k < arity(key.right); ++k) {
        faces.push_back(lazy_face(key.family, key.part, key.left, face(key.right, k)));
      }
      break;
    case LazyPart::base:
      for (std::uint32_t k = 0; k < arity(key.left); ++k) {
        faces.push_back(lazy_face(key.family, key.part, face(key.left, k)));
      }
      break;
    case LazyPart::coned:
      for (std::uint32_t k = 0; k < arity(key.left); ++k) {
        faces.push_back(lazy_face(key.family, key.part, face(key.left, k)));
      }
      if (const int p = dimension(key.left.cell); p == 0) {
        faces.push_back({family.apex});
      } else if (family.by_edges) {
        faces.push_back(incidence_of(normal_form({family.apex, key.left.type, (Degeneracy{1} << p) - 1})));
      }
      faces.push_back(lazy_face(key.family, LazyPart::base, key.left));
      break;
  }
  return faces;
}

void Structure::make_all_cells_of(FamilyId id) const {
  const LazyFamily& family = families_[id];
  const auto as_value = [this](CellId c) { return Value{c, nodes_->type[c], 0}; };
  if (family.kind == FamilyKind::cone) {
    for (const BodyId body : family.bodies) {
      for (const CellId c : cells_of(body)) {
        (void)lazy_cell(id, LazyPart::base, as_value(c));
        (void)lazy_cell(id, LazyPart::coned, as_value(c));
      }
    }
    return;
  }
  const std::vector<CellId> lefts = cells_of(family.bodies[0]);
  const std::vector<CellId> rights = cells_of(family.bodies[1]);
  for (const CellId left : lefts) {
    for (const CellId right : rights) {
      if (family.kind == FamilyKind::product) {
        (void)lazy_cell(id, LazyPart::pair, as_value(left), as_value(right));
        continue;
      }
      const int p = dimension(left);
      const int q = dimension(right);
      for (int n = std::max(p, q); n <= p + q; ++n) {
        for_each_pair_of_degeneracies(n, p, q, [&](Degeneracy l, Degeneracy r) {
          const TypeId type = types_->simplex(n);
          (void)lazy_cell(id, LazyPart::pair, {left, type, l}, {right, type, r});
        });
      }
    }
  }
}

void Structure::make_all_lazy_cells() const {
  for (FamilyId f = 0; f < families(); ++f) {
    make_all_cells_of(f);
  }
}

// ------------------------------------------------------------------------------------------------------------- names

std::string_view Structure::own_name(CellId c) const {
  if (nodes_->name[c] != none) {
    return names_[nodes_->name[c]].text;
  }
  if (families_.empty() || nodes_->lazy[c] == none) {
    return "(degenerate)";  // a node that no name can denote
  }
  LazyCell& lazy = nodes_->lazy_cells[nodes_->lazy[c]];
  if (lazy.name.empty()) {
    lazy.name = lazy_name(lazy.key);
  }
  return lazy.name;
}

std::string Structure::lazy_name(const LazyKey& key) const {
  const LazyFamily& family = families_[key.family];
  const auto written = [this](const Value& v) {
    std::string text{name(v.cell)};
    const char* separator = "^";
    for (int d = 0; d <= largest_dimension; ++d) {
      if ((v.collapsed >> d & 1) != 0) {
        text += separator + std::to_string(d);
        separator = ",";
      }
    }
    return text;
  };
  switch (key.part) {
    case LazyPart::base:
      return written(key.left);
    case LazyPart::coned:
      return fmt::format("{}*{}", family.name, written(key.left));
    case LazyPart::pair:
      break;
  }
  return fmt::format("{}.({}|{})", family.name, written(key.left), written(key.right));
}

namespace {

/// Calls visit(prefix, hash) for the parts of a name before which that of a lazy family may end.
template <class Visit>
void for_each_prefix(std::string_view name, Visit visit) {
  TextHash hash;
  for (std::size_t k = 0; k < name.size(); ++k) {
    if (ends_prefix(name, k)) {
      visit(name.substr(0, k), hash);
    }
    hash.add(name[k]);
  }
}

}  // namespace

std::optional<Incidence> Structure::lookup_in_order(std::string_view name) const {
  const auto named = NameReader(*this, name).read();
  if (!named) {
    return std::nullopt;
  }
  Incidence found = named->is_degenerate() ? incidence_of(normal_form(*named)) : Incidence{named->cell, named->order};
  while (is_consumed(found.node)) {
    const FamilyId family = consumed_by(nodes_->body[found.node]);
    if (families_[family].kind != FamilyKind::cone) {
      break;
    }
    found = lazy_face(family, LazyPart::base, maps_->reordered(found.order, value(found.node)));
  }
  return found;
}

bool Structure::is_name_taken(std::string_view name) const {
  return names_.find(name) != nullptr || NameReader(*this, name).read().has_value();
}

OrderId Structure::order_of_name(std::string_view name) const {
  const auto found = lookup_in_order(name);
  return found ? found->order : same_order;
}

Value Structure::named_value(CellId current) const {
  const CellId node = oldest(current);
  return maps_->reordered(order_of_own_name(node), value(node));
}

/// The name of a lazy cell has the names of others in it.
OrderId Structure::order_of_own_name(CellId node) const {
  const LazyCell* lazy = lazy_of(node);
  if (lazy == nullptr) {
    const auto at = name_orders_.empty() ? name_orders_.end() : name_orders_.find(node);
    return at == name_orders_.end() ? same_order : at->second;
  }
  const Value left = named_value(lazy->key.left.cell);
  switch (lazy->key.part) {
    case LazyPart::base:
      return left.order;
    case LazyPart::coned:
      return maps_->coned(none, left, families_[lazy->key.family].by_edges).order;
    case LazyPart::pair:
      break;
  }
  return families_[lazy->key.family].kind == FamilyKind::product
             ? maps_->product(none, left, named_value(lazy->key.right.cell)).order
             : same_order;
}

bool Structure::is_prefix_taken(std::string_view prefix) const {
  TextHash hash;
  hash.add(prefix);
  if (!prefixes_.contains(hash.word())) {
    return false;
  }
  for (std::uint32_t k = 0; k < names_.size(); ++k) {  // hardly ever in vain: hashes have 64 bits
    if (extends_name(names_[k].text, prefix)) {
      return true;
    }
  }
  return false;
}

bool Structure::is_ambiguous_prefix(std::string_view name) const {
  bool is_ambiguous = false;
  for_each_prefix(name, [&](std::string_view prefix, const TextHash& hash) {
    const NameTable::Name* known = names_.find(prefix, hash.value());
    is_ambiguous = is_ambiguous || (known != nullptr && (product_named(*known) != none ||
                                                         (known->cell != none && cone_from(known->cell) != nullptr)));
  });
  const auto extends = [&](std::string_view other) { return extends_name(other, name); };
  return is_ambiguous ||
         (is_prefix_taken(name) &&
          (std::any_of(cones_.begin(), cones_.end(), [&](const Cone& cone) { return extends(own_name(cone.apex)); }) ||
           std::any_of(families_.begin(), families_.end(),
                       [&](const LazyFamily& family) { return extends(family.name); })));
}

void Structure::add_name(std::string_view text, CellId cell, BodyId body) {
  if (!is_well_bracketed(text)) {
    odd_names_.push_back(names_.size());
  }
  names_.add(text, cell, body);
  for_each_prefix(text, [this](std::string_view, const TextHash& hash) { ++prefixes_[hash.word()]; });
}

void Structure::drop_last_name() {
  const std::uint32_t last = names_.size() - 1;
  for_each_prefix(names_[last].text, [this](std::string_view, const TextHash& hash) {
    if (const auto at = prefixes_.find(hash.word()); --at->second == 0) {
      prefixes_.erase(at);
    }
  });
  if (!odd_names_.empty() && odd_names_.back() == last) {
    odd_names_.pop_back();
  }
  names_.pop_back();
}

FamilyId Structure::product_named(const NameTable::Name& name) const {
  const FamilyId family = name.cell == none && name.body != none ? bodies_[name.body].family : none;
  return family != none && families_[family].kind != FamilyKind::cone ? family : none;
}

// ------------------------------------------------------------------------------------------------------------- cones

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

// ------------------------------------------------------------------------------------------------------------- ages

/// Negative when a is older, positive when b is.
int Structure::compare_age(CellId a, CellId b) const {
  const LazyCell* x = lazy_of(a);
  const LazyCell* y = lazy_of(b);
  while (x != nullptr && x->key.part == LazyPart::base) {
    a = oldest(x->key.left.cell);
    x = lazy_of(a);
  }
  while (y != nullptr && y->key.part == LazyPart::base) {
    b = oldest(y->key.left.cell);
    y = lazy_of(b);
  }
  const auto compare = [](auto m, auto n) { return m < n ? -1 : m > n ? 1 : 0; };
  const auto created = [this](CellId c, const LazyCell* lazy) {
    return lazy == nullptr ? 2 * std::uint64_t{c} + 1 : 2 * std::uint64_t{families_[lazy->key.family].first};
  };
  if (const int order = compare(created(a, x), created(b, y)); order != 0 || x == nullptr || y == nullptr) {
    return order;
  }
  if (const int order = compare(x->key.family, y->key.family); order != 0) {
    return order;
  }
  if (x->key.part == LazyPart::coned) {
    if (const int order = compare(dimension(a), dimension(b)); order != 0) {
      return order;
    }
  }
  if (x->key.left.cell != y->key.left.cell) {
    return compare_age(oldest(x->key.left.cell), oldest(y->key.left.cell));
  }
  if (x->key.right.cell != y->key.right.cell) {
    return compare_age(oldest(x->key.right.cell), oldest(y->key.right.cell));
  }
  const int order = compare(x->key.left.collapsed, y->key.left.collapsed);
  return order != 0 ? order : compare(x->key.right.collapsed, y->key.right.collapsed);
}

// ------------------------------------------------------------------------------------------------------------ bodies

std::optional<BodyId> Structure::lookup_body(std::string_view name) const {
  const NameTable::Name* found = names_.find(name);
  if (found == nullptr || found->body == none) {
    return std::nullopt;
  }
  BodyId body = find_body(found->body);
  while (bodies_[body].consumed_by != none && families_[bodies_[body].consumed_by].kind == FamilyKind::cone) {
    body = find_body(families_[bodies_[body].consumed_by].body);
  }
  return body;
}

BodyId Structure::find_body(BodyId b) const {
  while (bodies_[b].parent != b) {
    b = bodies_[b].parent;
  }
  return b;
}

std::vector<BodyId> Structure::current_bodies() const {
  std::vector<BodyId> current;
  for (BodyId b = 0; b < bodies_.size(); ++b) {
    if (bodies_[b].parent == b && bodies_[b].consumed_by == none) {
      current.push_back(b);
    }
  }
  std::sort(current.begin(), current.end(),
            [this](BodyId a, BodyId b) { return bodies_[a].oldest < bodies_[b].oldest; });
  return current;
}

std::vector<CellId> Structure::cells_of(BodyId body) const {
  std::vector<CellId> cells;
  std::vector<BodyId> pending{find_body(body)};
  while (!pending.empty()) {
    const Body& b = bodies_[pending.back()];
    pending.pop_back();
    pending.insert(pending.end(), b.children.begin(), b.children.end());
    for (const Range& range : b.made) {
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

// ------------------------------------------------------------------------------------------------------------ change

Moment Structure::moment_at(Journal::Position position) const {
  const EventCounts since = journal_->counts_since(position);
  const auto less = [&since](std::uint32_t now, auto... kinds) {
    return static_cast<std::uint32_t>(now - (since[kinds] + ...));
  };
  return {less(created(), EventKind::cell, EventKind::copy, EventKind::degenerate, EventKind::lazy),
          less(links(), EventKind::removal), less(static_cast<std::uint32_t>(moves_.size()), EventKind::move),
          less(families(), EventKind::family), less(copies(), EventKind::copy)};
}

void Structure::apply(const Plan& plan) {
  const CellId first = created();
  expects(plan.cells.empty() || plan.first == first, "a plan is carried out in the state that it was made for");
  const auto new_body = plan.new_body || plan.family ? static_cast<BodyId>(bodies_.size()) : none;
  if (new_body != none) {
    note(EventKind::body, new_body);
    bodies_.emplace_back();
    bodies_.back().name = none;
    bodies_.back().parent = bodies_.back().oldest = new_body;
    bodies_.back().kind = {plan.abstract.has_value(), true};
  }
  const Instant made = instant_of(links(), families());
  for (const Plan::WrittenCone& cone : plan.cones) {
    note(EventKind::cone, cones_.size());
    cones_.push_back({first + cone.apex, first + cone.end, made, links(), none, cone.by_edges});
  }
  add_cells(plan, new_body);
  if (plan.family) {
    add_family(*plan.family, new_body);
  }
  if (created() > first && plan.sources.empty()) {
    bodies_[new_body != none ? new_body : plan.into_body.value()].made.push_back({first, created()});
  }
  for (const BodyId joined : plan.joined_bodies) {
    join_bodies(plan.into_body.value(), joined);
  }
  for (const Move& move : plan.moves) {
    make_move(move);
  }
  if (!plan.merges.empty()) {
    first_links_.push_back(links());
  }
  for (const Merge& merge : plan.merges) {
    link(merge);
    if (merge.survivor != none) {
      join_bodies(body_of(merge.survivor), body_of(merge.removed));
    } else {
      join_bodies(body_of(merge.becomes.cell), body_of(merge.removed));
    }
  }
  if (plan.abstract) {
    change_abstract(plan, first);
  } else if (!abstract_.empty()) {
    leave_abstract(plan);
  }
  if (has_orders_) {
    note_orders(plan, first);
  }
}

/// Bodies where a cell and its faces do not have their vertices in the same order any more.
void Structure::note_orders(const Plan& plan, CellId first) {
  const auto lower = [this](BodyId body) { lower_kind(body, {kind_of(body).is_abstract, false}); };
  if (!plan.face_orders.empty()) {
    lower(body_of(first));
  }
  for (const Merge& merge : plan.merges) {
    if (merge.order != same_order || (merge.survivor == none && merge.becomes.order != same_order)) {
      lower(body_of(merge.removed));
    }
  }
  if (plan.family) {
    for (const BodyId body : plan.family->bodies) {
      if (!kind_of(body).keeps_orders) {
        lower(static_cast<BodyId>(bodies_.size()) - 1);
      }
    }
  }
}

void Structure::change_abstract(const Plan& plan, CellId first) {
  const AbstractChange& change = *plan.abstract;
  const std::uint32_t changes_before = abstract_.mark();
  for (const std::string& label : change.labels) {
    abstract_.add_label(label);
  }
  std::span<const VertexId> vertices = change.vertices;
  for (CellId c = first; c < created(); ++c) {
    const auto size = static_cast<std::size_t>(dimension(c)) + 1;
    abstract_.add(c, vertices.first(size));
    vertices = vertices.subspan(size);
  }
  if (const auto& collapse = change.collapse) {
    for (const Merge& merge : plan.merges) {
      abstract_.remove(merge.removed);
    }
    for (const CellId c : change.renamed) {
      abstract_.replace(c, collapse->gone, collapse->kept);
    }
    abstract_.join_labels(collapse->from, collapse->to, collapse->kept);
  }
  for (std::uint32_t k = changes_before; k < abstract_.mark(); ++k) {
    note(EventKind::simplicial, k);
  }
}

/// The bodies that another operation changes are no abstract complexes any more.
void Structure::leave_abstract(const Plan& plan) {
  const auto leave = [this](BodyId body) { lower_kind(body, {false, kind_of(body).keeps_orders}); };
  for (const Merge& merge : plan.merges) {
    leave(body_of(merge.removed));
  }
  for (const CellId source : plan.sources) {
    leave(body_of(source));
  }
  for (const Move& move : plan.moves) {
    leave(body_of(move.cell));
  }
  if (plan.into_body) {
    leave(*plan.into_body);
  }
  if (plan.family) {
    for (const BodyId body : plan.family->bodies) {
      leave(body);
    }
  }
}

void Structure::lower_kind(BodyId body, BodyKind kind) {
  body = find_body(body);
  if (!(bodies_[body].kind == kind)) {
    note(EventKind::body_kind, kind_changes_.size());
    kind_changes_.push_back({body, bodies_[body].kind});
    bodies_[body].kind = kind;
  }
}

void Structure::undo_last_kind_change() {
  bodies_[kind_changes_.back().body].kind = kind_changes_.back().before;
  kind_changes_.pop_back();
}

CellId Structure::add_node(TypeId type, std::uint32_t name, std::uint32_t lazy, BodyId body) const {
  Nodes& n = *nodes_;
  const CellId id = created();
  n.type.push_back(type);
  n.first_face.push_back(n.faces.size());
  n.first_incidence.push_back(none);
  n.parent.push_back(id);
  n.oldest.push_back(id);
  n.size.push_back(1);
  n.link_of.push_back(none);
  n.last_child.push_back(none);
  n.name.push_back(name);
  n.lazy.push_back(lazy);
  n.body.push_back(body);
  return id;
}

void Structure::squash(CellId node, const Value& becomes) const {
  nodes_->parent[node] = none;
  nodes_->squashed.emplace(node, becomes);
  nodes_->squashed_onto[becomes.cell].push_back(node);
}

/// Requires: the node was squashed last of those that are still degenerate over the same node.
void Structure::unsquash(CellId node) const {
  const auto squashed = nodes_->squashed.find(node);
  nodes_->squashed_onto.at(squashed->second.cell).pop_back();
  nodes_->squashed.erase(squashed);
  nodes_->parent[node] = node;
}

void Structure::add_cells(const Plan& plan, BodyId new_body) {
  std::size_t name_begin = 0;
  auto next_degenerate = plan.degenerate.begin();
  auto next_order = plan.face_orders.begin();
  auto next_name = plan.name_orders.begin();
  for (std::size_t k = 0; k < plan.cells.size(); ++k) {
    const Plan::NewCell& cell = plan.cells[k];
    if (next_degenerate != plan.degenerate.end() && next_degenerate->first == k) {
      (void)incidence_of(next_degenerate->second);
      ++next_degenerate;
      continue;
    }
    const TypeInfo& type = types_->info(cell.type);
    const CellId source = plan.sources.empty() ? none : plan.sources[k];
    const BodyId body = source != none ? body_of(source) : new_body != none ? new_body : plan.into_body.value();
    const CellId id = add_node(cell.type, names_.size(), none, body);
    for (std::size_t f = 0; f < type.faces.size(); ++f) {
      const CellId face = plan.faces[cell.first_face + f];
      const auto entry = static_cast<std::uint32_t>(nodes_->faces.size());
      if (next_order != plan.face_orders.end() && next_order->first == cell.first_face + f) {
        face_orders_.emplace(entry, next_order->second);
        has_orders_ = true;
        ++next_order;
      }
      nodes_->faces.push_back(face);
      nodes_->next_incidence.push_back(std::exchange(nodes_->first_incidence[face], entry));
    }
    const std::string_view name = std::string_view{plan.names}.substr(name_begin, cell.name_end - name_begin);
    if (plan.new_body && name == *plan.new_body) {  // the name of the whole, or of the first vertex, is the body's too
      bodies_[new_body].name = names_.size();
      add_name(name, id, new_body);
    } else {
      add_name(name, id, none);
    }
    name_begin = cell.name_end;
    count(id, 1);
    if (source != none) {
      if (next_name != plan.name_orders.end() && next_name->first == k) {
        name_orders_.emplace(id, next_name->second);
        has_orders_ = true;
        ++next_name;
      }
      bodies_[body].made.push_back({id, id + 1});
      copy_index_.emplace(id, copies());
      copies_.push_back({id,
                         source,
                         {id - static_cast<CellId>(k), links(), static_cast<std::uint32_t>(moves_.size()), families(),
                          copies() - static_cast<std::uint32_t>(k)}});
      copies_of_[source].push_back(id);
    }
    note(source == none ? EventKind::cell : EventKind::copy, id);
  }
  for (const auto& [name, cell] : plan.aliases) {
    note(EventKind::name, names_.size());
    add_name(name, cell, none);
  }
  if (plan.new_body && bodies_[new_body].name == none) {
    note(EventKind::name, names_.size());
    bodies_[new_body].name = names_.size();
    add_name(*plan.new_body, none, new_body);
  }
}

void Structure::add_family(const NewFamily& family, BodyId body) {
  const auto id = families();
  families_.push_back({family.kind, family.name, family.bodies, family.by_edges,
                       family.kind == FamilyKind::cone ? created() - 1 : none, created(), links(), body,
                       family.counts});
  note(EventKind::family, id);
  nodes_->lazy_made.emplace_back();
  if (family.kind == FamilyKind::cone) {
    cones_.push_back({created() - 1, created(), instant_of(links(), id), links(), id, family.by_edges});
  }
  Body& made = bodies_[body];
  made.family = id;
  for (const BodyId b : family.bodies) {
    if (bodies_[b].consumed_by == none) {  // a factor may be there twice
      bodies_[b].consumed_by = id;
      add_counts(bodies_[b].counts, counts_, true);
    }
    made.nesting = std::max(made.nesting, bodies_[b].nesting + 1);
    if (family.kind == FamilyKind::cone) {
      made.oldest = std::min(made.oldest, bodies_[b].oldest);
    }
  }
  made.simploids = family.simploids;
  add_counts(family.counts, made.counts, false);
  add_counts(family.counts, counts_, false);
}

void Structure::undo_last_family() {
  const LazyFamily& family = families_.back();
  add_counts(family.counts, counts_, true);
  bodies_[family.body].simploids = 0;
  add_counts(family.counts, bodies_[family.body].counts, true);
  for (const BodyId b : family.bodies) {
    if (bodies_[b].consumed_by != none) {
      bodies_[b].consumed_by = none;
      add_counts(bodies_[b].counts, counts_, false);
    }
  }
  nodes_->lazy_made.pop_back();
  if (family.kind == FamilyKind::cone) {
    cones_.pop_back();
  }
  families_.pop_back();
}

void Structure::link(const Merge& merge) {
  const auto& [removed, survivor, becomes, order] = merge;
  expects(is_current(removed) && removed != survivor && (survivor == none || is_current(survivor)),
          "a merge joins two current cells");
  Nodes& n = *nodes_;
  note(EventKind::removal, links());
  n.link_of[removed] = links();
  count(removed, -1);
  const bool reverses = maps_->sign(order) < 0;
  reverses_.push_back(reverses);
  reversals_ += reverses ? 1 : 0;
  has_orders_ = has_orders_ || order != same_order || becomes.order != same_order;
  if (order != same_order) {
    link_orders_.emplace(links(), order);
  }
  if (survivor == none) {
    links_.push_back({removed, none, none});
    squash(removed, becomes);
    return;
  }
  links_.push_back({removed, n.oldest[survivor], n.last_child[survivor]});
  n.last_child[survivor] = links() - 1;
  n.parent[removed] = survivor;
  n.size[survivor] += n.size[removed];
  if (is_older(n.oldest[removed], n.oldest[survivor])) {
    n.oldest[survivor] = n.oldest[removed];
  }
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

void Structure::make_move(const Move& move) {
  const auto number = static_cast<std::uint32_t>(moves_.size());
  MovedFaces& moved = moved_[move.cell];
  if (moved.faces.empty()) {
    const auto faces = faces_as_created(move.cell);
    moved.faces.assign(faces.begin(), faces.end());
    for (std::uint32_t k = 0; k < faces.size(); ++k) {
      moved.orders.push_back(order_as_created(move.cell, k));
    }
  }
  moved.history.push_back(number);
  has_orders_ = has_orders_ || move.order != same_order;
  const OrderId order_before = std::exchange(moved.orders[move.slot], move.order);
  moves_.push_back({move.cell, move.slot, std::exchange(moved.faces[move.slot], move.to), move.to, links(),
                    order_before, move.order});
  moved_onto_[move.to].push_back(number);
  note(EventKind::move, number);
}

void Structure::undo_last_move() {
  const MadeMove& made = moves_.back();
  const auto moved = moved_.find(made.cell);
  moved->second.faces[made.slot] = made.before;
  moved->second.orders[made.slot] = made.order_before;
  moved->second.history.pop_back();
  if (moved->second.history.empty()) {
    moved_.erase(moved);
  }
  const auto onto = moved_onto_.find(made.after);
  onto->second.pop_back();
  if (onto->second.empty()) {
    moved_onto_.erase(onto);
  }
  moves_.pop_back();
}

void Structure::join_bodies(BodyId a, BodyId b) {
  a = find_body(a);
  b = find_body(b);
  if (a == b) {
    return;
  }
  if (bodies_[a].size < bodies_[b].size) {
    std::swap(a, b);
  }
  note(EventKind::union_of_bodies, body_links_.size());
  body_links_.push_back({b, bodies_[a].oldest, bodies_[a].kind, bodies_[a].nesting});
  bodies_[a].kind = {bodies_[a].kind.is_abstract && bodies_[b].kind.is_abstract,
                     bodies_[a].kind.keeps_orders && bodies_[b].kind.keeps_orders};
  bodies_[a].nesting = std::max(bodies_[a].nesting, bodies_[b].nesting);
  bodies_[b].parent = a;
  bodies_[a].children.push_back(b);
  bodies_[a].size += bodies_[b].size;
  bodies_[a].oldest = std::min(bodies_[a].oldest, bodies_[b].oldest);
  bodies_[a].simploids += bodies_[b].simploids;
  add_counts(bodies_[b].counts, bodies_[a].counts, false);
}

void Structure::undo_last_body_link() {
  const BodyLink link = body_links_.back();
  body_links_.pop_back();
  Body& child = bodies_[link.child];
  Body& above = bodies_[child.parent];
  above.simploids -= child.simploids;
  add_counts(child.counts, above.counts, true);
  above.children.pop_back();
  above.size -= child.size;
  above.oldest = link.oldest_before;
  above.kind = link.kind_before;
  above.nesting = link.nesting_before;
  child.parent = link.child;
}

void Structure::count(CellId c, int change) {
  const auto p = static_cast<std::size_t>(dimension(c));
  for (std::vector<std::uint64_t>* counts : {&counts_, &bodies_[body_of(c)].counts}) {
    if (p >= counts->size()) {
      counts->resize(p + 1, 0);
    }
    (*counts)[p] += static_cast<std::uint64_t>(static_cast<std::int64_t>(change));
  }
  if (!is_simplex(type(c).type)) {
    bodies_[body_of(c)].simploids += static_cast<std::uint64_t>(static_cast<std::int64_t>(change));
  }
}

void Structure::add_counts(std::span<const std::uint64_t> from, std::vector<std::uint64_t>& to, bool subtract) {
  if (to.size() < from.size()) {
    to.resize(from.size(), 0);
  }
  for (std::size_t p = 0; p < from.size(); ++p) {
    to[p] = subtract ? to[p] - from[p] : to[p] + from[p];
  }
}

void Structure::drop_last_node() {
  Nodes& n = *nodes_;
  const CellId c = created() - 1;
  if (std::vector<Range>& made = bodies_[n.body[c]].made; !made.empty() && made.back().last == c + 1) {
    made.back().last = c;
    if (made.back().first == c) {
      made.pop_back();
    }
  }
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
  const auto of = copies_of_.find(copies_.back().source);
  of->second.pop_back();
  if (of->second.empty()) {
    copies_of_.erase(of);
  }
  copy_index_.erase(c);
  copies_.pop_back();
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
      return undo_last_move();
    case EventKind::family:
      return undo_last_family();
    case EventKind::cone:
      return cones_.pop_back();
    case EventKind::name:
      return drop_last_name();
    case EventKind::body:
      return bodies_.pop_back();
    case EventKind::union_of_bodies:
      return undo_last_body_link();
    case EventKind::body_kind:
      return undo_last_kind_change();
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
